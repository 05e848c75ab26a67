"""Axes: x away from the position of rest, to either side. SI units.

The spring and the damper may also push where others pull: negative k and b stand for forces that drive the mass.
"""

from ..bondgraph import C, Graph, I, R, equations_bond_graph, one
from ..core import Drawing, Model, coordinate, param
from ..parts.shapes import mass_on_a_spring


class Oscillator(Model):
    """Mass on a spring with a damper: static and dynamic stability (Karnopp 2004, eqs. (3.1) and (3.2))."""

    m: float = param("kg", "mass", above=0)
    b: float = param("N s/m", "damping, negative where the motion is driven")
    k: float = param("N/m", "stiffness, negative where the mass is pushed away")

    x = coordinate("m", "displacement of the mass", motion="mass")

    def kinetic_energy(self, x, dx):
        return self.m * dx.x**2 / 2

    def potential_energy(self, x):
        return self.k * x.x**2 / 2

    def forces(self, x, dx):
        return ((-self.b * dx.x, dx.x),)

    def bond_graph(self):
        return Graph(
            one("x"),
            I("mass", self.m),
            C("spring", effort=lambda x: self.k * x),
            R("damper", self.b),
            "x -> mass",
            "x -> spring",
            "x -> damper",
        )

    equations_bond_graph = equations_bond_graph

    def equations_newton(self, x, dx, ddx):
        return self.m * ddx.x + self.b * dx.x + self.k * x.x

    def drawing(self, x):
        return Drawing("side", mass_on_a_spring(0.5, x.x))
