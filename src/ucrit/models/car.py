"""Axes: x forward, y to the right, z down, fixed to the body; r positive to the right. SI units and radians.

Slip angles are those of the tires' contact points to their wheels' planes; steer angles positive to the right.
"""

from types import MappingProxyType

from ..bondgraph import Graph, Sf, bodies, equations_bond_graph, f, running_gear
from ..core import Drawing, Model, cos, input, output, param, speed, state
from ..parts.shapes import car
from ..parts.tires import linear_side_force, slip_angle


class Car(Model):
    """Single-track car at constant forward speed in body-fixed axes (Karnopp 2004, section 6.III.B)."""

    m: float = param("kg", "mass", above=0)
    I_z: float = param("kg m^2", "yaw moment of inertia about the centre of mass", above=0)
    a: float = param("m", "centre of mass to front axle", above=0)
    b: float = param("m", "centre of mass to rear axle", above=0)
    C_f: float = param("N/rad", "cornering coefficient of the front axle", above=0)
    C_r: float = param("N/rad", "cornering coefficient of the rear axle", above=0)
    U: float = speed("forward speed")

    V = state("m/s", "lateral velocity of the centre of mass", motion="sideslip")
    r = state("rad/s", "yaw rate", motion="yaw")

    mode_names = MappingProxyType(
        {
            "sideslip oscillation": "yaw oscillation",
            "sideslip divergence": "spin divergence",
            "yaw divergence": "spin divergence",
        }
    )

    delta_f = input("rad", "front steer angle")
    delta_r = input("rad", "rear steer angle")

    a_y = output("m/s^2", "lateral acceleration of the centre of mass")
    curvature = output("1/m", "curvature of a steady turn, one over its radius")
    beta = output("rad", "sideslip angle of the centre of mass")
    alpha_f = output("rad", "slip angle of the front axle")
    alpha_r = output("rad", "slip angle of the rear axle")

    def slip_angles(self, x, u):
        front = slip_angle(x.V + self.a * x.r, self.U) - u.delta_f
        rear = slip_angle(x.V - self.b * x.r, self.U) - u.delta_r
        return front, rear

    def equations(self, x, dx, u):
        front, rear = self.slip_angles(x, u)
        Y_f = linear_side_force(self.C_f, front) * cos(u.delta_f)
        Y_r = linear_side_force(self.C_r, rear) * cos(u.delta_r)
        return (
            self.m * (dx.V + x.r * self.U) - (Y_f + Y_r),
            self.I_z * dx.r - (self.a * Y_f - self.b * Y_r),
        )

    def bond_graph(self, u):
        def force(C, steer):
            return lambda v: linear_side_force(C, slip_angle(v, f("U")) - steer) * cos(steer)

        return Graph(
            bodies.plane_body(self.m, self.I_z),
            Sf("speed", self.U),
            "speed -> U",
            running_gear.axle("front", force(self.C_f, u.delta_f), V=1, r=self.a),
            running_gear.axle("rear", force(self.C_r, u.delta_r), V=1, r=-self.b),
        )

    equations_bond_graph = equations_bond_graph

    def outputs(self, x, dx, u):
        front, rear = self.slip_angles(x, u)
        return {
            "a_y": dx.V + x.r * self.U,
            "curvature": x.r / self.U,
            "beta": slip_angle(x.V, self.U),
            "alpha_f": front,
            "alpha_r": rear,
        }

    def drawing(self, x, u):
        return Drawing("top", car(self.a, self.b, u.delta_f, u.delta_r), turned=True, travel=(self.U, x.V, x.r))
