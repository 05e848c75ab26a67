"""Axes and signs as in the caster; F is positive to the wheel's left. SI units and radians."""

from types import MappingProxyType

from ..core import param, state
from ..parts.relaxation import force_lag
from ..parts.tires import linear_side_force, slip_angle
from .caster import Caster


class CasterRelaxation(Caster):
    """Caster whose side force follows over a relaxation length (Karnopp 2004, section 8.VI.B)."""

    sigma: float = param("m", "relaxation length of the tire", above=0)

    F = state("N", "side force on the wheel", motion="side force")

    mode_names = MappingProxyType({"swivel oscillation": "shimmy", "side force oscillation": "shimmy"})

    def forces(self, x, dx):
        lateral, _ = self.axle_velocity(x, dx)
        return ((x.F, lateral),)

    def side_force_lag(self, x, dx):
        lateral, longitudinal = self.axle_velocity(x, dx)
        steady = linear_side_force(self.C, slip_angle(lateral, longitudinal))
        return force_lag(self.sigma, longitudinal, x.F, dx.F, steady)

    def equations(self, x, dx, ddx):
        about_pivot = (self.I_c + self.m * self.a**2) * ddx.theta
        return about_pivot - (self.a + self.b) * x.F, self.side_force_lag(x, dx)

    def equations_newton(self, x, dx, ddx):
        pivot_force = self.m * self.a * ddx.theta - x.F
        about_centre_of_mass = self.I_c * ddx.theta
        return about_centre_of_mass - (self.b * x.F - self.a * pivot_force), self.side_force_lag(x, dx)
