"""How a linear vehicle answers its inputs: frequency response, and responses in time to a step and an impulse."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt

from ..core.compiled import labels, state_space
from ..core.errors import UcritError, near_match
from ..core.model import Model
from .convert import Series, Table, Tabular, complex_series, unit_of
from .modes import modes

Array = npt.NDArray[Any]

POINTS = 400
"""Points of a time or frequency axis that is not given."""


@dataclass(frozen=True)
class _Response(Tabular):
    """What all responses have: leading dimensions of ``values`` are the vehicle's, then the axis, then outputs."""

    vehicle: Model
    input: str
    outputs: tuple[str, ...]
    units: tuple[str, ...]

    @property
    def _axis(self) -> Series:
        raise NotImplementedError

    def _series(self) -> tuple[Series, ...]:
        raise NotImplementedError

    def _place(self, output: str) -> int:
        if output not in self.outputs:
            raise UcritError(f"the response has no output '{output}'{near_match(output, self.outputs)}")
        return self.outputs.index(output)

    def table(self) -> Table:
        """Return the response of each output over the axis, with units."""
        coords = [Series(name, (name,), x, unit_of(self.vehicle, name)) for name, x in self.vehicle.dims.items()]
        axis = self._axis
        return Table(self._title, self.vehicle, (*coords, axis), self._series(), (*self.vehicle.dims, axis.name))

    @property
    def _title(self) -> str:
        return "response"


@dataclass(frozen=True)
class FrequencyResponse(_Response):
    """Steady response to sines of one input.

    Attributes
    ----------
    frequencies
        [Hz], shape (F,).
    values
        Complex amplitude of each output per unit of the input, shape (..., F, outputs).
    stable
        Whether the vehicle is stable, shape (...): only then does a steady response set in.
    """

    frequencies: Array
    values: Array
    stable: Array

    def __getitem__(self, output: str) -> Array:
        """Return the complex response of one output, shape (..., F)."""
        return np.asarray(self.values[..., self._place(output)])

    def gain(self, output: str) -> Array:
        """Return the amplitude of an output per unit of the input, shape (..., F)."""
        return np.asarray(np.abs(self[output]))

    def gain_db(self, output: str) -> Array:
        """Return the amplitude in decibels (20 log10 of the gain in SI units), shape (..., F)."""
        with np.errstate(divide="ignore"):
            return np.asarray(20 * np.log10(self.gain(output)))

    def phase_deg(self, output: str) -> Array:
        """Return the phase [deg] without jumps along the frequencies, shape (..., F)."""
        return np.asarray(np.rad2deg(np.unwrap(np.angle(self[output]), axis=-1)))

    def peak(self, output: str) -> tuple[Array, Array]:
        """Return frequency [Hz] and size of the largest gain among the given frequencies, shapes (...)."""
        gain = self.gain(output)
        at = gain.argmax(axis=-1)
        return self.frequencies[at], np.take_along_axis(gain, at[..., None], axis=-1)[..., 0]

    @property
    def _axis(self) -> Series:
        return Series("frequency", ("frequency",), self.frequencies, "Hz")

    def _series(self) -> tuple[Series, ...]:
        dims = (*self.vehicle.dims, "frequency")
        per = type(self.vehicle).declaration.inputs[self.input].unit
        pairs = (
            complex_series(name, dims, self[name], unit if per == "1" else f"({unit})/({per})")
            for name, unit in zip(self.outputs, self.units, strict=True)
        )
        return tuple(series for pair in pairs for series in pair)

    @property
    def _title(self) -> str:
        return f"frequency response to {self.input}"


@dataclass(frozen=True)
class TimeResponse(_Response):
    """Response in time to a step or an impulse of one input, from the basic motion.

    Attributes
    ----------
    kind
        ``"step"`` or ``"impulse"``.
    times
        [s], shape (T,).
    values
        Outputs, shape (..., T, outputs), for an input of size ``size``.
    direct
        For an impulse, the weight of the impulse that passes straight to each output and is left out of
        ``values``, shape (..., outputs); for a step zeros.
    final
        What the outputs of a stable vehicle tend to, nan for others, shape (..., outputs).
    """

    kind: str
    size: float
    times: Array
    values: Array
    direct: Array
    final: Array

    def __getitem__(self, output: str) -> Array:
        """Return one output over time, shape (..., T)."""
        return np.asarray(self.values[..., self._place(output)])

    def overshoot(self, output: str) -> Array:
        """Return by how much a step response exceeds its final value at most, as a share of it, shape (...)."""
        final = self.final[..., self._place(output)]
        with np.errstate(all="ignore"):
            return np.asarray(np.maximum((self[output] / final[..., None]).max(axis=-1) - 1, 0))

    def starts_opposite(self, output: str) -> Array:
        """Return whether a response first goes against its final value, shape (...)."""
        values, final = self[output], self.final[..., self._place(output)]
        moved = np.abs(values) > 1e-9 * np.abs(values).max(axis=-1, keepdims=True)
        first = np.take_along_axis(values, moved.argmax(axis=-1)[..., None], axis=-1)[..., 0]
        return np.asarray(first * final < 0)

    @property
    def _axis(self) -> Series:
        return Series("time", ("time",), self.times, "s")

    def _series(self) -> tuple[Series, ...]:
        dims = (*self.vehicle.dims, "time")
        return tuple(Series(name, dims, self[name], unit) for name, unit in zip(self.outputs, self.units, strict=True))

    @property
    def _title(self) -> str:
        return f"{self.kind} response to {self.input}"


