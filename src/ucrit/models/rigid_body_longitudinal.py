"""Axes: x forward, y to the right, z down, through the centre of mass and fixed to the body. SI units and radians.

The body is symmetric about the x-z plane and moves in it, so that nothing is needed to hold it there.
"""

from .rigid_body_symmetric import RigidBodySymmetric


class RigidBodyLongitudinal(RigidBodySymmetric):
    """Rigid body that moves in its plane of symmetry, such as an airplane (Karnopp 2004, problem 2.5)."""

    V = p = r = 0
    Y = L = N = 0
    I_xx = I_zz = I_xz = 0

    def possible(self):
        return {}  # of three moments of inertia only one matters
