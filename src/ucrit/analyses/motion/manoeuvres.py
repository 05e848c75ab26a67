"""Shapes of inputs over time: steps, ramps, sines, pulses, gusts and tables, whose kinks are known exactly.

Sizes and times are numbers in SI units or texts with a unit. A shape is added to the input's value on the basic
motion, but for a table, which is the input itself. Shapes add up: ``Step("2 deg", at=1) + Step("-2 deg", at=3)``.
"""

from __future__ import annotations

import math
import os
from bisect import bisect_right
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

from ...core.contract.declare import Quantity
from ...core.errors import UcritError
from ...core.units import to_si

Value = float | str
Piece = Callable[[float], float]


@dataclass(frozen=True)
class Signal:
    """A function of time in smooth pieces: one more of them than there are breaks."""

    breaks: tuple[float, ...]
    pieces: tuple[Piece, ...]

    def piece(self, t: float) -> Piece:
        """Return the piece that holds at and just after a time."""
        return self.pieces[bisect_right(self.breaks, t)]

    def __call__(self, t: float) -> float:
        """Return the value at a time [s]; at a break that of the later piece."""
        return self.piece(t)(t)


def constant(value: float) -> Signal:
    """Return a signal that stays."""
    return Signal((), (lambda _: value,))


def total(signals: Sequence[Signal]) -> Signal:
    """Return the sum of signals."""
    breaks = tuple(sorted({b for signal in signals for b in signal.breaks}))
    starts = (-math.inf, *breaks)

    def piece(start: float) -> Piece:
        parts = [signal.piece(start) for signal in signals]
        return lambda t: sum(part(t) for part in parts)

    return Signal(breaks, tuple(piece(start) for start in starts))


class Shape:
    """Base of all shapes."""

    relative: ClassVar[bool] = True
    """Whether the shape is added to the input's value on the basic motion."""

    def signal(self, quantity: Quantity, thing: str, until: float) -> Signal:
        """Return the shape as a function of time for an input.

        Parameters
        ----------
        quantity
            The input, whose unit the sizes must fit.
        thing
            What it is, for error messages.
        until
            Last time [s] at which it is needed.
        """
        raise NotImplementedError

    def __add__(self, other: Shape) -> Shape:
        if not isinstance(other, Shape):
            return NotImplemented
        return Sum((*_parts(self), *_parts(other)))


@dataclass(frozen=True)
class Sum(Shape):
    """Shapes added up."""

    parts: tuple[Shape, ...]

    def signal(self, quantity: Quantity, thing: str, until: float) -> Signal:
        """Return the sum as a function of time."""
        for part in self.parts:
            if not part.relative:
                raise UcritError(f"{thing}: a table is the whole input, nothing can be added to it")
        return total([part.signal(quantity, thing, until) for part in self.parts])


def _parts(shape: Shape) -> tuple[Shape, ...]:
    return shape.parts if isinstance(shape, Sum) else (shape,)


@dataclass(frozen=True)
class Step(Shape):
    """A jump by ``size`` at a time.

    Examples
    --------
    >>> from ucrit import Step, load, simulate
    >>> car = load("understeering-car")
    >>> turned = simulate(car, 3, inputs={"delta_f": Step("1 deg", at=1)}, times=[0.5, 3])
    >>> [round(float(r), 4) for r in turned["r"]]
    [0.0, 0.0911]
    """

    size: Value
    at: Value = 0.0

    def signal(self, quantity: Quantity, thing: str, until: float) -> Signal:
        """Return the step as a function of time."""
        size, at = _size(self.size, quantity, thing), _time(self.at, "at", thing)
        return Signal((at,), (lambda _: 0.0, lambda _: size))


@dataclass(frozen=True)
class Ramp(Shape):
    """A straight rise to ``size`` that takes the time ``over``."""

    size: Value
    over: Value
    at: Value = 0.0

    def signal(self, quantity: Quantity, thing: str, until: float) -> Signal:
        """Return the ramp as a function of time."""
        size, at = _size(self.size, quantity, thing), _time(self.at, "at", thing)
        over = _time(self.over, "over", thing, above=0)
        return Signal((at, at + over), (lambda _: 0.0, lambda t: size * (t - at) / over, lambda _: size))


@dataclass(frozen=True)
class Sine(Shape):
    """A sine of an amplitude and a frequency, ``over`` a time or on and on."""

    size: Value
    frequency: Value
    at: Value = 0.0
    over: Value = math.inf

    def signal(self, quantity: Quantity, thing: str, until: float) -> Signal:
        """Return the sine as a function of time."""
        size, at = _size(self.size, quantity, thing), _time(self.at, "at", thing)
        omega = 2 * math.pi * _frequency(self.frequency, thing)
        wave: Piece = lambda t: size * math.sin(omega * (t - at))  # noqa: E731
        if self.over == math.inf:
            return Signal((at,), (lambda _: 0.0, wave))
        over = _time(self.over, "over", thing, above=0)
        return Signal((at, at + over), (lambda _: 0.0, wave, lambda _: 0.0))