@dataclass(frozen=True)
class _Chosen:
    """State equations reduced to one input and the outputs asked for."""

    A: Array
    B: Array
    C: Array
    D: Array
    outputs: tuple[str, ...]
    units: tuple[str, ...]

    @cached_property
    def growth(self) -> Array:
        return np.asarray(np.linalg.eigvals(self.A).real.max(axis=-1))


def _choose(vehicle: Model, input: str, outputs: str | Sequence[str] | None) -> _Chosen:
    declared, states = type(vehicle).declaration, labels(vehicle)
    model = type(vehicle).model_id()
    if input not in declared.inputs:
        raise UcritError(f"{model}: there is no input '{input}'{near_match(input, declared.inputs)}")
    known = {label: declared.variables[label.rstrip("'")].state_unit(label.count("'")) for label in states}
    known |= {name: output.unit for name, output in declared.outputs.items()}
    names = tuple(known) if outputs is None else (outputs,) if isinstance(outputs, str) else tuple(outputs)
    for name in names:
        if name not in known:
            raise UcritError(f"{model}: there is no output '{name}'{near_match(name, known)}")
    A, B, C, D = state_space(vehicle)
    column = list(declared.inputs).index(input)
    eye = np.broadcast_to(np.eye(len(states)), A.shape)
    rows = [list(known).index(name) for name in names]
    C_all = np.concatenate([eye, C], axis=-2)[..., rows, :]
    D_all = np.concatenate([np.zeros_like(B), D], axis=-2)[..., rows, column]
    return _Chosen(A, B[..., column], C_all, D_all, names, tuple(known[name] for name in names))


def frequency_response(
    vehicle: Model, input: str, outputs: str | Sequence[str] | None = None, frequencies: Any = None
) -> FrequencyResponse:
    """Return the complex response of outputs to sines of one input.

    Parameters
    ----------
    vehicle
        Its array parameters span leading dimensions.
    input
        Name of an input.
    outputs
        Names of states and declared outputs; all by default.
    frequencies
        [Hz], above 0; by default 400 of them spread over the vehicle's own.

    Returns
    -------
    FrequencyResponse
        Solutions of ``(j omega - A) x = B``, which need no stable vehicle but describe its motion only then.

    Raises
    ------
    UcritError
        If there is no such input or output, or a frequency is not above 0 Hz.

    Examples
    --------
    >>> from ucrit import load
    >>> response = frequency_response(load("understeering-car"), "delta_f", "r", [0.1, 1.0])
    >>> [round(float(g), 3) for g in response.gain("r")]
    [5.253, 5.284]
    """
    chosen = _choose(vehicle, input, outputs)
    f = np.atleast_1d(_axis(vehicle, "frequencies", frequencies, _frequencies))
    if f.ndim != 1 or not np.all(np.isfinite(f) & (f > 0)):
        raise UcritError("frequencies must be a list of finite numbers above 0 Hz")
    s = 2j * np.pi * f[:, None, None]
    n = chosen.A.shape[-1]
    x = np.linalg.solve(s * np.eye(n) - chosen.A[..., None, :, :], chosen.B[..., None, :, None])
    values = (chosen.C[..., None, :, :] @ x)[..., 0] + chosen.D[..., None, :]
    return FrequencyResponse(vehicle, input, chosen.outputs, chosen.units, f, values, chosen.growth < 0)


