"""Signs as in the trailer with a steered axle. SI units and radians."""

from ...core.contract.declare import param
from ..controller import Controller


class TrailerSteeringByYawRate(Controller):
    """Trailer's wheels steered in proportion to its yaw rate (Karnopp 2004, Problem 5.12)."""

    drives = ("delta",)

    g: float = param("s", "steer angle of the wheels per yaw rate of the trailer")

    def law(self, x):
        return {"delta": self.g * x.r}
