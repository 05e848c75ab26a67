"""Sliding mode: a law that drives ``S = c'(x - x_d)`` to zero in finite time and keeps it there.

``u = -(c'b)^-1 (c'A x - c'x_d' + q S + alpha sgn S)`` gives ``S' = -q S - alpha sgn S``, whatever the vehicle does
besides, as long as what the law does not know is smaller than alpha (V. I. Utkin, IEEE Transactions on Automatic
Control 22 (1977) 212-222; Karnopp 2004, section 11.V). A boundary layer of width phi takes the jump out of it.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import Any

import numpy.typing as npt

from ..core.contract.declare import Input, Output, Parameter, algebraic
from ..core.contract.model import Model
from ..core.errors import UcritError
from ..core.formulas.functions import maximum, minimum
from ..core.made import made
from .actuators import Actuator, input_of, model_of
from .controller import Controller
from .copies import (
    DESIRED,
    KNOWN,
    basic_states,
    bound_parameters,
    checked_states,
    copied,
    linear_in_symbols,
    own_parameters,
    own_states,
    plain_name,
    rates,
    ratio,
    state_meaning,
    state_unit,
    symbol_of,
)
from .feedback import HAT, Observer
from .jumping import Jumping
from .loop import ClosedLoop, chain_of

Array = npt.NDArray[Any]


class SlidingMode(Controller):
    """Sliding mode: an input that drives S = c'(x - x_d) to zero, by a model of the vehicle."""

    _model: type[Model] = Model
    _reference: type[Model] | None = None
    _surface: tuple[str, ...] = ()
    _own: tuple[str, ...] = ()
    _reference_own: tuple[str, ...] = ()
    _estimated: tuple[str, ...] = ()
    _signum = False
    _id = ""

    @classmethod
    def model_id(cls) -> str:
        """Name with its arguments, as vehicle files have it."""
        return cls._id or cls.__name__

    def _state(self, label: str, x: Any, dx: Any) -> Any:
        if label in self._estimated:
            return getattr(x, f"{plain_name(label)}_{HAT}")
        return symbol_of(self._model, label, x, dx)

    def _error(self, x: Any, dx: Any, u: Any) -> Any:
        """Return S."""
        wanted = u if self._reference is None else x
        return sum(
            self._weight(label) * (self._state(label, x, dx) - getattr(wanted, f"{plain_name(label)}_{DESIRED}"))
            for label in self._surface
        )

    def _weight(self, label: str) -> Any:
        return 1 if label == self._surface[0] else self.__dict__[f"c_{plain_name(label)}"]

    def law(self, x: Any, dx: Any, u: Any, x0: Any, u0: Any) -> Any:
        name = self.drives[0]
        labels, A, B, symbols = linear_once(self._model, -1 if self._backward() else 1)
        values = bound_parameters(self, self._model, self._own, KNOWN)
        swap = {symbol: values[key] for key, symbol in symbols.items()}
        rows = {label: labels.index(label) for label in self._surface}
        inputs = list(self._model.declaration.inputs)

        def along(column: Any) -> Any:
            return sum(self._weight(label) * column[row].xreplace(swap) for label, row in rows.items())

        drift = sum(
            along(A[:, j]) * (self._state(label, x, dx) - (0 if "'" in label else getattr(x0, label)))
            for j, label in enumerate(labels)
        )
        if self._reference is not None:
            wanted = rates(self._reference, DESIRED, *self._followed(x, u))
            drift -= sum(self._weight(label) * wanted[label] for label in self._surface)
        S = self._error(x, dx, u)
        reach = self._reach(S, x, u)
        drift += self.__dict__["q_S"] * S + self.__dict__["alpha_S"] * reach
        return {name: getattr(u0, name) - drift / along(B[:, inputs.index(name)])}

    def _reach(self, S: Any, x: Any, u: Any) -> Any:
        """Return what stands for the sign of S."""
        return maximum(-1, minimum(1, S / self.__dict__["phi_S"]))

    def _followed(self, x: Any, u: Any) -> tuple[dict[str, Any], Any, dict[str, Any]]:
        """Return parameters, states and inputs of the reference."""
        assert self._reference is not None
        values = bound_parameters(self, self._reference, self._reference_own, DESIRED)
        return values, x, {name: getattr(u, name) for name in self.drives}

    def _backward(self) -> bool:
        speed = self._model.declaration.speed
        return bool(speed and self.__dict__[speed].is_negative)

    def outputs(self, x: Any, dx: Any, u: Any) -> Any:
        return {"S": self._error(x, dx, u)}


class FollowingSlidingMode(SlidingMode):
    """Sliding mode: an input that makes the vehicle follow a reference vehicle that has the same demand."""

    through = True

    def equations(self, x: Any, dx: Any, u: Any) -> Any:
        assert self._reference is not None
        values, _, demands = self._followed(x, u)
        return copied(self._reference, DESIRED, values, x, dx, demands).residuals

    def basic_motion(self) -> dict[str, dict[str, Any]]:
        """Return the basic motion: the reference's."""
        assert self._reference is not None
        return basic_states(
            self._reference, DESIRED, bound_parameters(self, self._reference, self._reference_own, DESIRED)
        )


linear_once: Any = cache(linear_in_symbols)


