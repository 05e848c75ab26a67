"""Kinks and jumps of a law along a periodic solution: found where switching values change sign, put on the mesh.

Collocation keeps its order if each of them is on a point of the mesh. Where the rates are continuous but their slopes
jump, the monodromy matrix needs no correction (R. I. Leine and H. Nijmeijer, Dynamics and Bifurcations of Non-Smooth
Mechanical Systems (2004), chapter 7: the saltation matrix is then the identity); where the rates jump themselves,
`collocation.correct` is told so.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from .collocation import Corrected, Field, Jump, beside, correct, refuse_sliding
from .orbit import PROBES, Metric, Orbit, Tangent, begun, carried

Array = npt.NDArray[Any]

ROOT_STEPS = 60
APART = 1e-7
"""Share of the period within which two kinks are taken as one."""

ROOM = 0.03
"""Least share of the period between a kink and the period's beginning."""

PLACED = 1e-9
"""Share of the period by which a kink may miss its point of the mesh."""

ROUNDS = 6

JUMPS = 1e-6
"""Rates that differ on both sides of a point by more than this share of the largest on the orbit jump there."""


def kinks(field: Field, orbit: Orbit) -> Array:
    """Return the shares of the period at which switching values change sign, ascending, within (0, 1).

    A kink next to a point of the mesh is at that point.
    """
    found = _kinks(field, orbit)[0]
    return found[(found > APART) & (found < 1 - APART)]


def clear(field: Field, orbit: Orbit, tangent: Tangent) -> tuple[Orbit, Tangent]:
    """Return an orbit and a direction that begin far from any kink, so that none comes or goes at the ends."""
    found = _kinks(field, orbit)[0]
    if not found.size or min(found[0], 1 - found[-1]) > ROOM:
        return orbit, tangent
    away = np.abs(orbit.mesh[:-1, None] - found)
    return begun(orbit, tangent, int(np.argmax(np.minimum(away, 1 - away).min(axis=1))))


def _kinks(field: Field, orbit: Orbit) -> tuple[Array, Array]:
    """Return the shares of kinks in [0, 1], and the rows of the switching values that vanish there."""
    none = np.empty(0), np.empty(0, dtype=int)
    if field.switches is None:
        return none
    inside = orbit.mesh[:-1, None] + orbit.widths[:, None] * PROBES[:-1]
    shares, values = _sampled(field, orbit, np.append(inside.ravel(), 1.0))
    which, place = np.nonzero((values[:, :-1] >= 0) != (values[:, 1:] >= 0))
    sound = np.isfinite(values[which, place]) & np.isfinite(values[which, place + 1])
    which, place = which[sound], place[sound]
    if not place.size:
        return none
    ends = shares[place], shares[place + 1]
    found = _roots(field, orbit, which, ends, (values[which, place], values[which, place + 1]))
    order = np.argsort(found)
    found, which = found[order], which[order]
    kept = np.concatenate([[True], np.diff(found) > APART])
    found, which = found[kept], which[kept]
    nearest = orbit.mesh[np.abs(found[:, None] - orbit.mesh).argmin(axis=1)]
    return np.asarray(np.where(np.abs(nearest - found) < PLACED, nearest, found)), which


def jumps(field: Field, orbit: Orbit, shares: Array, rows: Array) -> tuple[Jump, ...]:
    """Return those kinks, which are points of the mesh, at which the rates themselves jump."""
    found = []
    size = np.abs(field.rates(orbit.values[:, 1:-1].reshape(-1, orbit.values.shape[2]).T, orbit.parameter)).max(axis=1)
    for share, row in zip(shares, rows, strict=True):
        point = int(np.argmin(np.abs(orbit.mesh - share)))
        if 0 < point < len(orbit.widths):
            before, after = beside(field, orbit, point)
            if np.any(np.abs(after - before) > JUMPS * size):
                found.append(Jump(point, int(row)))
    return tuple(found)


