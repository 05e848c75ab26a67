"""Signs as in the car models: yaw rate and steer angles positive to the right. SI units and radians.

The reference is the steady yaw rate of a neutral car, U delta_f/(a + b).
"""

from ...core.contract.declare import output, param, speed
from ..controller import Controller


class YawRateReference(Controller):
    """Steer angle added to the driver's so that the yaw rate follows a reference (Karnopp 2004, Problem 11.6)."""

    drives = ("delta_f",)
    through = True

    G: float = param("s", "added steer angle per error of the yaw rate")
    a: float = param("m", "centre of mass to front axle", above=0)
    b: float = param("m", "centre of mass to rear axle", above=0)
    U: float = speed("forward speed")
    r_d = output("rad/s", "desired yaw rate")

    def desired(self, u):
        return self.U * u.delta_f / (self.a + self.b)

    def law(self, x, u):
        return {"delta_f": u.delta_f + self.G * (self.desired(u) - x.r)}

    def outputs(self, u):
        return {"r_d": self.desired(u)}
