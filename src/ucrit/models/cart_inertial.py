"""Axes: X along the floor, Y to the left, fixed to the floor; phi positive to the left. SI units and radians.

The centre of mass moves along X with speed U; the fixed rear axle lies b behind it. The front casters follow
freely.
"""

from types import MappingProxyType

from ..core import Drawing, Model, coordinate, cos, param, sin, speed
from ..parts.shapes import shopping_cart


class CartInertial(Model):
    """Shopping cart in axes fixed to the floor (Karnopp 2004, section 1.III.A)."""

    m: float = param("kg", "mass", above=0)
    I_z: float = param("kg m^2", "yaw moment of inertia about the centre of mass", above=0)
    b: float = param("m", "centre of mass to rear axle, positive when the axle is behind it", above=0)
    U: float = speed("forward speed", reverse=True)

    y = coordinate("m", "lateral displacement of the centre of mass", motion="lateral")
    phi = coordinate("rad", "yaw angle of the cart", motion="yaw")

    mode_names = MappingProxyType({"yaw angle": "heading", "lateral speed": "heading"})

    def kinetic_energy(self, x, dx):
        return self.m * (self.U**2 + dx.y**2) / 2 + self.I_z * dx.phi**2 / 2

    def constraints(self, x, dx):
        axle_sideways = dx.y * cos(x.phi) - self.U * sin(x.phi) - self.b * dx.phi
        return (axle_sideways,)

    def drawing(self, x):
        return Drawing("top", shopping_cart(self.b, (0, x.y), x.phi), travel=(self.U, 0, 0))
