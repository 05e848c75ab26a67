"""Axes and signs as in the trailer. SI units and radians."""

from ..bondgraph import Graph, Sf, equations_bond_graph
from ..core import cos, sin
from .trailer import Trailer


class TrailerRigidTire(Trailer):
    """Trailer with a flexible, damped hitch whose wheels cannot slip sideways (Karnopp 2004, section 5.IV)."""

    C = None

    def constraints(self, x, dx):
        lateral, _ = self.axle_velocity(x, dx)
        return (lateral,)

    def forces(self, x, dx):
        return ((-self.c * dx.theta, dx.theta),)

    def tire_bonds(self, at, along):
        return Graph(Sf("grip", 0), f"{at} -> grip")

    equations_bond_graph = equations_bond_graph

    def equations_newton(self, x, dx, ddx):
        lateral, _ = self.axle_velocity(x, dx)
        acceleration = ddx.x + self.a * (ddx.theta * cos(x.theta) - dx.theta**2 * sin(x.theta))
        Y = (self.m * acceleration + self.k * x.x) / cos(x.theta)
        about_hitch = self.m * self.a * (self.a * ddx.theta + ddx.x * cos(x.theta))
        return lateral, self.I_c * ddx.theta + about_hitch - ((self.a + self.b) * Y - self.c * dx.theta)
