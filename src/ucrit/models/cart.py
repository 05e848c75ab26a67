"""Axes: x forward, y to the left, fixed to the cart's centre of mass; r positive counter-clockwise. SI units.

The fixed rear axle lies b behind the centre of mass. The front casters follow freely, and nothing holds the
forward velocity: this is the exact motion of a Chaplygin sleigh. U is the forward speed of the basic motion.
"""

from ..core import Drawing, Model, algebraic, param, speed, state
from ..parts.shapes import shopping_cart


class Cart(Model):
    """Shopping cart in axes fixed to it, free to change its speed (Karnopp 2004, section 1.III.B)."""

    m: float = param("kg", "mass", above=0)
    I_z: float = param("kg m^2", "yaw moment of inertia about the centre of mass", above=0)
    b: float = param("m", "centre of mass to rear axle, positive when the axle is behind it", above=0)
    U: float = speed("forward speed of the basic motion", reverse=True)

    v_x = state("m/s", "forward velocity of the centre of mass", motion="forward")
    v_y = state("m/s", "lateral velocity of the centre of mass", motion="lateral")
    r = state("rad/s", "yaw rate", motion="yaw")
    Y = algebraic("N", "side force of the floor on the rear axle")

    even = ("v_x",)

    def basic_motion(self):
        return {"x": {"v_x": self.U}}

    def equations(self, x, dx):
        axle_sideways = x.v_y - self.b * x.r
        return (
            self.m * (dx.v_x - x.r * x.v_y),
            self.m * (dx.v_y + x.r * x.v_x) - x.Y,
            self.I_z * dx.r + self.b * x.Y,
            axle_sideways,
        )

    def conserved(self, x, dx):
        return (self.m * (x.v_x**2 + x.v_y**2) / 2 + self.I_z * x.r**2 / 2,)

    def drawing(self, x):
        return Drawing("top", shopping_cart(self.b), travel=(x.v_x, x.v_y, x.r))

    def events(self, x):
        return {"turns round": x.v_x}
