"""Axes: x forward, y to the right, z down, fixed to the body; r positive to the right. SI units and radians.

Two tires carry each axle and share its load, which does not change: the car has no height. Slip angles are those of
the contact points to the wheels' planes; steer angles are positive to the right. Beyond a right angle a wheel rolls
backward, where tire laws do not hold; a motion ends there.
"""

import math
from types import MappingProxyType

from ..core import Drawing, Model, cos, event, input, output, param, slot, speed, state
from ..parts.shapes import car
from ..parts.tires import slip_angle
from ..parts.tires.brush import Brush


class CarHandling(Model):
    """Single-track car at constant forward speed with tires that saturate (Karnopp 2004, sections 6.V and 6.VI)."""

    m: float = param("kg", "mass", above=0)
    I_z: float = param("kg m^2", "yaw moment of inertia about the centre of mass", above=0)
    a: float = param("m", "centre of mass to front axle", above=0)
    b: float = param("m", "centre of mass to rear axle", above=0)
    g: float = param("m/s^2", "gravity", above=0, default=9.80665)
    front = slot(Brush, "each front tire")
    rear = slot(Brush, "each rear tire")
    U: float = speed("forward speed")

    V = state("m/s", "lateral velocity of the centre of mass", motion="sideslip")
    r = state("rad/s", "yaw rate", motion="yaw")

    mode_names = MappingProxyType(
        {
            "sideslip oscillation": "yaw oscillation",
            "sideslip divergence": "spin divergence",
            "yaw divergence": "spin divergence",
        }
    )

    delta_f = input("rad", "front steer angle")
    delta_r = input("rad", "rear steer angle")

    a_y = output("m/s^2", "lateral acceleration of the centre of mass")
    curvature = output("1/m", "curvature of a steady turn, one over its radius")
    beta = output("rad", "sideslip angle of the centre of mass")
    alpha_f = output("rad", "slip angle of the front axle")
    alpha_r = output("rad", "slip angle of the rear axle")

    valid = MappingProxyType(dict.fromkeys(("alpha_f", "alpha_r"), (-1.57, 1.57)))  # just short of a right angle

    def slip_angles(self, x, u):
        front = slip_angle(x.V + self.a * x.r, self.U) - u.delta_f
        rear = slip_angle(x.V - self.b * x.r, self.U) - u.delta_r
        return front, rear

    def side_forces(self, x, u):
        front, rear = self.slip_angles(x, u)
        load = self.m * self.g / (2 * (self.a + self.b))
        Y_f = 2 * self.front.side_force(load * self.b, front) * cos(u.delta_f)
        Y_r = 2 * self.rear.side_force(load * self.a, rear) * cos(u.delta_r)
        return Y_f, Y_r

    def equations(self, x, dx, u):
        Y_f, Y_r = self.side_forces(x, u)
        return (
            self.m * (dx.V + x.r * self.U) - (Y_f + Y_r),
            self.I_z * dx.r - (self.a * Y_f - self.b * Y_r),
        )

    def equations_moments(self, x, dx, u):
        """Moments about the rear and about the front axle."""
        Y_f, Y_r = self.side_forces(x, u)
        sideways = self.m * (dx.V + x.r * self.U)
        return (
            self.b * sideways + self.I_z * dx.r - (self.a + self.b) * Y_f,
            self.a * sideways - self.I_z * dx.r - (self.a + self.b) * Y_r,
        )

    def outputs(self, x, dx, u):
        front, rear = self.slip_angles(x, u)
        return {
            "a_y": dx.V + x.r * self.U,
            "curvature": x.r / self.U,
            "beta": slip_angle(x.V, self.U),
            "alpha_f": front,
            "alpha_r": rear,
        }

    def events(self, x, u):
        return {
            f"rolls backward on its {place} wheels": event(
                math.pi / 2 - abs(slip), when="falling", ends=True, from_start=True
            )
            for place, slip in zip(("front", "rear"), self.slip_angles(x, u), strict=True)
        }

    def drawing(self, x, u):
        return Drawing("top", car(self.a, self.b, u.delta_f, u.delta_r), turned=True, travel=(self.U, x.V, x.r))
