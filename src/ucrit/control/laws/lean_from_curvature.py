"""Signs as in the lean model: lean and curvature positive to the right. SI units and radians."""

from ...core.contract.declare import input, param, speed
from ..controller import Controller


class LeanFromCurvature(Controller):
    """Desired lean angle of a steady turn, from one over its radius (Karnopp 2004, section 7.III, figure 7.4)."""

    drives = ("theta_d",)

    g: float = param("m/s^2", "gravity", above=0)
    U: float = speed("forward speed")
    kappa_d = input("1/m", "desired curvature, one over the turn's radius")

    def law(self, u):
        return {"theta_d": self.U**2 * u.kappa_d / self.g}
