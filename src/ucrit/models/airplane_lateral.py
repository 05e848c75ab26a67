"""Axes: x forward along the path of the basic motion, y to the right, z down, fixed to the body (stability axes); p and
phi positive to the right, r positive to the right. SI units and radians.

Each derivative is that of a force or moment on the airplane with respect to the variable in its name, at the one speed
and height it was measured or computed for.
"""

from types import MappingProxyType

from ..core import Drawing, Model, cos, input, param, state, tan
from ..parts.shapes import airplane_rear, radius_of_gyration


class AirplaneLateral(Model):
    """Airplane across its plane of symmetry by stability derivatives (Etkin and Reid 1996, eq. 4.9,19)."""

    m: float = param("kg", "mass", above=0)
    I_x: float = param("kg m^2", "roll moment of inertia", above=0)
    I_z: float = param("kg m^2", "yaw moment of inertia", above=0)
    I_xz: float = param("kg m^2", "product of inertia, the integral of x z", default=0)
    U: float = param("m/s", "speed of the basic motion", above=0)
    theta_0: float = param("rad", "angle of climb of the basic motion", above=-1.5, below=1.5, default=0)
    g: float = param("m/s^2", "gravity", above=0, default=9.80665)
    Y_v: float = param("N s/m", "side force per lateral velocity")
    Y_p: float = param("N s/rad", "side force per roll rate")
    Y_r: float = param("N s/rad", "side force per yaw rate")
    L_v: float = param("N s", "rolling moment per lateral velocity")
    L_p: float = param("N m s/rad", "rolling moment per roll rate")
    L_r: float = param("N m s/rad", "rolling moment per yaw rate")
    N_v: float = param("N s", "yawing moment per lateral velocity")
    N_p: float = param("N m s/rad", "yawing moment per roll rate")
    N_r: float = param("N m s/rad", "yawing moment per yaw rate")

    v = state("m/s", "lateral velocity", motion="Dutch roll")
    p = state("rad/s", "roll rate", motion="roll")
    r = state("rad/s", "yaw rate", motion="Dutch roll")
    phi = state("rad", "roll angle", motion="spiral")

    Y = input("N", "further side force, from rudder or gust")
    L = input("N m", "further rolling moment, from ailerons, rudder or gust")
    N = input("N m", "further yawing moment, from ailerons, rudder or gust")

    one_mode_each = True
    mode_names = MappingProxyType({"roll decay": "roll subsidence"})

    def possible(self):
        return {"I_xz must lie between -sqrt(I_x I_z) and sqrt(I_x I_z)": self.I_xz**2 < self.I_x * self.I_z}

    def equations(self, x, dx, u):
        Y = self.Y_v * x.v + self.Y_p * x.p + self.Y_r * x.r + u.Y
        L = self.L_v * x.v + self.L_p * x.p + self.L_r * x.r + u.L
        N = self.N_v * x.v + self.N_p * x.p + self.N_r * x.r + u.N
        return (
            self.m * (dx.v + self.U * x.r - self.g * cos(self.theta_0) * x.phi) - Y,
            self.I_x * dx.p - self.I_xz * dx.r - L,
            self.I_z * dx.r - self.I_xz * dx.p - N,
            dx.phi - (x.p + tan(self.theta_0) * x.r),
        )

    def drawing(self, x):
        return Drawing("rear", airplane_rear(8 * radius_of_gyration(self.I_x, self.m), x.phi))
