"""Periodic solutions of ``x' = f(x, p)`` by Gauss collocation on an adapted mesh, with Floquet multipliers.

A period is cut into N intervals; in each the solution is a polynomial of degree 4 that satisfies the equations at the
four Gauss points (C. de Boor and B. Swartz, SIAM Journal on Numerical Analysis 10 (1973)). Newton's equations are
condensed to a few interval ends.

Where a law jumps, a point of the mesh lies on the crossing, and moves with it: its share of the period is one more
unknown, and that the switching value vanishes there one more equation. Deviations go through a crossing by the
saltation matrix (M. A. Aizerman and F. R. Gantmakher, Quarterly Journal of Mechanics and Applied Mathematics 11 (1958);
R. I. Leine and H. Nijmeijer, Dynamics and Bifurcations of Non-Smooth Mechanical Systems (2004), section 7.1).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from .orbit import (
    AT_GAUSS,
    AT_INNER,
    DEGREE,
    GAUSS_WEIGHTS,
    SLOPE_AT_GAUSS,
    SLOPE_AT_INNER,
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

SHIFT = 1e-6
"""Share of its size by which an unknown is moved to find the slopes of a switching value."""

NEAR = np.array([1e-5, 2e-5])
"""Shares of an interval beside a jump at which the rates are taken."""


class Field(NamedTuple):
    """Right-hand side: ``rates(x, p)`` of shape (n, P) for states (n, P); ``slopes(x, p)`` (P, n, n) and (P, n).

    Where laws have kinks, ``switches(x, p)`` are values, one a row, that change sign there.
    """

    rates: Callable[[Array, float], Array]
    slopes: Callable[[Array, float], tuple[Array, Array]]
    switches: Callable[[Array, float], Array] | None = None


class Jump(NamedTuple):
    """A crossing at which the rates jump: its point of the mesh, and the row of the switching value."""

    point: int
    row: int


class SlidingError(ArithmeticError):
    """The rates on both sides of a jump point towards it, so that motions slide along it; or away from it."""


class Corrected(NamedTuple):
    """A solution of Newton's method: orbit, direction of the branch there, monodromy matrix, steps taken."""

    orbit: Orbit
    tangent: Tangent
    monodromy: Array
    steps: int


def correct(field: Field, guess: Orbit, along: Tangent, metric: Metric, jumps: Sequence[Jump] = ()) -> Corrected | None:
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
    jumps
        Crossings at which the rates jump, in order.

    Returns
    -------
    Corrected or None
        ``None`` where Newton's method does not converge.

    Raises
    ------
    SlidingError
        If the orbit found cannot go through a jump.
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
            solved = _newton(field, orbit, phase, (ahead, border), misses, [*_crossings(field, orbit, metric, jumps)])
        if solved is None:
            return None
        change, tangent, transfers = solved
        size = max(
            float(np.max(np.abs(change.values) / metric.states)),
            abs(change.period / metric.period),
            abs(change.parameter / metric.parameter),
            float(np.max(np.abs(change.mesh))),
        )
        orbit = moved(orbit, change, 1.0)
        if not np.isfinite(size) or size > 1e3 or orbit.period <= 0 or np.any(orbit.widths <= 0):
            return None
        if size < CONVERGED * max(1.0, abs(orbit.parameter / metric.parameter)):
            refuse_sliding(field, orbit, metric, jumps)
            monodromy = _monodromy(field, orbit, transfers, [*_crossings(field, orbit, metric, jumps)])
            return Corrected(orbit, scaled(tangent, 1 / norm(tangent, widths, metric)), monodromy, step)
    return None


class _Crossing(NamedTuple):
    """A jump on an orbit: its point of the mesh, the switching value there, its slopes by states and parameter."""

    point: int
    value: float
    normal: Array
    by_parameter: float


def _crossings(field: Field, orbit: Orbit, metric: Metric, jumps: Sequence[Jump]) -> Iterator[_Crossing]:
    for point, row in jumps:
        assert field.switches is not None
        x, p, n = orbit.values[point, 0], orbit.parameter, orbit.values.shape[2]
        h, step = SHIFT * metric.states, SHIFT * metric.parameter
        about = x[:, None] + np.concatenate([np.zeros((n, 1)), np.diag(h), -np.diag(h)], axis=1)
        values = field.switches(about, p)[row]
        there, back = (float(field.switches(x[:, None], p + s * step)[row, 0]) for s in (1, -1))
        normal = (values[1 : n + 1] - values[n + 1 :]) / (2 * h)
        yield _Crossing(point, float(values[0]), normal, (there - back) / (2 * step))


