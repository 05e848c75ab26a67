"""Tire whose side force is in proportion to the slip angle. Signs as for all tires; SI units and radians."""

from __future__ import annotations

from typing import Any

from ...core.contract.declare import param
from .slip import linear_side_force
from .tire import Forces, Tire


class Linear(Tire):
    """Tire with a side force in proportion to the slip angle, whatever its load (Karnopp 2004, section 4.II)."""

    C: float = param("N/rad", "cornering coefficient", above=0)
    C_x: float = param("N", "longitudinal force per slip", above=0, default=100_000)

    def forces(self, F_z: Any, alpha: Any, kappa: Any = 0, gamma: Any = 0) -> Forces:
        """Return the forces on the wheel."""
        return Forces(self.C_x * kappa, linear_side_force(self.C, alpha), 0)

    def cornering_coefficient(self, F_z: Any) -> Any:
        """Return the cornering coefficient, the same for all loads."""
        return self.C

    def slip_stiffness(self, F_z: Any) -> Any:
        """Return the longitudinal force per slip, the same for all loads."""
        return self.C_x
