"""A periodic function as polynomials on a mesh: values, extremes, scalar products, adapted meshes."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[Any]

DEGREE = 4
ALIKE = 1e-3
"""Multipliers nearer to 1 than this are told apart from the trivial one by its eigenvector."""

GAUSS, GAUSS_WEIGHTS = (
    0.5 * (np.polynomial.legendre.leggauss(DEGREE)[0] + 1),
    0.5 * np.polynomial.legendre.leggauss(DEGREE)[1],
)
NODES = 0.5 * (1 - np.cos(np.pi * np.arange(DEGREE + 1) / DEGREE))
PROBES = np.linspace(0, 1, 9)


def _basis(points: Array) -> tuple[Array, Array]:
    """Return matrices that give a polynomial and its derivative at points from its values at `NODES`."""
    inverse = np.linalg.inv(np.vander(NODES, increasing=True))
    powers = np.arange(DEGREE + 1)
    values = points[:, None] ** powers
    slopes = powers * points[:, None] ** np.maximum(powers - 1, 0)
    return values @ inverse, slopes @ inverse


AT_GAUSS, SLOPE_AT_GAUSS = _basis(GAUSS)
AT_PROBES, _ = _basis(PROBES)
AT_INNER, SLOPE_AT_INNER = _basis(np.clip(PROBES, 1e-6, 1 - 1e-6))  # on an end a law that jumps has no one value
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
    phase
        Share of the period by which it begins later than the branch's first solution.
    """

    mesh: Array
    values: Array
    period: float
    parameter: float
    phase: float = 0.0

    @cached_property
    def widths(self) -> Array:
        """Widths of the intervals."""
        return np.asarray(np.diff(self.mesh))

    def at(self, shares: Array) -> Array:
        """Return the states at shares of the period in [0, 1], shape (n, ...)."""
        where = np.clip(np.searchsorted(self.mesh, shares, side="right") - 1, 0, len(self.widths) - 1)
        local = (np.asarray(shares) - self.mesh[where]) / self.widths[where]
        return np.asarray(np.einsum("pk,pka->ap", _basis(local)[0], self.values[where]))

    def dense(self) -> Array:
        """Return the states at nine points of every interval, shape (n, 9 N)."""
        return np.asarray(np.einsum("jk,ika->aij", AT_PROBES, self.values).reshape(self.values.shape[2], -1))

    def extremes(self) -> tuple[Array, Array]:
        """Return the least and the greatest value of each state along the orbit."""
        dense = np.einsum("jk,ika->aij", AT_PROBES, self.values)
        powers = np.einsum("ck,ika->aic", TO_POWERS, self.values)
        least, greatest = (
            np.array([sign * _peak(sign * d, sign * p) for d, p in zip(dense, powers, strict=True)]) for sign in (-1, 1)
        )
        return least, greatest

    def on(self, mesh: Array, phase: float | None = None) -> Orbit:
        """Return the same solution on another mesh, and begun at another phase."""
        later = 0.0 if phase is None else phase - self.phase
        shares = (mesh[:-1, None] + np.diff(mesh)[:, None] * NODES).ravel()
        shares = np.mod(shares + later, 1) if later else shares
        values = self.at(np.clip(shares, 0, 1)).T.reshape(len(mesh) - 1, DEGREE + 1, -1).copy()
        values[:, -1] = np.roll(values[:, 0], -1, axis=0)
        return replace(self, mesh=mesh, values=values, phase=self.phase + later)


def _peak(states: Array, powers: Array) -> float:
    """Return the greatest value of a state from values at the probes and coefficients of each interval."""
    best, found = int(np.argmax(states.max(axis=1))), [float(states.max())]
    for i in (best - 1, best, (best + 1) % len(states)):  # the greatest sample may be an end of two intervals
        flat = np.roots((powers[i, 1:] * np.arange(1, DEGREE + 1))[::-1])
        inside = flat.real[(flat.imag == 0) & (flat.real >= 0) & (flat.real <= 1)]
        found += np.polynomial.polynomial.polyval(inside, powers[i]).tolist()
    return max(found)


class Tangent(NamedTuple):
    """Direction of a branch: changes of the values (N, 5, n), the period, the parameter and the mesh (N + 1,)."""

    values: Array
    period: float
    parameter: float
    mesh: Array


class Metric(NamedTuple):
    """Sizes against which changes of states (n,), period and parameter are measured."""

    states: Array
    period: float
    parameter: float


def inner(a: Array, b: Array, widths: Array, metric: Metric) -> float:
    """Return the scalar product of two periodic functions given at the nodes, averaged over time and states."""
    return float(np.sum(weights(b, widths, metric) * a))


def weights(b: Array, widths: Array, metric: Metric) -> Array:
    """Return the functional ``<., b>`` as weights of the values at the nodes."""
    at_gauss = np.einsum("jk,ika->ija", AT_GAUSS, b) / metric.states**2 / len(metric.states)
    return np.asarray(np.einsum("i,j,jk,ija->ika", widths, GAUSS_WEIGHTS, AT_GAUSS, at_gauss))


