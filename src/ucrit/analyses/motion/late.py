"""Inputs that are what the motion itself was one delay before: remembered, and read again (method of steps).

R. D. Driver, Ordinary and Delay Differential Equations (1977), chapter V.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from itertools import combinations_with_replacement, pairwise
from typing import Any

import numpy as np
import numpy.typing as npt

from .follow import Stretch
from .manoeuvres import Piece, Signal

Array = npt.NDArray[Any]

NODES = 16
"""Points of each step of the solver at which what is late is worked out; between them it is a polynomial."""

SMOOTH = 4
"""Sums of so many delays at most at which a kink is looked for: each delay makes it smoother by one derivative."""

CLOSE = 1e-12
"""Share of the whole time within which two kinks are one."""


@dataclass(frozen=True)
class LateInput:
    """An input by its place, the place of what it was among states and outputs, the delay [s], and its past."""

    place: int
    quantity: int
    delay: float
    before: Callable[[float], float]


@dataclass
class Memory:
    """What late inputs need of the motion so far.

    ``outputs`` gives the outputs of states (n, T) and inputs (m, T); ``stretches`` is the course, which grows.
    """

    late: Sequence[LateInput]
    outputs: Callable[[Array, Array], Array]
    stretches: list[Stretch] = field(default_factory=list)
    starts: list[float] = field(default_factory=list)
    fits: list[Array] = field(default_factory=list)

    def signals(self, breaks: Sequence[float], until: float) -> list[Signal]:
        """Return the late inputs as signals, given the kinks of the others."""
        times = kinks([late.delay for late in self.late], breaks, until)
        return [Signal(tuple(times), tuple(self._pieces(row, times, until))) for row in range(len(self.late))]

    def _pieces(self, row: int, times: Sequence[float], until: float) -> list[Piece]:
        late, tiny = self.late[row], CLOSE * until
        ends = [-math.inf, *times, math.inf]

        def piece(start: float, end: float) -> Piece:
            lo, hi = start - late.delay + tiny, end - late.delay - tiny
            if hi <= 2 * tiny:
                return lambda t: late.before(min(t - late.delay, 0.0))
            return lambda t: self._read(row, min(max(t - late.delay, lo), hi))

        return [piece(a, b) for a, b in pairwise(ends)]

    def _read(self, row: int, t: float) -> float:
        while (done := len(self.fits)) < len(self.stretches) and self.stretches[done].start <= t:
            fit = self._fit(self.stretches[done])  # reads what was before only
            self.fits.append(fit)
            self.starts.append(self.stretches[done].start)
        k = max(bisect_right(self.starts, t) - 1, 0)
        stretch = self.stretches[k]
        length = stretch.end - stretch.start
        x = min(max(2 * (t - stretch.start) / length - 1, -1.0), 1.0) if length > 0 else 0.0
        return float(np.cos(np.arange(NODES) * math.acos(x)) @ self.fits[k][row])

    def _fit(self, stretch: Stretch) -> Array:
        """Return Chebyshev coefficients of each late quantity over one step, shape (late, nodes)."""
        angles = np.pi * (np.arange(NODES) + 0.5) / NODES
        times = stretch.start + (np.cos(angles) + 1) / 2 * (stretch.end - stretch.start)
        states = np.array([stretch.states(t) for t in times]).T
        inputs = np.array([stretch.inputs(t) for t in times]).T
        values = np.concatenate([states, self.outputs(states, inputs)])[[late.quantity for late in self.late]]
        found = values @ np.cos(angles[:, None] * np.arange(NODES)) * (2 / NODES)
        found[:, 0] /= 2
        return np.asarray(found)


def kinks(delays: Sequence[float], others: Sequence[float], until: float) -> list[float]:
    """Return ascending times, no farther apart than the shortest delay, that hold where late inputs have kinks.

    >>> [round(t, 3) for t in kinks([0.4, 1.0], [], 1.5)]
    [0.4, 0.8, 1.0, 1.2, 1.4]
    """
    sums = {sum(some) for n in range(1, SMOOTH + 1) for some in combinations_with_replacement(sorted(delays), n)}
    wanted = sorted({start + s for start in (0.0, *others) for s in sums if start + s < until})
    found = [t for t in others if 0 < t < until]
    shortest, tiny = min(delays), CLOSE * until
    for t in wanted:
        if all(abs(t - other) > tiny for other in found[-2 * len(others) - 1 :]):
            found.append(t)
    found.sort()
    filled: list[float] = []
    for start, end in zip([0.0, *found], [*found, until], strict=True):
        parts = max(math.ceil((end - start) / shortest - 1e-9), 1)
        filled += [start + (end - start) * k / parts for k in range(1, parts)]
        filled.append(end)
    return filled[:-1]
