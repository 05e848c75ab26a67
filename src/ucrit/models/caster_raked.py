"""Axes: X along the road, Y to the left, Z up; the pivot moves along X with speed U. SI units and radians.

The pivot's axis leans back by the rake beta. theta is the angle of turning about it, positive when the wheel
swings to the left. a and b are distances at right angles to the axis; the trail on the ground is
(a + b)/cos(beta). The rise and fall of the frame with theta, of second order, is left out.
"""

import math

from ..core import Drawing, asin, atan2, cos, param, sin
from ..parts.shapes import caster
from ..parts.tires import linear_side_force, slip_angle
from .caster import Caster


class CasterRaked(Caster):
    """Caster with an inclined pivot that follows a straight line (Karnopp 2004, section 8.III)."""

    a: float = param("m", "pivot's axis to centre of mass, negative when this is ahead of it")
    b: float = param("m", "centre of mass to contact point, which is behind it", above=0)
    beta: float = param("rad", "angle of the axis to the vertical: rake", at_least=0, below=math.pi / 2)
    C_gamma: float = param("N/rad", "camber thrust coefficient of the wheel", at_least=0)

    def wheel_axle(self, x):
        """Unit vector along the wheel's axle, which turns with theta about the inclined axis."""
        forward = cos(self.beta) * sin(x.theta)
        left = cos(x.theta)
        up = sin(self.beta) * sin(x.theta)
        return forward, left, up

    def camber(self, x):
        _, _, up = self.wheel_axle(x)
        return asin(up)

    def ground_steer_angle(self, x):
        forward, left, _ = self.wheel_axle(x)
        return atan2(forward, left)

    def axle_velocity(self, x, dx):
        steer = self.ground_steer_angle(x)
        swing = (self.a + self.b) * dx.theta
        return self.U * sin(steer) + swing * cos(self.camber(x)), self.U * cos(steer)

    def kinetic_energy(self, x, dx):
        forward, left, up = (self.a * dx.theta * component for component in self.wheel_axle(x))
        return self.m * ((self.U + forward) ** 2 + left**2 + up**2) / 2 + self.I_c * dx.theta**2 / 2

    def side_force(self, x, dx):
        lateral, longitudinal = self.axle_velocity(x, dx)
        cornering = linear_side_force(self.C, slip_angle(lateral, longitudinal))
        return cornering + linear_side_force(self.C_gamma, self.camber(x))

    def forces(self, x, dx):
        lateral, _ = self.axle_velocity(x, dx)
        return ((self.side_force(x, dx), lateral),)

    def equations_newton(self, x, dx, ddx):
        about_axis = (self.I_c + self.m * self.a**2) * ddx.theta
        return about_axis - (self.a + self.b) * cos(self.camber(x)) * self.side_force(x, dx)

    def drawing(self, x):
        trail = (self.a + self.b) / math.cos(self.beta)
        return Drawing("top", caster(trail, angle=-self.ground_steer_angle(x)), travel=(self.U, 0, 0))
