"""The state of a sweep whose eigenvalues are being linked from point to point.

Every step of the sweep is an assignment problem between n eigenvalues and the next n: the cost of a pair is
its distance beyond what the slopes of the branches predict, plus what its eigenvectors lack in common (modal
assurance criterion: Allemang, Sound and Vibration 37, 2003, pp. 14-23). All steps are solved at once.
"""

from copy import copy
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .assignment import assign

Complex = NDArray[np.complex128]
Float = NDArray[np.float64]
Index = NDArray[np.intp]
Vectors = NDArray[Any]

_BLOCK = 4096  # steps handled together, so that the n x n costs stay in the cache
_ROUNDS = 8  # slopes and assignment improve each other; they settle in two or three rounds
_TINY = 1e-12  # distances below this fraction of the largest eigenvalue of a step are noise
_SAME = 1e-7  # eigenvalues closer than this fraction cannot be told apart: a double root is known no better
_DOUBTFUL = 0.25  # cost of an assignment over the cost with two branches exchanged


@dataclass(eq=False)
class Links:
    """A sweep being tracked: value i of row k continues as value ``links[k, i]`` of row k + 1."""

    values: Complex
    vectors: Vectors | None
    parameter: Float
    links: Index

    def __post_init__(self) -> None:
        _check(self.values, self.vectors)
        count = len(self.values)
        turns = np.diff(self.parameter)
        if self.parameter.shape != (count,) or not ((turns > 0).all() or (turns < 0).all()):
            raise ValueError(f"parameter of shape {self.parameter.shape}: it must rise or fall over all {count} points")
        # Scales of the whole sweep: of the eigenvalues and, so that units cancel, of every component.
        self._size = max(float(np.abs(self.values).max()), np.finfo(float).tiny)
        self._units = None if self.vectors is None else np.abs(self.vectors).max(axis=(0, 2))
        self._closed = _closed(self.values)
        self.values, self.vectors = self._scaled(self.values, self.vectors)

    @classmethod
    def unlinked(cls, values: ArrayLike, vectors: ArrayLike | None, parameter: ArrayLike | None) -> "Links":
        """A sweep from any array-likes, with identity links; equally spaced by default."""
        rows = np.asarray(values, dtype=complex)
        count = len(rows) if rows.ndim else 0
        where = np.arange(count) if parameter is None else np.asarray(parameter)
        links = np.tile(np.arange(rows.shape[-1] if rows.ndim else 0), (max(count - 1, 0), 1))
        return cls(rows, None if vectors is None else np.asarray(vectors), where.astype(float), links)

    def restricted(self, rows: Index) -> "Links":
        """The sweep at the listed rows only, the links composed over what lies between them."""
        part = copy(self)
        order = self.permutation()[rows]
        part.links = np.take_along_axis(order[1:], np.argsort(order[:-1], axis=1), axis=1)
        part.values, part.parameter, part._closed = (
            self.values[rows],
            self.parameter[rows],
            self._closed[rows],
        )
        part.vectors = None if self.vectors is None else self.vectors[rows]
        return part

    def insert(self, steps: Index, values: ArrayLike, vectors: ArrayLike | None, parameter: Float) -> Index:
        """Put a new point into each of the listed steps and link it; the steps that need another look."""
        rows = np.asarray(values, dtype=complex)
        columns = None if vectors is None else np.asarray(vectors)
        _check(rows, columns)
        scaled, normalised = self._scaled(rows, columns)
        self.values = np.insert(self.values, steps + 1, scaled, axis=0)
        if self.vectors is not None and normalised is not None:
            self.vectors = np.insert(self.vectors, steps + 1, normalised, axis=0)
        self.parameter = np.insert(self.parameter, steps + 1, parameter)
        self._closed = np.insert(self._closed, steps + 1, _closed(rows))
        self.links = np.insert(self.links, steps + 1, self.links[steps], axis=0)
        first = steps + np.arange(len(steps))
        halves = np.sort(np.concatenate([first, first + 1]))
        self.link_all(halves)
        return neighbours(halves, len(self.links))

    def link_all(self, steps: Index) -> None:
        """Find the links of the listed steps from scratch, and let them and their neighbours settle."""
        self._link(steps, sides=0)
        steps = neighbours(steps, len(self.links))
        # The slopes before a step carry the branches through crossings; then both sides are weighed.
        for sides in (1, 2):
            todo = steps
            for _ in range(_ROUNDS):
                # Even and odd steps in turn: two neighbours corrected at once would undo each other.
                changed = [self._link(todo[todo % 2 == parity], sides) for parity in (0, 1)]
                todo = neighbours(np.concatenate(changed), len(self.links))
                if not len(todo):
                    break

    def doubtful(self, steps: Index) -> NDArray[np.bool_]:
        """For the listed steps, whether exchanging two branches would fit nearly as well."""
        doubts = [self._doubtful_block(block) for block in _blocks(steps)]
        return np.concatenate([np.zeros(0, dtype=bool), *doubts])

    def permutation(self) -> Index:
        """All links composed, by a parallel prefix: the branches that start in the order of the first row."""
        n = self.values.shape[1]
        total = np.concatenate([np.arange(n)[None, :], self.links])
        reach = 1
        while reach < len(total):
            total[reach:] = np.take_along_axis(total[reach:], total[:-reach], axis=1)
            reach *= 2
        return total

    def _scaled(self, values: Complex, vectors: Vectors | None) -> tuple[Complex, Vectors | None]:
        """Eigenvalues of order 1 and eigenvectors of length 1 whose components have no units."""
        if vectors is None or self._units is None:
            return values / self._size, None
        scaled = vectors / np.where(self._units > 0, self._units, 1)[:, None]
        length = np.sqrt(np.sum(scaled.real**2 + scaled.imag**2, axis=1, keepdims=True))
        return values / self._size, scaled / np.where(length > 0, length, 1)

    def _link(self, steps: Index, sides: int) -> Index:
        """Solve the listed steps again; the steps whose links changed."""
        found = [assign(self._cost(block, sides)) for block in _blocks(steps)]
        links = np.concatenate([self.links[:0], *found])
        changed = (links != self.links[steps]).any(axis=1)
        self.links[steps] = links
        return np.asarray(steps[changed], dtype=np.intp)

    def _cost(self, steps: Index, sides: int) -> Float:
        """(m, n, n) cost of every pair, with slopes on 0, 1 or 2 sides; infinite between the half planes."""
        here, there = self.values[steps], self.values[steps + 1]
        change = there[:, None, :] - here[:, :, None]
        square = np.zeros(change.shape)
        if sides and len(self.links) > 1:
            rise, fall = self._slopes(steps)
            expected = rise if sides == 1 else (rise + fall) / 2
            kink = expected - rise  # a branch that bounces is as wrong as one that misses its slope
            square = kink.real**2 + kink.imag**2
            change -= expected
        square += change.real**2 + change.imag**2
        n = here.shape[1]
        runner_up = min(1, n - 1)
        by_row = np.partition(square, runner_up, axis=2)[:, :, runner_up, None]
        by_column = np.partition(square, runner_up, axis=1)[:, None, runner_up, :]
        largest = np.maximum(np.abs(here).max(axis=1), np.abs(there).max(axis=1))[:, None, None]
        relative = square / (np.sqrt(by_row * by_column) + (_TINY * largest) ** 2 + np.finfo(float).tiny)
        cost: Float = relative / (1 + 1e-6 * relative)  # far pairs must not drown the others in rounding
        if self.vectors is not None:
            common = np.conj(self.vectors[steps]).transpose(0, 2, 1) @ self.vectors[steps + 1]
            cost += 1 - np.minimum(common.real**2 + common.imag**2, 1)
        opposite = np.sign(here.imag)[:, :, None] * np.sign(there.imag)[:, None, :] < 0
        cost[opposite & (self._closed[steps] & self._closed[steps + 1])[:, None, None]] = np.inf
        return cost

    def _slopes(self, steps: Index) -> tuple[Complex, Complex]:
        """(m, n, n) change over a step by the slope of value i before it, and by that of value j after it."""
        last = len(self.links) - 1
        before, after = np.maximum(steps - 1, 0), np.minimum(steps + 1, last)
        width = np.diff(self.parameter)
        source = np.argsort(self.links[before], axis=1)
        rise = self.values[steps] - np.take_along_axis(self.values[before], source, axis=1)
        fall = np.take_along_axis(self.values[after + 1], self.links[after], axis=1) - self.values[steps + 1]
        rise *= (width[steps] / width[before])[:, None]
        fall *= (width[steps] / width[after])[:, None]
        has_before, has_after = (steps > 0)[:, None, None], (steps < last)[:, None, None]
        return (
            np.where(has_before, rise[:, :, None], fall[:, None, :]),
            np.where(has_after, fall[:, None, :], rise[:, :, None]),
        )

    def _doubtful_block(self, steps: Index) -> NDArray[np.bool_]:
        doubt = np.zeros((len(steps), *[self.values.shape[1]] * 2), dtype=bool)
        for sides in (0, 2):
            cost = np.take_along_axis(self._cost(steps, sides), self.links[steps][:, None, :], axis=2)
            own = np.einsum("kii->ki", cost)
            kept, exchanged = own[:, :, None] + own[:, None, :], cost + cost.transpose(0, 2, 1)
            np.logical_or(doubt, kept > _DOUBTFUL * exchanged, out=doubt)
        here = self.values[steps]
        there = np.take_along_axis(self.values[steps + 1], self.links[steps], axis=1)
        apart = np.zeros(doubt.shape, dtype=bool)
        for row in (here, there):
            apart |= np.abs(row[:, :, None] - row[:, None, :]) > _SAME * np.abs(row).max(axis=1)[:, None, None]
        return np.asarray((apart & doubt).any(axis=(1, 2)))


