"""Axes: x forward, y to the right, z down, through the centre of mass and fixed to the body. SI units and radians.

Products of inertia are I_xy = integral of x y dm. Forces and moments are inputs; the basic motion is straight,
with the speed U_0. A model derived from this one sets to 0 the velocities that something holds, and with them
the forces that do so: what is left follows.
"""

from ..bondgraph import Graph, Se, bodies, equations_bond_graph
from ..core import Model, input, param, speed, state
from ..parts.rigid_body import components, euler, inertia_tensor, newton, possible_inertia


class RigidBody(Model):
    """Rigid body in axes fixed to it, with its full tensor of inertia (Karnopp 2004, eqs. (2.17) and (2.19))."""

    m: float = param("kg", "mass", above=0)
    I_xx: float = param("kg m^2", "moment of inertia about the x axis", above=0)
    I_yy: float = param("kg m^2", "moment of inertia about the y axis", above=0)
    I_zz: float = param("kg m^2", "moment of inertia about the z axis", above=0)
    I_xy: float = param("kg m^2", "product of inertia of x and y")
    I_xz: float = param("kg m^2", "product of inertia of x and z")
    I_yz: float = param("kg m^2", "product of inertia of y and z")
    U_0: float = speed("forward speed of the basic motion")

    U = state("m/s", "forward velocity of the centre of mass", motion="forward")
    V = state("m/s", "lateral velocity of the centre of mass", motion="sideslip")
    W = state("m/s", "velocity of the centre of mass down", motion="heave")
    p = state("rad/s", "roll rate", motion="roll")
    q = state("rad/s", "pitch rate", motion="pitch")
    r = state("rad/s", "yaw rate", motion="yaw")

    X = input("N", "force forward")
    Y = input("N", "force to the right")
    Z = input("N", "force down")
    L = input("N m", "rolling moment")
    M = input("N m", "pitching moment")
    N = input("N m", "yawing moment")

    mirror = False

    def basic_motion(self):
        return {"x": {"U": self.U_0}}

    def inertia(self):
        return inertia_tensor(self.I_xx, self.I_yy, self.I_zz, self.I_xy, self.I_xz, self.I_yz)

    def bond_graph(self, u):
        free = type(self).declaration.variables
        axes, spin = ([name if name in free else "" for name in names] for names in ("UVW", "pqr"))
        loads = zip("UVWpqr", components(u, "X Y Z") + components(u, "L M N"), strict=True)
        sources = [(Se(f"load_{name}", load), f"load_{name} -> {name}") for name, load in loads if name in free]
        return Graph(
            bodies.translation(self.m, axes, spin),
            bodies.rotation(self.inertia(), spin),
            *(part for source in sources for part in source),
        )

    equations_bond_graph = equations_bond_graph

    def possible(self):
        given = [name for name in type(self).declaration.parameters if name.startswith("I_")]
        return possible_inertia(", ".join(given), self.inertia())

    def equations(self, x, dx, u):
        spin = components(x, "p q r")
        force, moment = components(u, "X Y Z"), components(u, "L M N")
        residuals = (
            *newton(self.m, components(x, "U V W"), components(dx, "U V W"), force, frame=spin),
            *euler(self.inertia(), spin, components(dx, "p q r"), moment, frame=spin),
        )
        free = type(self).declaration.variables
        return [residual for name, residual in zip("UVWpqr", residuals, strict=True) if name in free]
