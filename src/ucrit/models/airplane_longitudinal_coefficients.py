"""Axes and signs as in the airplane by longitudinal derivatives. SI units and radians.

Coefficients are referred to the area S and the chord c, those of rates to q c/(2 U); they hold for the one speed and
height they are given for. Thrust does not change with speed.
"""

from ..core import param
from .airplane_longitudinal import AirplaneLongitudinal


class AirplaneLongitudinalCoefficients(AirplaneLongitudinal):
    """Airplane in its plane of symmetry by coefficients without dimension (Nelson 1998, tables 3.3 and 3.5)."""

    S: float = param("m^2", "area of the wing", above=0)
    c: float = param("m", "mean chord of the wing", above=0)
    rho: float = param("kg/m^3", "density of the air", above=0, default=1.225)
    C_L: float = param("1", "lift coefficient of the basic motion")
    C_D: float = param("1", "drag coefficient of the basic motion", at_least=0)
    C_Lalpha: float = param("1/rad", "lift per angle of attack")
    C_Dalpha: float = param("1/rad", "drag per angle of attack")
    C_malpha: float = param("1/rad", "moment per angle of attack")
    C_Lalphadot: float = param("1/rad", "lift per rate of the angle of attack", default=0)
    C_malphadot: float = param("1/rad", "moment per rate of the angle of attack", default=0)
    C_Lq: float = param("1/rad", "lift per pitch rate", default=0)
    C_mq: float = param("1/rad", "moment per pitch rate")
    C_Lu: float = param("1", "lift per relative change of speed, beyond that of the pressure", default=0)
    C_Du: float = param("1", "drag per relative change of speed, beyond that of the pressure", default=0)
    C_mu: float = param("1", "moment per relative change of speed", default=0)

    @property
    def per_velocity(self):
        return self.rho * self.U * self.S / 2

    @property
    def lag(self):
        return self.c / (2 * self.U)

    X_u = property(lambda self: -self.per_velocity * (2 * self.C_D + self.C_Du))
    X_w = property(lambda self: self.per_velocity * (self.C_L - self.C_Dalpha))
    Z_u = property(lambda self: -self.per_velocity * (2 * self.C_L + self.C_Lu))
    Z_w = property(lambda self: -self.per_velocity * (self.C_Lalpha + self.C_D))
    Z_q = property(lambda self: -self.per_velocity * self.U * self.lag * self.C_Lq)
    Z_wdot = property(lambda self: -self.per_velocity * self.lag * self.C_Lalphadot)
    M_u = property(lambda self: self.per_velocity * self.c * self.C_mu)
    M_w = property(lambda self: self.per_velocity * self.c * self.C_malpha)
    M_q = property(lambda self: self.per_velocity * self.U * self.c * self.lag * self.C_mq)
    M_wdot = property(lambda self: self.per_velocity * self.c * self.lag * self.C_malphadot)
