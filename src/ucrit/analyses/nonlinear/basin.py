"""How large a disturbance leads from straight running to a limit cycle, found by simulation."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ...core.errors import UcritError, near_match
from ...core.html import Rich
from ...core.numeric.motion import motion
from .cycle import Cycle
from .cycle_field import field_of
from .cycle_words import amplitude_text, value_text
from .cycles import LimitCycles, limit_cycles

Array = npt.NDArray[Any]

LANES = 32
"""Disturbances that are simulated side by side."""

ROUNDS = 2
PERIODS = 300
INSIDE, OUTSIDE, TREND = 0.9, 1.1, 6
"""Shares of the unstable cycle beyond which a motion that shrank or grew for so many periods is decided."""

STEADY = 0.02
"""Share by which a motion that stays beyond the unstable cycle may shrink in a period."""

LARGEST = 8.0
"""Largest disturbance that is tried, as a multiple of the unstable cycle's amplitude; the smallest is its inverse."""


@dataclass(frozen=True)
class Basin(Rich):
    """The disturbance of one state that parts motions that die out from those that do not.

    Attributes
    ----------
    vehicle
        The vehicle as it runs.
    state, unit
        Which state is disturbed, the others being those of the basic motion, and its unit.
    dies_out, persists
        Largest disturbance that was seen to die out and smallest one that was not [SI].
    unstable, stable
        The limit cycle on the border between the two, and the one that is reached; ``None`` where none was followed.
    """

    vehicle: Model
    state: str
    unit: str
    dies_out: float
    persists: float
    unstable: Cycle
    stable: Cycle | None
    _place: str

    @property
    def threshold(self) -> float:
        """Disturbance on the border [SI]."""
        return 0.5 * (self.dies_out + self.persists)

    def to_dict(self) -> dict[str, Any]:
        """Return the finding as plain data, in words too."""
        sizes = {"dies_out": self.dies_out, "persists": self.persists}
        return {"sentence": str(self), "state": self.state, "unit": self.unit, **sizes}

    def __str__(self) -> str:
        size = amplitude_text(self.threshold, self.unit)
        end = "does not die out"
        if self.stable is not None:
            end = f"leads to the limit cycle of {self.stable.frequency_hz:.3g} Hz"
        return f"At {self._place} a disturbance of {self.state} beyond {size} {end}; a smaller one dies out."


def basin(
    vehicle: Model,
    state: str,
    cycles: LimitCycles | None = None,
    *,
    progress: Callable[[int, int], None] | None = None,
) -> Basin:
    """Find by simulation which disturbance of a state leads a vehicle that runs stably into a limit cycle.

    Parameters
    ----------
    vehicle
        As it runs; straight running must be stable and a limit cycle unstable there.
    state
        The state that is disturbed at first, such as ``"theta"`` or ``"theta'"``.
    cycles
        What `limit_cycles` returned for this vehicle; followed in the speed by default.
    progress
        Called with the number of periods followed and the most there can be.

    Returns
    -------
    Basin
        Bracketed to about half a percent by two rounds of 32 simulations side by side.

    Raises
    ------
    UcritError
        If there is no such state, no unstable cycle to part the motions, or every disturbance dies out.

    Examples
    --------
    >>> from ucrit import basin, load
    >>> print(basin(load("caravan-with-stabiliser", {"U": 24}), "theta'"))
    At 24 m/s (86.4 km/h) a disturbance of theta' beyond ...
    """
    model, labels = type(vehicle), motion(type(vehicle)).labels
    if state not in labels:
        raise UcritError(f"{model.model_id()}: there is no state '{state}'{near_match(state, labels)}")
    cycles = limit_cycles(vehicle) if cycles is None else cycles
    value = float(vehicle.values[cycles.parameter])
    place = value_text(cycles, value)
    if not any(low < value < high for low, high in cycles.critical.stable_ranges()):
        raise UcritError(f"{model.model_id()}: straight running is unstable at {place}: every disturbance grows")
    here = cycles.at(value)
    border = [c for c in here if not c.stable]
    if not border:
        raise UcritError(f"{model.model_id()}: no unstable limit cycle is found at {place}: every disturbance dies out")
    unstable = min(border, key=lambda c: c.amplitude[state])
    larger = [c for c in here if c.stable and c.amplitude[state] > unstable.amplitude[state]]
    stable = min(larger, key=lambda c: c.amplitude[state]) if larger else None
    unit = model.declaration.variables[state.rstrip("'")].state_unit(state.count("'"))
    trial = _Trial(vehicle, cycles.parameter, labels.index(state), unstable, unit)
    inside, outside = _bracketed(trial, unstable.amplitude[state], progress, model.model_id(), state)
    return Basin(vehicle, state, unit, inside, outside, unstable, stable, place)


