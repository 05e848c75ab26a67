"""Axes: x forward, y to the right, z down, fixed to the car; r positive to the right. SI units and radians.

theta is the trailer's yaw angle to the car, positive when its rear swings to the left; the car keeps its
forward speed.
"""

from types import MappingProxyType

from ..core import Drawing, Model, coordinate, cos, input, output, param, sin, speed, state
from ..parts.shapes import car, trailer
from ..parts.tires import linear_side_force, slip_angle


class CarTrailer(Model):
    """Single-track car with a trailer on a hitch with yaw damping (after Karnopp 2004, chapters 5 and 6)."""

    m: float = param("kg", "mass of the car", above=0)
    I_z: float = param("kg m^2", "yaw moment of inertia of the car about its centre of mass", above=0)
    a: float = param("m", "car's centre of mass to front axle", above=0)
    b: float = param("m", "car's centre of mass to rear axle", above=0)
    h: float = param("m", "car's centre of mass to hitch", above=0)
    C_f: float = param("N/rad", "cornering coefficient of the front axle", above=0)
    C_r: float = param("N/rad", "cornering coefficient of the rear axle", above=0)
    m_t: float = param("kg", "mass of the trailer", above=0)
    I_t: float = param("kg m^2", "yaw moment of inertia of the trailer about its centre of mass", above=0)
    a_t: float = param("m", "hitch to trailer's centre of mass", above=0)
    b_t: float = param("m", "trailer's centre of mass to its axle, positive when the axle is behind it")
    C_t: float = param("N/rad", "cornering coefficient of the trailer's axle", above=0)
    c: float = param("N m s/rad", "yaw damping of the hitch", at_least=0)
    U: float = speed("forward speed")

    V = state("m/s", "lateral velocity of the car's centre of mass", motion="sideslip")
    r = state("rad/s", "yaw rate of the car", motion="yaw")
    theta = coordinate("rad", "articulation angle", motion="trailer")

    mode_names = MappingProxyType(
        {
            "trailer oscillation": "sway",
            "sideslip oscillation": "yaw oscillation",
            "trailer divergence": "jackknife divergence",
            "sideslip divergence": "jackknife divergence",
            "yaw divergence": "jackknife divergence",
        }
    )

    delta_f = input("rad", "front steer angle")

    a_y = output("m/s^2", "lateral acceleration of the car's centre of mass")
    r_t = output("rad/s", "yaw rate of the trailer")

    def car_forces(self, x, u):
        Y_f = linear_side_force(self.C_f, slip_angle(x.V + self.a * x.r, self.U) - u.delta_f) * cos(u.delta_f)
        Y_r = linear_side_force(self.C_r, slip_angle(x.V - self.b * x.r, self.U))
        return Y_f, Y_r

    def trailer_velocity(self, x, dx, behind):
        """Velocity along and across the trailer of its point ``behind`` the hitch."""
        hitch = x.V - self.h * x.r
        along = self.U * cos(x.theta) + hitch * sin(x.theta)
        across = hitch * cos(x.theta) - self.U * sin(x.theta) - behind * (x.r + dx.theta)
        return along, across

    def trailer_acceleration(self, x, dx, ddx):
        """Acceleration of the trailer's centre of mass along and across the trailer."""
        forward, right = -x.r * (x.V - self.h * x.r), dx.V - self.h * dx.r + x.r * self.U
        spin = x.r + dx.theta
        along = forward * cos(x.theta) + right * sin(x.theta) + self.a_t * spin**2
        across = right * cos(x.theta) - forward * sin(x.theta) - self.a_t * (dx.r + ddx.theta)
        return along, across

    def trailer_force(self, x, dx):
        along, across = self.trailer_velocity(x, dx, self.a_t + self.b_t)
        return linear_side_force(self.C_t, slip_angle(across, along))

    def equations(self, x, dx, ddx, u):
        Y_f, Y_r = self.car_forces(x, u)
        Y_t = self.trailer_force(x, dx)
        along, across = self.trailer_acceleration(x, dx, ddx)
        X_h, Y_h = self.m_t * along, self.m_t * across - Y_t
        hitch = X_h * sin(x.theta) + Y_h * cos(x.theta)
        damper = self.c * dx.theta
        return (
            self.m * (dx.V + x.r * self.U) - (Y_f + Y_r - hitch),
            self.I_z * dx.r - (self.a * Y_f - self.b * Y_r + self.h * hitch + damper),
            self.I_t * (dx.r + ddx.theta) - (self.a_t * Y_h - self.b_t * Y_t - damper),
        )

    def equations_virtual_power(self, x, dx, ddx, u):
        """Inertia and side forces times the velocities that V, r and theta' alone would give their points."""
        Y_f, Y_r = self.car_forces(x, u)
        Y_t = self.trailer_force(x, dx)
        along, across = self.trailer_acceleration(x, dx, ddx)
        turning = self.I_t * (dx.r + ddx.theta)
        lateral, C, S = self.m * (dx.V + x.r * self.U), cos(x.theta), sin(x.theta)
        axle = self.a_t + self.b_t
        return (
            lateral + self.m_t * (along * S + across * C) - Y_f - Y_r - Y_t * C,
            self.I_z * dx.r
            + turning
            - self.m_t * (along * self.h * S + across * (self.h * C + self.a_t))
            - self.a * Y_f
            + self.b * Y_r
            + Y_t * (self.h * C + axle),
            turning - self.m_t * across * self.a_t + axle * Y_t + self.c * dx.theta,
        )

    def outputs(self, x, dx):
        return {"a_y": dx.V + x.r * self.U, "r_t": x.r + dx.theta}

    def drawing(self, x, u):
        towed = trailer(self.a_t, self.b_t, (-self.h, 0), x.theta)
        shape = (*towed, *car(self.a, self.b, u.delta_f))
        return Drawing("top", shape, turned=True, travel=(self.U, x.V, x.r))
