"""Axes: x along the track, y to the left, psi positive counter-clockwise seen from above. SI units and radians."""

from types import MappingProxyType

from ..core import Drawing, Model, param, sin, state
from ..parts.shapes import rails, wheelset


class WheelsetKinematic(Model):
    """Tapered wheelset rolling without slip on rails (Karnopp 2004, section 1.II)."""

    Psi: float = param("rad", "taper angle of the treads, positive when the flange side is larger")
    r_0: float = param("m", "rolling radius in the central position", above=0)
    l: float = param("m", "distance between the contact points", above=0)
    Omega: float = param("rad/s", "spin of the wheels", above=0)

    y = state("m", "lateral displacement of the wheelset", motion="lateral")
    psi = state("rad", "yaw angle of the wheelset", motion="yaw")

    mode_names = MappingProxyType({"lateral oscillation": "hunting", "yaw oscillation": "hunting"})

    def equations(self, x, dx):
        left = (self.r_0 + self.Psi * x.y) * self.Omega
        right = (self.r_0 - self.Psi * x.y) * self.Omega
        centre = (left + right) / 2
        return (
            dx.y - centre * sin(x.psi),
            dx.psi - (right - left) / self.l,
        )

    def drawing(self, x):
        half = self.l / 2
        shape = (*rails(half, 3 * half), *wheelset(half, self.r_0, (0, x.y), x.psi))
        return Drawing("top", shape, travel=(self.r_0 * self.Omega, 0, 0))
