"""Critical speeds of very many vehicles of one model at once, without a loop over them.

Where the characteristic polynomial is a polynomial in the speed, so are a_0, a_n and the last but one Hurwitz
determinant, whose real roots divide the axis of speeds. Verdicts between them tell which roots are critical; the
rest, and roots that rounding has made complex, do no harm. What is found is refined by bisection on the verdict.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ...core.numeric.compiled import Compiled, compiled, deciding
from ...core.record import Record
from ...numerics.bundles import hurwitz_bundle, real_parts
from ...numerics.hurwitz import stable as hurwitz_stable
from ..stability.judge import settle

Array = npt.NDArray[Any]

BLOCK = 4096
"""Vehicles handled together."""

ACCURACY = 1e-11
"""Relative width to which critical speeds are refined."""

GRID = np.geomspace(1e-3, 1e3, 241)
"""Speeds, relative to the vehicle's own, that divide the axis where the model is no polynomial in the speed."""


@dataclass(frozen=True)
class Crossings(Record):
    """Where stability changes with the size of the speed, for N vehicles.

    Attributes
    ----------
    stable_at_lower
        Shape (N,): whether a vehicle is stable at the lowest speeds.
    edges
        Shape (N, M) [m/s]: all critical speeds, ascending, infinity behind the last.
    exact
        Whether all roots of the boundary polynomials were looked at, or speeds a few percent apart.
    """

    stable_at_lower: Array
    edges: Array
    exact: bool

    def stable(self, speed: float) -> Array:
        """Return which vehicles are stable at a speed."""
        return np.asarray(self.stable_at_lower ^ (np.count_nonzero(self.edges <= speed, axis=1) % 2 == 1))

    def first_lost(self) -> Array:
        """Return where stability is first lost, shape (N,): infinity if never, 0 where there is none to lose."""
        lost = np.where(self.stable_at_lower[:, None] ^ (np.arange(self.edges.shape[1]) % 2 == 1), self.edges, np.inf)
        first = lost.min(axis=1, initial=np.inf)
        never_stable = ~self.stable_at_lower & ~np.isfinite(self.edges).any(axis=1)
        return np.where(never_stable, 0.0, first)


def crossings(
    vehicle: Model,
    columns: Mapping[str, Array],
    sense: int = 1,
    progress: Callable[[int, int], None] | None = None,
) -> Crossings:
    """Find all critical speeds of many vehicles.

    Parameters
    ----------
    vehicle
        Gives all values that ``columns`` does not, and the scale of speeds.
    columns
        Values of some parameters, all of one length N, already checked.
    sense
        +1 forward, -1 backing up.
    progress
        Called with the number of vehicles done and of all.
    """
    count = len(next(iter(columns.values())))
    parts = []
    for start in range(0, count, BLOCK):
        block = {name: values[start : start + BLOCK] for name, values in columns.items()}
        parts.append(_Block(vehicle, block, sense).found())
        if progress is not None:
            progress(min(start + BLOCK, count), count)
    width = max(part.edges.shape[1] for part in parts)
    edges = [np.pad(p.edges, ((0, 0), (0, width - p.edges.shape[1])), constant_values=np.inf) for p in parts]
    stable = np.concatenate([part.stable_at_lower for part in parts])
    return Crossings(stable, np.concatenate(edges), parts[0].exact)


