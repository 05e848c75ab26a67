"""Cells of a box of parameters, halved where a boundary may run, and the simplices in which it does.

Places are whole numbers from 0 to ``count`` on each axis; `Lattice` says which parameter values those are.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import permutations, product

import numpy as np
import numpy.typing as npt

from ...core.errors import UcritError

Array = npt.NDArray[np.float64]
Places = npt.NDArray[np.int64]

WIDE = 24
"""Open cells, for each of a cut across the box, above which excluding them does not pay."""

MAX_CELLS = 2**22
"""Cells held at once."""

START = 8
"""Cells of each axis to begin with."""

LOW, HIGH = slice(None, -1), slice(1, None)
"""The places of an axis with a neighbour above, and with one below."""

SLAB = 2**24
"""Points judged at once where a whole grid is."""


@dataclass(frozen=True)
class Lattice:
    """Ranges of parameters with ``count`` equal steps each, of the value or of its logarithm."""

    names: tuple[str, ...]
    lower: Array
    upper: Array
    log: tuple[bool, ...]
    count: int

    def columns(self, places: npt.NDArray[np.floating | np.integer]) -> dict[str, Array]:
        """Return parameter values at places of shape (points, d), which need not be whole."""
        share = np.asarray(places, dtype=float).T / self.count
        columns = {}
        for name, lo, hi, log, t in zip(self.names, self.lower, self.upper, self.log, share, strict=True):
            value = lo * (hi / lo) ** t if log else lo + (hi - lo) * t
            columns[name] = np.clip(value, lo, hi)
        return columns

    def axes(self) -> dict[str, Array]:
        """Return the parameter values at all places of each axis."""
        every = self.columns(np.arange(self.count + 1)[:, None] * np.ones(len(self.names), dtype=np.int64))
        return dict(every)

    def keys(self, places: Places) -> Places:
        """Return one number for each place of shape (..., d)."""
        return np.asarray(np.ravel_multi_index(tuple(np.moveaxis(places, -1, 0)), (self.count + 1,) * len(self.names)))

    def places(self, keys: Places) -> Places:
        """Return the places, shape (..., d), of their numbers."""
        return np.stack(np.unravel_index(keys, (self.count + 1,) * len(self.names)), axis=-1)


def corners(dimensions: int) -> Places:
    """Return the corners of a unit cell, shape (2^d, d)."""
    return np.array(list(product((0, 1), repeat=dimensions)), dtype=np.int64)


def subdivided(lattice: Lattice, open_: Callable[[Places, int], npt.NDArray[np.bool_]]) -> Places | None:
    """Return the smallest cells that are still open, by their lowest corners of shape (cells, d).

    Parameters
    ----------
    lattice
        The places; ``count`` is a power of two.
    open_
        Tells of cells, by lowest corner and width, in which of them a boundary may run.

    Returns
    -------
    array or None
        ``None`` where so many of them stay open that this is not worth while.
    """
    dimensions = len(lattice.names)
    width = lattice.count // min(START, lattice.count)
    cells = np.array(list(np.ndindex(*(lattice.count // width,) * dimensions)), dtype=np.int64) * width
    while True:
        cells = cells[open_(cells, width)]
        if width == 1 or not len(cells):
            return cells
        if WIDE * (lattice.count // width) ** (dimensions - 1) < len(cells) or len(cells) * 2**dimensions > MAX_CELLS:
            return None
        width //= 2
        cells = (cells[:, None] + width * corners(dimensions)).reshape(-1, dimensions)


def differing(lattice: Lattice, judged: Callable[[Mapping[str, Array]], npt.NDArray[np.bool_]]) -> Places:
    """Return all the smallest cells whose corners differ, by their lowest corners: the whole grid is judged.

    Parameters
    ----------
    lattice
        The places.
    judged
        Tells of a grid, by the values of each axis, where it is stable.

    Raises
    ------
    UcritError
        If there are too many such cells.
    """
    axes, dimensions = lattice.axes(), len(lattice.names)
    first, step = lattice.names[0], max(1, SLAB // (lattice.count + 1) ** (dimensions - 1))
    found: list[Places] = []
    for start in range(0, lattice.count, step):
        some = every = judged({**axes, first: axes[first][start : start + step + 1]})
        for axis in range(dimensions):
            low, high = (tuple(s if k == axis else slice(None) for k in range(dimensions)) for s in (LOW, HIGH))
            some, every = some[low] | some[high], every[low] & every[high]
        found.append(np.argwhere(some & ~every) + np.eye(dimensions, dtype=np.int64)[0] * start)
        if sum(map(len, found)) > MAX_CELLS:
            raise UcritError(
                f"the boundary over {' and '.join(lattice.names)} runs through more than {MAX_CELLS:,} cells: "
                "it fills a region; take smaller ranges or a larger tolerance"
            )
    return np.concatenate(found)


def simplices(dimensions: int) -> Places:
    """Return the triangles or tetrahedra of a unit cell, shape (d!, d + 1, d): paths along its axes."""
    found = []
    for order in permutations(range(dimensions)):
        path = [np.zeros(dimensions, dtype=np.int64)]
        for axis in order:
            path.append(path[-1] + np.eye(dimensions, dtype=np.int64)[axis])
        found.append(path)
    return np.array(found)


def crossed(keys: Places, stable: npt.NDArray[np.bool_]) -> tuple[Places, Places]:
    """Find where a boundary cuts simplices.

    Parameters
    ----------
    keys, stable
        Shape (simplices, d + 1): numbers of the corners, and whether they are stable.

    Returns
    -------
    edges, pieces
        Edges (m, 2) that are cut, the stable corner first, and the pieces of the boundary: lines (k, 2) or
        triangles (k, 3) between cuts, by edge.
    """
    size = keys.shape[1]
    order = np.argsort(~stable, axis=1, kind="stable")
    keys, count = np.take_along_axis(keys, order, axis=1), stable.sum(axis=1)
    parts: list[Places] = []
    for number in range(1, size):
        these = keys[count == number]
        for piece in _pieces(number, size):
            parts.append(these[:, np.array(piece)])
    pairs = np.concatenate(parts) if parts else np.zeros((0, size - 1, 2), dtype=np.int64)
    edges, inverse = np.unique(pairs.reshape(-1, 2), axis=0, return_inverse=True)
    return edges, np.asarray(inverse).reshape(-1, size - 1)


def _pieces(number: int, size: int) -> Sequence[Sequence[tuple[int, int]]]:
    """Pieces of the boundary in a simplex whose first ``number`` corners are stable, each by the edges it cuts."""
    cut = [(i, j) for i in range(number) for j in range(number, size)]
    if len(cut) == size - 1:
        return [cut]
    (a, b, c, d) = cut  # two and two corners of a tetrahedron: four edges, in the order a b d c round the cut
    return [[a, b, d], [a, d, c]]
