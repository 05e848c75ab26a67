"""Where in a plane (or box) of parameters a vehicle is stable: a million points in some milliseconds.

No eigenvalue is computed: the coefficients of the characteristic polynomial are known functions of the
parameters, and the conditions of Lienard and Chipart are a few products of them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ..core.compiled import deciding_coefficients
from ..core.errors import UcritError
from ..core.model import Model
from ..numerics.hurwitz import stable as hurwitz_stable
from .convert import Series, Table, Tabular, unit_of
from .sweep import read_ranges

Array = npt.NDArray[Any]

BLOCK = 2**16
"""Points handled together: a dozen temporaries of them stay in the second-level cache."""

MAX_POINTS = 2**31


@dataclass(frozen=True, eq=False)
class StabilityMap(Tabular):
    """Stability of a vehicle over a grid of parameters.

    Attributes
    ----------
    vehicle
        The vehicle, with the grid's values put in.
    coords
        Names of the dimensions, in the order given, with their values [SI].
    stable
        Shape of the grid, bool: every motion decays (where none can decay: none grows). A point exactly on a
        boundary is not stable.
    """

    vehicle: Model
    coords: dict[str, Array]
    stable: Array

    @property
    def dims(self) -> tuple[str, ...]:
        """Names of the dimensions."""
        return tuple(self.coords)

    @property
    def share(self) -> float:
        """Share of the points that are stable, 0 to 1."""
        return float(np.count_nonzero(self.stable) / self.stable.size)

    def table(self) -> Table:
        """Return the map with its coordinates."""
        coords = tuple(Series(name, (name,), x, unit_of(self.vehicle, name)) for name, x in self.coords.items())
        return Table("stability map", self.vehicle, coords, (Series("stable", self.dims, self.stable),), self.dims)


def stability_map(vehicle: Model, /, **grid: Sequence[float] | Array | str) -> StabilityMap:
    """Tell which combinations of some parameters' values are stable.

    Parameters
    ----------
    vehicle
        With scalar parameters, but for those of the grid.
    **grid
        Values of each parameter [SI]: a one-dimensional array, or text such as ``"1e3:1e6:400:log"``
        (see `parse_range`). The result's dimensions come in this order.

    Returns
    -------
    StabilityMap
        Verdicts are those of the characteristic polynomial, right unless the products compared agree to about
        2e-15 (up to fourth order; above, unless a pivot of Routh's array is as small as its rounding error).

    Raises
    ------
    UcritError
        If there is no such parameter, a value is impossible, or there are more than 2e9 points.

    Examples
    --------
    >>> from ucrit import load
    >>> stability_map(load("caravan"), c=[0, 2000, 4000], U=[15, 30]).stable.tolist()
    [[False, False], [False, False], [True, False]]
    """
    if not grid:
        raise UcritError("a stability map needs ranges, such as b=[0.1, 0.2], k=[1e4, 1e5]")
    if extra := [name for name in vehicle.dims if name not in grid]:
        raise UcritError(f"a stability map is that of one vehicle: give one value each for {', '.join(extra)}")
    mapped = vehicle.with_(**read_ranges(vehicle, grid))
    coords = {name: mapped.dims[name] for name in grid}
    shape = tuple(x.size for x in coords.values())
    points = 1
    for count in shape:
        points *= count
    if points > MAX_POINTS:
        raise UcritError(f"{type(vehicle).model_id()}: a map of {points:,} points is too large; at most {MAX_POINTS:,}")
    return StabilityMap(mapped, coords, _decide(mapped, coords, shape))


def _decide(vehicle: Model, coords: dict[str, Array], shape: tuple[int, ...]) -> Array:
    """Judge the grid block by block; nothing but the answer is as large as the grid."""
    names = list(coords)
    declared = [names.index(name) for name in vehicle.dims]
    result = np.empty(shape, dtype=bool)
    answer = result.transpose(declared)
    for block in _blocks(answer.shape):
        part = {name: coords[name][s] for name, s in zip(vehicle.dims, block, strict=True)}
        a = deciding_coefficients(vehicle.with_(**part))
        answer[block] = hurwitz_stable(a) if len(a) > 1 else True
    return result


def _blocks(shape: tuple[int, ...]) -> Iterator[tuple[slice, ...]]:
    """Split a grid into pieces of at most `BLOCK` points, whole in as many last dimensions as possible."""
    inner = int(np.prod(shape[1:]))
    step = max(1, BLOCK // inner)
    rest = list(_blocks(shape[1:])) if inner > BLOCK else [(slice(None),) * (len(shape) - 1)]
    for start in range(0, shape[0], step):
        for tail in rest:
            yield (slice(start, start + step), *tail)
