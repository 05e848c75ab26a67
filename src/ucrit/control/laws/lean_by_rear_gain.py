"""Signs as in the lean model: lean and steer angles positive to the right. SI units and radians."""

from ...core.contract.declare import input, param
from ..controller import Controller


class LeanByRearGain(Controller):
    """Rear steering in proportion to the error of the lean angle, which cannot work (Karnopp 2004, eq. 7.34)."""

    drives = ("delta_r",)

    G: float = param("1", "rear steer angle per error of the lean angle")
    theta_d = input("rad", "desired lean angle")

    def law(self, x, u):
        return {"delta_r": self.G * (u.theta_d - x.theta)}
