"""Axes: X along the road, Y to the left; the hitch moves along X with speed U. SI units and radians.

theta is positive when the trailer's rear swings to the left; the axle lies a + b behind the hitch.
"""

from types import MappingProxyType

from ..bondgraph import Graph, Sf, bodies, equations_bond_graph, f, one, q, running_gear
from ..core import Drawing, Model, coordinate, cos, param, sin, speed
from ..parts.shapes import trailer
from ..parts.tires import linear_side_force, slip_angle


class TrailerRigidHitch(Model):
    """Trailer whose hitch follows a straight line: one degree of freedom (Karnopp 2004, section 5.II)."""

    m: float = param("kg", "mass", above=0)
    I_c: float = param("kg m^2", "yaw moment of inertia about the centre of mass", above=0)
    a: float = param("m", "hitch to centre of mass", above=0)
    b: float = param("m", "centre of mass to axle, positive when the axle is behind it", at_least=0)
    C: float = param("N/rad", "cornering coefficient of the axle", above=0)
    U: float = speed("speed of the towing vehicle", reverse=True)

    theta = coordinate("rad", "yaw angle of the trailer", motion="yaw")

    mode_names = MappingProxyType({"yaw oscillation": "sway", "yaw divergence": "jackknife divergence"})

    def axle_velocity(self, x, dx):
        return self.U * sin(x.theta) + (self.a + self.b) * dx.theta, self.U * cos(x.theta)

    def kinetic_energy(self, x, dx):
        forward = self.U + self.a * dx.theta * sin(x.theta)
        left = self.a * dx.theta * cos(x.theta)
        return self.m * (forward**2 + left**2) / 2 + self.I_c * dx.theta**2 / 2

    def forces(self, x, dx):
        lateral, longitudinal = self.axle_velocity(x, dx)
        return ((linear_side_force(self.C, slip_angle(lateral, longitudinal)), lateral),)

    def bond_graph(self):
        return Graph(
            Sf("speed", self.U),
            one("road"),
            "speed -> road",
            bodies.swinging_body(self.m, self.I_c, self.a, ahead="road"),
            running_gear.velocity("axle", road=sin(q("theta")), theta=self.a + self.b),
            self.tire_bonds("axle", f("road") * cos(q("theta"))),
        )

    def tire_bonds(self, at, along):
        return running_gear.tire(at, lambda v: linear_side_force(self.C, slip_angle(v, along)))

    equations_bond_graph = equations_bond_graph

    def equations_newton(self, x, dx, ddx):
        about_hitch = (self.I_c + self.m * self.a**2) * ddx.theta
        Y = linear_side_force(self.C, slip_angle(*self.axle_velocity(x, dx)))
        return about_hitch - (self.a + self.b) * Y

    def drawing(self, x):
        return Drawing("top", trailer(self.a, self.b, angle=-x.theta), travel=(self.U, 0, 0))
