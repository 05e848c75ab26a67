"""Axes: X along the road, Y to the right, fixed to the ground; psi positive to the right. SI units and
radians.

The centre of mass runs along X with constant speed U; steer angles are relative to the body, positive to the
right.
"""

from types import MappingProxyType

from ..core import Drawing, Model, coordinate, cos, input, param, sin, speed
from ..parts.shapes import car
from ..parts.tires import linear_side_force, slip_angle


class CarInertial(Model):
    """Single-track car in coordinates fixed to the road (Karnopp 2004, section 6.III.A)."""

    m: float = param("kg", "mass", above=0)
    I_z: float = param("kg m^2", "yaw moment of inertia about the centre of mass", above=0)
    a: float = param("m", "centre of mass to front axle", above=0)
    b: float = param("m", "centre of mass to rear axle", above=0)
    C_f: float = param("N/rad", "cornering coefficient of the front axle", above=0)
    C_r: float = param("N/rad", "cornering coefficient of the rear axle", above=0)
    U: float = speed("forward speed along the road")

    y = coordinate("m", "lateral position of the centre of mass", motion="lateral")
    psi = coordinate("rad", "yaw angle", motion="yaw")

    mode_names = MappingProxyType(
        {
            "lateral oscillation": "yaw oscillation",
            "lateral divergence": "spin divergence",
            "yaw divergence": "spin divergence",
            "yaw angle": "heading",
            "lateral speed": "heading",
        }
    )

    delta_f = input("rad", "front steer angle")
    delta_r = input("rad", "rear steer angle")

    def wheel_velocity(self, x, dx, ahead, steer):
        """Velocity of a contact point across and along its wheel."""
        forward = self.U * cos(x.psi) + dx.y * sin(x.psi)
        right = dx.y * cos(x.psi) - self.U * sin(x.psi) + ahead * dx.psi
        return right * cos(steer) - forward * sin(steer), forward * cos(steer) + right * sin(steer)

    def kinetic_energy(self, dx):
        return (self.m * (self.U**2 + dx.y**2) + self.I_z * dx.psi**2) / 2

    def forces(self, x, dx, u):
        front = self.wheel_velocity(x, dx, self.a, u.delta_f)
        rear = self.wheel_velocity(x, dx, -self.b, u.delta_r)
        return (
            (linear_side_force(self.C_f, slip_angle(*front)), front[0]),
            (linear_side_force(self.C_r, slip_angle(*rear)), rear[0]),
        )

    def equations_newton(self, x, dx, ddx, u):
        forward = self.U * cos(x.psi) + dx.y * sin(x.psi)
        right = dx.y * cos(x.psi) - self.U * sin(x.psi)
        Y_f = linear_side_force(self.C_f, slip_angle(right + self.a * dx.psi, forward) - u.delta_f)
        Y_r = linear_side_force(self.C_r, slip_angle(right - self.b * dx.psi, forward) - u.delta_r)
        return (
            self.m * ddx.y - (Y_f * cos(x.psi + u.delta_f) + Y_r * cos(x.psi + u.delta_r)),
            self.I_z * ddx.psi - (self.a * Y_f * cos(u.delta_f) - self.b * Y_r * cos(u.delta_r)),
        )

    def drawing(self, x, u):
        shape = car(self.a, self.b, u.delta_f, u.delta_r, (0, x.y), x.psi)
        return Drawing("top", shape, turned=True, travel=(self.U, 0, 0))
