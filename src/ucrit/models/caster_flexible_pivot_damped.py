"""Axes: X along the road, Y to the left; the pivot's housing moves along X at speed U. SI units.

theta is positive when the wheel swings to the left; the wheel touches the road a + b behind the pivot: the
trail. The motion is that of a trailer on a flexible hitch.
"""

from types import MappingProxyType

from ..core import Drawing, coordinate, param, speed
from ..parts.shapes import caster
from .trailer import Trailer


class CasterFlexiblePivotDamped(Trailer):
    """Caster with a laterally flexible, damped pivot and a tire that slips (Karnopp 2004, section 8.V)."""

    m: float = param("kg", "mass of the swivelling part", above=0)
    I_c: float = param("kg m^2", "swivel moment of inertia about the centre of mass", above=0)
    a: float = param("m", "pivot to centre of mass, which is behind it", above=0)
    b: float = param("m", "centre of mass to wheel, positive when the wheel is behind", above=0)
    C: float = param("N/rad", "cornering coefficient of the wheel", above=0)
    k: float = param("N/m", "lateral stiffness of the pivot", above=0)
    c: float = param("N m s/rad", "damping of the swivel motion", at_least=0)
    U: float = speed("speed of the pivot's housing", reverse=True)

    x = coordinate("m", "lateral displacement of the pivot", motion="lateral")
    theta = coordinate("rad", "swivel angle", motion="swivel")

    mode_names = MappingProxyType({"lateral oscillation": "shimmy", "swivel oscillation": "shimmy"})

    def drawing(self, x):
        return Drawing("top", caster(self.a + self.b, (0, x.x), -x.theta), travel=(self.U, 0, 0))
