"""Motion of a controlled vehicle whose loop is delayed, exactly: by the method of steps."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import numpy.typing as npt
from numpy.polynomial import chebyshev

from ..control import broken
from ..core.errors import UcritError
from ..core.model import Model
from ..core.motion import motion
from ..core.units import to_si
from .simulate import POINTS, simulate
from .simulation import Simulation

Array = npt.NDArray[Any]

DEGREES = (16, 32, 64, 128, 256, 512)
"""Degrees tried for the polynomial that keeps what came back during one delay."""

KEPT = 1e-9
"""Share of the largest coefficient below which the last ones must be."""

MOST = 10_000
"""Delays that one simulation may last."""


def simulate_delayed(
    vehicle: Model,
    input: str,
    delay: float | str,
    until: float | str,
    initial: Mapping[str, float | str] | None = None,
    inputs: Mapping[str, float | str | Callable[[float], float]] | None = None,
    *,
    times: Any = None,
    tolerance: float = 1e-10,
) -> Simulation:
    """Follow the non-linear motion of a vehicle under control, what reaches one input being late.

    Parameters
    ----------
    vehicle
        Under control, with scalar parameters.
    input
        Input of the vehicle that a controller drives.
    delay
        How late it is [s, or text with a unit]. Before time 0 the vehicle was in its basic motion.
    until
        Last time [s, or text with a unit].
    initial, inputs
        As for `simulate`.
    times
        Times of the result [s]; by default 400 from 0 to the last.
    tolerance
        Relative error of each step.

    Returns
    -------
    Simulation
        Of the vehicle with its loop cut: the input ``<input>_cut`` is what the output ``<input>_return`` was one delay
        before. During each delay that is a known function of time, kept as a Chebyshev polynomial (method of steps;
        R. D. Driver, Ordinary and Delay Differential Equations (1977), chapter V).

    Raises
    ------
    UcritError
        If no controller drives the input, or a number is not allowed; see also `simulate`.

    Examples
    --------
    >>> from ucrit import load
    >>> ridden = load("motorcycle-steered-to-lean")
    >>> late = simulate_delayed(ridden, "delta_f", 0.2, 1, {"theta": 0.01}, times=[0.1, 1.0])
    >>> bool(abs(late["theta"][1]) > 0.01)
    True
    """
    cut = broken(type(vehicle), input)
    late, last = to_si(delay, "s", "delay"), to_si(until, "s", "time until")
    if not late > 0 or last / late > MOST:
        raise UcritError(f"the delay must be above 0 s and above {last / MOST:g} s for {last:g} s, got {late:g} s")
    subject = cut(**{name: vehicle.values[name] for name in cut.declaration.parameters})
    at = np.linspace(0, last, POINTS) if times is None else np.atleast_1d(np.asarray(times, dtype=float))
    steady = motion(cut).basic(subject.arguments())[1][list(cut.declaration.inputs).index(f"{input}_cut")]
    before: Callable[[float], float] = lambda _: float(steady)  # noqa: E731
    state, pieces = dict(initial or {}), []
    for k in range(int(np.ceil(last / late - 1e-9))):
        start, end = k * late, min((k + 1) * late, last)
        drive: dict[str, Any] = {name: _later(value, start) for name, value in (inputs or {}).items()}
        wanted = at[(at >= start) & ((at < end) | (end == last))] - start
        piece, before = _stepped(
            subject, input, state, {**drive, f"{input}_cut": before}, end - start, late, wanted, tolerance
        )
        state = dict(zip(piece.states, piece.values[-1].tolist(), strict=True))
        chosen = np.isin(piece.times, wanted)
        pieces.append((start + piece.times[chosen], *(v[chosen] for v in _arrays(piece))))
    joined = [np.concatenate(parts) for parts in zip(*pieces, strict=True)]
    return replace(
        piece, vehicle=subject, times=joined[0], values=joined[1], output_values=joined[2], input_values=joined[3]
    )


def _arrays(piece: Simulation) -> tuple[Array, Array, Array]:
    return piece.values, piece.output_values, piece.input_values


def _later(value: Any, start: float) -> Any:
    return (lambda t: value(t + start)) if callable(value) else value


def _stepped(
    subject: Model,
    input: str,
    state: Mapping[str, Any],
    drive: Mapping[str, Any],
    length: float,
    late: float,
    wanted: Array,
    tolerance: float,
) -> tuple[Simulation, Callable[[float], float]]:
    """Follow the motion for one delay; return it and what came back meanwhile as a function of time."""
    for degree in DEGREES:
        nodes = (1 - np.cos(np.pi * (np.arange(degree + 1) + 0.5) / (degree + 1))) / 2 * length
        at = np.unique(np.concatenate([nodes, wanted, [length]]))
        found = simulate(subject, length, state, drive, times=at, tolerance=tolerance)
        returned = found[f"{input}_return"][np.searchsorted(at, nodes)]
        coefficients = chebyshev.chebfit(2 * nodes / length - 1, returned, degree)
        if np.abs(coefficients[-3:]).max() <= KEPT * max(np.abs(coefficients).max(), 1e-12):
            break
    return found, lambda t: float(chebyshev.chebval(2 * t / length - 1, coefficients))
