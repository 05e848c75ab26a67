"""Axes and signs as in the airplane by lateral derivatives. SI units and radians.

Coefficients are referred to the area S and the span b, those of rates to p b/(2 U) and r b/(2 U); they hold for the one
speed and height they are given for.
"""

from ..core import param
from .airplane_lateral import AirplaneLateral


class AirplaneLateralCoefficients(AirplaneLateral):
    """Airplane across its plane of symmetry by coefficients without dimension (Nelson 1998, tables 3.4 and 3.6)."""

    S: float = param("m^2", "area of the wing", above=0)
    b: float = param("m", "span of the wing", above=0)
    rho: float = param("kg/m^3", "density of the air", above=0, default=1.225)
    C_ybeta: float = param("1/rad", "side force per sideslip")
    C_lbeta: float = param("1/rad", "rolling moment per sideslip")
    C_nbeta: float = param("1/rad", "yawing moment per sideslip")
    C_yp: float = param("1/rad", "side force per roll rate", default=0)
    C_lp: float = param("1/rad", "rolling moment per roll rate")
    C_np: float = param("1/rad", "yawing moment per roll rate")
    C_yr: float = param("1/rad", "side force per yaw rate", default=0)
    C_lr: float = param("1/rad", "rolling moment per yaw rate")
    C_nr: float = param("1/rad", "yawing moment per yaw rate")

    @property
    def per_velocity(self):
        return self.rho * self.U * self.S / 2

    @property
    def per_rate(self):
        return self.per_velocity * self.b / 2

    Y_v = property(lambda self: self.per_velocity * self.C_ybeta)
    L_v = property(lambda self: self.per_velocity * self.b * self.C_lbeta)
    N_v = property(lambda self: self.per_velocity * self.b * self.C_nbeta)
    Y_p = property(lambda self: self.per_rate * self.C_yp)
    L_p = property(lambda self: self.per_rate * self.b * self.C_lp)
    N_p = property(lambda self: self.per_rate * self.b * self.C_np)
    Y_r = property(lambda self: self.per_rate * self.C_yr)
    L_r = property(lambda self: self.per_rate * self.b * self.C_lr)
    N_r = property(lambda self: self.per_rate * self.b * self.C_nr)
