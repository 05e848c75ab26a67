"""Slips are below 0 where a wheel is braked, as for all tires. SI units and radians.

The pressure follows what is demanded with a lag, less of it the further the wheel's slip is beyond kappa_0, and none
beyond kappa_0 + band. Where no wheel is braked the law only adds the lags to the vehicle's linear equations.
"""

from ...core.contract.declare import input, output, param, state
from ...core.formulas.functions import maximum, minimum
from ..controller import Controller

WHEELS = ("fl", "fr", "rl", "rr")


class WheelSlipControl(Controller):
    """Brakes that follow their demands with a lag and give way to slip, wheel by wheel (after Karnopp 2004)."""

    drives = tuple(f"brake_{wheel}" for wheel in WHEELS)
    even = tuple(f"{kind}_{wheel}" for kind in ("torque", "demand", "release") for wheel in WHEELS)
    sides = tuple((f"{kind}_{axle}l", f"{kind}_{axle}r") for kind in ("torque", "demand", "release") for axle in "fr")

    tau: float = param("s", "lag of the brakes", above=0, default=0.01)
    kappa_0: float = param("1", "slip of a braked wheel from which its brake gives way", above=0, default=0.05)
    band: float = param("1", "further slip over which it gives way, until it is released", above=0, default=0.1)

    torque_fl = state("N m", "torque of the front left brake", motion="brake")
    torque_fr = state("N m", "torque of the front right brake", motion="brake")
    torque_rl = state("N m", "torque of the rear left brake", motion="brake")
    torque_rr = state("N m", "torque of the rear right brake", motion="brake")

    demand_fl = input("N m", "demanded torque of the front left brake")
    demand_fr = input("N m", "demanded torque of the front right brake")
    demand_rl = input("N m", "demanded torque of the rear left brake")
    demand_rr = input("N m", "demanded torque of the rear right brake")

    release_fl = output("1", "share of the demand that is withheld, front left")
    release_fr = output("1", "share of the demand that is withheld, front right")
    release_rl = output("1", "share of the demand that is withheld, rear left")
    release_rr = output("1", "share of the demand that is withheld, rear right")

    def released(self, y):
        for wheel in WHEELS:
            beyond = (-getattr(y, f"kappa_{wheel}") - self.kappa_0) / self.band
            yield maximum(minimum(beyond, 1), 0)

    def law(self, x):
        return {f"brake_{wheel}": getattr(x, f"torque_{wheel}") for wheel in WHEELS}

    def equations(self, x, dx, u, y):
        return tuple(
            self.tau * getattr(dx, f"torque_{wheel}")
            + getattr(x, f"torque_{wheel}")
            - (1 - released) * getattr(u, f"demand_{wheel}")
            for wheel, released in zip(WHEELS, self.released(y), strict=True)
        )

    def outputs(self, y):
        return {f"release_{wheel}": released for wheel, released in zip(WHEELS, self.released(y), strict=True)}
