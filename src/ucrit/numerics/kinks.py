"""Kinks of a law along a periodic solution: found where switching values change sign, and put on points of the mesh.

Where the right-hand side is continuous but its slopes jump, collocation keeps its order if every jump is on a point of
the mesh, and the monodromy matrix needs no correction (R. I. Leine and H. Nijmeijer, Dynamics and Bifurcations of
Non-Smooth Mechanical Systems (2004), chapter 7: the saltation matrix is then the identity).
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from .collocation import Corrected, Field, correct
from .orbit import PROBES, Metric, Orbit, Tangent, carried

Array = npt.NDArray[Any]

ROOT_STEPS = 60
APART = 1e-7
"""Share of the period within which two kinks are taken as one."""

PLACED = 1e-9
"""Share of the period by which a kink may miss its point of the mesh."""

ROUNDS = 6


def kinks(field: Field, orbit: Orbit) -> Array:
    """Return the shares of the period at which switching values change sign, ascending, within (0, 1).

    A kink next to a point of the mesh is at that point.
    """
    if field.switches is None:
        return np.empty(0)
    inside = orbit.mesh[:-1, None] + orbit.widths[:, None] * PROBES[:-1]
    shares = np.append(inside.ravel(), 1.0)
    values = field.switches(orbit.at(shares), orbit.parameter)
    which, place = np.nonzero((values[:, :-1] >= 0) != (values[:, 1:] >= 0))
    sound = np.isfinite(values[which, place]) & np.isfinite(values[which, place + 1])
    which, place = which[sound], place[sound]
    if not place.size:
        return np.empty(0)
    ends = shares[place], shares[place + 1]
    found = np.sort(_roots(field, orbit, which, ends, (values[which, place], values[which, place + 1])))
    kept = np.concatenate([[True], np.diff(found) > APART]) & (found > APART) & (found < 1 - APART)
    found = found[kept]
    nearest = orbit.mesh[np.abs(found[:, None] - orbit.mesh).argmin(axis=1)]
    return np.asarray(np.where(np.abs(nearest - found) < PLACED, nearest, found))


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
    square.
    """
    found, last = None, np.inf
    for _ in range(ROUNDS):
        shares = kinks(field, guess)
        left = missed(guess.mesh, shares)
        if found is not None and (left == 0 or left > 0.5 * last):
            return found
        if left:
            mesh = snapped(guess.mesh, shares)
            guess, along = guess.on(mesh), carried(along, guess, mesh)
        better = correct(field, guess, along, metric)
        if better is None:
            return found
        last = np.inf if found is None else left  # the first guess may have been near by chance
        found, guess = better, better.orbit
        if field.switches is None:
            return found
    return found
