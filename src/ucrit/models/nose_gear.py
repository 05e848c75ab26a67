"""Axes: x ahead, y to the left, z up; psi is positive when the wheel turns to the left. SI units and radians.

y is the sideways deflection of the tire at the front of its contact patch; the force follows its slope over the
relaxation length. As in the source c, k and kappa are signed like the moments that they give: negative ones resist.
"""

from types import MappingProxyType

from ..core import Drawing, Model, atan, coordinate, param, slot, speed, state
from ..parts.shapes import caster
from ..parts.tires.clipped import Clipped


class NoseGear(Model):
    """Nose landing gear that swivels about a vertical axis (G. Somieski 1997, third-order model)."""

    I_z: float = param("kg m^2", "moment of inertia about the swivel axis", above=0)
    a: float = param("m", "half the contact length", above=0)
    e: float = param("m", "caster length: swivel axis to wheel centre, which is behind it")
    F_z: float = param("N", "vertical load", above=0)
    c: float = param("N m/rad", "torsional spring rate, negative when it restores")
    k: float = param("N m s/rad", "torsional damping constant, negative when it damps")
    kappa: float = param("N m^2/rad", "tread width moment constant, negative when it damps")
    sigma: float = param("m", "relaxation length", above=0)
    tire = slot(Clipped, "the tire")
    V: float = speed("forward speed")

    psi = coordinate("rad", "swivel angle", motion="swivel")
    y = state("m", "lateral deflection of the tire", motion="tire")

    mode_names = MappingProxyType({"swivel oscillation": "shimmy", "tire oscillation": "shimmy"})

    def tire_forces(self, x):
        return self.tire.forces(self.F_z, -atan(x.y / self.sigma))

    def equations(self, x, dx, ddx):
        tire = self.tire_forces(x)
        return (
            self.I_z * ddx.psi
            - (self.c * x.psi + (self.k + self.kappa / self.V) * dx.psi + tire.M_z - self.e * tire.F_y),
            dx.y + self.V / self.sigma * x.y - (self.V * x.psi + (self.e - self.a) * dx.psi),
        )

    def drawing(self, x):
        return Drawing("top", caster(self.e, angle=-x.psi), travel=(self.V, 0, 0))
