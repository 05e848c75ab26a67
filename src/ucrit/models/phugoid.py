"""Axes: V along the path of flight, gamma positive climbing; the path lies in a vertical plane. SI units and
radians.

The airplane keeps its angle of attack, so that lift and drag grow with V^2, and its thrust. On the basic motion it
flies level with speed U: lift balances weight, thrust balances drag.
"""

from ..core import Drawing, Model, cos, param, sin, speed, state
from ..parts.shapes import airplane_side


class Phugoid(Model):
    """Slow exchange of speed and height at constant angle of attack (Karnopp 2004, section 9.IV)."""

    epsilon: float = param("1", "drag per lift", at_least=0)
    g: float = param("m/s^2", "gravity", above=0, default=9.80665)
    U: float = speed("speed of level flight")

    V = state("m/s", "speed", motion="phugoid")
    gamma = state("rad", "angle of climb", motion="phugoid")

    mirror = False

    def basic_motion(self):
        return {"x": {"V": self.U}}

    def equations(self, x, dx):
        lift = self.g * (x.V / self.U) ** 2
        drag, thrust = self.epsilon * lift, self.epsilon * self.g
        return (
            dx.V - (thrust - drag - self.g * sin(x.gamma)),
            x.V * dx.gamma - (lift - self.g * cos(x.gamma)),
        )

    def drawing(self, x):
        length = self.U**2 / self.g / 15
        travel = x.V * cos(x.gamma), x.V * sin(x.gamma), 0
        return Drawing("side", airplane_side(length, angle=x.gamma), travel=travel)
