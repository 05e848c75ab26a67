"""Periodic solutions of ``x' = f(x, p)`` by Gauss collocation on an adapted mesh, with Floquet multipliers.

A period is cut into N intervals; in each the solution is a polynomial of degree 4 that satisfies the equations at the
four Gauss points (C. de Boor and B. Swartz, SIAM Journal on Numerical Analysis 10 (1973)). Newton's equations are
condensed to the N interval ends, whose transfer matrices multiply to the monodromy matrix.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[Any]

DEGREE = 4
GAUSS, GAUSS_WEIGHTS = (0.5 * (np.polynomial.legendre.leggauss(DEGREE)[0] + 1), np.polynomial.legendre.leggauss(4)[1] / 2)
NODES = 0.5 * (1 - np.cos(np.pi * np.arange(DEGREE + 1) / DEGREE))
PROBES = np.linspace(0, 1, 9)
DEFECT_SHARE = 0.06
"""Share of the largest defect of an interval that is taken as the error of the states."""

NEWTON_STEPS = 12
CONVERGED = 1e-10


class Field(NamedTuple):
    """Right-hand side: ``rates(x, p)`` of shape (n, P) for states (n, P); ``slopes(x, p)`` (P, n, n) and (P, n)."""

    rates: Callable[[Array, float], Array]
    slopes: Callable[[Array, float], tuple[Array, Array]]


def _basis(points: Array) -> tuple[Array, Array]:
    """Return matrices that give a polynomial and its derivative at points from its values at `NODES`."""
    inverse = np.linalg.inv(np.vander(NODES, increasing=True))
    powers = np.arange(DEGREE + 1)
    values = points[:, None] ** powers
    slopes = powers * points[:, None] ** np.maximum(powers - 1, 0)
    return values @ inverse, slopes @ inverse


AT_GAUSS, SLOPE_AT_GAUSS = _basis(GAUSS)
AT_PROBES, SLOPE_AT_PROBES = _basis(PROBES)
TO_POWERS = np.linalg.inv(np.vander(NODES, increasing=True))
HIGHEST = TO_POWERS[-1]


@dataclass(frozen=True)
class Orbit:
    """One periodic solution.

    Attributes
    ----------
    mesh
        Ends of the intervals as shares of the period, shape (N + 1,), from 0 to 1.
    values
        States at the nodes of each interval, shape (N, 5, n); the last node is the next interval's first.
    period, parameter
        Period and value of the parameter.
    """

    mesh: Array
    values: Array
    period: float
    parameter: float

    @cached_property
    def widths(self) -> Array:
        """Widths of the intervals."""
        return np.asarray(np.diff(self.mesh))

    def at(self, shares: Array) -> Array:
        """Return the states at shares of the period in [0, 1], shape (n, ...)."""
        where = np.clip(np.searchsorted(self.mesh, shares, side="right") - 1, 0, len(self.widths) - 1)
        local = (np.asarray(shares) - self.mesh[where]) / self.widths[where]
        return np.einsum("pk,pka->ap", _basis(local)[0], self.values[where])

    def dense(self) -> Array:
        """Return the states at nine points of every interval, shape (n, 9 N)."""
        return np.einsum("jk,ika->aij", AT_PROBES, self.values).reshape(self.values.shape[2], -1)

    def extremes(self) -> tuple[Array, Array]:
        """Return the least and the greatest value of each state along the orbit."""
        dense = np.einsum("jk,ika->aij", AT_PROBES, self.values)
        powers = np.einsum("ck,ika->aic", TO_POWERS, self.values)
        least, greatest = (
            np.array([sign * _peak(sign * d, sign * p) for d, p in zip(dense, powers, strict=True)]) for sign in (-1, 1)
        )
        return least, greatest

    def on(self, mesh: Array) -> Orbit:
        """Return the same solution on another mesh."""
        shares = (mesh[:-1, None] + np.diff(mesh)[:, None] * NODES).ravel()
        values = self.at(np.clip(shares, 0, 1)).T.reshape(len(mesh) - 1, DEGREE + 1, -1).copy()
        values[:, -1] = np.roll(values[:, 0], -1, axis=0)
        return replace(self, mesh=mesh, values=values)


def _peak(states: Array, powers: Array) -> float:
    """Return the greatest value of a state from values at the probes and coefficients of each interval."""
    best, found = int(np.argmax(states.max(axis=1))), [float(states.max())]
    for i in (best - 1, best, (best + 1) % len(states)):  # the greatest sample may be an end of two intervals
        flat = np.roots((powers[i, 1:] * np.arange(1, DEGREE + 1))[::-1])
        inside = flat.real[(flat.imag == 0) & (flat.real >= 0) & (flat.real <= 1)]
        found += np.polynomial.polynomial.polyval(inside, powers[i]).tolist()
    return max(found)


class Corrected(NamedTuple):
    """A solution of Newton's method: orbit, direction of the branch there, monodromy matrix, steps taken."""

    orbit: Orbit
    tangent: Tangent
    monodromy: Array
    steps: int


