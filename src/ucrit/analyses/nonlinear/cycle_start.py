"""A limit cycle that a simulated motion comes to: where a branch begins that no critical value leads to."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ...core.errors import UcritError
from ...core.numeric.motion import motion
from ...numerics.collocation import Field, SlidingError
from ...numerics.cycle_branch import settled
from ...numerics.cycle_points import Point
from ...numerics.orbit import NODES, Orbit
from ..motion.simulate import simulate
from ..motion.simulation import Simulation

Array = npt.NDArray[Any]

INTERVALS, SAMPLES = 40, 4000

FIRST, LONGER, ROUNDS = 10.0, 1.5, 24
"""Periods of the fastest motion that are simulated first, by what each round is longer than the last one, rounds."""

REPEATS = 0.02
"""A motion repeats that comes back to within this share of its size; it is then settled as a cycle."""

LIKE = 0.2
"""Share by which period and sizes of the cycle may differ from those of the motion that led to it."""

TURNS = 4
"""Most times that a state passes its middle upwards in one period."""

DEAD = 1e-3
"""Share of its largest size at which a motion has died out."""

TOLERANCE = 1e-8


class _Repeat(NamedTuple):
    """Where a motion nearly repeats: its last period's beginning, its length [s], by what share it misses."""

    begin: float
    period: float
    misses: float


def settled_motion(
    vehicle: Model, field: Field, parameter: str, start: Mapping[str, Any], lower: float, upper: float
) -> Point:
    """Return the limit cycle that the motion from a disturbance comes to, at the vehicle's value of the parameter."""
    value, model = float(vehicle.values[parameter]), type(vehicle).model_id()
    labels = motion(type(vehicle)).labels
    if not start:
        raise UcritError(f"{model}: start needs the values of one state or more, such as {{'{labels[0]}': 0.1}}")
    said = f"{model}: the motion from {', '.join(f'{name} = {given}' for name, given in start.items())}"
    rest, _ = motion(type(vehicle)).basic(vehicle.arguments())
    states: Mapping[str, Any] = start
    time, passed, largest, slides = 0.0, 0.0, np.zeros(len(labels)), False
    for _ in range(ROUNDS):
        time = max(LONGER * time, FIRST * _fastest(field, rest, value))
        run = _simulated(vehicle, time, states, said, passed)
        passed += time
        times = np.linspace(time / 2, time, SAMPLES)
        values = run.at(times).values.T
        half = np.ptp(values, axis=1) / 2
        largest = np.maximum(largest, np.abs(run.values - rest).max(axis=0))
        if not np.any(half > DEAD * largest):
            here = "dies out" if np.all(np.abs(values[:, -1] - rest) <= DEAD * largest) else "comes to rest elsewhere"
            raise UcritError(f"{said} {here} within {passed:.3g} s: it leads to no limit cycle")
        repeat = _repeat(times, values, half)
        if repeat is not None and repeat.misses < REPEATS:
            try:
                found = settled(field, _orbit(run, repeat, value), lower, upper)
            except SlidingError:
                found, slides = None, True
            if found is not None and _like(found.orbit, repeat, half) and not _leaves(found):
                return found
        states = dict(zip(labels, map(float, values[:, -1]), strict=True))
    why = " that could be followed: it would slide along a jump of a law" if slides else ""
    raise UcritError(f"{said} has come to no limit cycle{why} within {passed:.3g} s")


def _simulated(vehicle: Model, time: float, states: Mapping[str, Any], said: str, passed: float) -> Simulation:
    try:
        run = simulate(vehicle, time, states, tolerance=TOLERANCE)
    except UcritError as error:
        if not passed and "initial" in str(error):
            raise
        raise UcritError(f"{said} runs away: {str(error).removeprefix(f'{type(vehicle).model_id()}: ')}") from None
    if run.ended:
        raise UcritError(f"{said} ends after {passed + run.times[-1]:.3g} s: {run.ended}")
    return run


def _fastest(field: Field, rest: Array, value: float) -> float:
    """Return the period [s] of the fastest motion near the basic motion, or 1 s where that has no rate."""
    A = field.slopes(rest[:, None], value)[0][0]
    rates = np.abs(np.linalg.eigvals(A)) if np.isfinite(A).all() else np.zeros(1)
    return float(2 * np.pi / rates.max()) if rates.max() > 0 else 1.0


def _repeat(times: Array, values: Array, half: Array) -> _Repeat | None:
    """Return the period after which a motion best comes back to where it was, seen where a state passes its middle."""
    sizes, found = np.where(half > 0, half, np.inf)[:, None], []
    for row in values[half > 0]:
        level = row - (row.max() + row.min()) / 2
        at = np.flatnonzero((level[:-1] < 0) & (level[1:] >= 0))
        share = level[at] / (level[at] - level[at + 1])
        when = times[at] + share * (times[at + 1] - times[at])
        states = values[:, at] + share * (values[:, at + 1] - values[:, at])
        for turns in range(1, min(TURNS, (len(at) - 1) // 2) + 1):
            apart = np.abs(states[:, turns:] - states[:, :-turns]) / sizes
            misses = float(apart[:, -turns:].max())
            found.append(_Repeat(float(when[-1 - turns]), float(when[-1] - when[-1 - turns]), misses))
            if misses < REPEATS:
                break
    return min(found, key=lambda one: one.misses, default=None)


def _orbit(run: Simulation, repeat: _Repeat, value: float) -> Orbit:
    """Return the last period of a motion as an orbit."""
    mesh = np.linspace(0, 1, INTERVALS + 1)
    shares = mesh[:-1, None] + np.diff(mesh)[:, None] * NODES
    wanted, place = np.unique(repeat.begin + repeat.period * shares.ravel(), return_inverse=True)
    states = run.at(wanted).values[place].reshape(*shares.shape, -1)
    states[-1, -1] = states[0, 0]
    return Orbit(mesh, states, repeat.period, value)


def _leaves(found: Point) -> bool:
    """Tell whether a cycle is one that motions leave again, however long they stay near it."""
    return bool(np.abs(found.multipliers).max(initial=0) > 1 + found.unsure)


def _like(orbit: Orbit, repeat: _Repeat, half: Array) -> bool:
    """Tell whether a cycle is that which the motion was near to."""
    least, greatest = orbit.extremes()
    big = half > 1e-6 * half.max()
    apart = np.abs((greatest - least)[big] / (2 * half[big]) - 1)
    return bool(abs(orbit.period / repeat.period - 1) < LIKE and apart.max() < LIKE)
