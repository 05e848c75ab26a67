"""Signs as in the car models: yaw rate and steer angles positive to the right. SI units and radians."""

from ...core.contract.declare import input, param
from ..controller import Controller


class YawRateFeedback(Controller):
    """Front steering in proportion to the error of the yaw rate (Karnopp 2004, Problem 11.5)."""

    drives = ("delta_f",)

    G: float = param("s", "front steer angle per error of the yaw rate")
    r_d = input("rad/s", "desired yaw rate")

    def law(self, x, u):
        return {"delta_f": self.G * (u.r_d - x.r)}
