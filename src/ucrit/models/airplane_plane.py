"""Axes: x forward, z down, fixed to the body; q positive nose up. SI units and radians.

The forward speed U stays, pitch angles are too small for gravity to lean. The wing's lift acts x_a ahead of the
centre of mass, the tail's l_t behind it; both meet the air as the point where they act moves. On the basic motion
the two lifts share the weight such that they balance about the centre of mass.
"""

from ..bondgraph import Graph, I, R, Se, Sf, bodies, equations_bond_graph, one, running_gear
from ..core import Drawing, Model, cos, output, param, speed, state
from ..parts.shapes import airplane_side
from ..parts.wings import angle_of_attack


class AirplanePlane(Model):
    """Airplane with wing and tail at constant forward speed (Karnopp 2004, section 9.V, eqs. 9.41 to 9.51)."""

    m: float = param("kg", "mass", above=0)
    I_yy: float = param("kg m^2", "pitch moment of inertia about the centre of mass", above=0)
    C: float = param("kg/m", "lift of the wing per angle of attack and speed squared", above=0)
    C_t: float = param("kg/m", "lift of the tail per angle of attack and speed squared", above=0)
    x_a: float = param("m", "centre of mass to lift of the wing, positive when this is ahead")
    l_t: float = param("m", "centre of mass to lift of the tail, which is behind", above=0)
    g: float = param("m/s^2", "gravity", above=0, default=9.80665)
    U: float = speed("forward speed")

    W = state("m/s", "downward velocity of the centre of mass", motion="short period")
    q = state("rad/s", "pitch rate", motion="short period")

    L = output("N", "lift of wing and tail")
    M = output("N m", "moment about the centre of mass, nose up")

    mirror = False

    def upward_force(self, C, trimmed, downward):
        """Upward part of a lift at right angles to the air that meets it; ``trimmed`` on the basic motion."""
        alpha = angle_of_attack(self.U, downward)
        lift = (trimmed / self.U**2 + C * alpha) * (self.U**2 + downward**2)
        return lift * cos(alpha)

    def wing_force(self, downward):
        share = self.l_t / (self.x_a + self.l_t)
        return self.upward_force(self.C, self.m * self.g * share, downward)

    def tail_force(self, downward):
        share = self.x_a / (self.x_a + self.l_t)
        return self.upward_force(self.C_t, self.m * self.g * share, downward)

    def lifts(self, W, q):
        return self.wing_force(W - self.x_a * q), self.tail_force(W + self.l_t * q)

    def equations(self, x, dx):
        wing, tail = self.lifts(x.W, x.q)
        return (
            self.m * (dx.W - self.U * x.q) - (self.m * self.g - wing - tail),
            self.I_yy * dx.q - (self.x_a * wing - self.l_t * tail),
        )

    def bond_graph(self):
        return Graph(
            bodies.translation(self.m, ("U", "", "W"), ("", "q", "")),
            one("q"),
            I("spin", self.I_yy),
            Sf("speed", self.U),
            Se("weight", self.m * self.g),
            "q -> spin",
            "speed -> U",
            "weight -> W",
            running_gear.velocity("wing", W=1, q=-self.x_a),
            R("wing_lift", effort=self.wing_force),
            "wing -> wing_lift",
            running_gear.velocity("tail", W=1, q=self.l_t),
            R("tail_lift", effort=self.tail_force),
            "tail -> tail_lift",
        )

    equations_bond_graph = equations_bond_graph

    def outputs(self, x):
        wing, tail = self.lifts(x.W, 0)
        return {"L": wing + tail, "M": self.x_a * wing - self.l_t * tail}

    def drawing(self, x):
        return Drawing("side", airplane_side(1.8 * self.l_t, up=-1), turned=True, travel=(self.U, x.W, -x.q))
