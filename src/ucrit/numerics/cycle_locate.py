"""Points of a branch of periodic solutions: what is known of one, and those between two neighbours."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import numpy.typing as npt

from . import collocation as co
from . import orbit as orbits
from .collocation import Corrected, Field, SlidingError
from .cycle_points import Point
from .kinks import settle
from .orbit import Metric, Orbit, Tangent

Array = npt.NDArray[Any]

SHARE_OF_RANGE = 0.1
"""Share of the parameter's range that counts as much as a cycle's own size."""

ROOT_STEPS = 40


def sizes(orbit: Orbit) -> Array:
    """Return half the range of each state; a state that rests is given the largest of the others."""
    dense = orbit.dense()
    half = 0.5 * (dense.max(axis=1) - dense.min(axis=1))
    return np.asarray(np.where(half > 1e-12 * half.max(), half, half.max() or 1.0))


def metric_of(orbit: Orbit, span: float) -> Metric:
    """Return the sizes that changes of an orbit are measured by."""
    return Metric(sizes(orbit), orbit.period, SHARE_OF_RANGE * span)


def point_of(field: Field, found: Corrected, metric: Metric, fold: bool = False) -> Point:
    """Return a solution of Newton's method as a point of a branch, with its multipliers and error."""
    x, p = found.orbit.values[0, :1], found.orbit.parameter
    multipliers, trivial = orbits.multipliers(found.monodromy, field.rates(x.T, p)[:, 0], metric.states)
    error = co.error(field, found.orbit, metric.states)
    return Point(found.orbit, found.tangent, metric, multipliers, trivial, error, fold)


def between(field: Field, a: Point, b: Point, share: float) -> Corrected | None:
    """Return the solution at a share of the way from one point of a branch to its neighbour."""
    other = b.orbit.on(a.orbit.mesh, a.orbit.phase)
    period, parameter = other.period - a.orbit.period, other.parameter - a.orbit.parameter
    chord = Tangent(other.values - a.orbit.values, period, parameter, 0 * a.orbit.mesh)
    try:
        return settle(field, orbits.moved(a.orbit, chord, share), chord, a.metric)
    except SlidingError:
        return None


def locate(field: Field, a: Point, b: Point, miss: Callable[[Corrected], float]) -> Point | None:
    """Return the point between two neighbours where a function of the solution changes sign, by the Illinois method."""
    ends = between(field, a, b, 0.0), between(field, a, b, 1.0)
    if ends[0] is None or ends[1] is None:
        return None
    low, high, f_low, f_high = 0.0, 1.0, miss(ends[0]), miss(ends[1])
    best, size = (ends[0], abs(f_low)) if abs(f_low) < abs(f_high) else (ends[1], abs(f_high))
    if f_low * f_high > 0:
        return None
    for _ in range(ROOT_STEPS):
        share = (low * f_high - high * f_low) / (f_high - f_low) if f_high != f_low else 0.5 * (low + high)
        found = between(field, a, b, share)
        if found is None:
            break
        value = miss(found)
        if abs(value) < size:
            best, size = found, abs(value)
        if value == 0 or high - low < 1e-12 or size < 1e-13:
            break
        if value * f_high < 0:
            low, f_low = high, f_high
        else:
            f_low /= 2
        high, f_high = share, value
    return point_of(field, best, a.metric, fold=True)


def at_parameter(field: Field, a: Point, b: Point, value: float) -> Point | None:
    """Return the periodic solution at a value of the parameter between those of two neighbours."""
    near = locate(field, a, b, lambda found: found.orbit.parameter - value)
    if near is None:  # a corner between them: the solution is like that of one of them
        return next((found for found in (kept(field, b, value), kept(field, a, value)) if found), None)
    found = kept(field, near, value)
    if found is None or abs(found.orbit.period / near.orbit.period - 1) > 1e-6:
        return replace(near, fold=False)
    return replace(found, tangent=near.tangent)


def kept(field: Field, near: Point, value: float) -> Point | None:
    """Return the periodic solution at a value of the parameter that is found from a point beside it."""
    guess = replace(near.orbit, parameter=value)
    only = Tangent(np.zeros_like(guess.values), 0.0, 1.0, 0 * guess.mesh)
    try:
        found = settle(field, guess, only, near.metric)
    except SlidingError:
        return None
    return None if found is None else point_of(field, found, near.metric)