def _sampled(field: Field, orbit: Orbit, shares: Array) -> tuple[Array, Array]:
    """Return switching values at places, and at those between them where one has just begun to touch zero."""
    assert field.switches is not None
    values = field.switches(orbit.at(shares), orbit.parameter)
    left, here, right = values[:, :-2], values[:, 1:-1], values[:, 2:]
    a, b = np.diff(shares)[:-1], np.diff(shares)[1:]
    with np.errstate(all="ignore"):
        rise, fall = (here - left) / a, (right - here) / b
        bend = 2 * (fall - rise) / (a + b)
        slope = (b * rise + a * fall) / (a + b)
        away = -slope / bend
        peak = here + away * slope / 2
        touches = (here * peak <= 0) & (here * left > 0) & (here * right > 0) & (away > -a) & (away < b)
    if not touches.any():
        return shares, values
    rows, places = np.nonzero(touches)
    shares = np.unique(np.append(shares, shares[places + 1] + away[rows, places]))
    return shares, field.switches(orbit.at(shares), orbit.parameter)


def _roots(field: Field, orbit: Orbit, which: Array, ends: tuple[Array, Array], values: tuple[Array, Array]) -> Array:
    """Return zeros of switching values between places where they differ in sign, by the Illinois method."""
    assert field.switches is not None
    (low, high), (f_low, f_high) = map(np.array, ends), map(np.array, values)
    each = np.arange(len(which))
    middle = low
    for _ in range(ROOT_STEPS):
        gap = f_high - f_low
        middle = np.where(gap != 0, (low * f_high - high * f_low) / np.where(gap != 0, gap, 1), low)
        value = field.switches(orbit.at(middle), orbit.parameter)[which, each]
        beyond = (value >= 0) == (f_high >= 0)
        low, f_low = np.where(beyond, low, high), np.where(beyond, f_low / 2, f_high)
        high, f_high = middle, value
        if np.all((np.abs(high - low) < 1e-14) | (value == 0)):
            break
    return np.asarray(middle)


def snapped(mesh: Array, shares: Array) -> Array:
    """Return a mesh that has every kink as a point: the nearest one is moved there, or one is added."""
    mesh, taken = mesh.copy(), np.isin(np.arange(len(mesh)), (0, len(mesh) - 1))
    for share in shares:
        nearest = int(np.argmin(np.where(taken, np.inf, np.abs(mesh - share))))
        if not taken[nearest] and np.searchsorted(np.delete(mesh, nearest), share) == nearest:
            mesh[nearest] = share
        else:
            nearest = int(np.searchsorted(mesh, share))
            mesh, taken = np.insert(mesh, nearest, share), np.insert(taken, nearest, True)
        taken[nearest] = True
    return mesh


def missed(mesh: Array, shares: Array) -> float:
    """Return how far the worst placed kink is from a point of the mesh."""
    if not shares.size:
        return 0.0
    return float(np.abs(shares[:, None] - mesh).min(axis=1).max())


def settle(field: Field, guess: Orbit, along: Tangent, metric: Metric) -> Corrected | None:
    """Solve as `correct` does, with the kinks of the law on points of the mesh.

    Each round moves the points to where the kinks of the last solution are; the distance that is left falls with its
    square. Raises `SlidingError` where the motion would slide along a jump instead of going through.
    """
    found, last = None, np.inf
    for _ in range(ROUNDS):
        shares, rows = _kinks(field, guess)
        inside = (shares > APART) & (shares < 1 - APART)
        shares, rows = shares[inside], rows[inside]
        left = missed(guess.mesh, shares)
        if found is not None and (left == 0 or left > 0.5 * last):
            return found
        if left:
            mesh = snapped(guess.mesh, shares)
            guess, along = guess.on(mesh), carried(along, guess, mesh)
        at = jumps(field, guess, shares, rows)
        better = correct(field, guess, along, metric, at)
        if better is None:
            if found is None:
                refuse_sliding(field, guess, metric, at)
            return found
        last = np.inf if found is None else left  # the first guess may have been near by chance
        found, guess = better, better.orbit
        if field.switches is None:
            return found
    return found
