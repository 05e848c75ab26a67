"""Signs as in the lean model: lean and steer angles positive to the right. SI units and radians.

With rho = 0 the front alone steers; with rho = -1 both wheels steer by the same angle in opposite senses; with
rho = -b/a the ground point below the centre of mass does not move sideways.
"""

from ...core.contract.declare import input, param
from ..controller import Controller


class LeanByBothSteerings(Controller):
    """Steering at both ends in proportion to the error of the lean angle (after Karnopp 2004, chapter 7)."""

    drives = ("delta_f", "delta_r")

    G: float = param("1", "front steer angle per error of the lean angle")
    rho: float = param("1", "rear steer angle per front steer angle")
    theta_d = input("rad", "desired lean angle")

    def law(self, x, u):
        front = -self.G * (u.theta_d - x.theta)
        return {"delta_f": front, "delta_r": self.rho * front}
