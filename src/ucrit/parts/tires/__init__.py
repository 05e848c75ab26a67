"""Tires: slip angle, and one file for each law of the forces between tire and road."""

from .load import degressive_coefficient
from .slip import linear_side_force, longitudinal_slip, slip_angle
from .tire import Forces, Tire, axle_coefficient

__all__ = [
    "Forces",
    "Tire",
    "axle_coefficient",
    "degressive_coefficient",
    "linear_side_force",
    "longitudinal_slip",
    "slip_angle",
]
