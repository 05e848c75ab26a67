"""Axes and signs as in the trailer. SI units and radians."""

from ..core import param, slot
from ..parts.tires.brush import Brush
from .trailer import Trailer


class TrailerHandling(Trailer):
    """Trailer on a flexible, damped hitch whose tires can slide (Karnopp 2004, sections 5.IV and 4.II)."""

    C = None
    F_z: float = param("N", "vertical load of the axle", above=0)
    tire = slot(Brush, "the axle's tires")

    def tire_force(self, alpha):
        return self.tire.side_force(self.F_z, alpha)
