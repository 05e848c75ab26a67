"""Axes: those of the hitch, forward along its path and to the left; r positive to the right. SI units and
radians.

theta is positive when the trailer's rear swings to the left, omega when the path turns to the right; the
wheels are steered in the same sense as theta.
"""

from ..core import input
from .trailer_active_steering import TrailerActiveSteering


class TrailerSteeredAxle(TrailerActiveSteering):
    """Trailer whose wheels are steered, by whatever law (Karnopp 2004, Problem 5.12)."""

    g = None
    delta = input("rad", "steer angle of the wheels")

    def steer(self, x, u):
        return u.delta

    def outputs(self, x, u):
        return {"offset": super().outputs(x, u)["offset"]}
