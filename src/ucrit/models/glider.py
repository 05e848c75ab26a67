"""Axes and signs as in the airplane in plane motion. SI units and radians.

The weights are those of the wing and of the tail, and each of the two lifts acts where its surface's weight does,
a distance l apart; the fuselage weighs nothing.
"""

from ..core import param
from .airplane_plane import AirplanePlane


class Glider(AirplanePlane):
    """Model glider, a wing and a tail on a light stick (Karnopp 2004, Problem 9.4)."""

    m_w: float = param("kg", "mass of the wing", above=0)
    m_t: float = param("kg", "mass of the tail", above=0)
    l: float = param("m", "wing to tail", above=0)
    S: float = param("m^2", "area of the wing", above=0)
    S_t: float = param("m^2", "area of the tail", above=0)
    a: float = param("1/rad", "lift slope of the wing", above=0)
    a_t: float = param("1/rad", "lift slope of the tail, downwash included", above=0)
    rho: float = param("kg/m^3", "density of the air", above=0, default=1.225)

    @property
    def m(self):
        return self.m_w + self.m_t

    @property
    def I_yy(self):
        return self.m_w * self.m_t * self.l**2 / self.m

    @property
    def x_a(self):
        return self.m_t * self.l / self.m

    @property
    def l_t(self):
        return self.m_w * self.l / self.m

    @property
    def C(self):
        return self.rho * self.S * self.a / 2

    @property
    def C_t(self):
        return self.rho * self.S_t * self.a_t / 2
