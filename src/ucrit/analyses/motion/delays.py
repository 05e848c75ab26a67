"""Motion with delays as they are: inputs that are what a state or an output was some time before."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from ...control import broken, driven
from ...control.late import Late, exactly_delayed
from ...core.contract.model import Model
from ...core.errors import UcritError, near_match
from ...core.numeric.motion import motion
from ...core.units import to_si
from .late import LateInput
from .simulate import followed
from .simulation import Simulation

MOST = 10_000
"""Delays that one simulation may last."""

Given = float | str | tuple[str, float | str]


def simulate_delayed(
    vehicle: Model,
    late: Mapping[str, Given],
    until: float | str,
    initial: Mapping[str, Any] | None = None,
    inputs: Mapping[str, Any] | None = None,
    *,
    before: Mapping[str, float | str | Callable[[float], float]] | None = None,
    times: Sequence[float] | npt.NDArray[Any] | None = None,
    tolerance: float | None = None,
    method: str = "auto",
) -> Simulation:
    """Follow the non-linear motion of a vehicle some of whose inputs come late.

    Parameters
    ----------
    vehicle
        With scalar parameters.
    late
        Delays [s, or text with a unit] by input. ``{"delta_f": 0.1}`` for an input of the vehicle that a controller
        drives: what the controller asks for reaches the vehicle that much later. ``{"theta_seen": ("theta", 0.1)}`` for
        an input that is what a state or output was: a sensor.
    until
        Last time [s, or text with a unit].
    initial, inputs
        As for `simulate`.
    before
        What late inputs were before time 0, by input: a number, text with a unit, or a function of the (negative) time
        of what is delayed. By default that of the basic motion.
    times, tolerance, method
        As for `simulate`.

    Returns
    -------
    Simulation
        For a driven input the loop is cut: the input ``<input>_cut`` is what the output ``<input>_return`` was one
        delay before. Delays among the vehicle's own controllers are exact too.

    Raises
    ------
    UcritError
        If no controller drives the input, a name or a unit is wrong, or a number is not allowed; see also `simulate`.

    Examples
    --------
    >>> from ucrit import load
    >>> ridden = load("motorcycle-steered-to-lean")
    >>> slow = simulate_delayed(ridden, {"delta_f": 0.2}, 1, {"theta": 0.01}, times=[0.1, 1.0])
    >>> bool(abs(slow["theta"][1]) > 0.01)
    True
    """
    given: dict[str, tuple[str, Any]] = {}
    model = type(vehicle)
    for name, value in late.items():
        if isinstance(value, tuple):
            if len(value) != 2:
                raise UcritError(f"late {name}: give a quantity and a delay, as in ('theta', 0.1), got {value!r}")
            given[name] = (str(value[0]), value[1])
        else:
            model = broken(model, _known(vehicle, name))
            given[f"{name}_cut"] = (f"{name}_return", value)
    subject = model(**{name: vehicle.values[name] for name in model.declaration.parameters})
    subject.__dict__["info"] = vehicle.info
    exact, own = exactly_delayed(model)
    subject, found = with_exact_delays(subject, exact, own)
    past = {f"{name}_cut" if name in late and f"{name}_cut" in given else name: v for name, v in (before or {}).items()}
    for name in past:
        if name not in given:
            raise UcritError(f"before: '{name}' is not late{near_match(name, given)}")
    found += [_late_input(subject, name, *value, past.get(name)) for name, value in given.items()]
    last = to_si(until, "s", "time until")
    for one in found:
        if last / one.delay > MOST:
            raise UcritError(f"the delay must be above {last / MOST:g} s for {last:g} s, got {one.delay:g} s")
    return followed(subject, until, initial, inputs, found, times, tolerance, method, None)


def _known(vehicle: Model, name: str) -> str:
    """Return the name of an input that is driven; one that is not needs to be told what it is late of."""
    if name in type(vehicle).declaration.inputs and name not in driven(type(vehicle)):
        raise UcritError(
            f"{type(vehicle).model_id()}: no controller drives '{name}'; say what it is late of, "
            f'as in {{"{name}": ("theta", 0.1)}}'
        )
    return name


def with_exact_delays(vehicle: Model, exact: type[Model], late: Sequence[Late]) -> tuple[Model, list[LateInput]]:
    """Return a vehicle with its own delays as they are, and its late inputs."""
    subject = vehicle
    if late:
        subject = exact(**{name: vehicle.values[name] for name in exact.declaration.parameters})
        subject.__dict__["info"] = vehicle.info
    return subject, [_late_input(subject, one.input, one.quantity, vehicle.values[one.delay], None) for one in late]


def _late_input(vehicle: Model, name: str, quantity: str, delay: Any, before: Any) -> LateInput:
    """Return a late input by places."""
    model, made = type(vehicle), motion(type(vehicle))
    declared, where = model.declaration, model.model_id()
    if vehicle.dims:
        raise UcritError(f"delays are followed for one vehicle: give one value each for {', '.join(vehicle.dims)}")
    if name not in declared.inputs:
        raise UcritError(f"{where}: there is no input '{name}' to be late{near_match(name, declared.inputs)}")
    known = [*made.labels, *declared.outputs]
    if quantity not in known:
        raise UcritError(f"{where}: there is no state or output '{quantity}'{near_match(quantity, known)}")
    unit = declared.inputs[name].unit
    state = declared.variables.get(quantity.rstrip("'"))
    theirs = declared.outputs[quantity].unit if quantity in declared.outputs else state.state_unit(quantity.count("'"))  # type: ignore[union-attr]
    if to_dimension(unit) != to_dimension(theirs):
        raise UcritError(f"{where}: {name} [{unit}] cannot be what {quantity} [{theirs}] was")
    time = to_si(delay, "s", f"delay of {name}")
    if not (time > 0 and np.isfinite(time)):
        raise UcritError(f"the delay must be above 0 s, got {time:g} s")
    place = known.index(quantity)
    return LateInput(list(declared.inputs).index(name), place, time, _past(vehicle, name, place, before))


def to_dimension(unit: str) -> Any:
    """Return the dimension of a unit."""
    from ...core.units import dimension

    return dimension(unit)


def _past(vehicle: Model, name: str, place: int, before: Any) -> Callable[[float], float]:
    """Return what a late quantity was before time 0."""
    if callable(before):
        return lambda t: float(before(t))
    if before is not None:
        value = to_si(before, type(vehicle).declaration.inputs[name].unit, f"before: {name}")
    else:
        made, arguments = motion(type(vehicle)), vehicle.arguments()
        w, u = made.basic(arguments)
        value = float(np.concatenate([w, made.outputs(w, u, arguments)])[place])
    return lambda _: value
