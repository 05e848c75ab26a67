"""Axes: x forward, y to the right, z down, through the centre of mass and fixed to the body. SI units and radians."""

from .rigid_body import RigidBody


class RigidBodySymmetric(RigidBody):
    """Rigid body whose x-z plane is one of symmetry (Karnopp 2004, eqs. (2.17) and (2.21))."""

    I_xy = I_yz = 0

    mirror = True
    even = ("U", "W", "q", "X", "Z", "M")
