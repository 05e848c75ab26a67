"""Axes: x forward, y to the right, z down, through the centre of mass and fixed to the body. SI units and radians.

A plane holds heave, roll and pitch at zero, with a force and two moments that do no work.
"""

from ..core import Drawing
from ..core.contract.drawing import box
from ..parts.shapes import radius_of_gyration
from .rigid_body_symmetric import RigidBodySymmetric


class RigidBodyPlane(RigidBodySymmetric):
    """Rigid body in plane motion, such as a car on the road (Karnopp 2004, problem 2.3)."""

    W = p = q = 0
    Z = L = M = 0
    I_xx = I_yy = I_xz = 0

    even = ("U", "X")

    def possible(self):
        return {}  # of three moments of inertia only one matters

    def drawing(self, x):
        k = radius_of_gyration(self.I_zz, self.m)
        return Drawing("top", (box(3.4 * k, 1.4 * k),), turned=True, travel=(x.U, x.V, x.r))
