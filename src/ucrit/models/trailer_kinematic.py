"""Axes: X along the road, Y to the left; the hitch moves along X with speed U. SI units and radians.

theta is positive when the trailer's rear swings to the left; the axle lies a + b behind the hitch.
"""

from types import MappingProxyType

from ..core import Drawing, Model, param, sin, speed, state
from ..parts.shapes import trailer


class TrailerKinematic(Model):
    """Trailer whose hitch follows a straight line and whose wheels do not slip (Karnopp 2004, section 5.II)."""

    a: float = param("m", "hitch to centre of mass", above=0)
    b: float = param("m", "centre of mass to axle, positive when the axle is behind it", at_least=0)
    U: float = speed("speed of the towing vehicle", reverse=True)

    theta = state("rad", "yaw angle of the trailer", motion="yaw")

    mode_names = MappingProxyType({"yaw divergence": "jackknife divergence"})

    def equations(self, x, dx):
        return (self.a + self.b) * dx.theta + self.U * sin(x.theta)

    def drawing(self, x):
        return Drawing("top", trailer(self.a, self.b, angle=-x.theta), travel=(self.U, 0, 0))
