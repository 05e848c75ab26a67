"""State feedback and observers as controllers: classes with one declared gain for each pair of quantities."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ..core.contract.declare import Parameter, algebraic
from ..core.contract.model import Model
from ..core.errors import UcritError, near_match
from ..core.made import made
from .actuators import input_of, model_of
from .controller import Controller
from .copies import (
    basic_states,
    bound_parameters,
    checked_states,
    copied,
    own_parameters,
    own_states,
    ratio,
    refuse_constrained,
    state_meaning,
    state_names,
    state_unit,
    symbol_of,
    traced_once,
)

HAT = "hat"
"""Ending of what an observer estimates, and of parameters that it does not share with the vehicle."""


class StateFeedback(Controller):
    """State feedback: the inputs less a gain times each state's distance from the basic motion."""

    through = True
    _labels: tuple[str, ...] = ()
    _estimated = False
    _id = ""

    @classmethod
    def model_id(cls) -> str:
        """Name with its arguments, as vehicle files have it."""
        return cls._id or cls.__name__

    def law(self, x: Any, dx: Any, u: Any, x0: Any) -> Any:
        def state(label: str) -> Any:
            if self._estimated:
                return getattr(x, f"{label.replace(chr(39), '_dot')}_{HAT}")
            return symbol_of(type(self), label, x, dx)

        def beyond(label: str) -> Any:
            return state(label) - (0 if "'" in label else getattr(x0, label))

        return {
            name: getattr(u, name)
            - sum(self.__dict__[gain_name(name, label)] * beyond(label) for label in self._labels)
            for name in self.drives
        }


def gain_name(input: str, label: str) -> str:
    """Return the name of the gain from a state to an input."""
    return f"K_{input}_{label.replace(chr(39), '_dot')}"


def _feedback(
    model: type[Model], inputs: tuple[str, ...], labels: tuple[str, ...], estimated: bool
) -> type[Controller]:
    body: dict[str, Any] = {"drives": inputs, "_labels": labels, "_estimated": estimated}
    word = "estimated-state-feedback" if estimated else "state-feedback"
    chosen = (*inputs, *(() if labels == tuple(state_names(model)) else labels))
    body |= {"_id": f"{word}({', '.join(chosen)})", "__doc__": StateFeedback.__doc__}
    for name in inputs:
        for label in labels:
            unit = ratio(model.declaration.inputs[name].unit, state_unit(model, label))
            meaning = f"gain from the {state_meaning(model, label)} to the {model.declaration.inputs[name].meaning}"
            body[gain_name(name, label)] = Parameter(unit, meaning, default=0.0)
    return type("StateFeedback", (StateFeedback,), body)


def state_feedback(
    model: type[Model] | Model,
    *inputs: str,
    states: Sequence[str] | None = None,
    estimated: bool = False,
) -> type[Controller]:
    """Return the controller ``u = u_demanded - K (x - x_0)`` with a gain ``K_<input>_<state>`` for each pair.

    Parameters
    ----------
    model
        The model or vehicle that it is for.
    inputs
        Names of the inputs that are driven; they stay inputs, as demands. Names of states may stand after them.
    states
        States that are fed back (``theta'`` or ``theta_dot`` for a rate); all by default.
    estimated
        Whether estimates of an observer take the place of the states: the model is then one with an `observer`.

    Returns
    -------
    type of Controller
        Gains that are not given are 0.

    Raises
    ------
    UcritError
        If there is no such input or state.

    Examples
    --------
    >>> from ucrit import find_model, criteria
    >>> from ucrit.control import closed
    >>> Car = find_model("car")
    >>> list(state_feedback(Car, "delta_r").declaration.parameters)
    ['K_delta_r_V', 'K_delta_r_r']
    """
    cls = model_of(model)
    of = observed(cls)[0] if estimated else cls
    listed = [name for name in inputs if name not in cls.declaration.inputs and name in _state_words(of)]
    inputs = tuple(name for name in inputs if name not in listed)
    for name in inputs:
        input_of(cls, name)
    if not inputs:
        raise UcritError(f"{cls.model_id()}: name at least one input, such as {', '.join(cls.declaration.inputs)}")
    chosen = [*(states or ()), *listed]
    labels = checked_states(of, chosen) if chosen else tuple(state_names(of))
    return made(_feedback, of, tuple(inputs), labels, estimated)  # type: ignore[no-any-return]


def _state_words(model: type[Model]) -> set[str]:
    """Return all that states may be called."""
    return {*state_names(model), *state_names(model).values()}


def estimated_feedback(model: type[Model] | Model, *inputs: str) -> type[Controller]:
    """Return `state_feedback` of what the observer that was added last estimates."""
    return state_feedback(model, *inputs, estimated=True)