@dataclass(frozen=True)
class SineWithDwell(Shape):
    """One period of a sine that is held at its second peak, by default for half a second (49 CFR 571.126, S7.9)."""

    size: Value
    frequency: Value = 0.7
    at: Value = 0.0
    dwell: Value = 0.5

    def signal(self, quantity: Quantity, thing: str, until: float) -> Signal:
        """Return the manoeuvre as a function of time."""
        size, (at, peak, left, _) = _size(self.size, quantity, thing), self.times(thing)
        omega, dwell = 2 * math.pi * _frequency(self.frequency, thing), left - peak
        return Signal(
            self.times(thing),
            (
                lambda _: 0.0,
                lambda t: size * math.sin(omega * (t - at)),
                lambda _: -size,
                lambda t: size * math.sin(omega * (t - at - dwell)),
                lambda _: 0.0,
            ),
        )

    def times(self, thing: str = "sine with dwell") -> tuple[float, float, float, float]:
        """Return when it begins, reaches and leaves its second peak, and is completed [s].

        Parameters
        ----------
        thing
            What it is, for error messages.
        """
        at, f = _time(self.at, "at", thing), _frequency(self.frequency, thing)
        dwell = _time(self.dwell, "hold", thing, above=0)
        return at, at + 0.75 / f, at + 0.75 / f + dwell, at + 1 / f + dwell


@dataclass(frozen=True)
class Pulse(Shape):
    """A rectangle: ``size`` for the time ``over``."""

    size: Value
    over: Value
    at: Value = 0.0

    def signal(self, quantity: Quantity, thing: str, until: float) -> Signal:
        """Return the pulse as a function of time."""
        size, at = _size(self.size, quantity, thing), _time(self.at, "at", thing)
        over = _time(self.over, "over", thing, above=0)
        return Signal((at, at + over), (lambda _: 0.0, lambda _: size, lambda _: 0.0))


@dataclass(frozen=True)
class Gust(Shape):
    """A smooth gust, ``size (1 - cos)/2`` over a time: the discrete gust of airworthiness codes (CS 25.341)."""

    size: Value
    over: Value
    at: Value = 0.0

    def signal(self, quantity: Quantity, thing: str, until: float) -> Signal:
        """Return the gust as a function of time."""
        size, at = _size(self.size, quantity, thing), _time(self.at, "at", thing)
        over = _time(self.over, "over", thing, above=0)
        rise: Piece = lambda t: size * (1 - math.cos(2 * math.pi * (t - at) / over)) / 2  # noqa: E731
        return Signal((at, at + over), (lambda _: 0.0, rise, lambda _: 0.0))


@dataclass(frozen=True)
class Measured(Shape):
    """Values at times in a CSV file, joined by straight lines.

    Lines that begin with ``#`` are remarks. The first other line heads the columns, each with its unit:
    ``time [s],delta_f [deg]``. The column of the input's name is taken, or the one named by ``column``. The table must
    cover the whole motion.
    """

    path: str | os.PathLike[str]
    column: str = ""

    relative: ClassVar[bool] = False

    def signal(self, quantity: Quantity, thing: str, until: float) -> Signal:
        """Return the table as a function of time."""
        from .tables import read_columns

        times, values = read_columns(self.path, self.column or quantity.name, quantity.unit)
        if times[0] > 0 or times[-1] < until:
            raise UcritError(
                f"{thing}: '{self.path}' must cover 0 s to {until:g} s, it goes from {times[0]:g} s to {times[-1]:g} s"
            )

        def between(i: int) -> Piece:
            t_0, y_0 = times[i], values[i]
            slope = (values[i + 1] - y_0) / (times[i + 1] - t_0)
            return lambda t: y_0 + slope * (t - t_0)

        lines = [between(i) for i in range(len(times) - 1)]
        return Signal(tuple(times[1:-1]), tuple(lines))


def _size(value: Any, quantity: Quantity, thing: str) -> float:
    return _finite(value, quantity.unit, f"{thing}: size")


def _time(value: Any, word: str, thing: str, above: float | None = None) -> float:
    name = {"at": "start", "over": "duration", "hold": "dwell"}[word]
    number = _finite(value, "s", f"{thing}: {name}")
    if number < 0 or (above is not None and number <= above):
        raise UcritError(
            f"{thing}: {name} must be {'above' if above is not None else 'at least'} 0 s, got {number:g} s"
        )
    return number


def _frequency(value: Any, thing: str) -> float:
    number = _finite(value, "Hz", f"{thing}: frequency")
    if number <= 0:
        raise UcritError(f"{thing}: frequency must be above 0 Hz, got {number:g} Hz")
    return number


def _finite(value: Any, unit: str, thing: str) -> float:
    number = to_si(value.item() if hasattr(value, "item") else value, unit, thing)
    if not math.isfinite(number):
        raise UcritError(f"{thing} must be finite, got {number:g}")
    return number