def beside(field: Field, orbit: Orbit, point: int) -> tuple[Array, Array]:
    """Return the rates just before and just after a point of the mesh, extrapolated from both sides."""
    found = []
    for interval, local in ((point - 1, 1 - NEAR), (point, NEAR)):
        shares = orbit.mesh[interval] + orbit.widths[interval] * local
        one, other = field.rates(orbit.at(shares), orbit.parameter).T
        found.append(2 * one - other)
    return found[0], found[1]


def refuse_sliding(field: Field, orbit: Orbit, metric: Metric, jumps: Sequence[Jump]) -> None:
    """Raise `SlidingError` if an orbit cannot go through one of its jumps."""
    for crossing in _crossings(field, orbit, metric, jumps):
        before, after = beside(field, orbit, crossing.point)
        if (crossing.normal @ before) * (crossing.normal @ after) <= 0:
            raise SlidingError("the rates on both sides of a jump point towards it, or away from it")


def _monodromy(field: Field, orbit: Orbit, transfers: Array, crossings: list[_Crossing]) -> Array:
    """Return the product of the intervals' transfer matrices, and of saltation matrices where rates jump."""
    product, through = np.eye(transfers.shape[1]), {c.point: c.normal for c in crossings}
    for i, transfer in enumerate(transfers):
        if i in through:
            normal, (before, after) = through[i], beside(field, orbit, i)
            product = product + np.outer(after - before, normal @ product) / (normal @ before)
        product = transfer @ product
    return np.asarray(product)


def _newton(
    field: Field,
    orbit: Orbit,
    phase: Array,
    arc: tuple[Array, tuple[float, float]],
    misses: tuple[float, float],
    crossings: list[_Crossing],
) -> tuple[Tangent, Tangent, Array] | None:
    """Return Newton's step, the direction along the branch, and the intervals' transfer matrices (N, n, n)."""
    N, _, n = orbit.values.shape
    shifts = _shifts(orbit.mesh, [c.point for c in crossings])
    blocks, columns = _linearised(field, orbit, np.diff(shifts))
    size, more = DEGREE * n, columns.shape[-1]
    inside = blocks[..., 1:, :].reshape(N, size, size)
    outside = np.concatenate([blocks[..., 0, :].reshape(N, size, n), columns.reshape(N, size, more)], axis=-1)
    on = np.zeros((len(crossings), *orbit.values.shape))
    for k, crossing in enumerate(crossings):
        on[k, crossing.point, 0] = crossing.normal
    try:
        Z = -np.linalg.solve(inside, outside).reshape(N, DEGREE, n, n + more)
        maps = _grouped(Z[:, -1], min(N, GROUPS))
        rows = np.stack([_row(functional, Z, maps) for functional in (phase, arc[0], *on)])
        rows[1, :, n : n + 2] += np.array(arc[1]) / rows.shape[1]
        rows[2:, :, n + 1] += np.array([c.by_parameter for c in crossings])[:, None] / rows.shape[1]
        found = _condensed(maps[:, -1], rows, (*misses, *(-c.value for c in crossings)))
    except np.linalg.LinAlgError:
        return None
    change, tangent = (_expanded(Z, maps, found[:, column], 1.0 - column, shifts) for column in range(2))
    return change, tangent, Z[:, -1, :, :n]


def _shifts(mesh: Array, points: list[int]) -> Array:
    """Return by how much each point of the mesh moves with each of some points, shape (points, N + 1).

    Between them the mesh stretches evenly; its ends stay.
    """
    places = [0, *points, len(mesh) - 1]
    return np.array([np.interp(mesh, mesh[places], np.eye(len(places))[k]) for k in range(1, len(places) - 1)]).reshape(
        len(points), len(mesh)
    )


