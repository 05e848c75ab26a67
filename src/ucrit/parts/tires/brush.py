"""Brush tire: bristles that bend until friction lets them slide. Signs as for all tires; SI units and radians."""

from __future__ import annotations

from typing import Any

from ...core.declare import param
from ...core.functions import minimum, sign, tan, where
from .tire import Forces, Tire


class Brush(Tire):
    """Brush tire with a parabolic pressure over the contact patch (E. Fiala, VDI-Zeitschrift 96 (1954))."""

    C: float = param("N/rad", "cornering coefficient", above=0)
    mu: float = param("1", "coefficient of friction", above=0, default=0.9)

    def forces(self, F_z: Any, alpha: Any, kappa: Any = 0) -> Forces:
        """Return the forces on the wheel."""
        slip = tan(alpha)
        share = minimum(self.C * abs(slip) / (3 * self.mu * F_z), 1)
        F_y = -self.C * slip * (1 - share + share**2 / 3)
        return Forces(0, where(share < 1, F_y, -self.mu * F_z * sign(slip)), 0)
