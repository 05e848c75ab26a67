"""What drawings of a root locus share: the branches worth drawing, and a view that shows what matters."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ..core.errors import UcritError

if TYPE_CHECKING:
    from ..analyses.stability.critical import Critical, CriticalValues
    from ..analyses.stability.locus import Locus
    from ..core.contract.declare import Parameter

Array = npt.NDArray[Any]

FAR = 3.0
"""Roots this many times farther from the origin than those that decide stability do not widen the view."""

ON_AXIS = 1e-9
"""Imaginary parts below this share of the largest eigenvalue count as zero."""


@dataclass(frozen=True)
class Branch:
    """The upper half of one branch: its number among those drawn, its name, its values."""

    index: int
    name: str
    values: Array


def parameter(locus: Locus) -> Parameter:
    """Return the declaration of the parameter that varies."""
    return type(locus.vehicle).declaration.parameters[locus.parameter]


def upper(locus: Locus) -> list[Branch]:
    """Return the branches of a locus but for those that mirror another; of a name, all share one number."""
    found: list[Branch] = []
    numbers: dict[str, int] = {}
    tolerance = ON_AXIS * float(np.abs(locus.branches).max())
    for name, column in zip(locus.names, locus.branches.T, strict=True):
        values = np.where(column.imag < -tolerance, complex(np.nan, np.nan), column)
        if np.isnan(values).all() or not values[~np.isnan(values)].any():
            continue
        shown = name.removesuffix(", conjugate")
        found.append(Branch(numbers.setdefault(shown, len(numbers)), shown, values))
    if not found:
        raise UcritError(f"there is no locus to draw: every root is zero, whatever {locus.parameter} is")
    return found


def at(branch: Branch, where: Array, value: float) -> complex:
    """Interpolate a branch at one value of the parameter; nan outside the range or in the lower half."""
    if not where[0] <= value <= where[-1]:
        return complex(np.nan, np.nan)
    return complex(np.interp(value, where, branch.values.real), np.interp(value, where, branch.values.imag))


def view(branches: Sequence[Branch], where: Array, marked: Sequence[float]) -> tuple[float, float, float]:
    """Return left, right and top of a view with the roots at the marked values and at the range's end."""
    farthest = where[np.argmax(np.abs(where))]
    points = [at(branch, where, value) for value in (*marked, farthest) for branch in branches]
    roots = np.array([p for p in points if not np.isnan(p)])
    size = np.abs(roots[roots != 0])
    deciding = size[np.argsort(-roots[roots != 0].real)][: 2 + len(marked)]
    near = roots[np.abs(roots) <= FAR * max(deciding, default=1.0)]
    left, right, top = near.real.min(initial=0), near.real.max(initial=0), near.imag.max(initial=0)
    width = max(right - left, 0.5 * top, 1e-6)
    left, right = min(left - 0.25 * width, -0.2 * width), max(right + 0.1 * width, 0.2 * width)
    tops = [float(np.nanmax(np.where(_inside(b.values, left, right), b.values.imag, 0))) for b in branches]
    highest = min(max(tops, default=0), 2 * top) if top else max(tops, default=0)
    return float(left), float(right), float(1.12 * max(highest, top) or 0.4 * width)


def _inside(values: Array, left: float, right: float) -> Array:
    with np.errstate(invalid="ignore"):
        return np.asarray((values.real >= left) & (values.real <= right))


def marks(critical: CriticalValues | None, where: Array) -> Iterator[Critical]:
    """Yield the critical values inside a range."""
    yield from (c for c in critical or () if where[0] <= c.value <= where[-1])
