"""Brush tire with its aligning moment. Signs as for all tires; SI units and radians."""

from __future__ import annotations

from typing import Any

from ...core.contract.declare import param
from ...core.formulas.functions import tan
from .brush import Brush
from .tire import Forces


class BrushMoment(Brush):
    """Brush tire with the aligning moment of its side force (E. Fiala, VDI-Zeitschrift 96 (1954)).

    The bent bristles are behind the middle of the contact patch, by a third of its half length where nothing slides.
    """

    l_c: float = param("m", "half length of the contact patch", above=0)

    def forces(self, F_z: Any, alpha: Any, kappa: Any = 0, gamma: Any = 0) -> Forces:
        """Return the forces on the wheel."""
        force, greater, sliding = self.bent(F_z, alpha, kappa)
        F_y = -force * (tan(alpha) / greater)
        trail = self.l_c / 3 * (1 - sliding) ** 3 / (1 - sliding + sliding**2 / 3)
        return Forces(force * (kappa / greater), F_y, -trail * F_y)