class _Block:
    """One block of vehicles; speeds are relative to ``unit`` (the vehicle's own) and positive."""

    def __init__(self, vehicle: Model, columns: Mapping[str, Array], sense: int) -> None:
        self.vehicle = vehicle
        self.functions: Compiled = compiled(type(vehicle), sense)
        self.speed = str(type(vehicle).declaration.speed)
        self.unit = abs(float(vehicle.values[self.speed])) * sense
        self.values = {**vehicle.values, **columns}
        self.count = len(next(iter(columns.values())))

    def coefficients(self, speeds: Array, rows: Any = slice(None)) -> tuple[Any, ...]:
        """Return the deciding coefficients at speeds of shape (rows,) or (rows, K)."""
        lead = (-1,) + (1,) * (np.ndim(speeds) - 1)
        values = {k: np.asarray(v)[rows].reshape(lead) if np.ndim(v) else v for k, v in self.values.items()}
        with np.errstate(all="ignore"):
            a = self.functions.coefficients([*{**values, self.speed: speeds * self.unit}.values()])
        return deciding(self.functions, a)

    def stable(self, speeds: Array, rows: Any = slice(None)) -> Array:
        """Return the verdicts at speeds."""
        a = self.coefficients(speeds, rows)
        if len(a) < 2:
            return np.ones(np.shape(speeds), dtype=bool)
        return np.asarray(np.broadcast_to(hurwitz_stable(a), np.shape(speeds)))

    def judged(self, speeds: Array) -> Array:
        """Return the verdicts at speeds of shape (rows, K), where rounding might matter by the exact judge."""
        repeated = {k: np.repeat(np.asarray(v), speeds.shape[1]) for k, v in self.values.items() if np.ndim(v)}
        return settle(self.vehicle, {**repeated, self.speed: speeds.ravel() * self.unit}).reshape(speeds.shape)

    def found(self) -> Crossings:
        """Return the crossings of this block."""
        candidates, exact = self._candidates()
        mids = np.empty((self.count, candidates.shape[1] + 1))
        ends = np.where(np.isfinite(candidates), candidates, 0).max(axis=1, initial=0)
        last = np.where(ends > 0, 2 * ends, 1.0)
        limited = np.minimum(candidates, 3 * last[:, None])  # beyond the last one, where nothing changes
        mids[:, 1:-1] = (limited[:, 1:] + limited[:, :-1]) / 2
        if candidates.shape[1]:
            mids[:, 0], mids[:, -1] = limited[:, 0] / 2, np.maximum(last, limited[:, -1])
        else:
            mids[:, 0] = last
        stable = self.judged(mids)
        rows, places = np.nonzero(stable[:, 1:] != stable[:, :-1])
        values = self._refined(rows, candidates[rows, places], mids[rows, places], mids[rows, places + 1])
        return Crossings(stable[:, 0], self._by_row(rows, values * abs(self.unit)), exact)

    def _by_row(self, rows: Array, values: Array) -> Array:
        """Put values, which come row by row, into a table with infinity behind the last of each row."""
        counts = np.bincount(rows, minlength=self.count)
        table = np.full((self.count, int(counts.max(initial=0))), np.inf)
        starts = np.concatenate([[0], np.cumsum(counts)[:-1]])
        table[rows, np.arange(len(rows)) - starts[rows]] = values
        return np.sort(table, axis=1)

    def _candidates(self) -> tuple[Array, bool]:
        """Return positive speeds, ascending, between which stability cannot change; and whether that is sure."""
        degrees = self.functions.degrees(self.speed)
        if degrees is None:
            return np.broadcast_to(GRID, (self.count, GRID.size)), False
        a = self._polynomials(degrees)
        if len(a) < 2:
            return np.zeros((self.count, 0)), True
        boundaries = [a[0], a[-1], *([hurwitz_bundle(a)] if len(a) > 2 else [])]
        return np.sort(np.concatenate([real_parts(p) for p in boundaries], axis=1), axis=1), True

    def _polynomials(self, degrees: list[int]) -> list[Array]:
        """Return the deciding coefficients as polynomials in the speed, by interpolation at Chebyshev points."""
        nodes = 1 + np.cos(np.pi * (np.arange(max(degrees) + 1) + 0.5) / (max(degrees) + 1))
        a = self.coefficients(np.broadcast_to(nodes, (self.count, nodes.size)))
        rows = [np.array(np.broadcast_to(x, (self.count, nodes.size)), dtype=float) for x in a]
        sizes = [float(np.median(np.abs(x).max(axis=1))) for x in rows]
        rate = (sizes[0] / sizes[-1]) ** (1 / (len(a) - 1)) if len(a) > 1 and sizes[0] > 0 < sizes[-1] else 1.0
        inverse = np.linalg.inv(np.vander(nodes, increasing=True)).T
        with np.errstate(all="ignore"):
            return [x * (rate**k / (sizes[-1] * rate ** (len(a) - 1) or 1.0)) @ inverse for k, x in enumerate(rows)]

    def _refined(self, rows: Array, guess: Array, lower: Array, upper: Array) -> Array:
        """Bisect between speeds of different verdicts, at first closely around the guessed ones."""
        before = self.stable(lower, rows) if len(rows) else np.zeros(0, dtype=bool)
        for margin in (1e-6, 1e-9):
            near, far = guess * (1 - margin), guess * (1 + margin)
            tight = (near > lower) & (far < upper)
            near, far = np.where(tight, near, lower), np.where(tight, far, upper)
            if len(rows):
                lower = np.where(self.stable(near, rows) == before, np.maximum(near, lower), lower)
                upper = np.where(self.stable(far, rows) != before, np.minimum(far, upper), upper)
        while len(rows) and np.any(upper - lower > ACCURACY * upper):
            middle = (lower + upper) / 2
            same = self.stable(middle, rows) == before
            lower, upper = np.where(same, middle, lower), np.where(same, upper, middle)
        return np.asarray((lower + upper) / 2)
