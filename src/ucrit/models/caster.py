"""Axes: X along the road, Y to the left; the pivot moves along X with speed U. SI units and radians.

theta is positive when the wheel swings to the left; the wheel touches the road a + b behind the pivot: the
trail. The motion is that of a trailer on a rigid hitch.
"""

from types import MappingProxyType

from ..core import Drawing, coordinate, param, speed
from ..parts.shapes import caster
from .trailer_rigid_hitch import TrailerRigidHitch


class Caster(TrailerRigidHitch):
    """Caster with a vertical pivot that follows a straight line (Karnopp 2004, section 8.II)."""

    m: float = param("kg", "mass of the swivelling part", above=0)
    I_c: float = param("kg m^2", "swivel moment of inertia about the centre of mass", above=0)
    a: float = param("m", "pivot to centre of mass, which is behind it", above=0)
    b: float = param("m", "centre of mass to wheel, positive when the wheel is behind", above=0)
    C: float = param("N/rad", "cornering coefficient of the wheel", above=0)
    U: float = speed("speed of the pivot", reverse=True)

    theta = coordinate("rad", "swivel angle", motion="swivel")

    mode_names = MappingProxyType({"swivel oscillation": "shimmy"})

    def drawing(self, x):
        return Drawing("top", caster(self.a + self.b, angle=-x.theta), travel=(self.U, 0, 0))
