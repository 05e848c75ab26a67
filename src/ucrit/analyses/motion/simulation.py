"""What a simulation is: states, outputs and inputs over time, and the events on the way."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ...core.errors import UcritError, near_match
from ...core.numeric.motion import motion
from ..results.convert import Series, Table, Tabular, unit_of
from .follow import Course

Array = npt.NDArray[Any]


@dataclass(frozen=True)
class Happening:
    """An event of a motion.

    Attributes
    ----------
    name
        What the model calls it.
    time
        [s].
    states
        Just before it, by name [SI].
    ends
        Whether the motion ended there.
    member
        Which one of a batch, an index into its dimensions; empty for a single motion.
    """

    name: str
    time: float
    states: Mapping[str, float]
    ends: bool
    member: tuple[int, ...] = ()


@dataclass(frozen=True)
class Simulation(Tabular):
    """Motion of a vehicle in time; leading dimensions are those of its array parameters and initial values.

    Attributes
    ----------
    times
        [s], shape (T,).
    states, outputs, inputs
        Names of the columns of the three arrays, in order.
    values, output_values, input_values
        Shapes (..., T, states), (..., T, outputs) and (..., T, inputs) [SI]; of a member of a batch whose motion has
        ended, nan.
    events
        In the order of time.
    ended
        Name of the event that ended the motion, empty if none did; of a batch always empty, see ``events``.
    method
        The one used last: a stiff motion changes from an explicit to an implicit one.
    starts
        Initial values that are arrays, by state: dimensions behind those of the vehicle.
    """

    vehicle: Model
    times: Array
    states: tuple[str, ...]
    outputs: tuple[str, ...]
    inputs: tuple[str, ...]
    values: Array
    output_values: Array
    input_values: Array
    events: tuple[Happening, ...] = ()
    ended: str = ""
    method: str = ""
    starts: Mapping[str, Array] = field(default_factory=dict)
    course: Course | None = field(default=None, repr=False, compare=False)

    def __getstate__(self) -> Any:
        """Return what is pickled and copied: the motion at its times, without the method's own interpolation."""
        return {**super().__getstate__(), "course": None}

    def __getitem__(self, name: str) -> Array:
        """Return a state, output or input over time, shape (..., T)."""
        names = (*self.states, *self.outputs, *self.inputs)
        if name not in names:
            raise UcritError(f"the simulation has no '{name}'{near_match(name, names)}")
        place = names.index(name)
        for group in (self.values, self.output_values, self.input_values):
            if place < group.shape[-1]:
                return group[..., place]
            place -= group.shape[-1]
        raise AssertionError

    def at(self, times: Any) -> Simulation:
        """Return the same motion at other times [s], by the method's own interpolation (dense output).

        At the instant of a jump it is what comes after. Raises `UcritError` for times outside the motion or a batch.

        >>> from ucrit import load, simulate
        >>> fall = simulate(load("bowling-ball-on-a-thin-stick"), 1, {"theta": "1 deg"})
        >>> round(float(fall.at(0.5)["theta"][0]), 4)
        0.0219
        """
        if self.course is None or not self.course.stretches:
            raise UcritError("a batch, or a copy, is known at its times only: give simulate the times wanted")
        last = self.course.stretches[-1].end
        try:
            at = np.atleast_1d(np.asarray(times, dtype=float))
        except (TypeError, ValueError):
            raise UcritError(f"times must be numbers, got {times!r}") from None
        if at.ndim != 1 or not at.size or not np.all((at >= 0) & (at <= last)):
            raise UcritError(f"times must be within 0 s and {last:g} s, got {times!r}")
        values, driven = self.course.at(at)
        outputs = motion(type(self.vehicle)).outputs(values, driven, self.vehicle.arguments()).reshape(-1, len(at))
        return replace(self, times=at, values=values.T, output_values=outputs.T, input_values=driven.T)

    @property
    def dims(self) -> dict[str, Array]:
        """Leading dimensions: name and values."""
        return {**self.vehicle.dims, **{f"initial {name}": values for name, values in self.starts.items()}}

    def units(self) -> dict[str, str]:
        """Return the unit of every state, output and input."""
        declared = type(self.vehicle).declaration
        units = {name: declared.variables[name.rstrip("'")].state_unit(name.count("'")) for name in self.states}
        return units | {n: quantity.unit for n, quantity in (*declared.outputs.items(), *declared.inputs.items())}

    def findings(self) -> dict[str, Any]:
        """Return the method, and what ended the motion before its time (empty if nothing did)."""
        return {"method": self.method, "ended": self.ended}

    def table(self) -> Table:
        """Return states, outputs and inputs over time with their units, and events beside them."""
        units, dims = self.units(), self.dims
        coords = [
            Series(n, (n,), v, units[n[8:]] if n[:8] == "initial " else unit_of(self.vehicle, n))
            for n, v in dims.items()
        ]
        rows = (*dims, "time")
        data = tuple(Series(n, rows, self[n], units[n]) for n in (*self.states, *self.outputs, *self.inputs))
        time = Series("time", ("time",), self.times, "s")
        return Table("simulation", self.vehicle, (*coords, time), data, rows, self._event_series(coords))

    def _event_series(self, coords: list[Series]) -> tuple[Series, ...]:
        """Return names and times of the events, and of a batch which members they happened to."""
        if not self.events:
            return ()
        happened = ("event",)
        names = Series("event name", happened, np.array([e.name for e in self.events]))
        times = Series("event time", happened, np.array([e.time for e in self.events]), "s")
        places = [
            Series(f"event {c.name}", happened, c.values[[e.member[axis] for e in self.events]], c.unit)
            for axis, c in enumerate(coords)
        ]
        return (names, times, *places)
