"""A simulation in a few facts: peaks, the end, and whether what is left grows or dies out."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.numeric.motion import motion
from ...numerics.prony import fit_exponents
from .simulation import Simulation

Array = npt.NDArray[Any]

SAMPLES, MOST_SAMPLES, PER_PERIOD = 101, 4001, 10
"""Fewest and most samples of a fit, and how many an oscillation needs."""

LAST = 0.5
"""Share of the time after the last kink of the inputs in which the motion is fitted."""

SIMPLE, FITS = 1e-3, 0.05
"""Misfits up to which one exponent, or a pair of them, is said to describe the motion."""

SINE, STEADY = 1e-4, 1e-3
"""Misfit beyond which an oscillation is no sine, and how much its periods and peaks may differ if it is steady."""

NOISE = 1e-10
"""Share of the largest rate of the same unit below which a rate is taken for rounding."""

AT_REST = 1e-7
"""Rates below this share of their largest mean that nothing moves any more."""


@dataclass(frozen=True)
class Peak:
    """Extreme value of a quantity, the largest departure from its first value, and its value at the end [SI]."""

    name: str
    unit: str
    value: float
    time: float
    end: float


def peaks(result: Simulation) -> tuple[Peak, ...]:
    """Return the extremes of all states and outputs of a single motion."""
    units, found = result.units(), []
    for name in (*result.states, *result.outputs):
        values = result[name]
        k = int(np.argmax(np.abs(values - values[0])))
        found.append(Peak(name, units[name], float(values[k]), float(result.times[k]), float(values[-1])))
    return tuple(found)


def tendency(result: Simulation) -> complex | None:
    """Return the exponent [1/s] that describes the last part of a single motion, None if no single one does.

    Fitted are the rates of the states, which vanish on every steady motion, over the last half of the time in which
    the inputs stay and something moves; 0 means that nothing does, an imaginary value that it swings on steadily.

    Examples
    --------
    >>> from ucrit import load, simulate
    >>> s = tendency(simulate(load("caravan"), 20, {"theta": 1e-3}))
    >>> round(s.real, 3), round(s.imag / (2 * math.pi), 3)
    (0.117, 0.755)
    """
    assert result.course is not None
    first, last = 0.0, float(result.times[-1])
    for stretch in result.course.stretches[::-1]:
        if not _same(stretch.inputs(stretch.start), stretch.inputs(stretch.end), result.input_values[-1]):
            first = stretch.end
            break
    if last - first <= 0:
        return None
    times, scaled = _rates(result, first, last)
    awake = np.flatnonzero(np.abs(scaled).max(axis=1, initial=0) > AT_REST)
    if not awake.size:
        return 0j
    last = float(times[awake[-1]])
    first = last - LAST * (last - first)
    times, samples = _rates(result, first, last, MOST_SAMPLES)
    if times[-1] <= times[0] or not samples.shape[1]:
        return 0j
    swings = np.max(np.sum(np.diff(np.sign(samples), axis=0) != 0, axis=0)) / 2
    fit_times, fitted = _rates(result, first, last, int(np.clip(PER_PERIOD * swings, SAMPLES, MOST_SAMPLES)))
    for order, limit in ((1, SIMPLE), (2, FITS)):
        exponents, misfit = fit_exponents(fitted, fit_times[1] - fit_times[0], order)
        if order == 2 and misfit > SINE and (steady := _steady(times, samples)):
            return 2j * math.pi * steady
        if misfit <= limit and np.isfinite(exponents).all():
            found = complex(exponents[0]) if exponents[0].imag else complex(exponents.real.max())
            return found if abs(found) * (last - first) > STEADY else None  # a steady rate, as of a car that brakes
    return None


def _steady(times: Array, samples: Array) -> float:
    """Return the frequency [Hz] of a motion that repeats itself, 0 if it does not."""
    leading = samples[:, np.argmax(np.abs(samples).max(axis=0))]
    up = np.flatnonzero((leading[:-1] < 0) & (leading[1:] >= 0))
    if len(up) < 4:
        return 0.0
    crossings = times[up] - leading[up] * (times[1] - times[0]) / (leading[up + 1] - leading[up])
    periods = np.diff(crossings)
    peaks = np.array([np.abs(samples[a:b]).max(axis=0) for a, b in pairwise(up)])
    same = all(np.ptp(v, axis=0).max() <= STEADY * v.max() for v in (periods, peaks))
    return float(1 / periods.mean()) if same else 0.0


def _rates(result: Simulation, first: float, last: float, count: int = SAMPLES) -> tuple[Array, Array]:
    """Return times between two, and the rates of all states there as shares of their largest, (times, states)."""
    times = np.linspace(first, last, count)
    part = result.at(times)
    made, arguments = motion(type(result.vehicle)), result.vehicle.arguments()
    rates = made.rhs(part.values.T, part.input_values.T, arguments)
    whole = made.rhs(result.values.T, result.input_values.T, arguments)
    typical, units = np.abs(np.concatenate([rates, whole], axis=1)).max(axis=1), result.units()
    alike = [[units[a] == units[b] for b in result.states] for a in result.states]
    moves = typical > NOISE * np.max(np.where(alike, typical, 0), axis=1)
    return times, (rates[moves] / typical[moves, None]).T


def _same(a: Array, b: Array, c: Array) -> bool:
    return bool(np.array_equal(a, b) and np.array_equal(b, c))


def tendency_text(s: complex | None) -> str:
    """Return how a motion goes on, in words.

    >>> tendency_text(0.25 + 5j)
    'grows at 0.25 1/s and 0.7958 Hz'
    """
    if s is None:
        return "follows no single growth or decay"
    if s == 0:
        return "has come to rest or to a steady state"
    at = f" and {s.imag / (2 * math.pi):.4g} Hz" if s.imag else ""
    if abs(s.real) < 1e-6 * abs(s):
        return f"neither grows nor decays{at.replace(' and', ', at')}"
    return f"{'grows' if s.real > 0 else 'decays'} at {abs(s.real):.4g} 1/s{at}"
