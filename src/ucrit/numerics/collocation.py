"""Periodic solutions of ``x' = f(x, p)`` by Gauss collocation on an adapted mesh, with Floquet multipliers.

A period is cut into N intervals; in each the solution is a polynomial of degree 4 that satisfies the equations at the
four Gauss points (C. de Boor and B. Swartz, SIAM Journal on Numerical Analysis 10 (1973)). Newton's equations are
condensed to a few interval ends, whose transfer matrices multiply to the monodromy matrix.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from .orbit import (
    AT_GAUSS,
    AT_PROBES,
    DEGREE,
    GAUSS_WEIGHTS,
    SLOPE_AT_GAUSS,
    SLOPE_AT_PROBES,
    Metric,
    Orbit,
    Tangent,
    moved,
    norm,
    scaled,
    weights,
)

Array = npt.NDArray[Any]

DEFECT_SHARE = 0.06
"""Share of the largest defect of an interval that is taken as the error of the states."""

GROUPS = 10
"""Most groups of intervals that the linear equations are condensed to."""

NEWTON_STEPS = 12
CONVERGED = 1e-10


class Field(NamedTuple):
    """Right-hand side: ``rates(x, p)`` of shape (n, P) for states (n, P); ``slopes(x, p)`` (P, n, n) and (P, n).

    Where laws have kinks, ``switches(x, p)`` are values, one a row, that change sign there.
    """

    rates: Callable[[Array, float], Array]
    slopes: Callable[[Array, float], tuple[Array, Array]]
    switches: Callable[[Array, float], Array] | None = None


class Corrected(NamedTuple):
    """A solution of Newton's method: orbit, direction of the branch there, monodromy matrix, steps taken."""

    orbit: Orbit
    tangent: Tangent
    monodromy: Array
    steps: int


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
    ahead = weights(along.values, widths, metric)
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
        maps = _grouped(Z[:, -1], min(N, GROUPS))
        rows = np.stack([_row(functional, Z, maps) for functional in (phase, arc[0])])
        rows[1, :, n : n + 2] += np.array(arc[1]) / rows.shape[1]
        found = _condensed(maps[:, -1], rows, misses)
    except np.linalg.LinAlgError:
        return None
    change, tangent = (_expanded(Z, maps, found[:, column], 1.0 - column) for column in range(2))
    monodromy = np.eye(n)
    for transfer in maps[:, -1, :, :n]:
        monodromy = transfer @ monodromy
    return change, tangent, monodromy


def _grouped(G: Array, groups: int) -> Array:
    """Return maps (groups, length + 1, n, n + 3) from the unknowns at a group's start to each interval end in it.

    Columns of a map: the states at the start, period, parameter, residual. A few groups, rather than one, keep the
    growth in each small.
    """
    N, n, _ = G.shape
    length = -(-N // groups)
    still = np.concatenate([np.eye(n), np.zeros((n, 3))], axis=1)
    padded = np.concatenate([G, np.broadcast_to(still, (groups * length - N, n, n + 3))])
    padded = padded.reshape(groups, length, n, n + 3)
    maps = np.empty((groups, length + 1, n, n + 3))
    maps[:, 0] = still
    for j in range(length):
        maps[:, j + 1] = padded[:, j, :, :n] @ maps[:, j]
        maps[:, j + 1, :, n:] += padded[:, j, :, n:]
    return maps


def _row(functional: Array, Z: Array, maps: Array) -> Array:
    """Return a functional of all nodal values as one of the groups' starts, shape (groups, n + 3)."""
    N, n = functional.shape[0], functional.shape[2]
    groups, length = maps.shape[0], maps.shape[1] - 1
    own = np.einsum("ika,ikac->ic", functional[:, 1:], Z)
    own[:, :n] += functional[:, 0]
    padded = np.zeros((groups * length, n + 3))
    padded[:N] = own
    padded = padded.reshape(groups, length, n + 3)
    row = np.einsum("gja,gjac->gc", padded[..., :n], maps[:, :-1])
    row[:, n:] += padded[..., n:].sum(axis=1)
    return np.asarray(row)


def _condensed(ends: Array, rows: Array, misses: tuple[float, float]) -> Array:
    """Solve for groups' starts, period and parameter; first column Newton's step, second the branch's direction."""
    groups, n, _ = ends.shape
    size = groups * n
    system, right = np.zeros((size + 2, size + 2)), np.zeros((size + 2, 2))
    grid, i = system[:size, :size].reshape(groups, n, groups, n), np.arange(groups)
    grid[i, :, i, :] += ends[..., :n]
    grid[i, :, (i + 1) % groups, :] -= np.eye(n)
    system[:size, size:] = ends[..., n : n + 2].reshape(-1, 2)
    right[:size, 0] = -ends[..., n + 2].ravel()
    system[size:, :size] = rows[..., :n].reshape(2, size)
    system[size:, size:] = rows[..., n : n + 2].sum(axis=1)
    right[size:, 0] = np.array(misses) - rows[..., n + 2].sum(axis=1)
    right[-1, 1] = 1.0
    return np.linalg.solve(system, right)


def _expanded(Z: Array, maps: Array, found: Array, residual: float) -> Tangent:
    """Return all unknowns from those at the groups' starts."""
    N, _, n, _ = Z.shape
    groups = len(maps)
    rest = np.append(found[groups * n :], residual)
    starts = np.concatenate([found[: groups * n].reshape(groups, n), np.broadcast_to(rest, (groups, 3))], axis=1)
    ends = np.einsum("gjac,gc->gja", maps[:, :-1], starts).reshape(-1, n)[:N]
    given = np.concatenate([ends, np.broadcast_to(rest, (N, 3))], axis=1)
    values = np.concatenate([ends[:, None], np.einsum("ikac,ic->ika", Z, given)], axis=1)
    return Tangent(values, float(rest[0]), float(rest[1]))


def _linearised(field: Field, orbit: Orbit) -> tuple[Array, Array]:
    """Return slopes of the residuals (N, 4, n, 5, n) and columns for period, parameter and the residuals."""
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
