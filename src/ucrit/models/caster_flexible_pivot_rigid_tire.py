"""Axes and signs as in the caster with a damped flexible pivot. SI units and radians."""

from .caster_flexible_pivot_damped import CasterFlexiblePivotDamped
from .trailer_rigid_tire import TrailerRigidTire


class CasterFlexiblePivotRigidTire(CasterFlexiblePivotDamped, TrailerRigidTire):
    """Caster with a flexible, damped pivot whose wheel cannot slip sideways (Karnopp 2004, section 8.IV)."""

    C = None
