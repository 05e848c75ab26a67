"""Where events happen along a step: sign changes of their values, located on the dense output."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.errors import UcritError

Array = npt.NDArray[Any]

SAMPLES = 4
"""Places of a step at which signs are looked at, so that two crossings in one step are not missed."""

EARLY = 10.0 ** np.arange(-10, 0)
"""Shares of a step at which signs are looked at too, right behind an event that changed the motion."""

MOST, CLOSE = 10_000, 1e-9
"""Events of one run, and the time [s] between two of one kind, beyond which they are taken to pile up."""


@dataclass(frozen=True)
class Crossing:
    """An event: which, of which member of the batch, when, with which states."""

    name: str
    which: int
    member: tuple[int, ...]
    time: float
    states: Array
    ends: bool


class Watch:
    """Signs of a model's event values, and the events found so far."""

    def __init__(self, made: Any, arguments: Sequence[Any], lead: tuple[int, ...]) -> None:
        self.made, self.arguments, self.lead = made, arguments, lead
        self.names: tuple[str, ...] = made.event_names
        self.found: list[Crossing] = []
        self.signs = np.zeros((len(self.names), *lead))
        self.last: dict[tuple[int, ...], float] = {}
        self.fresh = False

    def begin(self, w: Array, u: Array) -> None:
        """Take the signs at the start; what is exactly zero there has not happened.

        An event that also counts from the start is taken to come from the other side.
        """
        if self.names:
            self.signs = np.sign(self._values(w, u))
            for which in np.flatnonzero(self.made.event_starts):
                signs, way = self.signs[which], self.made.event_ways[which]
                self.signs[which] = np.where((signs == way) | (way == 0), -signs, signs)

    def _values(self, w: Array, u: Array) -> Array:
        with np.errstate(all="ignore"):
            values = self.made.event_values(w, u, self.arguments)
        return np.broadcast_to(values, self.signs.shape)

    def look(
        self, a: float, b: float, states: Callable[[float], Array], inputs: Callable[[float], Array], alive: Array
    ) -> Crossing | None:
        """Note what happens in a step from ``a`` to ``b``; return the first event that changes the motion."""
        if not self.names:
            return None
        times = np.linspace(a, b, SAMPLES + 1)
        if self.fresh:
            times = np.concatenate([[a], np.unique([*(a + (times[1] - a) * EARLY), *times[1:]])])
            self.fresh = False
        for early, late in pairwise(map(float, times)):
            new = np.sign(self._values(states(late), inputs(late)))
            ways = np.array(self.made.event_ways).reshape(-1, *(1,) * len(self.lead))
            crossed = (self.signs * new < 0) & ((ways == 0) | (ways == new)) & alive
            events = sorted(
                (
                    self._locate(int(which), tuple(map(int, member)), early, late, states, inputs, new)
                    for which, *member in np.argwhere(crossed)
                ),
                key=lambda e: e.time,
            )
            stop = next((e for e in events if self._changes(e)), None)
            for e in events:  # what changes the motion at the same instant is met again when it goes on
                if stop is None or e is stop or (e.time <= stop.time and not self._changes(e)):
                    self._keep(e)
                    self.signs[(e.which, *e.member)] = 0 if e is stop else new[(e.which, *e.member)]
            if stop is not None:
                self.fresh = True
                return stop
            self.signs = np.where(new == 0, self.signs, new)
        return None

    def _changes(self, e: Crossing) -> bool:
        return e.ends or self.made.event_changes(e.which)

    def _keep(self, e: Crossing) -> None:
        self.found.append(e)
        place, gap = (e.which, *e.member), CLOSE * max(e.time, 1.0)
        if e.time - self.last.get(place, -np.inf) < gap or len(self.found) > MOST * max(int(np.prod(self.lead)), 1):
            raise UcritError(f"the event '{e.name}' happens over and over at {e.time:.6g} s, without time going on")
        self.last[place] = e.time

    def _locate(
        self, which: int, member: tuple[int, ...], a: float, b: float, states: Any, inputs: Any, new: Array
    ) -> Crossing:
        from scipy.optimize import brentq

        place = (which, *member)

        def value(t: float) -> float:
            return float(self._values(states(t), inputs(t))[place])

        t = (
            a
            if np.sign(value(a)) == new[place]
            else float(brentq(value, a, b, xtol=1e-14 * max(abs(b), 1e-3), rtol=1e-14))
        )
        at = states(t)[(slice(None), *member)].copy()
        return Crossing(self.names[which], which, member, t, at, self.made.event_ends[which])
