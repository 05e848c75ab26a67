"""Signs as in the lean model: lean and yaw rate positive to the right. SI units and radians."""

from ...core.contract.declare import input, param, speed
from ..controller import Controller


class LeanFromYawRate(Controller):
    """Desired lean angle of a steady turn with a desired yaw rate (Karnopp 2004, section 7.III, figure 7.4)."""

    drives = ("theta_d",)

    g: float = param("m/s^2", "gravity", above=0)
    U: float = speed("forward speed")
    r_d = input("rad/s", "desired yaw rate")

    def law(self, u):
        return {"theta_d": self.U * u.r_d / self.g}
