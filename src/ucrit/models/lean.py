"""Axes: x forward along the track, y to the right, z down; the ground point below the upright centre of mass
runs along x with speed U. Lean, yaw rate and steer angles are positive to the right. SI units and radians.

The wheels do not slip sideways, so the steer angles give the ground point's lateral velocity V and yaw rate r.
p is the momentum of Lagrange's equation for the lean angle, dT/d(theta'): with it in place of the lean rate the
equations hold the steer angles, not their rates, and a steer angle may jump. A wheel across the track would have to
turn the vehicle on the spot: a motion ends there.
"""

from types import MappingProxyType

from ..core import Drawing, Model, cos, event, input, output, param, sin, speed, state
from ..parts.rigid_body import inertia_tensor, possible_inertia
from ..parts.rolling import rolling_motion
from ..parts.shapes import leaning


class Lean(Model):
    """Two-wheeler steered at both ends that leans as it likes (Karnopp 2004, sections 7.II and 7.III)."""

    m: float = param("kg", "mass with rider", above=0)
    h: float = param("m", "height of the centre of mass", above=0)
    I_1: float = param("kg m^2", "roll moment of inertia about the centre of mass", above=0)
    I_2: float = param("kg m^2", "pitch moment of inertia about the centre of mass", above=0)
    I_3: float = param("kg m^2", "yaw moment of inertia about the centre of mass", above=0)
    a: float = param("m", "centre of mass to front axle", above=0)
    b: float = param("m", "centre of mass to rear axle", above=0)
    g: float = param("m/s^2", "gravity", above=0, default=9.80665)
    U: float = speed("forward speed")

    theta = state("rad", "lean angle", motion="lean")
    p = state("kg m^2/s", "lean momentum about the line on the ground", motion="lean")

    mode_names = MappingProxyType({"lean divergence": "capsize divergence"})

    delta_f = input("rad", "front steer angle")
    delta_r = input("rad", "rear steer angle")

    V = output("m/s", "lateral velocity of the ground point")
    r = output("rad/s", "yaw rate")

    def possible(self):
        return possible_inertia("I_1, I_2, I_3", inertia_tensor(self.I_1, self.I_2, self.I_3))

    def rolling(self, u):
        return rolling_motion(self.U, self.a, self.b, u.delta_f, u.delta_r)

    def equations(self, x, dx, u):
        V, r = self.rolling(u)
        sine, cosine = sin(x.theta), cos(x.theta)
        forward = self.U - r * self.h * sine
        momentum = (self.I_1 + self.m * self.h**2) * dx.theta + self.m * self.h * V * cosine
        slope_of_kinetic_energy = (
            -self.m * self.h * (forward * r * cosine + V * dx.theta * sine)
            + (self.I_2 - self.I_3) * r**2 * sine * cosine
        )
        slope_of_potential_energy = -self.m * self.g * self.h * sine
        return (
            x.p - momentum,
            dx.p - (slope_of_kinetic_energy - slope_of_potential_energy),
        )

    def outputs(self, u):
        V, r = self.rolling(u)
        return {"V": V, "r": r}

    def drawing(self, x):
        return Drawing("rear", leaning(self.h, x.theta))

    def events(self, x, u):
        crosswise = {
            f"steers its {place} wheel across": event(cos(delta), when="falling", ends=True, from_start=True)
            for place, delta in (("front", u.delta_f), ("rear", u.delta_r))
        }
        return {"falls over": event(cos(x.theta), ends=True), **crosswise}
