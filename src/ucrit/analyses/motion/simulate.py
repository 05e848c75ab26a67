"""The motion itself: a model's non-linear equations followed in time."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from ...control.late import exactly_delayed
from ...core.contract.declare import Quantity
from ...core.contract.model import Model
from ...core.errors import UcritError, near_match
from ...core.numeric.motion import Motion, motion
from ...core.units import to_si
from .follow import METHODS, Course, Drive, Follower
from .late import LateInput, Memory
from .manoeuvre_text import parse_shape
from .manoeuvres import Shape, Signal, constant
from .simulation import Happening, Simulation

Array = npt.NDArray[Any]

POINTS = 400
"""Times of a result that are not given."""

SMALLEST, LARGEST = 1e-13, 1e-2
"""Tolerances that can be asked for."""

EXACT = 1e-9
"""Share of its terms up to which a constraint may be broken at the start."""


def simulate(
    vehicle: Model,
    until: float | str,
    initial: Mapping[str, Any] | None = None,
    inputs: Mapping[str, float | str | Shape | Callable[[float], float]] | None = None,
    *,
    times: Sequence[float] | Array | None = None,
    tolerance: float | None = None,
    method: str = "auto",
    progress: Callable[[float, float], None] | None = None,
) -> Simulation:
    """Follow a vehicle's non-linear motion from time 0.

    Parameters
    ----------
    vehicle
        Its array parameters span leading dimensions of the result.
    until
        Last time [s, or text with a unit].
    initial
        Values of states at time 0, by name: ``theta`` for a variable, ``theta'`` for its rate. The others are those of
        the basic motion. A one-dimensional array spans a dimension of its own, behind those of the vehicle.
    inputs
        Values of inputs by name: constant; a `Step`, `Ramp`, `Sine`, `SineWithDwell`, `Pulse`, `Gust` or a
        `Measured` table, whose kinks are met exactly, or such a shape as text (``"step 2 deg at 1 s"``); or a smooth
        function of time.
        The others are those of the basic motion.
    times
        Times of the result [s]; by default 400 from 0 to the last, or to the event that ends the motion.
    tolerance
        Relative error of each step, the absolute one a thousandth of it in SI units; by default 1e-12, and 1e-9 where
        the method is implicit. The worst member of a batch keeps it, as far as double precision goes.
    method
        ``"DOP853"``, ``"Radau"``, ``"BDF"`` or ``"LSODA"`` of SciPy, the implicit ones with exact slopes. ``"auto"``
        begins with the first, and goes over to Radau where a single motion proves stiff.
    progress
        Called now and then with the time reached and the last one.

    Returns
    -------
    Simulation
        By default by the method of Dormand and Prince of order 8 (E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary
        Differential Equations I (1993), section II.10). A constraint is kept as well as at the start. Delays of a
        vehicle under control are taken as they are, not as approximated for linear work; see `simulate_delayed`.

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
    exact, late = exactly_delayed(type(vehicle))
    if late:
        from .delays import with_exact_delays

        vehicle, own = with_exact_delays(vehicle, exact, late)
    else:
        own = []
    return followed(vehicle, until, initial, inputs, own, times, tolerance, method, progress)


def followed(
    vehicle: Model,
    until: float | str,
    initial: Mapping[str, Any] | None,
    inputs: Mapping[str, Any] | None,
    late: Sequence[LateInput],
    times: Any,
    tolerance: float | None,
    method: str,
    progress: Callable[[float, float], None] | None,
) -> Simulation:
    """Follow a motion some of whose inputs are late; see `simulate` for the rest."""
    if tolerance is not None and not SMALLEST <= tolerance <= LARGEST:
        raise UcritError(f"tolerance must be within {SMALLEST:g} and {LARGEST:g}, got {tolerance!r}")
    if method not in METHODS:
        raise UcritError(f"there is no method '{method}'{near_match(str(method), METHODS)}")
    model, made = type(vehicle), motion(type(vehicle))
    last = _value(until, "s", f"{model.model_id()}: time until")
    at = _times(times, last)
    given = _starts(vehicle, made, initial or {})
    spans = {label: value for label, value in given.items() if value.ndim}
    arguments = tuple(
        np.reshape(a, (*np.shape(a), *(1,) * len(spans))) if np.ndim(a) else a for a in vehicle.arguments()
    )
    lead = (*(len(d) for d in vehicle.dims.values()), *map(len, spans.values()))
    basic, steady = (np.broadcast_to(_spread(v, len(lead)), (len(v), *lead)) for v in made.basic(arguments))
    start = _start(made, basic, given, list(spans))
    drive = Drive(_signals(vehicle, steady, inputs or {}, last), lead)
    _fill_steady(drive, steady, inputs or {}, vehicle)
    _refuse_broken_constraints(vehicle, made, start, drive.around(0.0)(0.0), arguments)
    wanted = (np.linspace(0, last, POINTS) if at is None else at) if lead else None
    where = f"{model.model_id()}: the motion cannot be followed until {last:g} s"
    options: Any = {"tolerance": tolerance, "method": method, "where": where, "progress": progress}
    memory = _remember(drive, late, lambda w, u: made.outputs(w, u, arguments).reshape(-1, w.shape[1]), last)
    follower = Follower(made, arguments, start, drive, last, times=wanted, **options)
    memory.stretches = follower.stretches
    course = follower.run()
    return _result(vehicle, made, course, arguments, at if wanted is None else wanted, last, spans)


def _remember(drive: Drive, late: Sequence[LateInput], outputs: Any, last: float) -> Memory:
    """Put signals that read what the motion was before in place of the inputs that are late."""
    memory = Memory(late, outputs)
    if late:
        signals = list(drive.signals)
        for one, signal in zip(late, memory.signals(drive.breaks, last), strict=True):
            signals[one.place] = signal
            drive.offsets.pop(one.place, None)
        drive.signals = signals
    return memory