class Tangent(NamedTuple):
    """Direction of a branch: changes of the values (N, 5, n), the period and the parameter."""

    values: Array
    period: float
    parameter: float


class Metric(NamedTuple):
    """Sizes against which changes of states (n,), period and parameter are measured."""

    states: Array
    period: float
    parameter: float


def inner(a: Array, b: Array, widths: Array, metric: Metric) -> float:
    """Return the scalar product of two periodic functions given at the nodes, averaged over time and states."""
    return float(np.sum(_weights(b, widths, metric) * a))


def _weights(b: Array, widths: Array, metric: Metric) -> Array:
    """Return the functional ``<., b>`` as weights of the values at the nodes."""
    at_gauss = np.einsum("jk,ika->ija", AT_GAUSS, b) / metric.states**2 / len(metric.states)
    return np.einsum("i,j,jk,ija->ika", widths, GAUSS_WEIGHTS, AT_GAUSS, at_gauss)


def norm(tangent: Tangent, widths: Array, metric: Metric) -> float:
    """Return the length of a direction."""
    square = inner(tangent.values, tangent.values, widths, metric)
    square += (tangent.period / metric.period) ** 2 + (tangent.parameter / metric.parameter) ** 2
    return float(np.sqrt(square))


def scaled(tangent: Tangent, factor: float) -> Tangent:
    """Return a direction times a number."""
    return Tangent(tangent.values * factor, tangent.period * factor, tangent.parameter * factor)


def moved(orbit: Orbit, tangent: Tangent, step: float) -> Orbit:
    """Return the orbit moved along a direction on the same mesh."""
    return replace(
        orbit,
        values=orbit.values + step * tangent.values,
        period=orbit.period + step * tangent.period,
        parameter=orbit.parameter + step * tangent.parameter,
    )


def correct(field: Field, guess: Orbit, along: Tangent, metric: Metric) -> Corrected | None:
    """Solve for the periodic orbit at right angles to a direction from a guess, by Newton's method.

    Parameters
    ----------
    field
        Right-hand side and its slopes.
    guess
        Predicted orbit; its phase is kept.
    along
        Direction in which the guess was moved; one with nothing but a parameter keeps the parameter.
    metric
        Sizes of the unknowns.

    Returns
    -------
    Corrected or None
        ``None`` where Newton's method does not converge.
    """
    widths, orbit = guess.widths, guess
    drift = np.einsum("jk,ika->ija", SLOPE_AT_GAUSS, guess.values)
    phase = np.einsum("j,jk,ija->ika", GAUSS_WEIGHTS, AT_GAUSS, drift / metric.states**2)
    phase /= np.abs(phase).sum() or 1.0
    ahead = _weights(along.values, widths, metric)
    border = (along.period / metric.period**2, along.parameter / metric.parameter**2)
    for step in range(1, NEWTON_STEPS + 1):
        offset = guess.values - orbit.values
        misses = (
            float(np.sum(phase * offset)),
            float(np.sum(ahead * offset))
            + border[0] * (guess.period - orbit.period)
            + border[1] * (guess.parameter - orbit.parameter),
        )
        with np.errstate(all="ignore"):
            solved = _newton(field, orbit, phase, (ahead, border), misses)
        if solved is None:
            return None
        change, tangent, monodromy = solved
        orbit = moved(orbit, change, 1.0)
        size = max(
            float(np.max(np.abs(change.values) / metric.states)),
            abs(change.period / metric.period),
            abs(change.parameter / metric.parameter),
        )
        if not np.isfinite(size) or size > 1e3 or orbit.period <= 0:
            return None
        if size < CONVERGED * max(1.0, abs(orbit.parameter / metric.parameter)):
            return Corrected(orbit, scaled(tangent, 1 / norm(tangent, widths, metric)), monodromy, step)
    return None