def neighbours(steps: Index, count: int) -> Index:
    """The listed steps and those next to them."""
    mask = np.zeros(count + 2, dtype=bool)
    for offset in (0, 1, 2):
        mask[steps + offset] = True
    return np.flatnonzero(mask[1:-1])


def _closed(values: Complex) -> NDArray[np.bool_]:
    """Rows that hold the conjugate of each of their values."""
    upper = np.sort(np.where(values.imag > 0, values, 0), axis=1)
    lower = np.sort(np.where(values.imag < 0, values.conj(), 0), axis=1)
    result: NDArray[np.bool_] = (upper == lower).all(axis=1)
    return result


def _check(values: Complex, vectors: Vectors | None) -> None:
    """Refuse arrays that are not the eigenvalues and eigenvectors of some points."""
    if values.ndim != 2 or 0 in values.shape:
        raise ValueError(f"eigenvalues of shape {values.shape}: the shape must be (points, eigenvalues)")
    if not np.isfinite(values).all():
        raise ValueError(f"{np.sum(~np.isfinite(values))} eigenvalues are not finite: all must be")
    if vectors is not None and vectors.shape != (*values.shape, values.shape[1]):
        raise ValueError(f"eigenvectors of shape {vectors.shape}: it must be {(*values.shape, values.shape[1])}")
    if vectors is not None and not np.isfinite(vectors).all():
        raise ValueError(f"{np.sum(~np.isfinite(vectors))} eigenvector components are not finite: all must be")


def _blocks(steps: Index) -> list[Index]:
    return [steps[start : start + _BLOCK] for start in range(0, len(steps), _BLOCK)]
