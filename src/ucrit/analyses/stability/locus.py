"""Root locus: the eigenvalues as continuous, named branches along one parameter."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.declare import Parameter
from ...core.contract.model import Model
from ...core.contract.possible import allowed
from ...core.errors import UcritError
from ...core.units import to_si
from ...numerics.tracking import track_adaptive
from ..linear.modes import eigensystem, eigenvalues, growth, modes
from ..results.convert import Series, Table, Tabular, complex_series, unit_of
from .critical import critical, parameter_name
from .dense import dense_branches

Array = npt.NDArray[Any]

SMALLEST = 0.01
"""Start of a default range as a share of its end."""

FARTHEST = 10.0
"""Critical values beyond this multiple of the present value do not stretch the default range."""

STEP = 0.05
"""Change of an eigenvalue in one step, as a share of its size, above which the step is halved."""

MOST_POINTS = 10_000_000
"""Points that a locus may have."""

TRACKED = 2000
"""Points that are tracked; further ones are filled in between."""

ROUNDS = 6
"""Times that steps are halved."""


@dataclass(frozen=True, eq=False)
class Locus(Tabular):
    """Eigenvalues of a vehicle along one parameter, each column of ``branches`` a continuous curve.

    Attributes
    ----------
    vehicle
        The vehicle that the branches are named for.
    parameter, unit
        What varies, and its unit.
    values
        Shape (S,): rising values of the parameter [SI], denser where eigenvalues move fast.
    branches
        Shape (S, n) [1/s]: each row a permutation of the eigenvalues at that value.
    names
        Name of the mode of each branch where the vehicle is on it: at its own value of the parameter, or, if
        that is outside the range, at the nearest end.
    reference
        The parameter's value [SI] that the names are for.
    """

    vehicle: Model
    parameter: str
    unit: str
    values: Array
    branches: Array
    names: tuple[str, ...]
    reference: float

    @property
    def growth(self) -> Array:
        """Largest real part [1/s] at each value but for rigid positions, shape (S,)."""
        return growth(self.vehicle, self.branches)

    def table(self) -> Table:
        """Return the branches, by name, with real and imaginary part."""
        coords = (
            Series(self.parameter, (self.parameter,), self.values, self.unit),
            Series("mode", ("mode",), np.array(self.names)),
        )
        data = complex_series("eigenvalue", (self.parameter, "mode"), self.branches, "1/s")
        return Table("root locus", self.vehicle, coords, data, (self.parameter,))


def locus(
    vehicle: Model,
    parameter: str | None = None,
    lower: float | str | None = None,
    upper: float | str | None = None,
    points: int = 400,
    depth: int = 8,
) -> Locus:
    """Follow every eigenvalue of a vehicle along one parameter.

    Parameters
    ----------
    vehicle
        With scalar parameters.
    parameter
        The speed by default.
    lower, upper
        Range [SI, or text with a unit]. By default it ends at 1.5 times the present or the largest critical value,
        whichever is larger (critical values beyond ten times the present one aside), and starts at a hundredth of that.
    points
        Even steps to begin with; where eigenvalues move fast some are halved, up to six times.
    depth
        Times that a step is halved in which it is in doubt which eigenvalue goes where. Fewer are faster.

    Returns
    -------
    Locus
        No eigenvalue is lost or doubled; the two of a complex pair keep their half planes. Where real roots
        meet and turn complex, which of the two takes which side is arbitrary.

    Raises
    ------
    UcritError
        If there is no such parameter, the range is empty or not allowed, or a parameter is an array.

    Examples
    --------
    >>> from ucrit import load
    >>> result = locus(load("caravan"))
    >>> result.names[0], result.branches.shape[1]
    ('sway', 4)
    """
    name = parameter_name(vehicle, parameter)
    if vehicle.dims:
        raise UcritError(f"a root locus is that of one vehicle: give one value each for {', '.join(vehicle.dims)}")
    if isinstance(points, bool) or not isinstance(points, int) or not 2 <= points <= MOST_POINTS:
        raise UcritError(f"a root locus needs 2 to {MOST_POINTS} points, got {points!r}")
    if isinstance(depth, bool) or not isinstance(depth, int) or not 0 <= depth <= 50:
        raise UcritError(f"depth must be a whole number from 0 to 50, got {depth!r}")
    lo, hi = _range(vehicle, name, lower, upper)
    now = float(vehicle.values[name])
    reference = min(max(now, lo), hi)
    few = min(points, TRACKED)
    grid = _refined(vehicle, name, np.unique(np.append(np.linspace(lo, hi, few), reference)), 8 * few)
    result = _tracked(vehicle, name, grid, reference, depth)
    if points <= few:
        return result
    more = np.unique(np.append(np.linspace(lo, hi, points), grid))
    branches = dense_branches(vehicle, name, more, grid, result.branches)
    if branches is None:
        return _tracked(vehicle, name, _refined(vehicle, name, more, 8 * points), reference, depth)
    return replace(result, values=more, branches=branches)


def _tracked(vehicle: Model, name: str, grid: Array, reference: float, depth: int) -> Locus:
    """Follow the eigenvalues over a grid that holds the reference."""

    def family(values: Array) -> tuple[Array, Array]:
        return eigensystem(vehicle.with_(**{name: values}))

    tracked = track_adaptive(family, grid, max_depth=depth)
    here = int(np.argmin(np.abs(grid - reference)))
    branches = tracked.branches[:, np.argsort(tracked.permutation[here])]
    named = modes(vehicle.with_(**{name: reference})).names
    return Locus(vehicle, name, unit_of(vehicle, name), grid, branches, named, reference)


def _range(vehicle: Model, name: str, lower: float | str | None, upper: float | str | None) -> tuple[float, float]:
    """Complete the range and refuse one that is empty or not allowed."""
    parameter = allowed(vehicle, name)
    lo, hi = (None if end is None else _finite(end, name, parameter.unit) for end in (lower, upper))
    if lo is None or hi is None:
        near, far = _default(vehicle, name, parameter)
        lo, hi = (near if lo is None else lo), (far if hi is None else hi)
    if not lo < hi:
        raise UcritError(f"{name}: the range from {lo:g} to {hi:g} {parameter.unit} is empty")
    vehicle.with_(**{name: [lo, hi]})
    return lo, hi


def _finite(end: float | str, name: str, unit: str) -> float:
    value = to_si(end, unit, name)
    if not math.isfinite(value):
        raise UcritError(f"{name}: the ends of a range must be finite, got {value:g}")
    return value


def _default(vehicle: Model, name: str, parameter: Parameter) -> tuple[float, float]:
    """Ends of the default range, on the side of zero where the present value lies and within the bounds."""
    now = float(vehicle.values[name])
    side = -1.0 if now < 0 else 1.0
    found = [side * c.value for c in critical(vehicle, name) if side * c.value > 0]
    near = [value for value in found if not now or value <= FARTHEST * abs(now)]
    top = 1.5 * max([abs(now), *near])
    if not top:
        raise UcritError(f"{name}: with the present value 0 and no critical value a range must be given")
    ends = sorted((side * SMALLEST * top, side * top))
    # Just inside a bound, whether or not it is itself allowed.
    margin = 1e-6 * top
    lo, hi = max(ends[0], parameter.lower + margin), min(ends[1], parameter.upper - margin)
    return lo, hi


def _refined(vehicle: Model, name: str, grid: Array, most: int) -> Array:
    """Halve steps in which some eigenvalue moves far, up to a number of points."""
    values = eigenvalues(vehicle.with_(**{name: grid}))
    for _ in range(ROUNDS):
        middle = (grid[1:] + grid[:-1]) / 2
        wide = _far(values) & (middle > grid[:-1]) & (middle < grid[1:])
        if not wide.any() or grid.size + np.count_nonzero(wide) > most:
            break
        places = np.flatnonzero(wide) + 1
        new = middle[wide]
        values = np.insert(values, places, eigenvalues(vehicle.with_(**{name: new})), axis=0)
        grid = np.insert(grid, places, new)
    return grid


def _far(values: Array) -> Array:
    """Steps in which some eigenvalue is farther than `STEP` of its size from all those before."""
    here, there = values[:-1, :, None], values[1:, None, :]
    moved = np.abs(here - there).min(axis=1)
    size = np.abs(values[1:])
    floor = 0.1 * np.median(size[size > 0]) if size.any() else 0.0
    return np.asarray((moved > STEP * np.maximum(size, floor)).any(axis=1))
