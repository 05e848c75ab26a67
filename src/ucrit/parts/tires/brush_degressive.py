"""Brush tire whose stiffness depends on its load. Signs as for all tires; SI units and radians."""

from __future__ import annotations

from typing import Any

from ...core.contract.declare import param
from .brush import Brush
from .load import degressive_coefficient


class BrushDegressive(Brush):
    """Brush tire with a cornering coefficient that grows less than the load."""

    C = None
    C_max: float = param("N/rad", "greatest cornering coefficient", above=0)
    F_max: float = param("N", "load of the greatest cornering coefficient", above=0)

    def cornering_coefficient(self, F_z: Any) -> Any:
        """Return the cornering coefficient [N/rad]."""
        return degressive_coefficient(self.C_max, self.F_max, F_z)
