"""Axes: x forward, y to the right, z down, fixed to the body; r and delta positive to the right. SI units
and radians.

The steered assembly (front wheels, linkage, steering wheel, reduced to the steer axis) is balanced about its
axis, which meets the road a length e ahead of the point where the front side force acts; held still, it adds
I_s to I_z.
"""

from types import MappingProxyType

from ..core import Drawing, Model, coordinate, cos, input, output, param, sin, speed, state
from ..parts.shapes import car
from ..parts.tires import linear_side_force, slip_angle


class CarFreeControl(Model):
    """Single-track car steered by a torque, with steering dynamics and trail (Karnopp 2004, Problem 6.6)."""

    m: float = param("kg", "mass", above=0)
    I_z: float = param("kg m^2", "yaw moment of inertia about the centre of mass, without I_s", above=0)
    I_s: float = param("kg m^2", "moment of inertia of the steered assembly about the steer axis", above=0)
    a: float = param("m", "centre of mass to front side force", above=0)
    b: float = param("m", "centre of mass to rear axle", above=0)
    e: float = param("m", "trail, steer axis to front side force, positive behind the axis")
    C_f: float = param("N/rad", "cornering coefficient of the front axle", above=0)
    C_r: float = param("N/rad", "cornering coefficient of the rear axle", above=0)
    c_s: float = param("N m s/rad", "damping of the steering at the steer axis", at_least=0)
    k_s: float = param("N m/rad", "stiffness that centres the steering, or of a held steering column", at_least=0)
    U: float = speed("forward speed")

    V = state("m/s", "lateral velocity of the centre of mass", motion="sideslip")
    r = state("rad/s", "yaw rate", motion="yaw")
    delta = coordinate("rad", "front steer angle", motion="steering")

    mode_names = MappingProxyType(
        {
            "sideslip oscillation": "weave",
            "yaw oscillation": "weave",
            "sideslip divergence": "spin divergence",
            "yaw divergence": "spin divergence",
        }
    )

    tau = input("N m", "torque about the steer axis, from the driver or an actuator, positive to the right")

    a_y = output("m/s^2", "lateral acceleration of the centre of mass")

    def side_forces(self, x, dx):
        axis = x.V + (self.a + self.e) * x.r
        across = axis * cos(x.delta) - self.U * sin(x.delta) - self.e * (x.r + dx.delta)
        along = self.U * cos(x.delta) + axis * sin(x.delta)
        Y_f = linear_side_force(self.C_f, slip_angle(across, along))
        Y_r = linear_side_force(self.C_r, slip_angle(x.V - self.b * x.r, self.U))
        return Y_f, Y_r

    def equations(self, x, dx, ddx, u):
        Y_f, Y_r = self.side_forces(x, dx)
        torque = -self.e * Y_f - self.c_s * dx.delta - self.k_s * x.delta + u.tau
        front_moment = ((self.a + self.e) * cos(x.delta) - self.e) * Y_f
        return (
            self.m * (dx.V + x.r * self.U) - (Y_f * cos(x.delta) + Y_r),
            self.I_z * dx.r + self.I_s * (dx.r + ddx.delta) - (front_moment - self.b * Y_r),
            self.I_s * (dx.r + ddx.delta) - torque,
        )

    def equations_two_bodies(self, x, dx, ddx, u):
        """The car about its rear axle and the assembly about the steer axis, which passes on the force."""
        Y_f, Y_r = self.side_forces(x, dx)
        on_assembly = -self.c_s * dx.delta - self.k_s * x.delta + u.tau
        at_axis = Y_f * cos(x.delta)
        rear_acceleration = dx.V + x.r * self.U - self.b * dx.r
        about_rear = self.I_z * dx.r + self.m * self.b * (rear_acceleration + self.b * dx.r)
        return (
            self.m * (dx.V + x.r * self.U) - at_axis - Y_r,
            about_rear + on_assembly - (self.a + self.e + self.b) * at_axis,
            self.I_s * (dx.r + ddx.delta) + self.e * Y_f - on_assembly,
        )

    def outputs(self, x, dx):
        return {"a_y": dx.V + x.r * self.U}

    def drawing(self, x):
        return Drawing("top", car(self.a, self.b, x.delta), turned=True, travel=(self.U, x.V, x.r))
