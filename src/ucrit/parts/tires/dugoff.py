"""Tire with a linear law that friction bounds. Signs as for all tires; SI units and radians."""

from __future__ import annotations

from typing import Any

from ...core.contract.declare import param
from ...core.formulas.functions import length, maximum, tan, where
from .slip import is_zero
from .tire import Forces, Tire


class Dugoff(Tire):
    """Tire linear in both slips until half the friction is used (H. Dugoff, P. S. Fancher, L. Segel, SAE 700377).

    With unlike stiffnesses along and across, the force of a sliding wheel opposes its velocity only roughly.
    """

    friction = ("mu",)

    C: float = param("N/rad", "cornering coefficient", above=0)
    C_x: float = param("N", "longitudinal force per slip", above=0, default=100_000)
    mu: float = param("1", "coefficient of friction", above=0, default=0.9)

    def forces(self, F_z: Any, alpha: Any, kappa: Any = 0, gamma: Any = 0) -> Forces:
        """Return the forces on the wheel."""
        along, across = self.C_x / self.C * kappa, tan(alpha)
        twice, held = 2 * self.C * length(along, across), self.mu * F_z * (1 + kappa)
        greater = maximum(twice, held)
        used = held / greater if is_zero(kappa) else where(1 + kappa > 0, held / greater, 0)  # slides whole backward
        stiffness = self.C * self.mu * F_z / greater * (2 - used)
        return Forces(stiffness * along, -stiffness * across, 0)

    def cornering_coefficient(self, F_z: Any) -> Any:
        """Return the cornering coefficient, the same for all loads."""
        return self.C

    def slip_stiffness(self, F_z: Any) -> Any:
        """Return the longitudinal force per slip, the same for all loads."""
        return self.C_x
