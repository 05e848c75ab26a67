"""What a branch of periodic solutions consists of."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from .orbit import Metric, Orbit, Tangent

Array = npt.NDArray[Any]


ROUNDING = 1e-9
"""Multipliers nearer to the unit circle than this may be on either side of it."""


@dataclass(frozen=True)
class Hopf:
    """An equilibrium with a pair of imaginary eigenvalues: parameter, state (n,), frequency [rad/s], eigenvector."""

    parameter: float
    state: Array
    omega: float
    vector: Array


@dataclass(frozen=True)
class Point:
    """A periodic solution on a branch.

    Attributes
    ----------
    orbit, tangent, metric
        The solution, the branch's direction there, and the sizes that this is measured by.
    multipliers
        Floquet multipliers but for the trivial one, largest first.
    trivial
        Distance of the trivial multiplier from 1.
    error
        Estimated relative error of the states.
    fold
        Whether the parameter is at an extreme of the branch.
    """

    orbit: Orbit
    tangent: Tangent
    metric: Metric
    multipliers: Array
    trivial: float
    error: float
    fold: bool = False

    @property
    def stable(self) -> bool:
        """Whether all multipliers are inside the unit circle, by more than their error."""
        return bool(np.all(np.abs(self.multipliers) < 1 - self.unsure))

    @property
    def unstable(self) -> int | None:
        """Number of multipliers outside the unit circle; ``None`` where one is on it as far as can be told."""
        size = np.abs(self.multipliers)
        return None if np.any(np.abs(size - 1) <= self.unsure) else int(np.sum(size > 1))

    @property
    def unsure(self) -> float:
        """Error of the multipliers: what the trivial one has, and no less than rounding."""
        return 10 * self.trivial + ROUNDING


@dataclass(frozen=True)
class Branch:
    """Periodic solutions in the order of their branch, and why the last one is the last.

    ``end`` is ``"range"``, ``"equilibrium"``, ``"closed"``, ``"large"``, ``"endless"``, ``"slides"``, ``"stuck"`` or
    ``"count"``; ``begin`` is one of them too, or empty where the branch begins at a Hopf point.
    """

    points: tuple[Point, ...]
    end: str
    begin: str = ""

    @property
    def folds(self) -> tuple[Point, ...]:
        """Points where the parameter turns round."""
        return tuple(point for point in self.points if point.fold)

    @property
    def events(self) -> tuple[tuple[str, float], ...]:
        """Other changes of stability than folds: ``"period doubling"``, ``"torus"`` or ``"branching"``, and near which
        value of the parameter.
        """
        found: list[tuple[str, float]] = []
        fold, last, before = False, None, 0
        for q in self.points:
            fold, now = fold or q.fold, q.unstable
            if now is None or q.fold:
                continue
            if last is not None and not fold and before != now:
                more = last if before > now else q
                outside = more.multipliers[np.abs(more.multipliers) > 1]
                crossing = complex(outside[np.argmin(np.abs(outside))])
                found.append((_event(crossing), 0.5 * (last.orbit.parameter + q.orbit.parameter)))
            last, before, fold = q, now, False
        return tuple(found)


def _event(multiplier: complex) -> str:
    if abs(multiplier.imag) > 1e-9:
        return "torus"
    return "period doubling" if multiplier.real < 0 else "branching"
