"""Brush tire: bristles that bend until friction lets them slide. Signs as for all tires; SI units and radians."""

from __future__ import annotations

from typing import Any

from ...core.contract.declare import param
from ...core.formulas.functions import length, maximum, tan
from .tire import Forces, Tire


class Brush(Tire):
    """Brush tire with a parabolic pressure over the contact patch (E. Fiala, VDI-Zeitschrift 96 (1954)).

    Its bristles are as stiff along as across the wheel, so that the force always opposes the sliding velocity.
    """

    friction = ("mu",)

    C: float = param("N/rad", "cornering coefficient", above=0)
    mu: float = param("1", "coefficient of friction", above=0, default=0.9)

    def cornering_coefficient(self, F_z: Any) -> Any:
        """Return the cornering coefficient, the same for all loads."""
        return self.C

    def slip_stiffness(self, F_z: Any) -> Any:
        """Return the longitudinal force per slip, the same as across the wheel."""
        return self.cornering_coefficient(F_z)

    def bent(self, F_z: Any, alpha: Any, kappa: Any) -> tuple[Any, Any, Any]:
        """Return the force [N], the slip that both slips are divided by for their share of it, and which share slides.

        The patch slides whole where the force that the bristles would need, a third of it their stiffness times the
        slip, is above that of friction; a locked wheel, which has no bristles that come anew, slides whole.
        """
        held = 3 * self.mu * F_z / self.cornering_coefficient(F_z) * (1 + kappa)
        slip = length(kappa, tan(alpha))
        greater = maximum(slip, held)
        sliding = slip / greater
        return self.mu * F_z * (3 - 3 * sliding + sliding**2), greater, sliding

    def forces(self, F_z: Any, alpha: Any, kappa: Any = 0, gamma: Any = 0) -> Forces:
        """Return the forces on the wheel."""
        force, greater, _ = self.bent(F_z, alpha, kappa)
        return Forces(force * (kappa / greater), -force * (tan(alpha) / greater), 0)
