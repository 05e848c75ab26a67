"""What `ucrit.boundary` returns: points on the boundary with their kind, joined to lines or triangles."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ..results.convert import Series, Table, Tabular, unit_of
from .stability_map import StabilityMap

Array = npt.NDArray[Any]


@dataclass(frozen=True, eq=False)
class StabilityBoundary(Tabular):
    """Where stability changes in the space of two or three parameters.

    Attributes
    ----------
    vehicle
        The vehicle with its other parameters.
    parameters
        Names of the parameters.
    lower, upper
        Ends of their ranges [SI].
    log
        Whether steps are those of the logarithm.
    tolerance
        Share of the ranges down to which boundaries were looked for.
    points
        Shape (n, d): points on the boundary [SI].
    kinds
        Shape (n,): ``"divergence"``, ``"flutter"`` or ``"order"`` (a root through infinity).
    line
        Shape (n,): number of the line that a point belongs to, in two parameters; points of one line follow each other.
    pieces
        Shape (m, d): lines or triangles between points, by their indices.
    evaluations
        How many cells and points were evaluated.
    sides
        Map of at most 129 x 129 points that tells which sides are stable, for two parameters.
    """

    vehicle: Model
    parameters: tuple[str, ...]
    lower: Array
    upper: Array
    log: tuple[bool, ...]
    tolerance: float
    points: Array
    kinds: Array
    line: Array
    pieces: Array
    evaluations: int
    sides: StabilityMap | None = None

    @property
    def lines(self) -> tuple[Array, ...]:
        """Curves in two parameters, each of shape (points, 2) [SI]; a closed one ends where it began."""
        if len(self.parameters) != 2:
            return ()
        edges = np.flatnonzero(np.diff(self.line)) + 1
        found = np.split(np.arange(len(self.points)), edges) if len(self.points) else []
        ends = {(int(a), int(b)) for a, b in self.pieces}
        closed = [len(i) > 2 and ((int(i[0]), int(i[-1])) in ends or (int(i[-1]), int(i[0])) in ends) for i in found]
        return tuple(self.points[np.append(i, i[0]) if c else i] for i, c in zip(found, closed, strict=True))

    @property
    def triangles(self) -> Array:
        """Surface in three parameters, shape (m, 3, 3): the corners [SI] of each triangle."""
        return np.asarray(self.points[self.pieces] if len(self.parameters) == 3 else np.zeros((0, 3, 3)))

    def table(self) -> Table:
        """Return the points with their kind and line."""
        rows = ("point",)
        numbers = Series("point", rows, np.arange(1, len(self.points) + 1))
        data = [
            Series(n, rows, x, unit_of(self.vehicle, n)) for n, x in zip(self.parameters, self.points.T, strict=True)
        ]
        data.append(Series("kind", rows, self.kinds))
        if len(self.parameters) == 2:
            data.append(Series("line", rows, self.line + 1))
        return Table("stability boundary", self.vehicle, (numbers,), tuple(data), rows)

    def __str__(self) -> str:
        kinds = ", ".join(f"{np.count_nonzero(self.kinds == kind)} of {kind}" for kind in np.unique(self.kinds))
        return f"boundary over {', '.join(self.parameters)}: {len(self.points)} points ({kinds or 'none'})"


def in_lines(pieces: Array, count: int) -> tuple[Array, Array, Array]:
    """Put the points of plane curves in the order in which the curves run.

    Returns
    -------
    order, pieces, line
        Old indices in the new order, the pieces by new indices, and the number of each point's line.
    """
    beside: list[list[int]] = [[] for _ in range(count)]
    for a, b in pieces.tolist():
        beside[a].append(b)
        beside[b].append(a)
    order: list[int] = []
    line: list[int] = []
    done = [False] * count
    number = 0
    ends = [i for i in range(count) if len(beside[i]) < 2]
    for start in (*ends, *range(count)):
        here: int | None = None if done[start] else start
        number += here is not None
        while here is not None:
            done[here] = True
            order.append(here)
            line.append(number - 1)
            here = next((i for i in beside[here] if not done[i]), None)
    place = np.empty(count, dtype=np.int64)
    place[order] = np.arange(count)
    return np.array(order, dtype=np.int64), place[pieces], np.array(line, dtype=np.int64)