def _sliding(
    model: type[Model],
    input: str,
    surface: tuple[str, ...],
    reference: type[Model] | None,
    own: tuple[str, ...],
    estimated: tuple[str, ...],
    signum: bool,
) -> type[SlidingMode]:
    first = state_unit(model, surface[0])
    words = [input, *surface, *(f"own {n}" for n in own), *(f"estimated {n}" for n in estimated)]
    words += ["signum"] * signum + ["reference"] * (reference is not None)
    base = SlidingMode if reference is None else FollowingSlidingMode
    body: dict[str, Any] = {"drives": (input,), "_model": model, "_reference": reference, "_surface": surface}
    body |= {"_own": own, "_estimated": estimated, "_signum": signum, "__doc__": base.__doc__}
    body |= {"_id": f"sliding-mode({', '.join(words)})"} | own_parameters(model, own, KNOWN)
    for label in surface[1:]:
        meaning = f"weight of the {state_meaning(model, label)} in the sliding variable"
        body[f"c_{plain_name(label)}"] = Parameter(ratio(first, state_unit(model, label)), meaning)
    body["q_S"] = Parameter("1/s", "rate at which a large sliding variable shrinks", at_least=0, default=0.0)
    if signum:
        body["side_S"] = Input("1", "side of the sliding variable that the law counts on: 1, -1, or 0 while it slides")
        body["jump_S"] = algebraic("1", "what stands for the sign of the sliding variable")
    body["alpha_S"] = Parameter(f"{first}/s", "least rate of change of the sliding variable", at_least=0)
    if not signum:
        body["phi_S"] = Parameter(first, "width of the boundary layer of the sliding variable", above=0)
    if reference is None:
        for label in surface:
            body[f"{plain_name(label)}_{DESIRED}"] = Input(
                state_unit(model, label), f"desired {state_meaning(model, label)}"
            )
    else:
        all_own = tuple(n for n, p in reference.declaration.parameters.items() if not p.is_speed)
        body["_reference_own"] = all_own
        body |= own_parameters(reference, all_own, DESIRED) | own_states(reference, DESIRED, "desired")
    body["S"] = Output(first, "sliding variable")
    bases = (Jumping, base) if signum else (base,)
    return type(base.__name__, bases, body)


def sliding(
    model: type[Model] | Model,
    input: str,
    *surface: str,
    reference: type[Model] | Model | None = None,
    own: Sequence[str] = (),
    estimated: Sequence[str] = (),
    signum: bool = False,
) -> type[SlidingMode]:
    """Return a sliding-mode controller of one input; see `slide` for the numbers.

    Parameters
    ----------
    model
        The model or vehicle that it is for. The law reckons with the vehicle itself, without actuators and observers
        that were added to it; inputs other than its own are disturbances that it does not know.
    input
        Name of the input that is driven.
    surface
        States that make up ``S``, the first with the weight 1, the others with parameters ``c_<state>``. Words may
        stand among them: ``"own m"``, ``"estimated V"``, ``"signum"``, and ``"reference"`` for one like the vehicle.
    reference
        Model that the vehicle shall follow, which gets the same input as a demand; its parameters are ``<name>_d``.
        Without one, the desired values are inputs ``<state>_d`` and taken to be constant.
    own
        Parameters that the law has values of its own for, ``<name>_known``; those that it does not need are left out.
    estimated
        States for which an observer's estimates are taken.
    signum
        Whether the law jumps at ``S = 0``; else it is linear within the boundary layer ``phi_S``. In simulation S is
        then kept at zero by the equivalent control; behind an actuator the law would chatter and is refused.

    Raises
    ------
    UcritError
        If there is no such input or state, or the input does not act on S at once.
    """
    cls = bare_model(model_of(model))
    listed = [word.partition(" ") for word in surface]
    own = (*own, *(rest for word, _, rest in listed if word == "own"))
    estimated = (*estimated, *(rest for word, _, rest in listed if word == "estimated"))
    signum = signum or "signum" in surface
    if reference is None and "reference" in surface:
        reference = cls
    if signum:
        _refuse_actuator(model_of(model))
    names = [word for word, _, rest in listed if word not in ("signum", "reference") and not rest]
    input_of(cls, input)
    if not names:
        raise UcritError(f"{cls.model_id()}: name the states that the sliding variable is made of")
    labels = checked_states(cls, names)
    follows = None if reference is None else model_of(reference)
    if follows is not None:
        checked_states(follows, names)
        input_of(follows, input)
    own_parameters(cls, own, KNOWN)  # refuses names that are none
    states, A, B, symbols = linear_once(cls, 1)
    column = list(cls.declaration.inputs).index(input)
    rows = [states.index(label) for label in labels]
    used = set().union(*(e.free_symbols for row in rows for e in (*A[row, :], B[row, column])))
    kept = tuple(dict.fromkeys(name for name in own if symbols[name] in used))
    if all(B[row, column] == 0 for row in rows):
        raise UcritError(
            f"{cls.model_id()}: {input} does not change {', '.join(labels)} at once; "
            "the sliding variable must hold a state whose rate the input enters"
        )
    return made(  # type: ignore[no-any-return]
        _sliding, cls, input, labels, follows, kept, checked_states(cls, estimated), signum
    )


def _refuse_actuator(model: type[Model]) -> None:
    """Refuse a law that jumps above an actuator, behind which nothing keeps S at zero."""
    between = next((c.model_id() for c in chain_of(model)[1] if issubclass(c, Actuator)), None)
    if between:
        raise UcritError(
            f"{model.model_id()}: behind {between} a law that jumps would chatter; give a boundary layer phi"
        )


def bare_model(model: type[Model]) -> type[Model]:
    """Return a model without the actuators and observers added to it."""
    while issubclass(model, ClosedLoop) and issubclass(model._controller, Actuator | Observer):
        model = model._plant
    return model
