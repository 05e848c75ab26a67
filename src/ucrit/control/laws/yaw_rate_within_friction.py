"""Signs as in the car models: yaw rate and steer angles positive to the right. SI units and radians."""

from ...core.contract.declare import output, param, state
from ...core.formulas.functions import maximum, minimum
from ..controller import Controller


class YawRateWithinFriction(Controller):
    """Desired yaw rate: that of a steady turn at the driver's steer angle, as far as friction allows, with a lag.

    A steady turn at velocity v has the yaw rate ``v delta/(a + b + K v^2)`` (Karnopp 2004, section 6.IV), and on a road
    of friction mu at most ``mu g/v``.
    """

    drives = ("r_d",)

    a: float = param("m", "centre of mass to front axle", above=0)
    b: float = param("m", "centre of mass to rear axle", above=0)
    g: float = param("m/s^2", "gravity", above=0)
    K: float = param("rad s^2/m", "understeer gradient that is desired", at_least=0, default=0.002)
    mu: float = param("1", "friction that is counted on", above=0, default=0.8)
    tau_d: float = param("s", "lag of the desired yaw rate", above=0, default=0.1)

    wanted = state("rad/s", "desired yaw rate", motion="reference")
    steady = output("rad/s", "yaw rate of a steady turn at the driver's steer angle, within friction")

    def of_steady_turn(self, x, u):
        bound = self.mu * self.g / x.v_x
        free = x.v_x * u.delta_f / (self.a + self.b + self.K * x.v_x**2)
        return maximum(minimum(free, bound), -bound)

    def law(self, x):
        return {"r_d": x.wanted}

    def equations(self, x, dx, u):
        return self.tau_d * dx.wanted + x.wanted - self.of_steady_turn(x, u)

    def outputs(self, x, u):
        return {"steady": self.of_steady_turn(x, u)}
