"""Linear tire whose coefficient grows less than its load. Signs as for all tires; SI units and radians."""

from __future__ import annotations

from typing import Any

from ...core.contract.declare import param
from .load import degressive_coefficient
from .slip import linear_side_force
from .tire import Forces, Tire


class Degressive(Tire):
    """Tire with a side force in proportion to the slip angle and a coefficient that depends on the load."""

    C_max: float = param("N/rad", "greatest cornering coefficient", above=0)
    F_max: float = param("N", "load of the greatest cornering coefficient", above=0)
    C_x: float = param("N", "longitudinal force per slip", above=0, default=100_000)

    def forces(self, F_z: Any, alpha: Any, kappa: Any = 0, gamma: Any = 0) -> Forces:
        """Return the forces on the wheel."""
        return Forces(self.C_x * kappa, linear_side_force(self.cornering_coefficient(F_z), alpha), 0)

    def cornering_coefficient(self, F_z: Any) -> Any:
        """Return the cornering coefficient [N/rad]."""
        return degressive_coefficient(self.C_max, self.F_max, F_z)

    def slip_stiffness(self, F_z: Any) -> Any:
        """Return the longitudinal force per slip, the same for all loads."""
        return self.C_x