def _result(
    vehicle: Model, made: Motion, course: Course, arguments: Any, at: Array | None, last: float, spans: dict[str, Array]
) -> Simulation:
    """Return a course at the wanted times, of a single motion that ended up to its end."""
    events = tuple(
        Happening(c.name, c.time, dict(zip(made.labels, map(float, c.states), strict=True)), c.ends, c.member)
        for c in sorted(course.crossings, key=lambda c: c.time)
    )
    declared, ended = type(vehicle).declaration, ""
    if course.stretches:
        ended = next((e.name for e in events if e.ends), "")
        end = float(course.alive_until)
        at = np.linspace(0, end, POINTS) if at is None else np.append(at[at < end], end) if ended else at
        values, driven = course.at(at)
    else:
        assert at is not None
        values, driven = course.values, course.inputs
        arguments = [a[..., None] if np.ndim(a) else a for a in arguments]
    with np.errstate(invalid="ignore"):
        outputs = made.outputs(values, driven, arguments).reshape(len(declared.outputs), *values.shape[1:])
    states, outputs, driven = (np.moveaxis(v, 0, -1) for v in (values, outputs, driven))
    names = made.labels, tuple(declared.outputs), tuple(declared.inputs)
    return Simulation(vehicle, at, *names, states, outputs, driven, events, ended, course.method, spans, course)


def _times(given: Any, last: float) -> Array | None:
    if not last > 0:
        raise UcritError(f"time until must be above 0 s, got {last:g} s")
    if given is None:
        return None
    try:
        at = np.atleast_1d(np.asarray(given, dtype=float))
    except (TypeError, ValueError):
        raise UcritError(f"times must be a list of numbers, got {given!r}") from None
    if at.ndim != 1 or not at.size or not np.all((at >= 0) & (at <= last)) or np.any(np.diff(at) <= 0):
        raise UcritError(f"times must ascend within 0 s and {last:g} s, got {given!r}")
    return at


def _spread(values: Array, axes: int) -> Array:
    """Append axes of length 1 behind the first until there are as many as asked for."""
    return values.reshape(*values.shape, *(1,) * (axes - values.ndim + 1))


def _starts(vehicle: Model, made: Motion, initial: Mapping[str, Any]) -> dict[str, Array]:
    """Return given initial values [SI], numbers or one-dimensional arrays."""
    found, variables = {}, type(vehicle).declaration.variables
    for label, value in initial.items():
        thing = f"{type(vehicle).model_id()}: initial {label}"
        if label not in made.labels:
            raise UcritError(f"{thing}: there is no such state{near_match(label, made.labels)}")
        unit = variables[label.rstrip("'")].state_unit(label.count("'"))
        many = isinstance(value, list | tuple | np.ndarray) and np.ndim(value) > 0
        if many and (np.ndim(value) != 1 or not len(value)):
            raise UcritError(f"{thing} must be a number or a one-dimensional array, got {value!r}")
        found[label] = np.array([_value(v, unit, thing) for v in value] if many else _value(value, unit, thing))
    return found


def _start(made: Motion, basic: Array, given: Mapping[str, Array], spans: list[str]) -> Array:
    """Return the state at time 0, shape (states, ...)."""
    start = np.array(basic)
    for label, value in given.items():
        axis = [1] * len(spans)
        if label in spans:
            axis[spans.index(label)] = -1
        start[made.labels.index(label)] = value.reshape(axis) if spans else value
    return start


def _signals(vehicle: Model, steady: Array, inputs: Mapping[str, Any], last: float) -> list[Signal]:
    """Return the given inputs as functions of time, without what the basic motion adds."""
    declared, model = type(vehicle).declaration.inputs, type(vehicle).model_id()
    found = dict.fromkeys(declared, constant(0.0))
    for name, value in inputs.items():
        if name not in declared:
            raise UcritError(f"{model}: there is no input '{name}'{near_match(name, declared)}")
        quantity, thing = declared[name], f"{model}: input {name}"
        shape = parse_shape(value, thing) if isinstance(value, str) else value
        if isinstance(shape, Shape):
            found[name] = shape.signal(quantity, thing, last)
        elif callable(value):
            found[name] = Signal((), (_checked(value, quantity, model),))
        else:
            found[name] = constant(_value(value, quantity.unit, thing))
    return list(found.values())


def _is_relative(value: Any) -> bool:
    shape = parse_shape(value, "") if isinstance(value, str) else value
    return isinstance(shape, Shape) and shape.relative


def _fill_steady(drive: Drive, steady: Array, inputs: Mapping[str, Any], vehicle: Model) -> None:
    """Add to the signals what inputs are on the basic motion, unless they are given as a whole."""
    for place, name in enumerate(type(vehicle).declaration.inputs):
        if name not in inputs or _is_relative(inputs[name]):
            drive.offsets[place] = steady[place]


def _checked(function: Callable[[float], float], quantity: Quantity, model: str) -> Callable[[float], float]:
    def value(t: float) -> float:
        return _number(function(t), quantity, model, t)

    return value


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


def _refuse_broken_constraints(vehicle: Model, made: Motion, start: Array, u: Array, arguments: Any) -> None:
    """Refuse a start that the model's constraints do not allow: the motion would keep what is wrong."""
    for condition, left, size in made.broken(start, u, arguments):
        if np.any(np.abs(left) > EXACT * size):
            raise UcritError(
                f"{type(vehicle).model_id()}: initial values must keep the constraint {condition} = 0, "
                f"got {np.ravel(left)[np.argmax(np.abs(np.ravel(left)))]:g}"
            )
