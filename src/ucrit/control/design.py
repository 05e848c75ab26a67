"""Design: vehicles closed by gains that are computed, and kept as parameters of the vehicle under control."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from ..core.contract.model import Model
from ..core.errors import UcritError
from ..core.numeric.compiled import state_space
from .actuators import input_of
from .closed import close
from .copies import parameter_values, state_names
from .feedback import (
    HAT,
    checked_measured,
    gain_name,
    observed,
    observer_gain,
    observing,
    state_feedback,
)
from .gains import checked_poles, place_gains, regulator_gains, weights

Array = npt.NDArray[Any]


def place(vehicle: Model, inputs: str | Sequence[str], poles: Any, *, estimated: bool = False) -> Model:
    """Return the vehicle under state feedback that gives it the poles asked for.

    Parameters
    ----------
    vehicle
        With scalar parameters.
    inputs
        One or several inputs that are driven. With several, the gains that make the poles least sensitive are taken
        (J. Kautsky, N. K. Nichols, P. Van Dooren, Int. J. Control 41 (1985) 1129-1155).
    poles
        As many as there are states [1/s], complex ones with their conjugates.
    estimated
        Whether to feed back the estimates of the observer that was added last.

    Returns
    -------
    Model
        Whose gains ``K_<input>_<state>`` are parameters: they can be swept, mapped and remedied.

    Raises
    ------
    UcritError
        If a motion cannot be moved by these inputs (it is named), or the poles are not possible.

    Examples
    --------
    >>> from ucrit import load, modes
    >>> from ucrit.control import place
    >>> car = load("oversteering-car")
    >>> modes(place(car, "delta_r", [-4 + 3j, -4 - 3j])).eigenvalues.round(6).tolist()
    [(-4+3j), (-4-3j)]
    """
    names, A, B, labels = _wanted(vehicle, inputs, estimated)
    K = place_gains(A, B, checked_poles(poles, labels), labels, f"{' and '.join(names)} cannot move")
    return _fed_back(vehicle, names, labels, K, estimated)


def lqr(vehicle: Model, inputs: str | Sequence[str], Q: Any, R: Any, *, estimated: bool = False) -> Model:
    """Return the vehicle under the state feedback of least quadratic cost.

    Parameters
    ----------
    vehicle
        With scalar parameters.
    inputs
        One or several inputs that are driven.
    Q
        Weights of squared states: a matrix, its diagonal, or numbers by state; those not named have none.
    R
        Weights of squared inputs: a matrix, its diagonal, one number, or numbers by input.
    estimated
        Whether to feed back the estimates of the observer that was added last.

    Returns
    -------
    Model
        Whose gains ``K_<input>_<state>`` are parameters.

    Raises
    ------
    UcritError
        If a weight is not allowed or an unstable motion cannot be moved (it is named).

    Examples
    --------
    >>> from ucrit import load, verdict
    >>> from ucrit.control import lqr
    >>> verdict(lqr(load("motorcycle-lean"), "delta_r", {"theta": 1}, 1)).stable
    True
    """
    names, A, B, labels = _wanted(vehicle, inputs, estimated)
    K = regulator_gains(
        A, B, weights(Q, labels, "Q", False), weights(R, names, "R", True), labels, f"{' and '.join(names)} cannot move"
    )
    return _fed_back(vehicle, names, labels, K, estimated)


def observer(
    vehicle: Model,
    measured: str | Sequence[str],
    poles: Any,
    *,
    own: Sequence[str] = (),
    unknown: Sequence[str] = (),
) -> Model:
    """Return the vehicle with an observer, whose errors decay by the poles asked for.

    Parameters
    ----------
    vehicle
        With scalar parameters.
    measured
        States or outputs, by name, that sensors give.
    poles
        As many as there are states [1/s], complex ones with their conjugates.
    own
        Parameters that the observer has values of its own for; see `observing`.
    unknown
        Inputs that it does not know: disturbances.

    Returns
    -------
    Model
        With the states ``<state>_hat``, for feedback by `place` and `lqr` with ``estimated=True``.

    Raises
    ------
    UcritError
        If a motion cannot be seen in what is measured (it is named), or the poles are not possible.

    Examples
    --------
    >>> from ucrit import load, modes
    >>> from ucrit.control import observer, place
    >>> motorcycle = observer(load("motorcycle-lean"), "theta", [-12, -14])
    >>> ridden = place(motorcycle, "delta_r", [-3, -4], estimated=True)
    >>> sorted(modes(ridden).eigenvalues.real.round(6).tolist())
    [-14.0, -12.0, -4.0, -3.0]
    """
    names, A, C, labels = _seen(vehicle, measured)
    doing = _does_not_show(names)
    L = place_gains(A.T, C.T, checked_poles(poles, labels), labels, doing).T
    return _with_observer(vehicle, names, labels, L, own, unknown)


def kalman(
    vehicle: Model,
    measured: str | Sequence[str],
    process: Any,
    noise: Any,
    *,
    own: Sequence[str] = (),
    unknown: Sequence[str] = (),
) -> Model:
    """Return the vehicle with the observer of least variance; with `lqr` of its estimates it makes an LQG controller.

    Parameters
    ----------
    vehicle
        With scalar parameters.
    measured
        States or outputs, by name, that sensors give.
    process
        Spectral density of the disturbances of the states' rates: a matrix, its diagonal, or numbers by state.
    noise
        That of the sensors' noise: a matrix, its diagonal, one number, or numbers by measured quantity.
    own
        Parameters that the observer has values of its own for; see `observing`.
    unknown
        Inputs that it does not know: disturbances.

    Returns
    -------
    Model
        With the states ``<state>_hat``.

    Raises
    ------
    UcritError
        If a density is not allowed or an unstable motion cannot be seen (it is named).
    """
    names, A, C, labels = _seen(vehicle, measured)
    W, V = weights(process, labels, "process", False), weights(noise, names, "noise", True)
    L = regulator_gains(A.T, C.T, W, V, labels, _does_not_show(names)).T
    return _with_observer(vehicle, names, labels, L, own, unknown)


def _wanted(vehicle: Model, inputs: Any, estimated: bool) -> tuple[tuple[str, ...], Array, Array, list[str]]:
    """Return the inputs, A and B of what feedback shall move, and its states."""
    _refuse_arrays(vehicle)
    try:
        names = (inputs,) if isinstance(inputs, str) else tuple(inputs)
    except TypeError:
        raise UcritError(f"inputs must be a name or a list of names, got {inputs!r}") from None
    for name in names:
        input_of(vehicle, name)
    if not names:
        raise UcritError("name at least one input that is driven")
    of = type(vehicle)
    if estimated:
        of, _ = observed(of)
    A, B, _, _ = state_space(of(**{name: vehicle.values[name] for name in of.declaration.parameters}))
    columns = [list(of.declaration.inputs).index(name) for name in names]
    return names, A, B[:, columns], list(state_names(of))


def _seen(vehicle: Model, measured: Any) -> tuple[tuple[str, ...], Array, Array, list[str]]:
    """Return what is measured, A and C, and the states."""
    _refuse_arrays(vehicle)
    names = checked_measured(type(vehicle), measured)
    labels = list(state_names(type(vehicle)))
    A, _, C, _ = state_space(vehicle)
    every = dict(zip(type(vehicle).declaration.outputs, C, strict=True))
    every |= dict(zip(labels, np.eye(len(labels)), strict=True))
    return names, A, np.array([every[name] for name in names]), labels


def _does_not_show(names: Sequence[str]) -> str:
    return f"{' and '.join(names)} {'does' if len(names) == 1 else 'do'} not show"


def _refuse_arrays(vehicle: Model) -> None:
    if vehicle.dims:
        raise UcritError(f"gains are those of one vehicle: give one value each for {', '.join(vehicle.dims)}")


def _fed_back(vehicle: Model, names: Sequence[str], labels: list[str], K: Array, estimated: bool) -> Model:
    law = state_feedback(vehicle, *names, estimated=estimated)
    gains = {gain_name(n, label): float(K[i, j]) for i, n in enumerate(names) for j, label in enumerate(labels)}
    return close(vehicle, law, **gains)


def _with_observer(
    vehicle: Model, names: Sequence[str], labels: list[str], L: Array, own: Sequence[str], unknown: Sequence[str]
) -> Model:
    law = observing(vehicle, *names, own=own, unknown=unknown)
    gains = {observer_gain(s, n): float(L[i, j]) for i, s in enumerate(labels) for j, n in enumerate(names)}
    return close(vehicle, law, **gains, **parameter_values(vehicle, own, HAT))
