"""Axes and signs as in the caster with a damped flexible pivot. SI units and radians."""

from ..core import param
from .caster_flexible_pivot_damped import CasterFlexiblePivotDamped
from .trailer_handling import TrailerHandling


class CasterHandling(CasterFlexiblePivotDamped, TrailerHandling):
    """Caster with a flexible, damped pivot whose tire can slide (Karnopp 2004, sections 8.V and 4.II)."""

    C = None
    F_z: float = param("N", "vertical load of the wheel", above=0)