def step_response(
    vehicle: Model, input: str, outputs: str | Sequence[str] | None = None, times: Any = None, *, size: float = 1.0
) -> TimeResponse:
    """Return the response in time of outputs to a step of one input at time 0.

    Parameters
    ----------
    vehicle
        Its array parameters span leading dimensions.
    input
        Name of an input.
    outputs
        Names of states and declared outputs; all by default.
    times
        [s], not below 0; by default 400 from 0 until the slowest motion has died out (or grown tenfold).
    size
        Height of the step in the input's unit. The response is linear in it.

    Returns
    -------
    TimeResponse
        Exact up to rounding at each time: a matrix exponential each, which defective matrices do not disturb.

    Raises
    ------
    UcritError
        If there is no such input or output, or a time is below 0 s.

    Examples
    --------
    >>> from ucrit import load
    >>> step = step_response(load("understeering-car"), "delta_r", "a_y")
    >>> bool(step.starts_opposite("a_y"))
    True
    """
    return _in_time(vehicle, input, outputs, times, size, "step")


def impulse_response(
    vehicle: Model, input: str, outputs: str | Sequence[str] | None = None, times: Any = None, *, size: float = 1.0
) -> TimeResponse:
    """Return the response in time of outputs to an impulse of one input at time 0, of ``size`` in input unit times s.

    Arguments, result and errors are those of `step_response`.

    Examples
    --------
    >>> from ucrit import load
    >>> kick = impulse_response(load("understeering-car"), "delta_f", "r", [0.0])
    >>> round(float(kick["r"][0]), 6) == round(1.25 * 75e3 / 2500, 6)
    True
    """
    return _in_time(vehicle, input, outputs, times, size, "impulse")


def _in_time(vehicle: Model, input: str, outputs: Any, times: Any, size: float, kind: str) -> TimeResponse:
    from scipy.linalg import expm

    chosen = _choose(vehicle, input, outputs)
    t = np.atleast_1d(_axis(vehicle, "times", times, _times))
    if t.ndim != 1 or not np.all(np.isfinite(t) & (t >= 0)):
        raise UcritError("times must be a list of finite numbers not below 0 s")
    n = chosen.A.shape[-1]
    joined = np.zeros((*chosen.A.shape[:-2], n + 1, n + 1))
    joined[..., :n, :n], joined[..., :n, n] = chosen.A, chosen.B
    flow = expm(joined[..., None, :, :] * t[:, None, None])
    x = flow[..., :n, n] if kind == "step" else (flow[..., :n, :n] @ chosen.B[..., None, :, None])[..., 0]
    values = (chosen.C[..., None, :, :] @ x[..., None])[..., 0]
    direct = np.zeros_like(chosen.D) if kind == "step" else chosen.D
    if kind == "step":
        values = values + chosen.D[..., None, :]
    final = _final(chosen) if kind == "step" else np.where((chosen.growth < 0)[..., None], 0.0, np.nan)
    final = np.broadcast_to(final, chosen.D.shape)
    return TimeResponse(
        vehicle, input, chosen.outputs, chosen.units, kind, size, t, size * values, size * direct, size * final
    )


def _final(chosen: _Chosen) -> Array:
    settles = chosen.growth < 0
    safe = np.where(settles[..., None, None], chosen.A, -np.eye(chosen.A.shape[-1]))
    x = -np.linalg.solve(safe, chosen.B[..., None])
    return np.asarray(np.where(settles[..., None], (chosen.C @ x)[..., 0] + chosen.D, np.nan))


def _axis(vehicle: Model, name: str, given: Any, default: Any) -> Array:
    try:
        return np.asarray(default(vehicle) if given is None else given, dtype=float)
    except (TypeError, ValueError):
        raise UcritError(f"{name} must be a list of numbers, got {given!r}") from None


def _speeds(vehicle: Model) -> Array:
    """Absolute values [1/s] of the vehicle's nonzero eigenvalues."""
    size = np.abs(modes(vehicle).eigenvalues)
    return size[size > 0] if np.any(size > 0) else np.ones(1)


def _frequencies(vehicle: Model) -> Array:
    size = _speeds(vehicle) / (2 * np.pi)
    return np.asarray(np.geomspace(size.min() / 30, size.max() * 30, POINTS))


def _times(vehicle: Model) -> Array:
    """Until the slowest decay has come to a ten-thousandth, or the fastest growth to the tenfold."""
    real = np.unique(modes(vehicle).eigenvalues.real)
    growing, decaying = real[real > 0], real[real < 0]
    if growing.size:
        end = np.log(10) / growing.max()
    elif decaying.size:
        end = min(np.log(1e4) / -decaying.max(), 1e3 / _speeds(vehicle).max())
    else:
        end = 30 / _speeds(vehicle).max()
    return np.linspace(0, end, POINTS)


__all__ = ["FrequencyResponse", "TimeResponse", "frequency_response", "impulse_response", "step_response"]
