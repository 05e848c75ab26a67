"""Axes: those of the hitch, forward along its path and to the left; r positive to the right. SI units and
radians.

theta is positive when the trailer's rear swings to the left, omega when the path turns to the right; the
wheels are steered in the same sense as theta.
"""

from types import MappingProxyType

from ..core import Drawing, Model, cos, input, output, param, sin, speed, state
from ..parts.shapes import trailer
from ..parts.tires import linear_side_force, slip_angle


class TrailerActiveSteering(Model):
    """Trailer whose wheels are steered in proportion to its yaw rate (Karnopp 2004, Problem 5.12)."""

    m: float = param("kg", "mass", above=0)
    I_c: float = param("kg m^2", "yaw moment of inertia about the centre of mass", above=0)
    a: float = param("m", "hitch to centre of mass", above=0)
    b: float = param("m", "centre of mass to axle, positive when the axle is behind it", above=0)
    C: float = param("N/rad", "cornering coefficient of the axle", above=0)
    g: float = param("s", "steer angle of the wheels per yaw rate of the trailer")
    U: float = speed("speed of the towing vehicle", reverse=True)

    theta = state("rad", "yaw angle of the trailer to the hitch's path", motion="yaw")
    r = state("rad/s", "yaw rate of the trailer", motion="yaw")

    mode_names = MappingProxyType({"yaw oscillation": "sway", "yaw divergence": "jackknife divergence"})

    omega = input("rad/s", "yaw rate of the hitch's path, constant in a steady turn")

    delta = output("rad", "steer angle of the wheels")
    offset = output("m", "lateral position of the axle to the line of the hitch's path")

    def steer(self, x, u):
        return self.g * x.r

    def side_force(self, x, u):
        across = self.U * sin(x.theta) + (self.a + self.b) * x.r
        along = self.U * cos(x.theta)
        delta = self.steer(x, u)
        left, forward = across * cos(delta) + along * sin(delta), along * cos(delta) - across * sin(delta)
        return linear_side_force(self.C, slip_angle(left, forward)) * cos(delta)

    def equations(self, x, dx, u):
        hitch_acceleration = -self.U * u.omega * cos(x.theta)
        about_hitch = (self.I_c + self.m * self.a**2) * dx.r + self.m * self.a * hitch_acceleration
        return (
            dx.theta - (x.r - u.omega),
            about_hitch - (self.a + self.b) * self.side_force(x, u),
        )

    def equations_centre_of_mass(self, x, dx, u):
        Y = self.side_force(x, u)
        acceleration = self.a * dx.r - self.U * u.omega * cos(x.theta)
        hitch_force = self.m * acceleration - Y
        return (
            dx.theta - (x.r - u.omega),
            self.I_c * dx.r - (self.b * Y - self.a * hitch_force),
        )

    def outputs(self, x, u):
        return {"delta": self.steer(x, u), "offset": (self.a + self.b) * sin(x.theta)}

    def drawing(self, x, u):
        shape = trailer(self.a, self.b, angle=-x.theta, steer=-self.steer(x, u))
        return Drawing("top", shape, travel=(self.U, 0, -u.omega))
