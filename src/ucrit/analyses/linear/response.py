"""How a linear vehicle answers its inputs: over frequencies, and in time to a step and an impulse."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ...core.errors import UcritError, near_match
from ...core.numeric.compiled import labels, state_space
from ...core.numeric.reach import unusable
from ...numerics.exponential import expm
from .modes import modes
from .response_results import FrequencyResponse, TimeResponse

Array = npt.NDArray[Any]

POINTS = 400
"""Points of a time or frequency axis that is not given."""


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
    if not all(np.isfinite(block).all() for block in (A, B, C, D)):
        raise unusable(vehicle)
    column = list(declared.inputs).index(input)
    eye = np.broadcast_to(np.eye(len(states)), A.shape)
    rows = [list(known).index(name) for name in names]
    C_all = np.concatenate([eye, C], axis=-2)[..., rows, :]
    D_all = np.concatenate([np.zeros_like(B), D], axis=-2)[..., rows, column]
    return _Chosen(A, B[..., column], C_all, D_all, names, tuple(known[name] for name in names))


def frequency_response(
    vehicle: Model,
    input: str,
    outputs: str | Sequence[str] | None = None,
    frequencies: Sequence[float] | Array | None = None,
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
    [5.26, 5.464]
    """
    chosen = _choose(vehicle, input, outputs)
    f = np.atleast_1d(_axis(vehicle, "frequencies", frequencies, _frequencies))
    if f.ndim != 1 or not np.all(np.isfinite(f) & (f > 0)):
        raise UcritError("frequencies must be a list of finite numbers above 0 Hz")
    n = chosen.A.shape[-1]
    with np.errstate(all="ignore"):
        s = 2j * np.pi * f[:, None, None]
        x = np.linalg.solve(s * np.eye(n) - chosen.A[..., None, :, :], chosen.B[..., None, :, None])
        values = (chosen.C[..., None, :, :] @ x)[..., 0] + chosen.D[..., None, :]
    _refuse_beyond(np.isfinite(values), f, "Hz", vehicle)
    return FrequencyResponse(vehicle, input, chosen.outputs, chosen.units, f, values, chosen.growth < 0)


def step_response(
    vehicle: Model,
    input: str,
    outputs: str | Sequence[str] | None = None,
    times: Sequence[float] | Array | None = None,
    *,
    size: float = 1.0,
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
    vehicle: Model,
    input: str,
    outputs: str | Sequence[str] | None = None,
    times: Sequence[float] | Array | None = None,
    *,
    size: float = 1.0,
) -> TimeResponse:
    """Return the response in time of outputs to an impulse of one input at time 0.

    Parameters
    ----------
    vehicle, input, outputs, times
        As those of `step_response`, and so are result and errors.
    size
        Area of the impulse, in the input's unit times s.

    Examples
    --------
    >>> from ucrit import load
    >>> kick = impulse_response(load("understeering-car"), "delta_f", "r", [0.0])
    >>> round(float(kick["r"][0]), 6) == round(1.25 * 75e3 / 2500, 6)
    True
    """
    return _in_time(vehicle, input, outputs, times, size, "impulse")


def _in_time(vehicle: Model, input: str, outputs: Any, times: Any, size: float, kind: str) -> TimeResponse:
    chosen = _choose(vehicle, input, outputs)
    t = np.atleast_1d(_axis(vehicle, "times", times, _times))
    if t.ndim != 1 or not np.all(np.isfinite(t) & (t >= 0)):
        raise UcritError("times must be a list of finite numbers not below 0 s")
    if not np.isfinite(size):
        raise UcritError(f"size must be a finite number, got {size!r}")
    n = chosen.A.shape[-1]
    joined = np.zeros((*chosen.A.shape[:-2], n + 1, n + 1))
    joined[..., :n, :n], joined[..., :n, n] = chosen.A, chosen.B
    with np.errstate(all="ignore"):
        flow = expm(joined[..., None, :, :] * t[:, None, None])
        x = flow[..., :n, n] if kind == "step" else (flow[..., :n, :n] @ chosen.B[..., None, :, None])[..., 0]
        values = (chosen.C[..., None, :, :] @ x[..., None])[..., 0]
        direct = np.zeros_like(chosen.D) if kind == "step" else chosen.D
        if kind == "step":
            values = values + chosen.D[..., None, :]
        values, direct = size * values, size * direct
        final = _final(chosen) if kind == "step" else np.where((chosen.growth < 0)[..., None], 0.0, np.nan)
        final = size * np.broadcast_to(final, chosen.D.shape)
    told = np.isfinite(direct) & ~np.isinf(final)
    _refuse_beyond(np.isfinite(values) & told[..., None, :], t, "s", vehicle)
    return TimeResponse(
        vehicle,
        input,
        chosen.outputs,
        chosen.units,
        kind,
        size,
        t,
        values,
        direct,
        final,
    )


def _refuse_beyond(finite: Array, axis: Array, unit: str, vehicle: Model) -> None:
    """Refuse a response that is not finite; the axis is the last but one of ``finite``."""
    if not finite.all():
        whole = finite.all(axis=tuple(k for k in range(finite.ndim) if k != finite.ndim - 2))
        raise UcritError(
            f"{type(vehicle).model_id()}: the response at {axis[~whole][0]:g} {unit} is beyond the range of double "
            "numbers, 1e308"
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
