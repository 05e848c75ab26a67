"""Signs as in the lean model: lean and steer angles positive to the right. SI units and radians."""

from ...core.contract.declare import input, param
from ..controller import Controller


class LeanByFrontSteering(Controller):
    """Front steering in proportion to the error of the lean angle (Karnopp 2004, eq. 7.19)."""

    drives = ("delta_f",)

    G: float = param("1", "front steer angle per error of the lean angle")
    theta_d = input("rad", "desired lean angle")

    def law(self, x, u):
        return {"delta_f": -self.G * (u.theta_d - x.theta)}
