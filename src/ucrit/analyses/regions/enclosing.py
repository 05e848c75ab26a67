"""Stability over boxes of parameters, proved with rounding: the conditions that branch and bound asks about.

Over a box on which a_n, a_0 and H_(n-1) do not vanish no root crosses the imaginary axis (it would cross at zero, as a
pair, or at infinity), so that all of the box is as stable as its centre, where Lienard and Chipart's conditions decide.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ...core.errors import UcritError
from ...core.formulas.codegen import build
from ...core.numeric.compiled import compiled, deciding
from ...numerics.rigorous import Boxes, Proved, ProvedFunctions, minors

Array = npt.NDArray[Any]


class Enclosing:
    """Conditions of one vehicle over boxes of some parameters.

    Parameters
    ----------
    vehicle
        Gives the other parameters: each stands for all numbers that are written or stored as it is.
    names
        Parameters of the boxes, in the order of their dimensions.
    sense
        Sign of the speed.
    """

    def __init__(self, vehicle: Model, names: Sequence[str], sense: int) -> None:
        self.functions = compiled(type(vehicle), sense)
        self.model, self.names = type(vehicle), list(names)
        self.fixed: Mapping[str, Any] = {
            name: Proved.constant(float(value)) for name, value in vehicle.values.items() if name not in names
        }
        self._run = build(self.functions.source, "coefficients", functions=ProvedFunctions())

    def coefficients(self, variables: Sequence[Proved]) -> list[Proved]:
        """Return the deciding coefficients."""
        moving = dict(zip(self.names, variables, strict=True))
        values = [moving[name] if name in moving else self.fixed[name] for name in self.model.declaration.parameters]
        try:
            found = self._run(values)
        except NotImplementedError as error:
            raise UcritError(
                f"{self.model.model_id()}: its equations contain {error}, whose range cannot be proved here"
            ) from None
        lifted = [a if isinstance(a, Proved) else Proved.constant(a) for a in found]
        return list(deciding(self.functions, lifted))

    def signs(self, boxes: Boxes) -> Array:
        """Return the sign of a_n at the centres."""
        low, high = self.coefficients(boxes.centres())[-1].ends
        return np.where(np.broadcast_to(low + high, boxes.centre.shape[1:]) < 0, -1.0, 1.0)

    def barriers(self, boxes: Boxes, sign: Array) -> list[Proved]:
        """Return what must not vanish over a box for stability not to change in it: a_n, a_0 and H_(n-1)."""
        a = [c.times_sign(sign) for c in self.coefficients(boxes.variables())]
        n = len(a) - 1
        return [a[-1], a[0], *(minors(a, [n - 1]).values() if n > 1 else ())]

    def at_centres(self, boxes: Boxes, sign: Array) -> tuple[Array, Array]:
        """Return which centres are stable for sure, and which are not stable for sure."""
        return self._judged([c.times_sign(sign) for c in self.coefficients(boxes.centres())], boxes.centre.shape[1])

    def _judged(self, a: list[Proved], count: int) -> tuple[Array, Array]:
        n = len(a) - 1
        conditions = [*a, *(minors(a, range(n - 1, 1, -2)).values() if n > 2 else ())]
        stable, unstable = np.ones(count, dtype=bool), np.zeros(count, dtype=bool)
        for condition in conditions:
            stable &= np.broadcast_to(condition.ends[0] > 0, count)
            unstable |= np.broadcast_to(condition.ends[1] < 0, count)
        return stable, unstable & np.broadcast_to(a[-1].ends[0] > 0, count)


def within(point: Sequence[float], ranges: Sequence[tuple[Fraction, Fraction]]) -> bool:
    """Tell whether doubles lie in ranges given exactly."""
    return all(low <= Fraction(x) <= high for x, (low, high) in zip(point, ranges, strict=True))
