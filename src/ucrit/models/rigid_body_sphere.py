"""Axes: x forward, y to the right, z down, through the centre of mass and fixed to the body. SI units and radians."""

from ..core import param
from .rigid_body_symmetric import RigidBodySymmetric


class RigidBodySphere(RigidBodySymmetric):
    """Rigid body with the same moment of inertia about all axes, such as a sphere (Karnopp 2004, problem 2.4)."""

    I: float = param("kg m^2", "moment of inertia about any axis through the centre of mass", above=0)
    I_xx = I_yy = I_zz = property(lambda self: self.I)
    I_xz = 0

    def possible(self):
        return {}  # a sphere of any size
