"""Limit cycles of a vehicle: one, and a branch of them."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ...core.numeric.motion import motion
from ...core.units import to_si
from ...numerics.cycle_locate import at_parameter
from ...numerics.cycle_points import ROUNDING, Branch, Point
from ...numerics.orbit import Orbit
from ..results.convert import Series, Table, Tabular
from ..stability.critical import Critical
from .cycle_field import field_of

Array = npt.NDArray[Any]

SAMPLES = 401

NEAR = 1e-8
"""Relative change of the parameter below which a branch is called vertical."""


@dataclass(frozen=True)
class Cycle(Tabular):
    """A periodic motion that its neighbours come to (stable) or part at (unstable).

    Attributes
    ----------
    vehicle
        The vehicle at this value of the parameter.
    parameter, value
        What was varied, and its value [SI].
    period
        [s].
    amplitude
        Greatest deviation of each state from the basic motion [SI], by name.
    multipliers
        Floquet multipliers but for the one that is always 1, largest first: factors by which deviations from the
        cycle grow in a period.
    stable, fold
        Whether all multipliers are inside the unit circle by more than their error, and whether the branch turns
        round here.
    error
        Estimated relative error of the states that the mesh makes. At a given value of the parameter a cycle with a
        multiplier near 1 is less certain, by the factor ``1/abs(1 - multiplier)``.
    accuracy
        How far the multiplier that should be 1 is from it: the error of the multipliers.
    """

    vehicle: Model
    parameter: str
    value: float
    period: float
    amplitude: dict[str, float]
    multipliers: Array
    stable: bool
    fold: bool
    error: float
    accuracy: float
    _orbit: Orbit = field(repr=False)

    @property
    def frequency_hz(self) -> float:
        """Frequency [Hz]."""
        return 1 / self.period

    @property
    def growth(self) -> float:
        """Share by which the deviation from the cycle that lasts longest grows in a period, below 0 if it shrinks.

        0 where the multipliers' error leaves the sign open.
        """
        share = float(np.abs(self.multipliers).max(initial=0.0)) - 1
        return share if abs(share) > 10 * self.accuracy + ROUNDING else 0.0

    def states(self, times: Array) -> Array:
        """Return the states at times [s], shape (states, times); the cycle goes on for ever."""
        return self._orbit.at(np.mod(np.asarray(times, dtype=float) / self.period, 1.0))

    def table(self) -> Table:
        """Return the states over one period."""
        times = np.linspace(0, self.period, SAMPLES)
        labels, declared = motion(type(self.vehicle)).labels, type(self.vehicle).declaration.variables
        values = self.states(times)
        data = tuple(
            Series(s, ("time",), values[i], declared[s.rstrip("'")].state_unit(s.count("'")))
            for i, s in enumerate(labels)
        )
        return Table("limit cycle", self.vehicle, (Series("time", ("time",), times, "s"),), data, ("time",))


def of_point(vehicle: Model, parameter: str, point: Point) -> Cycle:
    """Return a point of a branch as a limit cycle of the vehicle."""
    orbit = point.orbit
    changed = vehicle.with_(**{parameter: orbit.parameter})
    made = motion(type(vehicle))
    rest, _ = made.basic(changed.arguments())
    least, greatest = orbit.extremes()
    peaks = np.maximum(greatest - rest, rest - least)
    return Cycle(
        changed,
        parameter,
        orbit.parameter,
        orbit.period,
        dict(zip(made.labels, map(float, peaks), strict=True)),
        point.multipliers,
        point.stable and not point.fold,
        point.fold,
        point.error,
        point.trivial,
        orbit,
    )


@dataclass(frozen=True)
class CycleBranch(Tabular):
    """Limit cycles in the order of their branch: those that leave a critical value, or that a motion came to.

    Attributes
    ----------
    vehicle, critical
        The vehicle, and where straight running begins to oscillate; ``None`` for a branch begun from a motion.
    parameter, unit, states
        What is varied, its unit, and the names of the states.
    cycles
        The limit cycles, from the smallest one next to the critical value; of a branch begun from a motion, from one
        end to the other.
    end
        Why the branch is followed no further: ``"range"`` (the parameter's), ``"equilibrium"`` (it ends in another
        critical value), ``"closed"`` (it comes back to its first cycle), ``"large"`` (angles pass 90 degrees),
        ``"endless"`` (ever larger cycles at one value), ``"slides"`` (the motion would slide along a jump of a law),
        ``"stuck"`` (no neighbour was found) or ``"count"``.
    begin, start
        For a branch begun from a motion: why it is followed no further the other way, and the cycle that the motion
        came to. Else ``"critical"`` and ``None``.
    """

    vehicle: Model
    critical: Critical | None
    parameter: str
    unit: str
    states: tuple[str, ...]
    cycles: tuple[Cycle, ...]
    end: str
    _points: tuple[Point, ...] = field(repr=False)
    begin: str = "critical"
    start: Cycle | None = None

    @property
    def values(self) -> Array:
        """Values of the parameter, shape (P,)."""
        return np.array([cycle.value for cycle in self.cycles])

    @cached_property
    def amplitudes(self) -> Array:
        """Greatest deviation of each state from the basic motion [SI], shape (P, states)."""
        return np.array([list(cycle.amplitude.values()) for cycle in self.cycles])

    @property
    def stable(self) -> Array:
        """Whether each cycle is stable, shape (P,)."""
        return np.array([cycle.stable for cycle in self.cycles])

    @property
    def folds(self) -> tuple[Cycle, ...]:
        """Cycles at which the parameter turns round, so that two cycles become one and vanish."""
        return tuple(cycle for cycle in self.cycles if cycle.fold)

    @property
    def kind(self) -> str:
        """``"supercritical"``: small stable cycles on the unstable side of the critical value; else ``"subcritical"``.

        ``"vertical"`` where the first cycles are at the critical value itself; ``"from a motion"`` for a branch that
        was begun so.
        """
        if self.critical is None:
            return "from a motion"
        value = self.critical.value
        turned = self.cycles[0].value - value
        if abs(turned) <= NEAR * abs(value):
            return "vertical"
        return "supercritical" if (turned > 0) == (self.critical.stable == "below") else "subcritical"

    @property
    def onset(self) -> Cycle | None:
        """The stable cycle furthest into the range where straight running is stable too; ``None`` if there is none.

        It is sought on branches that leave a critical value.
        """
        if self.critical is None:
            return None
        below, value = self.critical.stable == "below", self.critical.value
        found = [c for c in self.cycles if c.stable and (c.value < value) == below]
        found += [c for c in self.folds if (c.value < value) == below]
        return (min if below else max)(found, key=lambda c: c.value) if found else None

    @property
    def events(self) -> tuple[tuple[str, float], ...]:
        """Other changes of stability: what leaves the unit circle, and near which value of the parameter."""
        return Branch(self._points, self.end).events

    def at(self, value: float | str) -> tuple[Cycle, ...]:
        """Return the cycles at a value of the parameter [SI, or text with a unit], in the order of the branch."""
        wanted = to_si(value, self.unit, self.parameter)
        moving, found = field_of(self.vehicle, self.parameter), []
        for p, q in zip(self._points, self._points[1:], strict=False):
            low, high = sorted((p.orbit.parameter, q.orbit.parameter))
            if low <= wanted <= high and wanted != p.orbit.parameter:
                point = q if wanted == q.orbit.parameter else at_parameter(moving, p, q, wanted)
                found += [of_point(self.vehicle, self.parameter, point)] if point else []
        if self._points and self._points[0].orbit.parameter == wanted:
            found.insert(0, of_point(self.vehicle, self.parameter, self._points[0]))
        return tuple(found)

    def table(self) -> Table:
        """Return one row for each cycle: parameter, frequency, amplitudes, largest multiplier, stability, error."""
        return table_of(self.vehicle, self.parameter, (self,))


def table_of(vehicle: Model, parameter: str, branches: tuple[CycleBranch, ...]) -> Table:
    """Return the flat table of branches' cycles."""
    declared = type(vehicle).declaration
    cycles = [cycle for branch in branches for cycle in branch.cycles]
    rows, states = ("number",), motion(type(vehicle)).labels
    units = [declared.variables[s.rstrip("'")].state_unit(s.count("'")) for s in states]
    amplitudes = np.array([list(c.amplitude.values()) for c in cycles]).reshape(len(cycles), len(states))
    largest = np.array([np.abs(c.multipliers).max(initial=0.0) for c in cycles])
    numbers = np.repeat(np.arange(1, len(branches) + 1), [len(b.cycles) for b in branches])
    data = (
        Series("branch", rows, numbers),
        Series(parameter, rows, np.array([c.value for c in cycles], dtype=float), declared.parameters[parameter].unit),
        Series("frequency", rows, np.array([c.frequency_hz for c in cycles], dtype=float), "Hz"),
        *(
            Series(f"amplitude of {s}", rows, amplitudes[:, i], unit)
            for i, (s, unit) in enumerate(zip(states, units, strict=True))
        ),
        Series("largest multiplier", rows, largest, "1"),
        Series("stable", rows, np.array([c.stable for c in cycles], dtype=bool)),
        Series("fold", rows, np.array([c.fold for c in cycles], dtype=bool)),
        Series("error", rows, np.array([c.error for c in cycles], dtype=float), "1"),
    )
    return Table("limit cycles", vehicle, (Series("number", rows, np.arange(1, len(cycles) + 1)),), data, rows)
