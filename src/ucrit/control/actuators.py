"""Actuators between a demand and what reaches the vehicle: lag, limited rate, saturation, delay."""

from __future__ import annotations

from math import factorial
from typing import Any

from ..core.contract.declare import Input, Parameter, Variable
from ..core.contract.model import Model
from ..core.errors import UcritError, near_match
from ..core.formulas.functions import maximum, minimum
from ..core.made import made
from .controller import Controller

MOST = 12
"""Largest order of a delay's approximation: above it, rounding spoils the coefficients."""


def model_of(subject: type[Model] | Model) -> type[Model]:
    """Return the class of a vehicle, or the class that is given."""
    return subject if isinstance(subject, type) else type(subject)


def input_of(subject: type[Model] | Model, input: str) -> Input:
    """Return the declaration of an input, or refuse its name."""
    model = model_of(subject)
    inputs = model.declaration.inputs
    if input not in inputs:
        raise UcritError(f"{model.model_id()}: there is no input '{input}'{near_match(input, inputs)}")
    return inputs[input]


class Actuator(Controller):
    """Base of what lies between a demand and an input of the vehicle; made for one input."""

    through = True
    _input = ""
    _id = ""

    @classmethod
    def model_id(cls) -> str:
        """Name with its arguments, as vehicle files have it."""
        return cls._id or cls.__name__

    def given(self, name: str) -> Any:
        """Return a parameter by the first part of its name."""
        return self.__dict__[f"{name}_{self._input}"]

    def demand(self, u: Any, u0: Any) -> Any:
        """Return what is demanded beyond the basic motion."""
        return getattr(u, self._input) - getattr(u0, self._input)

    def reached(self, u0: Any, beyond: Any) -> dict[str, Any]:
        """Return what reaches the vehicle."""
        return {self._input: getattr(u0, self._input) + beyond}


class _Lag(Actuator):
    """Actuator that follows its demand slowly."""

    def law(self, x: Any, u0: Any) -> Any:
        return self.reached(u0, getattr(x, f"{self._input}_lagged"))

    def equations(self, x: Any, dx: Any, u: Any, u0: Any) -> Any:
        name = f"{self._input}_lagged"
        return self.given("tau") * getattr(dx, name) + getattr(x, name) - self.demand(u, u0)


class _RateLimit(Actuator):
    """Actuator whose rate is limited; a lag where the limit is not met."""

    def law(self, x: Any, u0: Any) -> Any:
        return self.reached(u0, getattr(x, f"{self._input}_lagged"))

    def equations(self, x: Any, dx: Any, u: Any, u0: Any) -> Any:
        name, limit = f"{self._input}_lagged", self.given("rate")
        rate = (self.demand(u, u0) - getattr(x, name)) / self.given("tau")
        return getattr(dx, name) - maximum(-limit, minimum(limit, rate))


class _Saturation(Actuator):
    """Actuator with end stops on both sides of the basic motion."""

    def law(self, u: Any, u0: Any) -> Any:
        limit = self.given("max")
        return self.reached(u0, maximum(-limit, minimum(limit, self.demand(u, u0))))


class Delay(Actuator):
    """Delay, as the all-pass function of H. Pade whose series agrees with the exponential's the longest."""

    _order = 1

    def law(self, x: Any, u: Any, u0: Any) -> Any:
        n = self._order
        kept = [self._weight(k) * getattr(x, self._name(k)) for k in range(n)]
        newest = self.demand(u, u0) - sum(kept)  # the highest derivative's term, which must not enter the vehicle
        return self.reached(u0, sum((-1) ** k * term for k, term in enumerate(kept)) + (-1) ** n * newest)

    def equations(self, x: Any, dx: Any, u: Any, u0: Any) -> Any:
        n, T = self._order, self.given("T")
        chain = [T * getattr(dx, self._name(k)) - getattr(x, self._name(k + 1)) for k in range(n - 1)]
        total = sum(self._weight(k) * getattr(x, self._name(k)) for k in range(n))
        return (*chain, total + self._weight(n) * T * getattr(dx, self._name(n - 1)) - self.demand(u, u0))

    def _name(self, k: int) -> str:
        return f"{self._input}_delayed_{k + 1}"

    def _weight(self, k: int) -> Any:
        """Coefficient of (T s)^k in the denominator, that of 1 being 1."""
        from sympy import Rational

        n = self._order
        return Rational(factorial(2 * n - k) * factorial(n), factorial(2 * n) * factorial(k) * factorial(n - k))


