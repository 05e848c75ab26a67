"""Axes and signs as in the caster; z is positive when the rim is to the left of the tread. SI units.

The tread's contact patch has no mass: its side force at its own slip angle is the sidewall's force -k_s z. That force
asks for a slip angle of k_s z/C, which must be less than a right angle; a motion ends where it is not.
"""

import math
from types import MappingProxyType

from ..bondgraph import equations_bond_graph, running_gear
from ..core import event, param, state, tan
from ..parts.tires import linear_side_force, slip_angle
from .caster import Caster


class CasterFlexibleSidewall(Caster):
    """Caster whose tire has a laterally flexible sidewall (Karnopp 2004, section 8.VI.A)."""

    k_s: float = param("N/m", "lateral stiffness of the tire's sidewall", above=0)

    z = state("m", "lateral deflection of the sidewall", motion="sidewall")

    mode_names = MappingProxyType({"swivel oscillation": "shimmy", "sidewall oscillation": "shimmy"})

    def forces(self, x, dx):
        lateral, _ = self.axle_velocity(x, dx)
        return ((-self.k_s * x.z, lateral),)

    def deflection_rate(self, x, dx):
        rim_lateral, longitudinal = self.axle_velocity(x, dx)
        patch_slip_angle = self.k_s * x.z / self.C
        patch_lateral = abs(longitudinal) * tan(patch_slip_angle)
        return rim_lateral - patch_lateral

    def equations(self, x, dx, ddx):
        about_pivot = (self.I_c + self.m * self.a**2) * ddx.theta
        return (
            about_pivot + (self.a + self.b) * self.k_s * x.z,
            dx.z - self.deflection_rate(x, dx),
        )

    def events(self, x):
        spare = self.C * math.pi / 2 - self.k_s * abs(x.z)
        return {
            "asks its tire for more than its largest force": event(spare, when="falling", ends=True, from_start=True)
        }

    def tire_bonds(self, at, along):
        def side_force(v):
            return linear_side_force(self.C, slip_angle(v, along))

        return running_gear.flexible_tire(at, side_force, 1 / self.k_s, sidewall="z")

    equations_bond_graph = equations_bond_graph

    def equations_newton(self, x, dx, ddx):
        F = -self.k_s * x.z
        pivot_force = self.m * self.a * ddx.theta - F
        about_centre_of_mass = self.I_c * ddx.theta
        return (
            about_centre_of_mass - (self.b * F - self.a * pivot_force),
            dx.z - self.deflection_rate(x, dx),
        )
