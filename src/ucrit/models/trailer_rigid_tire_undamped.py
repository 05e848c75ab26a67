"""Axes and signs as in the trailer. SI units and radians."""

from .trailer_rigid_tire import TrailerRigidTire


class TrailerRigidTireUndamped(TrailerRigidTire):
    """Trailer with a flexible, undamped hitch whose wheels cannot slip sideways (Karnopp 2004, section 5.III)."""

    c = 0.0