def norm(tangent: Tangent, widths: Array, metric: Metric) -> float:
    """Return the length of a direction."""
    square = inner(tangent.values, tangent.values, widths, metric)
    square += (tangent.period / metric.period) ** 2 + (tangent.parameter / metric.parameter) ** 2
    return float(np.sqrt(square))


def scaled(tangent: Tangent, factor: float) -> Tangent:
    """Return a direction times a number."""
    values, period, parameter, mesh = tangent
    return Tangent(values * factor, period * factor, parameter * factor, mesh * factor)


def carried(tangent: Tangent, orbit: Orbit, mesh: Array) -> Tangent:
    """Return a direction that is given on an orbit's mesh on another one."""
    values = replace(orbit, values=tangent.values).on(mesh).values
    return tangent._replace(values=values, mesh=np.interp(mesh, orbit.mesh, tangent.mesh))


def begun(orbit: Orbit, tangent: Tangent, point: int) -> tuple[Orbit, Tangent]:
    """Return an orbit and a direction begun at a point of the mesh."""
    ahead, behind = slice(point, None), slice(1, point + 1)
    mesh = np.concatenate([orbit.mesh[ahead], orbit.mesh[behind] + 1]) - orbit.mesh[point]
    shift = np.concatenate([tangent.mesh[ahead], tangent.mesh[behind]]) - tangent.mesh[point]
    values, changes = (np.roll(part, -point, axis=0) for part in (orbit.values, tangent.values))
    phase = orbit.phase + float(orbit.mesh[point])
    return replace(orbit, mesh=mesh, values=values, phase=phase), tangent._replace(values=changes, mesh=shift)


def moved(orbit: Orbit, tangent: Tangent, step: float) -> Orbit:
    """Return the orbit moved along a direction."""
    return replace(
        orbit,
        mesh=orbit.mesh + step * tangent.mesh,
        values=orbit.values + step * tangent.values,
        period=orbit.period + step * tangent.period,
        parameter=orbit.parameter + step * tangent.parameter,
    )


def adapted_mesh(orbit: Orbit, sizes: Array, count: int, kinks: Array | None = None) -> Array:
    """Return a mesh of about ``count`` intervals that spreads the error evenly, and has the kinks as points.

    The fifth derivative is taken from the fourth ones of neighbouring intervals (R. D. Russell and J. Christiansen,
    SIAM Journal on Numerical Analysis 15 (1978)), but not across a kink.
    """
    h, fixed = orbit.widths, np.empty(0) if kinks is None else kinks
    fourth = np.einsum("k,ika->ia", HIGHEST, orbit.values) / h[:, None] ** DEGREE / sizes
    jump = (np.roll(fourth, -1, axis=0) - fourth) / (0.5 * (h + np.roll(h, -1)))[:, None]
    ahead, smooth = np.abs(jump).max(axis=1), ~np.isin(orbit.mesh[1:], fixed)
    sides = np.stack([ahead, np.roll(ahead, 1)]), np.stack([smooth, np.roll(smooth, 1)])
    size = np.sum(sides[0], axis=0, where=sides[1]) / np.maximum(sides[1].sum(axis=0), 1)
    size = np.where(sides[1].any(axis=0), size, np.abs(fourth).max(axis=1) / h)  # alone between two kinks
    monitor = size ** (1 / (DEGREE + 1))
    monitor = np.maximum(monitor, 0.1 * float(np.sum(monitor * h))) + 1e-12
    total = np.concatenate([[0.0], np.cumsum(monitor * h)])
    ends = np.interp([0.0, *fixed, 1.0], orbit.mesh, total)
    counts = np.maximum(np.rint(count * np.diff(ends) / total[-1]), 1).astype(int)
    parts = zip(ends, ends[1:], counts, strict=False)
    wanted = np.concatenate([np.linspace(a, b, n, endpoint=False) for a, b, n in parts])
    mesh = np.append(np.interp(wanted, total, orbit.mesh), 1.0)
    mesh[np.cumsum(counts)[:-1]] = fixed
    return mesh


def multipliers(monodromy: Array, rates: Array, sizes: Array) -> tuple[Array, float]:
    """Return the Floquet multipliers but for the trivial one, largest first, and how far that is from 1.

    Where another one is near 1, the rates where the period begins tell them apart: they are the trivial one's
    eigenvector, and the others are those of what is left at right angles to it.
    """
    found = np.linalg.eigvals(monodromy)
    trivial = int(np.argmin(np.abs(found - 1)))
    rest, off = np.delete(found, trivial), float(abs(found[trivial] - 1))
    if np.any(np.abs(rest - 1) < ALIKE):
        scaled, along = monodromy * (sizes / sizes[:, None]), rates / sizes
        along = along / np.linalg.norm(along)
        frame, _ = np.linalg.qr(np.column_stack([along, np.eye(len(along))]))
        rest = np.linalg.eigvals(frame[:, 1:].T @ scaled @ frame[:, 1:])
        off = float(np.linalg.norm(scaled @ along - along))
    return rest[np.argsort(-np.abs(rest), kind="stable")], off
