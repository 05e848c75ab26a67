"""Tire with a clipped side force and an aligning moment that fades. Signs as for all tires; SI units and radians."""

from __future__ import annotations

import math
from typing import Any

from ...core.contract.declare import param
from ...core.formulas.functions import atan2, sign, sin, where
from .tire import Forces, Tire


class Clipped(Tire):
    """Tire of G. Somieski, Aerospace Science and Technology 1 (1997): linear up to a slip angle, constant beyond."""

    c_F: float = param("1/rad", "cornering coefficient per load", above=0)
    c_M: float = param("m/rad", "aligning moment per load and slip angle", at_least=0)
    delta: float = param("rad", "slip angle beyond which the side force is constant", above=0, default=math.radians(5))
    alpha_g: float = param("rad", "slip angle beyond which no moment is left", above=0, default=math.radians(10))

    def cornering_coefficient(self, F_z: Any) -> Any:
        """Return the cornering coefficient, in proportion to the load."""
        return self.c_F * F_z

    def forces(self, F_z: Any, alpha: Any, kappa: Any = 0, gamma: Any = 0) -> Forces:
        """Return the forces on the wheel."""
        clipped = where(abs(alpha) < self.delta, alpha, self.delta * sign(alpha))
        pi = atan2(0 * alpha, -1)  # exact for symbols, unlike math.pi
        wave = self.alpha_g / pi * sin(pi * alpha / self.alpha_g)
        aligning = where(abs(alpha) < self.alpha_g, wave, 0)
        return Forces(0, -self.c_F * F_z * clipped, self.c_M * F_z * aligning)
