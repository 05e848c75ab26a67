"""Grids of parameters, and the tiles of them in which one bound of the rounding errors holds."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise, product
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ...core.numeric.bounds import coefficient_bounds
from ...core.numeric.compiled import Compiled, compiled, direction
from ...numerics.rounded import slacks

Array = npt.NDArray[Any]
Tile = tuple[slice, ...]

SPAN = 16.0
"""Largest ratio of a parameter's values within a tile: one bound of the rounding errors serves it all."""


@dataclass(frozen=True)
class Grid:
    """Values of some parameters of a vehicle, each axis in rising order."""

    vehicle: Model
    axes: Mapping[str, Array]

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of values of each axis."""
        return tuple(x.size for x in self.axes.values())

    def functions(self, tile: Tile) -> Compiled:
        """Compiled functions for a tile, in which the speed has one sign."""
        model = type(self.vehicle)
        name = model.declaration.speed
        if name is None or name not in self.axes:
            return compiled(model, direction(self.vehicle))
        first = self.axes[name][tile[list(self.axes).index(name)]][0]
        return compiled(model, 1 if first > 0 else -1)

    def arguments(self, tile: Tile) -> list[Any]:
        """Parameter values of a tile in declared order, shaped to broadcast."""
        values: dict[str, Any] = dict(self.vehicle.values)
        for i, (name, x) in enumerate(self.axes.items()):
            values[name] = x[tile[i]].reshape([-1 if k == i else 1 for k in range(len(tile))])
        return list(values.values())


def tiles(grid: Grid, most: int) -> Iterator[Tile]:
    """Split a grid where a parameter changes its sign or by more than `SPAN`, and further to at most so many points."""
    for tile in product(*(segments(x) for x in grid.axes.values())):
        sizes = [s.stop - s.start for s in tile]
        steps, room = [], most
        for size in reversed(sizes):
            steps.append(max(1, min(size, room)))
            room //= steps[-1]
        pieces = [
            [slice(at, min(at + step, s.stop)) for at in range(s.start, s.stop, step)]
            for s, step in zip(tile, reversed(steps), strict=True)
        ]
        yield from product(*pieces)


def segments(x: Array) -> list[slice]:
    """Return runs of rising values of one sign in which the size changes by at most a factor `SPAN`."""
    size = np.where(x == 0, 1.0, np.abs(x))
    label = np.sign(x) * (5000 + np.floor(np.log(size) / np.log(SPAN)))
    edges = [0, *(np.flatnonzero(np.diff(label)) + 1), x.size]
    return [slice(int(a), int(b)) for a, b in pairwise(edges)]


def flat(grid: Grid, tile: Tile, inside: Array) -> Array:
    """Flat indices, in the whole grid, of the true entries of a tile."""
    place = [i + s.start for i, s in zip(np.nonzero(inside), tile, strict=True)]
    return np.asarray(np.ravel_multi_index(tuple(place), grid.shape), dtype=np.int64)


def limits(functions: Compiled, arguments: Sequence[Any]) -> Array:
    """Return what the kernels compare with, for a whole tile: errors of the conditions, up to degree 4 their inverses.

    Errors count twice: ordering by powers of the inner parameter, and Horner's rule, round at most as often again.
    """
    sizes, errors = coefficient_bounds(functions, arguments, whole=True)
    with np.errstate(all="ignore"):
        errors = [2 * x for x in errors]
        if len(sizes) > 5:
            return np.array([float(x) for x in errors]) + 1e-300
        return 1 / (np.array([float(x) for x in slacks(sizes, errors)]) + 1e-300)