def _newton(
    field: Field, orbit: Orbit, phase: Array, arc: tuple[Array, tuple[float, float]], misses: tuple[float, float]
) -> tuple[Tangent, Tangent, Array] | None:
    """Return Newton's step, the direction along the branch, and the monodromy matrix."""
    N, _, n = orbit.values.shape
    blocks, columns = _linearised(field, orbit)
    size = DEGREE * n
    inside = blocks[..., 1:, :].reshape(N, size, size)
    outside = np.concatenate([blocks[..., 0, :].reshape(N, size, n), columns.reshape(N, size, 3)], axis=-1)
    try:
        Z = -np.linalg.solve(inside, outside).reshape(N, DEGREE, n, n + 3)
        G = Z[:, -1]
        system = np.zeros((N * n + 2, N * n + 2))
        right = np.zeros((N * n + 2, 2))
        grid = system[: N * n, : N * n].reshape(N, n, N, n)
        i = np.arange(N)
        grid[i, :, i, :] += G[..., :n]
        grid[i, :, (i + 1) % N, :] -= np.eye(n)
        system[: N * n, N * n :] = G[..., n : n + 2].reshape(-1, 2)
        right[: N * n, 0] = -G[..., n + 2].ravel()
        ahead, border = arc
        for row, weights, last, miss in ((0, phase, (0.0, 0.0), misses[0]), (1, ahead, border, misses[1])):
            through = np.einsum("ika,ikac->ic", weights[:, 1:], Z)
            system[N * n + row, : N * n] = (weights[:, 0] + through[:, :n]).ravel()
            system[N * n + row, N * n :] = through[:, n : n + 2].sum(axis=0) + last
            right[N * n + row, 0] = miss - through[:, n + 2].sum()
        right[-1, 1] = 1.0
        found = np.linalg.solve(system, right)
    except np.linalg.LinAlgError:
        return None
    change, tangent = (
        _expanded(Z, found[:, column], np.array([1.0 - column])) for column in range(2)
    )
    monodromy = np.eye(n)
    for transfer in G[..., :n]:
        monodromy = transfer @ monodromy
    return change, tangent, monodromy


def _expanded(Z: Array, found: Array, residual: Array) -> Tangent:
    """Return the unknowns inside the intervals from those at their ends."""
    N, _, n, _ = Z.shape
    ends, rest = found[: N * n].reshape(N, n), found[N * n :]
    given = np.concatenate([ends, np.broadcast_to(np.concatenate([rest, residual]), (N, 3))], axis=1)
    return Tangent(np.concatenate([ends[:, None], np.einsum("ikac,ic->ika", Z, given)], axis=1), *map(float, rest))


def _linearised(field: Field, orbit: Orbit) -> tuple[Array, Array]:
    """Return slopes of the residuals (N, 4, n, 5, n), and columns for period, parameter and the residuals themselves."""
    N, _, n = orbit.values.shape
    x = np.einsum("jk,ika->ija", AT_GAUSS, orbit.values)
    flat = x.reshape(-1, n).T
    f = field.rates(flat, orbit.parameter).T.reshape(N, DEGREE, n)
    A, b = field.slopes(flat, orbit.parameter)
    h = orbit.widths[:, None, None]
    blocks = -orbit.period * np.einsum("i,jk,ijab->ijakb", orbit.widths, AT_GAUSS, A.reshape(N, DEGREE, n, n))
    blocks += np.einsum("jk,ab->jakb", SLOPE_AT_GAUSS, np.eye(n))
    residual = np.einsum("jk,ika->ija", SLOPE_AT_GAUSS, orbit.values) - h * orbit.period * f
    columns = np.stack([-h * f, -h * orbit.period * b.reshape(N, DEGREE, n), residual], axis=-1)
    return blocks, columns


def error(field: Field, orbit: Orbit, sizes: Array) -> float:
    """Return an estimate of the relative error of the states: the equations' defect between the Gauss points."""
    N, _, n = orbit.values.shape
    x = np.einsum("jk,ika->ija", AT_PROBES, orbit.values)
    with np.errstate(all="ignore"):
        f = field.rates(x.reshape(-1, n).T, orbit.parameter).T.reshape(N, -1, n)
    slope = np.einsum("jk,ika->ija", SLOPE_AT_PROBES, orbit.values)
    defect = np.abs(slope - orbit.widths[:, None, None] * orbit.period * f) / sizes
    return DEFECT_SHARE * float(defect.max())


def adapted_mesh(orbit: Orbit, sizes: Array, count: int) -> Array:
    """Return a mesh of ``count`` intervals that spreads the error evenly.

    The fifth derivative is taken from the fourth ones of neighbouring intervals (R. D. Russell and J. Christiansen,
    SIAM Journal on Numerical Analysis 15 (1978)).
    """
    h = orbit.widths
    fourth = np.einsum("k,ika->ia", HIGHEST, orbit.values) / h[:, None] ** DEGREE / sizes
    jump = (np.roll(fourth, -1, axis=0) - fourth) / (0.5 * (h + np.roll(h, -1)))[:, None]
    size = np.abs(jump).max(axis=1)
    monitor = (0.5 * (size + np.roll(size, 1))) ** (1 / (DEGREE + 1))
    monitor = np.maximum(monitor, 0.1 * float(np.sum(monitor * h))) + 1e-12
    total = np.concatenate([[0.0], np.cumsum(monitor * h)])
    return np.asarray(np.interp(np.linspace(0, total[-1], count + 1), total, orbit.mesh))


def multipliers(monodromy: Array) -> tuple[Array, float]:
    """Return the Floquet multipliers but for the trivial one, largest first, and how far that is from 1."""
    found = np.linalg.eigvals(monodromy)
    trivial = int(np.argmin(np.abs(found - 1)))
    rest = np.delete(found, trivial)
    return rest[np.argsort(-np.abs(rest), kind="stable")], float(abs(found[trivial] - 1))