def _grouped(G: Array, groups: int) -> Array:
    """Return maps (groups, length + 1, n, columns) from the unknowns at a group's start to each interval end in it.

    Columns of a map: the states at the start, period, parameter, shares of jumps, residual. A few groups, rather than
    one, keep the growth in each small.
    """
    N, n, size = G.shape
    length = -(-N // groups)
    still = np.eye(n, size)
    padded = np.concatenate([G, np.broadcast_to(still, (groups * length - N, n, size))])
    padded = padded.reshape(groups, length, n, size)
    maps = np.empty((groups, length + 1, n, size))
    maps[:, 0] = still
    for j in range(length):
        maps[:, j + 1] = padded[:, j, :, :n] @ maps[:, j]
        maps[:, j + 1, :, n:] += padded[:, j, :, n:]
    return maps


def _row(functional: Array, Z: Array, maps: Array) -> Array:
    """Return a functional of all nodal values as one of the groups' starts, shape (groups, columns)."""
    N, n, size = functional.shape[0], functional.shape[2], Z.shape[-1]
    groups, length = maps.shape[0], maps.shape[1] - 1
    own = np.einsum("ika,ikac->ic", functional[:, 1:], Z)
    own[:, :n] += functional[:, 0]
    padded = np.zeros((groups * length, size))
    padded[:N] = own
    padded = padded.reshape(groups, length, size)
    row = np.einsum("gja,gjac->gc", padded[..., :n], maps[:, :-1])
    row[:, n:] += padded[..., n:].sum(axis=1)
    return np.asarray(row)


def _condensed(ends: Array, rows: Array, misses: tuple[float, ...]) -> Array:
    """Solve for groups' starts, period, parameter and shares; first column Newton's step, second the direction."""
    groups, n, _ = ends.shape
    size, more = groups * n, len(rows)
    system, right = np.zeros((size + more, size + more)), np.zeros((size + more, 2))
    grid, i = system[:size, :size].reshape(groups, n, groups, n), np.arange(groups)
    grid[i, :, i, :] += ends[..., :n]
    grid[i, :, (i + 1) % groups, :] -= np.eye(n)
    system[:size, size:] = ends[..., n:-1].reshape(-1, more)
    right[:size, 0] = -ends[..., -1].ravel()
    system[size:, :size] = rows[..., :n].reshape(more, size)
    system[size:, size:] = rows[..., n:-1].sum(axis=1)
    right[size:, 0] = np.array(misses) - rows[..., -1].sum(axis=1)
    right[size + 1, 1] = 1.0
    return np.linalg.solve(system, right)


def _expanded(Z: Array, maps: Array, found: Array, residual: float, shifts: Array) -> Tangent:
    """Return all unknowns from those at the groups' starts."""
    N, _, n, _ = Z.shape
    groups = len(maps)
    rest = np.append(found[groups * n :], residual)
    given = [np.broadcast_to(rest, (count, len(rest))) for count in (groups, N)]
    starts = np.concatenate([found[: groups * n].reshape(groups, n), given[0]], axis=1)
    ends = np.einsum("gjac,gc->gja", maps[:, :-1], starts).reshape(-1, n)[:N]
    values = np.einsum("ikac,ic->ika", Z, np.concatenate([ends, given[1]], axis=1))
    return Tangent(np.concatenate([ends[:, None], values], axis=1), float(rest[0]), float(rest[1]), rest[2:-1] @ shifts)


def _linearised(field: Field, orbit: Orbit, stretched: Array) -> tuple[Array, Array]:
    """Return slopes of the residuals (N, 4, n, 5, n), and columns (N, 4, n, ...) for the other unknowns.

    These are period, parameter, the shares of jumps, with each of which the intervals are stretched, and the residuals.
    """
    N, _, n = orbit.values.shape
    x = np.einsum("jk,ika->ija", AT_GAUSS, orbit.values)
    flat = x.reshape(-1, n).T
    f = field.rates(flat, orbit.parameter).T.reshape(N, DEGREE, n)
    A, b = field.slopes(flat, orbit.parameter)
    h = orbit.widths[:, None, None]
    blocks = -orbit.period * np.einsum("i,jk,ijab->ijakb", orbit.widths, AT_GAUSS, A.reshape(N, DEGREE, n, n))
    blocks += np.einsum("jk,ab->jakb", SLOPE_AT_GAUSS, np.eye(n))
    residual = np.einsum("jk,ika->ija", SLOPE_AT_GAUSS, orbit.values) - h * orbit.period * f
    moves = (-orbit.period * by[:, None, None] * f for by in stretched)
    columns = np.stack([-h * f, -h * orbit.period * b.reshape(N, DEGREE, n), *moves, residual], axis=-1)
    return blocks, columns


def error(field: Field, orbit: Orbit, sizes: Array) -> float:
    """Return an estimate of the relative error of the states: the equations' defect between the Gauss points."""
    N, _, n = orbit.values.shape
    x = np.einsum("jk,ika->ija", AT_INNER, orbit.values)
    with np.errstate(all="ignore"):
        f = field.rates(x.reshape(-1, n).T, orbit.parameter).T.reshape(N, -1, n)
    slope = np.einsum("jk,ika->ija", SLOPE_AT_INNER, orbit.values)
    defect = np.abs(slope - orbit.widths[:, None, None] * orbit.period * f) / sizes
    return DEFECT_SHARE * float(defect.max())
