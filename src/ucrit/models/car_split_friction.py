"""Axes and signs of the four-wheel car: x forward, y to the right, z down; r positive to the right. SI units, radians.

The friction of the road under the wheels of either side is an input, so that it can change on the way. Longitudinal
slips are as for all tires: below 0 where a wheel is braked, -1 where it is locked.
"""

from ..core import input, output, slot
from ..parts.tires.brush import Brush
from .car_four_wheels import WHEELS, CarFourWheels


class CarSplitFriction(CarFourWheels):
    """Plane car on four wheels whose tires friction limits, on a road with two sides (after Karnopp 2004)."""

    front = slot(Brush, "each front tire")
    rear = slot(Brush, "each rear tire")

    mu_left = input("1", "friction under the left wheels over the friction that the tires are given for")
    mu_right = input("1", "friction under the right wheels over the friction that the tires are given for")

    kappa_fl = output("1", "longitudinal slip of the front left wheel")
    kappa_fr = output("1", "longitudinal slip of the front right wheel")
    kappa_rl = output("1", "longitudinal slip of the rear left wheel")
    kappa_rr = output("1", "longitudinal slip of the rear right wheel")

    even = (*CarFourWheels.even, "mu_left", "mu_right", *(f"kappa_{wheel}" for wheel in WHEELS))
    sides = (
        *CarFourWheels.sides,
        ("mu_left", "mu_right"),
        *((f"kappa_{axle}l", f"kappa_{axle}r") for axle in "fr"),
    )

    def basic_motion(self):
        return {**super().basic_motion(), "u": {"mu_left": 1, "mu_right": 1}}

    def tires(self, u):
        return tuple(tire.on_road(mu) for tire, mu in zip(super().tires(u), (u.mu_left, u.mu_right) * 2, strict=True))

    def outputs(self, x, dx, u):
        slips = {f"kappa_{wheel}": kappa for wheel, (_, kappa) in zip(WHEELS, self.slips(x, u), strict=True)}
        return {**super().outputs(x, dx, u), **slips}
