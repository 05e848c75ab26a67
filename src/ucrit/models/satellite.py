"""Axes: x, y, z along the principal axes of inertia, fixed to the satellite. SI units and radians.

It spins about the x axis, with nothing to turn it. Which axis that is, the longest, the shortest or the one
between, is told by the moments of inertia.
"""

from ..core import param, state
from ..parts.rigid_body import angular_momentum, components, dot
from .rigid_body import RigidBody


class Satellite(RigidBody):
    """Satellite that spins freely about a principal axis (Karnopp 2004, eqs. (2.27) to (2.33))."""

    Omega: float = param("rad/s", "spin about the x axis on the basic motion", above=0)

    p = state("rad/s", "rate of spin about the x axis", motion="spin")
    q = state("rad/s", "rate about the y axis", motion="wobble")
    r = state("rad/s", "rate about the z axis", motion="wobble")

    U = V = W = U_0 = m = 0
    X = Y = Z = L = M = N = 0
    I_xy = I_xz = I_yz = 0

    mirror = True
    even = ("q",)

    def basic_motion(self):
        return {"x": {"p": self.Omega}}

    def conserved(self, x, dx):
        spin = components(x, "p q r")
        H = angular_momentum(self.inertia(), spin)
        return {"energy": dot(spin, H) / 2, "angular momentum squared": dot(H, H)}
