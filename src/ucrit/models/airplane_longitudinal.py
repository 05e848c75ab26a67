"""Axes: x forward along the path of the basic motion, z down, fixed to the body (stability axes); q and theta positive
nose up. u, w, q and theta are deviations. SI units and radians.

Each derivative is that of a force or moment on the airplane with respect to the variable in its name, at the one speed
and height it was measured or computed for; thrust is part of X.
"""

from ..core import Drawing, Model, cos, input, param, sin, state
from ..parts.shapes import airplane_side, radius_of_gyration


class AirplaneLongitudinal(Model):
    """Airplane in its plane of symmetry by stability derivatives (Etkin and Reid 1996, eq. 4.9,18)."""

    m: float = param("kg", "mass", above=0)
    I_y: float = param("kg m^2", "pitch moment of inertia about the centre of mass", above=0)
    U: float = param("m/s", "speed of the basic motion", above=0)
    theta_0: float = param("rad", "angle of climb of the basic motion", above=-1.5, below=1.5, default=0)
    g: float = param("m/s^2", "gravity", above=0, default=9.80665)
    X_u: float = param("N s/m", "forward force per forward velocity")
    X_w: float = param("N s/m", "forward force per downward velocity")
    Z_u: float = param("N s/m", "downward force per forward velocity")
    Z_w: float = param("N s/m", "downward force per downward velocity")
    Z_q: float = param("N s/rad", "downward force per pitch rate")
    Z_wdot: float = param("kg", "downward force per downward acceleration")
    M_u: float = param("N s", "pitching moment per forward velocity")
    M_w: float = param("N s", "pitching moment per downward velocity")
    M_q: float = param("N m s/rad", "pitching moment per pitch rate")
    M_wdot: float = param("kg m", "pitching moment per downward acceleration")

    u = state("m/s", "change of forward velocity", motion="phugoid")
    w = state("m/s", "downward velocity", motion="short period")
    q = state("rad/s", "pitch rate", motion="short period")
    theta = state("rad", "change of pitch angle", motion="phugoid")

    X = input("N", "further forward force, from throttle or gust")
    Z = input("N", "further downward force, from elevator or gust")
    M = input("N m", "further pitching moment, from elevator or gust")

    mirror = False
    one_mode_each = True

    def equations(self, x, dx, u):
        X = self.X_u * x.u + self.X_w * x.w + u.X
        Z = self.Z_u * x.u + self.Z_w * x.w + self.Z_q * x.q + self.Z_wdot * dx.w + u.Z
        M = self.M_u * x.u + self.M_w * x.w + self.M_q * x.q + self.M_wdot * dx.w + u.M
        weight = self.m * self.g
        return (
            self.m * dx.u - (X - weight * cos(self.theta_0) * x.theta),
            self.m * (dx.w - self.U * x.q) - (Z - weight * sin(self.theta_0) * x.theta),
            self.I_y * dx.q - M,
            dx.theta - x.q,
        )

    def drawing(self, x):
        pitch, forward = self.theta_0 + x.theta, self.U + x.u
        travel = forward * cos(pitch) + x.w * sin(pitch), forward * sin(pitch) - x.w * cos(pitch), 0
        return Drawing("side", airplane_side(5 * radius_of_gyration(self.I_y, self.m), angle=pitch), travel=travel)
