"""Axes: X along the road, Y to the left; the hitch moves along X with speed U. SI units and radians.

theta is positive when the trailer's rear swings to the left; the axle lies a + b behind the hitch.
"""

from types import MappingProxyType

from ..bondgraph import C, Graph, R, Sf, bodies, equations_bond_graph, f, one, q, running_gear
from ..core import Drawing, Model, coordinate, cos, param, sin, speed
from ..parts.shapes import trailer
from ..parts.tires import linear_side_force, slip_angle


class Trailer(Model):
    """Trailer on a laterally flexible hitch with yaw damping (Karnopp 2004, sections 5.III and 5.IV)."""

    m: float = param("kg", "mass", above=0)
    I_c: float = param("kg m^2", "yaw moment of inertia about the centre of mass", above=0)
    a: float = param("m", "hitch to centre of mass", above=0)
    b: float = param("m", "centre of mass to axle, positive when the axle is behind it", at_least=0)
    C: float = param("N/rad", "cornering coefficient of the axle", above=0)
    k: float = param("N/m", "lateral stiffness of the hitch", above=0)
    c: float = param("N m s/rad", "yaw damping of the hitch", at_least=0)
    U: float = speed("speed of the towing vehicle", reverse=True)

    x = coordinate("m", "lateral displacement of the hitch", motion="lateral")
    theta = coordinate("rad", "yaw angle of the trailer", motion="yaw")

    mode_names = MappingProxyType(
        {
            "lateral oscillation": "sway",
            "yaw oscillation": "sway",
            "lateral divergence": "jackknife divergence",
            "yaw divergence": "jackknife divergence",
        }
    )

    def kinetic_energy(self, x, dx):
        forward = self.U + self.a * dx.theta * sin(x.theta)
        left = dx.x + self.a * dx.theta * cos(x.theta)
        return self.m * (forward**2 + left**2) / 2 + self.I_c * dx.theta**2 / 2

    def potential_energy(self, x):
        return self.k * x.x**2 / 2

    def axle_velocity(self, x, dx):
        lateral = self.U * sin(x.theta) + dx.x * cos(x.theta) + (self.a + self.b) * dx.theta
        longitudinal = self.U * cos(x.theta) - dx.x * sin(x.theta)
        return lateral, longitudinal

    def tire_force(self, alpha):
        return linear_side_force(self.C, alpha)

    def side_force(self, x, dx):
        return self.tire_force(slip_angle(*self.axle_velocity(x, dx)))

    def forces(self, x, dx):
        lateral, _ = self.axle_velocity(x, dx)
        return (
            (self.side_force(x, dx), lateral),
            (-self.c * dx.theta, dx.theta),
        )

    def bond_graph(self):
        theta = q("theta")
        return Graph(
            Sf("speed", self.U),
            one("road"),
            "speed -> road",
            one("x"),
            C("hitch", 1 / self.k),
            "x -> hitch",
            bodies.swinging_body(self.m, self.I_c, self.a, ahead="road", left="x"),
            R("damper", self.c),
            "theta -> damper",
            running_gear.velocity("axle", road=sin(theta), x=cos(theta), theta=self.a + self.b),
            self.tire_bonds("axle", f("road") * cos(theta) - f("x") * sin(theta)),
        )

    def tire_bonds(self, at, along):
        return running_gear.tire(at, lambda v: self.tire_force(slip_angle(v, along)))

    equations_bond_graph = equations_bond_graph

    def equations_newton(self, x, dx, ddx):
        Y = self.side_force(x, dx)
        acceleration = ddx.x + self.a * (ddx.theta * cos(x.theta) - dx.theta**2 * sin(x.theta))
        about_hitch = self.m * self.a * (self.a * ddx.theta + ddx.x * cos(x.theta))
        return (
            self.m * acceleration - (Y * cos(x.theta) - self.k * x.x),
            self.I_c * ddx.theta + about_hitch - ((self.a + self.b) * Y - self.c * dx.theta),
        )

    def drawing(self, x):
        return Drawing("top", trailer(self.a, self.b, (0, x.x), -x.theta), travel=(self.U, 0, 0))