class Observer(Controller):
    """Observer of D. G. Luenberger: a copy of the vehicle, corrected by what is measured."""

    _model: type[Model] = Model
    _measured: tuple[str, ...] = ()
    _own: tuple[str, ...] = ()
    _unknown: tuple[str, ...] = ()
    _implicit: tuple[str, ...] = ()
    _id = ""

    @classmethod
    def model_id(cls) -> str:
        """Name with its arguments, as vehicle files have it."""
        return cls._id or cls.__name__

    def equations(self, x: Any, dx: Any, u: Any, y: Any) -> Any:
        errors, gaps = {}, []
        for name in self._measured:
            seen = self._seen(name, x, dx, y)
            estimate = self._with_own(x, dx, u, {}).outputs.get(name) if name in y.__dict__ else None
            if name in self._implicit:
                errors[name] = getattr(x, f"e_{name}")
            else:
                hat = f"{name.replace(chr(39), '_dot')}_{HAT}"
                errors[name] = seen - (getattr(x, hat) if estimate is None else estimate)
        injected = {
            label: sum(self.__dict__[observer_gain(label, name)] * error for name, error in errors.items())
            for label in state_names(self._model)
        }
        copy = self._with_own(x, dx, u, injected)
        for name in self._implicit:
            gaps.append(getattr(x, f"e_{name}") - (self._seen(name, x, dx, y) - copy.outputs[name]))
        return (*copy.residuals, *gaps)

    def _seen(self, name: str, x: Any, dx: Any, y: Any) -> Any:
        return y.__dict__[name] if name in y.__dict__ else symbol_of(self._model, name, x, dx)

    def _with_own(self, x: Any, dx: Any, u: Any, injected: dict[str, Any]) -> Any:
        parameters = bound_parameters(self, self._model, self._own, HAT)
        inputs = {name: getattr(u, name) for name in self._model.declaration.inputs if name not in self._unknown}
        return copied(self._model, HAT, parameters, x, dx, inputs, injected)

    def basic_motion(self) -> dict[str, dict[str, Any]]:
        """Return the basic motion: the vehicle's."""
        return basic_states(self._model, HAT, bound_parameters(self, self._model, self._own, HAT))


def observer_gain(label: str, measured: str) -> str:
    """Return the name of the gain from a measured quantity to the rate of a state's estimate."""
    return f"L_{label.replace(chr(39), '_dot')}_{measured.replace(chr(39), '_dot')}"


def measured_unit(model: type[Model], name: str) -> str:
    """Return the unit of a measured quantity: a state or an output."""
    outputs = model.declaration.outputs
    return outputs[name].unit if name in outputs else state_unit(model, name)


def checked_measured(model: type[Model], measured: Sequence[str]) -> tuple[str, ...]:
    """Return measured quantities as they are labelled, or refuse a name."""
    states, outputs = state_names(model), model.declaration.outputs
    if isinstance(measured, str):
        measured = (measured,)
    if not measured:
        raise UcritError(f"{model.model_id()}: name what is measured, such as {next(iter(states))}")
    for name in measured:
        if name not in {*outputs, *states, *states.values()}:
            known = near_match(name, [*outputs, *states])
            raise UcritError(f"{model.model_id()}: there is no state or output '{name}' to measure{known}")
    return tuple(name if name in outputs else checked_states(model, [name])[0] for name in measured)


def _observer(
    model: type[Model], measured: tuple[str, ...], own: tuple[str, ...], unknown: tuple[str, ...]
) -> type[Observer]:
    refuse_constrained(model)
    traced = traced_once(model, None)
    highest = {chain[-1] for chain in traced.q}
    formulas = dict(zip(model.declaration.outputs, traced.outputs, strict=True))
    implicit = tuple(name for name in measured if name in formulas and formulas[name].free_symbols & highest)
    body: dict[str, Any] = {"_model": model, "_measured": measured, "_own": own, "_implicit": implicit}
    body["_unknown"] = unknown
    words = (*measured, *(f"own {name}" for name in own), *(f"unknown {name}" for name in unknown))
    body |= {"_id": f"observer({', '.join(words)})", "__doc__": Observer.__doc__}
    body["twins"] = {f"{plain}_{HAT}": (at.rstrip("'"), at.count("'")) for at, plain in state_names(model).items()}
    body |= own_parameters(model, own, HAT) | own_states(model, HAT, "estimated")
    for label in state_names(model):
        for name in measured:
            unit = ratio(state_unit(model, label) + "/s", measured_unit(model, name))
            meaning = f"gain from the error of {name} to the rate of the estimated {state_meaning(model, label)}"
            body[observer_gain(label, name)] = Parameter(unit, meaning, default=0.0)
    for name in implicit:
        body[f"e_{name}"] = algebraic(model.declaration.outputs[name].unit, f"error of {name}, measured less estimated")
    return type("Observer", (Observer,), body)


def observing(
    model: type[Model] | Model, *measured: str, own: Sequence[str] = (), unknown: Sequence[str] = ()
) -> type[Observer]:
    """Return an observer: a copy of the model whose states follow by gains ``L_<state>_<measured>``.

    Parameters
    ----------
    model
        The model or vehicle that it is for.
    measured
        States or outputs, by name, that sensors give; ``"own m"`` is another way to say ``own=("m",)``.
    own
        Parameters that the observer has values of its own for, ``<name>_hat``: the vehicle's may then change while the
        observer does not know. The others are shared, the speed for example.
    unknown
        Inputs that the observer does not know: disturbances; ``"unknown F_w"`` among what is measured says the same.

    Returns
    -------
    type of Controller
        With the states ``<state>_hat``. It follows the non-linear equations (D. G. Luenberger, IEEE Transactions on
        Automatic Control 11 (1966) 190-197, for linear ones).

    Raises
    ------
    UcritError
        If there is no such state, output or parameter, or the model has constraints.
    """
    cls = model_of(model)
    own = (*own, *(name.removeprefix("own ").strip() for name in measured if name.startswith("own ")))
    unknown = (*unknown, *(name.removeprefix("unknown ").strip() for name in measured if name.startswith("unknown ")))
    for name in unknown:
        input_of(cls, name)
    names = checked_measured(cls, [name for name in measured if not name.startswith(("own ", "unknown "))])
    return made(_observer, cls, names, own, unknown)  # type: ignore[no-any-return]


def observed(model: type[Model]) -> tuple[type[Model], type[Observer]]:
    """Return the model that an observer was added to last, and the observer; refuse one without."""
    controller = getattr(model, "_controller", None)
    if controller is None or not issubclass(controller, Observer):
        raise UcritError(f"{model.model_id()}: there are no estimated states; add an observer first")
    return model._plant, controller  # type: ignore[attr-defined]
