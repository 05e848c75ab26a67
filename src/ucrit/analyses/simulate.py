"""The motion itself: a model's non-linear equations followed in time."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ..core.declare import Quantity
from ..core.errors import UcritError, near_match
from ..core.model import Model
from ..core.motion import Motion, motion
from ..core.units import to_si
from .convert import Series, Table, Tabular

Array = npt.NDArray[Any]

POINTS = 400
"""Times of a result that are not given."""

TOLERANCE = 1e-12
"""Relative error of a step; the absolute one is a thousandth of it, in SI units."""

SMALLEST, LARGEST = 1e-13, 1e-2
"""Tolerances that can be asked for."""

EXACT = 1e-9
"""Share of its terms up to which a constraint may be broken at the start."""


@dataclass(frozen=True)
class Simulation(Tabular):
    """Motion of a vehicle in time.

    Attributes
    ----------
    times
        [s], shape (T,).
    states, outputs, inputs
        Names of the columns of the three arrays, in order.
    values, output_values, input_values
        Shapes (T, states), (T, outputs) and (T, inputs) [SI].
    """

    vehicle: Model
    times: Array
    states: tuple[str, ...]
    outputs: tuple[str, ...]
    inputs: tuple[str, ...]
    values: Array
    output_values: Array
    input_values: Array

    def __getitem__(self, name: str) -> Array:
        """Return a state, output or input over time, shape (T,)."""
        found = {series.name: series.values for series in self.table().data}
        if name not in found:
            raise UcritError(f"the simulation has no '{name}'{near_match(name, found)}")
        return found[name]

    def table(self) -> Table:
        """Return states, outputs and inputs over time with their units."""
        declared = type(self.vehicle).declaration
        rates = {name: (name.rstrip("'"), name.count("'")) for name in self.states}
        units = {name: declared.variables[base].state_unit(k) for name, (base, k) in rates.items()}
        units |= {name: quantity.unit for name, quantity in (*declared.outputs.items(), *declared.inputs.items())}
        names = (*self.states, *self.outputs, *self.inputs)
        columns = np.concatenate([self.values, self.output_values, self.input_values], axis=1).T
        data = tuple(Series(n, ("time",), v, units[n]) for n, v in zip(names, columns, strict=True))
        return Table("simulation", self.vehicle, (Series("time", ("time",), self.times, "s"),), data, ("time",))


def simulate(
    vehicle: Model,
    until: float | str,
    initial: Mapping[str, float | str] | None = None,
    inputs: Mapping[str, float | str | Callable[[float], float]] | None = None,
    *,
    times: Any = None,
    tolerance: float = TOLERANCE,
) -> Simulation:
    """Follow a vehicle's non-linear motion from time 0.

    Parameters
    ----------
    vehicle
        With scalar parameters.
    until
        Last time [s, or text with a unit].
    initial
        Values of states at time 0, by name: ``theta`` for a variable, ``theta'`` for its rate. The others are those of
        the basic motion.
    inputs
        Values of inputs by name, constant or functions of time; the others are those of the basic motion.
    times
        Times of the result [s]; by default 400 from 0 to the last.
    tolerance
        Relative error of each step.

    Returns
    -------
    Simulation
        By the method of Dormand and Prince of order 8 (E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary
        Differential Equations I (1993), section II.10). A constraint is kept as well as at the start.

    Raises
    ------
    UcritError
        If a name or value is wrong, the start breaks a constraint, or the motion ends in infinity or a singularity.

    Examples
    --------
    >>> from ucrit import load
    >>> falling = simulate(load("bowling-ball-on-a-thin-stick"), 1, {"theta": "1 deg"}, times=[0, 1])
    >>> [round(float(angle), 4) for angle in falling["theta"]]
    [0.0175, 0.0371]
    """
    if vehicle.dims:
        raise UcritError("simulate follows one vehicle: give scalar parameters")
    if not SMALLEST <= tolerance <= LARGEST:
        raise UcritError(f"tolerance must be within {SMALLEST:g} and {LARGEST:g}, got {tolerance!r}")
    made, arguments = motion(type(vehicle)), vehicle.arguments()
    last = _value(until, "s", f"{type(vehicle).model_id()}: time until")
    at = _times(times, last)
    basic, steady = made.basic(arguments)
    start, drive = _start(vehicle, made, basic, initial or {}), _drive(vehicle, steady, inputs or {})
    _refuse_broken_constraints(vehicle, start, drive(0.0))
    values = _followed(vehicle, start, drive, last, at, tolerance)
    driven = np.array([drive(t) for t in at]).reshape(len(at), len(steady)).T
    outputs = made.outputs(values, driven, arguments).reshape(-1, len(at))
    declared = type(vehicle).declaration
    names = made.labels, tuple(declared.outputs), tuple(declared.inputs)
    return Simulation(vehicle, at, *names, values.T, outputs.T, driven.T)


def _followed(
    vehicle: Model, start: Array, drive: Callable[[float], Array], last: float, times: Array, tolerance: float
) -> Array:
    """Return the states, one a row, at given times of a motion that goes on to the last."""
    from scipy.integrate import solve_ivp

    made, arguments = motion(type(vehicle)), vehicle.arguments()

    def rates(t: float, w: Array) -> Array:
        return made.rhs(w, drive(t), arguments)

    where = f"{type(vehicle).model_id()}: the motion cannot be followed until {last:g} s"
    limits = {"rtol": tolerance, "atol": 1e-3 * tolerance}
    try:
        with np.errstate(all="ignore"):
            found = solve_ivp(rates, (0, last), start, method="DOP853", t_eval=times, **limits)
    except np.linalg.LinAlgError:
        raise UcritError(f"{where}: the equations cannot be solved for the accelerations") from None
    if not (found.success and np.isfinite(found.y).all()):
        raise UcritError(f"{where}: it grows without bound or meets a singularity")
    return np.asarray(found.y)


def _times(given: Any, last: float) -> Array:
    if not last > 0:
        raise UcritError(f"time until must be above 0 s, got {last:g} s")
    try:
        at = np.linspace(0, last, POINTS) if given is None else np.atleast_1d(np.asarray(given, dtype=float))
    except (TypeError, ValueError):
        raise UcritError(f"times must be a list of numbers, got {given!r}") from None
    if at.ndim != 1 or not at.size or not np.all((at >= 0) & (at <= last)) or np.any(np.diff(at) <= 0):
        raise UcritError(f"times must ascend within 0 s and {last:g} s, got {given!r}")
    return at


def _start(vehicle: Model, made: Motion, basic: Array, initial: Mapping[str, Any]) -> Array:
    """Return the state at time 0."""
    start, variables = basic.copy(), type(vehicle).declaration.variables
    for label, value in initial.items():
        thing = f"{type(vehicle).model_id()}: initial {label}"
        if label not in made.labels:
            raise UcritError(f"{thing}: there is no such state{near_match(label, made.labels)}")
        unit = variables[label.rstrip("'")].state_unit(label.count("'"))
        start[made.labels.index(label)] = _value(value, unit, thing)
    return start


def _drive(vehicle: Model, steady: Array, inputs: Mapping[str, Any]) -> Callable[[float], Array]:
    """Return the inputs as a function of time."""
    declared, model = type(vehicle).declaration.inputs, type(vehicle).model_id()
    constant, varying = steady.copy(), {}
    for name, value in inputs.items():
        if name not in declared:
            raise UcritError(f"{model}: there is no input '{name}'{near_match(name, declared)}")
        place = list(declared).index(name)
        if callable(value):
            varying[place] = (value, declared[name])
        else:
            constant[place] = _value(value, declared[name].unit, f"{model}: input {name}")

    def drive(t: float) -> Array:
        u = constant.copy()
        for place, (function, quantity) in varying.items():
            u[place] = _number(function(t), quantity, model, t)
        return u

    return drive


def _value(value: Any, unit: str, thing: str) -> float:
    """Return a finite number [SI] from one or from a text with a unit."""
    number = to_si(value.item() if hasattr(value, "item") else value, unit, thing)
    if not np.isfinite(number):
        raise UcritError(f"{thing} must be finite, got {number:g}")
    return number


def _number(value: Any, quantity: Quantity, model: str, t: float) -> float:
    try:
        number = float(value)
    except (TypeError, ValueError):
        number = np.nan
    if not np.isfinite(number):
        raise UcritError(f"{model}: input {quantity.name} must be a finite number, got {value!r} at {t:g} s")
    return number


def _refuse_broken_constraints(vehicle: Model, start: Array, u: Array) -> None:
    """Refuse a start that the model's constraints do not allow: the motion would keep what is wrong."""
    declared = type(vehicle).declaration
    if all(v.order for v in declared.variables.values()) and not hasattr(vehicle, "constraints"):
        return
    import sympy as sp

    from ..core.nonlinear import constraints
    from ..core.trace import trace

    traced = trace(type(vehicle), direction=None)
    symbols = (*traced.states, *traced.u, *traced.parameters.values())
    numbers = dict(zip(symbols, (*start, *u, *vehicle.arguments()), strict=True))
    for condition in constraints(traced):
        terms = [float(term.xreplace(numbers)) for term in sp.Add.make_args(sp.expand(condition))]
        if abs(sum(terms)) > EXACT * sum(map(abs, terms)):
            raise UcritError(
                f"{type(vehicle).model_id()}: initial values must keep the constraint {condition} = 0, "
                f"got {sum(terms):g}"
            )
