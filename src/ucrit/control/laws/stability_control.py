"""Axes of the four-wheel car: y to the right, yaw rate positive to the right. SI units and radians.

Which wheel is braked, with the error e of the yaw rate beyond a dead band (Karnopp 2004, figure 11.2):

======== =============================== ===============================
turn     oversteer: |r| too large        understeer: |r| too small
======== =============================== ===============================
right    e > 0: front left (outer)       e < 0: rear right (inner)
left     e < 0: front right (outer)      e > 0: rear left (inner)
======== =============================== ===============================

The side is that of the error, the axle that of the turn, and where the car hardly turns both wheels share. Where the
driver brakes, the brakes of the other side give way as well: on a road whose friction differs from side to side nothing
else helps, since the wheels that should brake more have no grip for it. Inside the dead band the law does nothing: the
vehicle's linear equations stay as they are.
"""

from ...core.contract.declare import input, output, param
from ...core.formulas.functions import maximum, minimum, where
from ..controller import Controller


class StabilityControl(Controller):
    """Stability control by braking one wheel: outer front or inner rear (after Karnopp 2004, figure 11.2)."""

    drives = ("demand_fl", "demand_fr", "demand_rl", "demand_rr")
    even = ("brake", "added_fl", "added_fr", "added_rl", "added_rr")
    sides = (("added_fl", "added_fr"), ("added_rl", "added_rr"))

    G: float = param("N m s", "brake torque per error of the yaw rate", at_least=0, default=30_000)
    G_beta: float = param("1/s", "error of the yaw rate per sideslip angle beyond its bound", at_least=0, default=3.0)
    e_0: float = param("rad/s", "error of the yaw rate below which nothing is braked", above=0, default=0.05)
    beta_0: float = param("rad", "sideslip angle below which it does not count", above=0, default=0.07)
    r_0: float = param("rad/s", "yaw rate up to which front and rear wheel share", above=0, default=0.05)
    share: float = param("1", "front axle's share of the driver's braking", at_least=0, at_most=1, default=0.65)

    relief: float = param(
        "1", "torque that is taken from the other side, over the torque added", at_least=0, default=1.0
    )

    r_d = input("rad/s", "desired yaw rate")
    brake = input("N m", "brake torque that the driver demands, all wheels together")

    error = output("rad/s", "yaw rate less the desired one, with what sideslip adds")
    added_fl = output("N m", "torque that is demanded beyond the driver's, front left")
    added_fr = output("N m", "torque that is demanded beyond the driver's, front right")
    added_rl = output("N m", "torque that is demanded beyond the driver's, rear left")
    added_rr = output("N m", "torque that is demanded beyond the driver's, rear right")

    def deviation(self, x, u, y):
        """Error of the yaw rate; a car whose tail is out to one side turns too much to the other."""
        slides = beyond(y.beta, self.beta_0)
        return x.r - u.r_d - self.G_beta * slides

    def torques(self, x, u, y):
        """Torques that are added: front left, front right, rear left, rear right."""
        error = self.deviation(x, u, y)
        left, right = self.G * maximum(error - self.e_0, 0), self.G * maximum(-error - self.e_0, 0)
        turn = maximum(minimum(x.r / (2 * self.r_0) + 0.5, 1), 0)  # 1 in a turn to the right, 0 to the left
        return left * turn, right * (1 - turn), left * (1 - turn), right * turn

    def drivers(self, x, u, y):
        """Torques of the driver's that are left."""
        error, front = self.deviation(x, u, y), self.share / 2
        for part, against in zip((front, front, 0.5 - front, 0.5 - front), (-error, error) * 2, strict=True):
            own, taken = part * u.brake, self.relief * self.G * (against - self.e_0)
            yield where(against > self.e_0, maximum(own - taken, 0), own)

    def law(self, x, u, y):
        parts = zip(self.drives, self.drivers(x, u, y), self.torques(x, u, y), strict=True)
        return {name: own + added for name, own, added in parts}

    def outputs(self, x, u, y):
        added = zip(("added_fl", "added_fr", "added_rl", "added_rr"), self.torques(x, u, y), strict=True)
        return {"error": self.deviation(x, u, y), **dict(added)}


def beyond(value, bound):
    """Return by how much a value is above its bound, or below minus its bound."""
    return value - maximum(minimum(value, bound), -bound)
