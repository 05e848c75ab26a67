"""Axes: x along the track, y to the left; psi positive to the left. SI units and radians.

The truck frame moves straight with speed V. f_x acts along, f_y across the rolling direction, for one wheel.
"""

from types import MappingProxyType

from ..bondgraph import C, Graph, I, R, Sf, equations_bond_graph, one, q, running_gear
from ..core import Drawing, Model, coordinate, cos, param, sin, speed
from ..parts.creep import contact_velocities, creep_force, creep_forces, creepage
from ..parts.shapes import rails, wheelset


class Wheelset(Model):
    """Wheelset sprung in a truck frame that moves straight (Karnopp 2004, section 10.II)."""

    m: float = param("kg", "mass of the wheelset", above=0)
    I: float = param("kg m^2", "yaw moment of inertia of the wheelset", above=0)
    d: float = param("m", "half the distance between the contact points", above=0)
    r_0: float = param("m", "rolling radius in the central position", above=0)
    lambda_: float = param("1", "conicity: slope of the treads, positive when the flange side is larger")
    f_x: float = param("N", "longitudinal creep coefficient of a wheel", above=0)
    f_y: float = param("N", "lateral creep coefficient of a wheel", above=0)
    k_1: float = param("N/m", "lateral stiffness between wheelset and frame", above=0)
    k_2: float = param("N m/rad", "yaw stiffness between wheelset and frame", above=0)
    V: float = speed("forward speed")

    y = coordinate("m", "lateral displacement of the wheelset", motion="lateral")
    psi = coordinate("rad", "yaw angle of the wheelset", motion="yaw")

    mode_names = MappingProxyType({"lateral oscillation": "hunting", "yaw oscillation": "hunting"})

    def kinetic_energy(self, x, dx):
        return self.m * dx.y**2 / 2 + self.I * dx.psi**2 / 2

    def potential_energy(self, x):
        return self.k_1 * x.y**2 / 2 + self.k_2 * x.psi**2 / 2

    def bond_graph(self):
        def creep(name, f):
            return R(name, effort=lambda v: -creep_force(f, creepage(v, self.V)))

        def contact(side, sign):
            radius = self.r_0 + sign * self.lambda_ * q("y")
            return Graph(
                running_gear.velocity(side, ahead=1, psi=-sign * self.d, spin=-radius),
                creep(f"{side}_x", self.f_x),
                creep(f"{side}_y", self.f_y),
                f"{side} -> {side}_x",
                f"across -> {side}_y",
            )

        return Graph(
            *(one(name) for name in ("y", "psi", "track", "spin", "ahead", "across")),
            Sf("speed", self.V),
            Sf("rolling", self.V / self.r_0),
            "speed -> track",
            "rolling -> spin",
            I("mass", self.m),
            I("yawing", self.I),
            C("lateral_spring", 1 / self.k_1),
            C("yaw_spring", 1 / self.k_2),
            "y -> mass",
            "y -> lateral_spring",
            "psi -> yawing",
            "psi -> yaw_spring",
            running_gear.velocity("along_wheels", track=cos(q("psi")), y=sin(q("psi"))),
            running_gear.velocity("across_wheels", y=cos(q("psi")), track=-sin(q("psi"))),
            "along_wheels -> ahead",
            "across_wheels -> across",
            contact("left", 1),
            contact("right", -1),
        )

    equations_bond_graph = equations_bond_graph

    def forces(self, x, dx):
        velocities = contact_velocities(self.V, x.y, x.psi, dx.y, dx.psi, self.d, self.r_0, self.lambda_)
        return creep_forces(self.V, velocities, self.f_x, self.f_y)

    def drawing(self, x):
        shape = (*rails(self.d, 3 * self.d), *wheelset(self.d, self.r_0, (0, x.y), x.psi))
        return Drawing("top", shape, travel=(self.V, 0, 0))
