"""Axes and signs as in the wheelset. SI units and radians.

Each wheel carries the load N. Displaced by y, the hollow treads on the rounder rail heads rise on one side
by more than they fall on the other, y^2/(2 R) on the mean; R is the difference of the two profiles' radii.
Yawed by psi, the cones touch the rails further out, where they are thinner, and sink by
lambda_ d psi^2/2.
"""

from ..bondgraph import C, Graph, R, equations_bond_graph
from ..core import param
from .wheelset import Wheelset


class WheelsetGravity(Wheelset):
    """Wheelset with dampers, whose load moves up and down (Karnopp 2004, chapter 10, problems)."""

    N: float = param("N", "vertical load of a wheel", at_least=0)
    R: float = param("m", "radius of the tread's hollow less that of the rail head", above=0)
    c_1: float = param("N s/m", "lateral damping between wheelset and frame", at_least=0)
    c_2: float = param("N m s/rad", "yaw damping between wheelset and frame", at_least=0)

    def bond_graph(self):
        return Graph(
            super().bond_graph(),
            C("load_sideways", effort=lambda y: 2 * self.N / self.R * y),
            C("load_turned", effort=lambda psi: -2 * self.N * self.lambda_ * self.d * psi),
            R("lateral_damper", self.c_1),
            R("yaw_damper", self.c_2),
            "y -> load_sideways",
            "y -> lateral_damper",
            "psi -> load_turned",
            "psi -> yaw_damper",
        )

    equations_bond_graph = equations_bond_graph

    def potential_energy(self, x):
        rise = x.y**2 / (2 * self.R) - self.lambda_ * self.d * x.psi**2 / 2
        return super().potential_energy(x) + 2 * self.N * rise

    def forces(self, x, dx):
        dampers = (-self.c_1 * dx.y, dx.y), (-self.c_2 * dx.psi, dx.psi)
        return (*super().forces(x, dx), *dampers)
