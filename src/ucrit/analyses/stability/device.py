"""Grids on a graphics processor: one launch for as many rows as fit, whatever limits hold in which part of them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from math import prod
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.numeric import kernels
from ...core.numeric.compiled import Compiled
from .grids import Grid, Tile, limits, segments

Array = npt.NDArray[Any]

POINTS = 2**28
"""Points of a launch: a byte each on the device, and some milliseconds of work."""

ROWS = 2**20
"""Rows of a launch: the values of their parameters are gathered here and copied."""

PIECE = 2**13
"""Points of a row that a block takes: enough that what it does once for a row counts little."""


def by_device(grid: Grid, codes: Array) -> Array:
    """Write codes for the whole grid; return the flat indices of those that are open."""
    layout, along = Layout.of(grid), grid.shape[-1]
    whole = codes.reshape(-1, along)
    if not layout.tables:
        codes[...] = kernels.STABLE
    found = [np.zeros(0, dtype=np.int64)]
    for rows, columns in chunks(grid) if layout.tables else ():
        out, doubts = layout.launch(rows, columns)
        part = whole[rows, columns]
        part[...] = out.copy_to_host()
        for i in np.flatnonzero(doubts.copy_to_host()):
            found.append((rows.start + i) * along + columns.start + np.flatnonzero(part[i] == kernels.OPEN))
    return np.concatenate(found)


def chunks(grid: Grid) -> Iterator[tuple[slice, slice]]:
    """Split a grid into rows, and rows longer than a launch into columns."""
    *shape, along = grid.shape
    step = max(1, min(POINTS // along, ROWS))
    for start in range(0, prod(shape), step):
        for first in range(0, along, POINTS):
            yield slice(start, min(start + step, prod(shape))), slice(first, min(first + POINTS, along))


@dataclass(frozen=True)
class Layout:
    """A grid's segments along each axis, and what the kernel of a direction of running compares with in each tile.

    Attributes
    ----------
    grid, runs
        The grid, and the segments of its axes.
    tables
        Limits of shape (combinations of segments of the outer axes, segments of the inner one, limits), and which of
        those tiles the direction takes; none where nothing decides.
    """

    grid: Grid
    runs: list[list[slice]]
    tables: dict[Compiled, tuple[Array, Array]]

    @classmethod
    def of(cls, grid: Grid) -> Layout:
        """Find segments and limits."""
        runs = [segments(x) for x in grid.axes.values()]
        *outer, last = (len(x) for x in runs)
        tables: dict[Compiled, tuple[Array, Array]] = {}
        shape = (prod(outer), last)
        for place, tile in enumerate(product(*runs)):
            functions = grid.functions(tile)
            if (degree := functions.order - functions.structural_zeros) == 0:
                continue
            table, mine = tables.setdefault(functions, (np.ones((*shape, degree + 1)), np.zeros(shape, dtype=bool)))
            table[divmod(place, last)] = limits(functions, grid.arguments(tile))
            mine[divmod(place, last)] = True
        return cls(grid, runs, tables)

    def launch(self, rows: slice, columns: slice) -> tuple[Any, Any]:
        """Return codes of a chunk on the device, shape (rows, columns), and marks of rows in which some are open."""
        cuda, names = kernels.needed("cuda"), list(type(self.grid.vehicle).declaration.parameters)
        *outer, inner = (names.index(name) for name in self.grid.axes)
        fixed = np.array([np.ravel(x)[0] for x in self.grid.arguments(_first(self.runs))], dtype=float)
        values, kinds = self._rows(rows)
        pieces = _pieces(self.runs[-1], columns)
        along = cuda.to_device(np.ascontiguousarray(list(self.grid.axes.values())[-1][columns]))
        out = cuda.device_array((len(values), along.size), dtype=np.uint8)
        doubts = cuda.to_device(np.zeros(len(values), dtype=np.uint8))
        for functions, (table, mine) in self.tables.items():
            outside, inside = np.flatnonzero(mine.any(axis=1)), np.flatnonzero(mine.any(axis=0))
            here, there = np.flatnonzero(np.isin(kinds, outside)), np.flatnonzero(np.isin(pieces[:, 2], inside))
            if here.size and there.size:
                kernel = kernels.graphics_kernel(functions, tuple(outer), inner)
                given = [cuda.to_device(x) for x in (fixed, table, here, kinds[here], values[here], pieces[there])]
                kernel[(here.size, there.size), kernels.THREADS](*given, along, out, doubts)
        return out, doubts

    def _rows(self, rows: slice) -> tuple[Array, Array]:
        """Values of the outer parameters in each row, and which combination of segments it lies in."""
        *shape, _ = self.grid.shape
        if not shape:
            return np.zeros((1, 0)), np.zeros(1, dtype=np.int64)
        at = np.unravel_index(np.arange(rows.start, rows.stop), shape)
        columns = [x[i] for x, i in zip(self.grid.axes.values(), at, strict=False)]
        numbers = [np.repeat(np.arange(len(run)), [s.stop - s.start for s in run]) for run in self.runs[:-1]]
        own = tuple(number[i] for number, i in zip(numbers, at, strict=True))
        kinds = np.ravel_multi_index(own, [len(run) for run in self.runs[:-1]])
        return np.stack(columns, axis=1), np.asarray(kinds, dtype=np.int64)


def _first(runs: list[list[slice]]) -> Tile:
    return tuple(run[0] for run in runs)


def _pieces(run: list[slice], columns: slice) -> Array:
    """First and last column of each piece, counted from the first of them all, and its segment; shape (pieces, 3)."""
    found = []
    for number, s in enumerate(run):
        start, stop = max(s.start, columns.start), min(s.stop, columns.stop)
        found += [
            (at - columns.start, min(at + PIECE, stop) - columns.start, number) for at in range(start, stop, PIECE)
        ]
    return np.array(found, dtype=np.int64)
