"""Axes and signs as in the caster with a damped flexible pivot. SI units and radians."""

from .caster_flexible_pivot_damped import CasterFlexiblePivotDamped


class CasterFlexiblePivot(CasterFlexiblePivotDamped):
    """Caster with a laterally flexible pivot and a tire that slips, undamped (Karnopp 2004, section 8.V)."""

    c = 0.0
