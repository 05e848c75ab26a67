"""Signs as in the lean model: lean and steer angles positive to the right. SI units and radians.

G (T_1 s + 1)/(T_2 s + 1) times the error of the lean angle. The lean model with one pole more has three coefficients,
and the compensator three numbers: the three poles can be placed at will.
"""

from ...core.contract.declare import input, param, state
from ..controller import Controller


class LeanByRearSteering(Controller):
    """Rear steering by the lean error through a compensator of first order (after Karnopp 2004, chapter 7)."""

    drives = ("delta_r",)

    G: float = param("1", "rear steer angle per lasting error of the lean angle")
    T_1: float = param("s", "time constant that leads")
    T_2: float = param("s", "time constant that lags")
    e_slow = state("rad", "error of the lean angle after the lag", motion="compensator")
    theta_d = input("rad", "desired lean angle")

    def law(self, x, u):
        error = u.theta_d - x.theta
        return {"delta_r": self.G * (x.e_slow + self.T_1 * (error - x.e_slow) / self.T_2)}

    def equations(self, x, dx, u):
        return self.T_2 * dx.e_slow + x.e_slow - (u.theta_d - x.theta)