def _bracketed(
    trial: _Trial, scale: float, progress: Callable[[int, int], None] | None, model: str, state: str
) -> tuple[float, float]:
    """Return the largest disturbance that dies out and the smallest that does not."""
    sizes, inside, outside = scale * np.geomspace(1 / LARGEST, LARGEST, LANES), 0.0, np.inf
    for number in range(ROUNDS):

        def advance(periods: int, number: int = number) -> None:
            if progress is not None:
                progress(number * PERIODS + periods, ROUNDS * PERIODS)

        kept = trial.persists(sizes, advance)
        if not kept.any() and not np.isfinite(outside):
            size = amplitude_text(float(sizes[-1]), trial.unit)
            raise UcritError(f"{model}: every disturbance of {state} up to {size} dies out")
        first = int(np.argmax(kept)) if kept.any() else len(sizes)
        inside = float(sizes[first - 1]) if first else inside
        outside = float(sizes[first]) if first < len(sizes) else outside
        sizes = np.linspace(inside, outside, LANES + 2)[1:-1]
    if progress is not None:
        progress(1, 1)
    return inside, outside


class _Trial:
    """Simulations of several disturbances of one state side by side."""

    def __init__(self, vehicle: Model, parameter: str, place: int, unstable: Cycle, unit: str) -> None:
        self.unit = unit
        self.value, self.place, self.period = float(vehicle.values[parameter]), place, unstable.period
        self.rates = field_of(vehicle, parameter).rates
        self.rest, _ = motion(type(vehicle)).basic(vehicle.arguments())
        self.scale = np.array([*unstable.amplitude.values()])[:, None]
        self.scale = np.where(self.scale > 0, self.scale, np.inf)

    def persists(self, sizes: Array, advance: Callable[[int], None]) -> Array:
        """Return which disturbances do not die out."""
        states = np.repeat(self.rest[:, None], len(sizes), axis=1)
        states[self.place] += sizes
        lanes, kept = np.arange(len(sizes)), np.zeros(len(sizes), dtype=bool)
        history: list[Array] = []
        for number in range(PERIODS):
            advance(number)
            states, size = self._period(states)
            history = [*history[-TREND:], size]
            steps = np.diff(np.array(history), axis=0)
            long = len(history) > TREND
            steady = (steps > -STEADY * size).all(axis=0)  # grows, or has come to another limit cycle
            grown = ~np.isfinite(size) | (long & (size > OUTSIDE) & steady)
            shrunk = long & (size < INSIDE) & (steps < 0).all(axis=0)
            kept[lanes[grown]] = True
            open_ = ~(grown | shrunk)
            lanes, states, history = lanes[open_], states[:, open_], [old[open_] for old in history]
            if not lanes.size:
                return kept
        kept[lanes] = [old > 1 for old in history[-1]]  # on the border all that time
        return kept

    def _period(self, states: Array) -> tuple[Array, Array]:
        """Return the states a period of the unstable cycle later, and the largest share of it met on the way."""
        from scipy.integrate import solve_ivp

        def flat(t: float, w: Array) -> Array:
            return self.rates(w.reshape(states.shape), self.value).ravel()

        limits = {"rtol": 1e-5, "atol": 1e-6 * float(np.min(self.scale))}
        with np.errstate(all="ignore"):
            run = solve_ivp(flat, (0, self.period), states.ravel(), method="DOP853", **limits)
        if not run.success:
            return states, np.full(states.shape[1], np.inf)
        deviations = np.abs(run.y.reshape(*states.shape, -1) - self.rest[:, None, None])
        return run.y[:, -1].reshape(states.shape), np.max(deviations.max(axis=2) / self.scale, axis=0)
