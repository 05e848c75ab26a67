"""Tires: slip angle, and one file for each law of the forces between tire and road."""

from .slip import linear_side_force, slip_angle
from .tire import Forces, Tire

__all__ = ["Forces", "Tire", "linear_side_force", "slip_angle"]