def _rate_unit(unit: str) -> str:
    return "1/s" if unit == "1" else f"{unit}/s"


def _make(base: type[Actuator], text: str, input: str, unit: str, meaning: str, order: int = 1) -> type[Actuator]:
    body: dict[str, Any] = {"drives": (input,), "_input": input, "_id": text, "_order": order, "__doc__": base.__doc__}
    if base in (_Lag, _RateLimit):
        body[f"tau_{input}"] = Parameter("s", f"time constant of the actuator of the {meaning}", above=0)
        body[f"{input}_lagged"] = Variable(unit, f"{meaning} beyond the basic motion", motion="actuator")
    if base is _RateLimit:
        body[f"rate_{input}"] = Parameter(_rate_unit(unit), f"largest rate of the {meaning}", above=0)
    if base is _Saturation:
        body[f"max_{input}"] = Parameter(unit, f"largest {meaning} beyond the basic motion", above=0)
    if base is Delay:
        body[f"T_{input}"] = Parameter("s", f"delay of the {meaning}", above=0)
        for k in range(order):
            body[f"{input}_delayed_{k + 1}"] = Variable(
                unit, f"state {k + 1} of the delay of the {meaning}", motion="delay"
            )
    return type(base.__name__.lstrip("_") + "Of" + input.title().replace("_", ""), (base,), body)


def _of(base: type[Actuator], word: str, model: type[Model] | Model, input: str, order: int = 1) -> type[Actuator]:
    quantity = input_of(model, input)
    text = f"{word}({input})" if base is not Delay else f"{word}({input}, {order})"
    return made(_make, base, text, input, quantity.unit, quantity.meaning, order)  # type: ignore[no-any-return]


def lag(model: type[Model] | Model, input: str) -> type[Actuator]:
    """Return an actuator of one input that follows its demand with the time constant ``tau_<input>``.

    Parameters
    ----------
    model
        The model or vehicle that it is for.
    input
        Name of an input, which becomes the demand.

    Raises
    ------
    UcritError
        If there is no such input.

    Examples
    --------
    >>> from ucrit import load, modes
    >>> from ucrit.control import close
    >>> car = load("bmw-320i")
    >>> slow = close(car, lag(car, "delta_f"), tau_delta_f=0.05)
    >>> -20.0 in modes(slow).eigenvalues.real.round(6)
    True
    """
    return _of(_Lag, "lag", model, input)


def rate_limit(model: type[Model] | Model, input: str) -> type[Actuator]:
    """Return an actuator of one input whose rate stays within ``rate_<input>``; else a lag of ``tau_<input>``.

    Parameters
    ----------
    model
        The model or vehicle that it is for.
    input
        Name of an input, which becomes the demand.

    Raises
    ------
    UcritError
        If there is no such input.
    """
    return _of(_RateLimit, "rate-limit", model, input)


def saturation(model: type[Model] | Model, input: str) -> type[Actuator]:
    """Return an actuator of one input that goes no farther than ``max_<input>``; linearly it does nothing.

    Parameters
    ----------
    model
        The model or vehicle that it is for.
    input
        Name of an input, which becomes the demand.

    Raises
    ------
    UcritError
        If there is no such input.
    """
    return _of(_Saturation, "saturation", model, input)


def delay(model: type[Model] | Model, input: str, order: int | str = 2) -> type[Actuator]:
    """Return a delay ``T_<input>`` of one input, approximated for linear work.

    Parameters
    ----------
    model
        The model or vehicle that it is for.
    input
        Name of an input, which becomes the demand.
    order
        Number of states, from 1 to 12; `simulate` takes the delay as it is.

    Raises
    ------
    UcritError
        If there is no such input or the order is not allowed.

    Notes
    -----
    The diagonal Pade approximation of ``exp(-T s)``: of gain 1 at all frequencies, its phase true up to
    ``omega T`` of about the order.

    Examples
    --------
    >>> from ucrit import load, simulate
    >>> from ucrit.control import close
    >>> car = load("bmw-320i")
    >>> late = close(car, delay(car, "delta_f"), T_delta_f=0.1)
    >>> simulate(late, 0.2, inputs={"delta_f": 0.02}, times=[0.05, 0.15])["delta_f_actual"].round(9).tolist()
    [0.0, 0.02]
    """
    try:
        n = int(order)
    except (TypeError, ValueError):
        n = 0
    if not 1 <= n <= MOST or str(n) != str(order):
        raise UcritError(f"the order of a delay must be a whole number from 1 to {MOST}, got {order!r}")
    return _of(Delay, "delay", model, input, n)
