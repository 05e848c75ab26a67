"""What a branch of periodic solutions consists of."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt

from .orbit import Metric, Orbit, Tangent

Array = npt.NDArray[Any]


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
        """Whether all neighbouring motions come to the cycle."""
        return not self.unstable

    @property
    def unstable(self) -> int:
        """Number of multipliers outside the unit circle."""
        return int(np.sum(np.abs(self.multipliers) > 1))


@dataclass(frozen=True)
class Branch:
    """Periodic solutions in the order in which they were found, and why the last one is the last.

    ``end`` is ``"range"``, ``"equilibrium"``, ``"large"``, ``"stuck"`` or ``"count"``.
    """

    points: tuple[Point, ...]
    end: str

    @property
    def folds(self) -> tuple[Point, ...]:
        """Points where the parameter turns round."""
        return tuple(point for point in self.points if point.fold)

    @property
    def events(self) -> tuple[tuple[str, float], ...]:
        """Other changes of stability than folds: ``"period doubling"``, ``"torus"`` or ``"branching"``, and near which
        value of the parameter.
        """
        found = []
        for p, q in pairwise(self.points):
            if p.unstable == q.unstable or p.fold or q.fold:
                continue
            more = max(p, q, key=lambda point: point.unstable)
            outside = more.multipliers[np.abs(more.multipliers) > 1]
            crossing = complex(outside[np.argmin(np.abs(outside))])
            if abs(crossing) - 1 > max(p.trivial, q.trivial):  # nearer to 1 it cannot be told from an error
                found.append((_event(crossing), 0.5 * (p.orbit.parameter + q.orbit.parameter)))
        return tuple(found)


def _event(multiplier: complex) -> str:
    if abs(multiplier.imag) > 1e-9:
        return "torus"
    return "period doubling" if multiplier.real < 0 else "branching"
