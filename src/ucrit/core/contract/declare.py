"""What a model file declares: parameters, variables, inputs and outputs, each with unit and meaning."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..errors import ModelError, UcritError
from ..units import Dimension, dimension, of_quantity, to_si


@dataclass(frozen=True)
class Quantity:
    """A named physical quantity with a coherent SI unit."""

    unit: str
    meaning: str
    name: str = ""

    def __post_init__(self) -> None:
        dimension(self.unit)

    @property
    def dimension(self) -> Dimension:
        """Exponents of mass, length and time."""
        return dimension(self.unit)


@dataclass(frozen=True)
class Parameter(Quantity):
    """A constant of the vehicle with its bounds; ``default`` is ``None`` when a value must be given."""

    above: float = -math.inf
    below: float = math.inf
    at_least: float = -math.inf
    at_most: float = math.inf
    default: float | None = None
    is_speed: bool = False

    @property
    def lower(self) -> float:
        """Greatest lower bound, whether or not it is itself allowed."""
        return max(self.above, self.at_least)

    @property
    def upper(self) -> float:
        """Least upper bound, whether or not it is itself allowed."""
        return min(self.below, self.at_most)

    @property
    def sign(self) -> int | None:
        """+1 or -1 where the bounds fix the sign, 0 for 'zero or positive', ``None`` where they do not."""
        if self.above >= 0 or self.at_least > 0:
            return 1
        if self.below <= 0 or self.at_most < 0:
            return -1
        return 0 if self.at_least == 0 else None

    @property
    def allowed(self) -> str:
        """The bounds in words, with the unit: ``above 0 kg``."""
        unit = "" if self.unit == "1" else f" {self.unit}"
        bounds = [
            (self.is_speed and self.above < 0, f"other than 0{unit}"),
            (self.above > -math.inf, f"above {self.above:g}{unit}"),
            (self.at_least > -math.inf, f"at least {self.at_least:g}{unit}"),
            (self.below < math.inf, f"below {self.below:g}{unit}"),
            (self.at_most < math.inf, f"at most {self.at_most:g}{unit}"),
        ]
        return " and ".join(text for given, text in bounds if given) or f"any finite number{unit and ' in' + unit}"

    def check(self, value: Any, model: str) -> float | np.ndarray[Any, Any]:
        """Return ``value`` in SI units as a float or a 1-D array; raise `UcritError` where it is not allowed."""
        thing = f"{model}: {self.meaning} {self.name}"
        value = of_quantity(value, self.unit, thing)
        if getattr(value, "shape", None) == () and hasattr(value, "item"):
            value = value.item()  # an array of no dimension is a number
        if isinstance(value, str | int | float) or not hasattr(value, "__len__"):
            number = to_si(value, self.unit, thing)
            self._check_bounds(np.asarray(number), thing)
            return number
        try:
            array = np.array(value, dtype=float)
        except (TypeError, ValueError, OverflowError):
            raise UcritError(f"{thing} must be a number or an array of numbers, got {value!r}") from None
        if array.ndim != 1 or not array.size:
            raise UcritError(f"{thing} must be a number or a one-dimensional array, got shape {array.shape}")
        self._check_bounds(array, thing)
        array.flags.writeable = False
        return array

    def allows(self, values: Any) -> Any:
        """Return a boolean array: which ``values`` are finite and within the bounds."""
        v = np.asarray(values, dtype=float)
        inside = (v > self.above) & (v < self.below) & (v >= self.at_least) & (v <= self.at_most)
        return inside & np.isfinite(v) & ((v != 0) | (not self.is_speed))

    def _check_bounds(self, values: np.ndarray[Any, Any], thing: str) -> None:
        wrong = values[~self.allows(values)]
        if not wrong.size:
            return
        unit = "" if self.unit == "1" else f" {self.unit}"
        if not np.isfinite(wrong.flat[0]):
            raise UcritError(f"{thing} must be finite, got {wrong.flat[0]:g}")
        raise UcritError(f"{thing} must be {self.allowed}, got {wrong.flat[0]:g}{unit}")


@dataclass(frozen=True)
class Variable(Quantity):
    """An unknown of the equations of motion; ``order`` counts the derivatives that make up its state."""

    order: int = 1
    motion: str = ""

    def label(self, derivative: int = 0) -> str:
        """Name of the variable or one of its derivatives: ``theta``, ``theta'``."""
        return self.name + "'" * derivative

    def state_unit(self, derivative: int = 0) -> str:
        """Unit of a derivative of the variable, such as ``rad/s`` for an angle's first."""
        base = self.unit if self.unit != "1" else "1"
        return base if not derivative else f"{base}/s" + (f"^{derivative}" if derivative > 1 else "")


@dataclass(frozen=True)
class Input(Quantity):
    """A quantity that is prescribed from outside, zero on the basic motion unless that says otherwise."""


@dataclass(frozen=True)
class Output(Quantity):
    """A quantity computed from state, rates and inputs by the model's ``outputs`` method."""


def param(
    unit: str,
    meaning: str,
    *,
    above: float = -math.inf,
    below: float = math.inf,
    at_least: float = -math.inf,
    at_most: float = math.inf,
    default: float | None = None,
) -> Any:
    """Declare a parameter: a constant of the vehicle.

    Parameters
    ----------
    unit
        Coherent SI unit, such as ``"kg m^2"``.
    meaning
        What it is, in words that fit into an error message.
    above, below
        Bounds that are not themselves allowed. A bound at zero tells the criteria the parameter's sign.
    at_least, at_most
        Bounds that are.
    default
        Value where none is given; without one, a value must be given.

    Raises
    ------
    ModelError
        If the unit cannot be read or no number is within the bounds.

    Examples
    --------
    >>> param("kg", "mass", above=0).allowed
    'above 0 kg'
    """
    declared = Parameter(unit, meaning, "", above, below, at_least, at_most, default)
    if not declared.lower < declared.upper:
        raise ModelError(f"parameter '{meaning}': no number is {declared.allowed}")
    return declared


def speed(meaning: str = "forward speed", *, reverse: bool = False) -> Any:
    """Declare the speed [m/s] that the vehicle's stability is judged against.

    Parameters
    ----------
    meaning
        Which speed it is.
    reverse
        Whether negative speeds (backing up) are allowed too; zero never is, it is a singular point.

    Examples
    --------
    >>> speed("speed of the car").unit
    'm/s'
    """
    return Parameter("m/s", meaning, above=-math.inf if reverse else 0.0, is_speed=True)


def state(unit: str, meaning: str, *, motion: str = "") -> Any:
    """Declare a variable that enters with its first derivative.

    Parameters
    ----------
    unit, meaning
        Coherent SI unit, and what it is in words.
    motion
        Word that names the modes in which it takes part most, such as ``"yaw"``; the meaning by default.

    Examples
    --------
    >>> state("rad/s", "yaw rate", motion="yaw").order
    1
    """
    return Variable(unit, meaning, order=1, motion=motion)


def coordinate(unit: str, meaning: str, *, motion: str = "") -> Any:
    """Declare a generalised coordinate: a variable that enters with its second derivative.

    Parameters
    ----------
    unit, meaning
        Coherent SI unit, and what it is in words.
    motion
        Word that names the modes in which it takes part most, such as ``"yaw"``; the meaning by default.

    Examples
    --------
    >>> coordinate("rad", "yaw angle", motion="yaw").order
    2
    """
    return Variable(unit, meaning, order=2, motion=motion)


def algebraic(unit: str, meaning: str) -> Any:
    """Declare an unknown that enters without derivatives, such as a constraint force.

    Parameters
    ----------
    unit, meaning
        Coherent SI unit, and what it is in words.

    Examples
    --------
    >>> algebraic("N", "side force").order
    0
    """
    return Variable(unit, meaning, order=0)


def input(unit: str, meaning: str) -> Any:
    """Declare an input: a steer angle, a side force.

    Parameters
    ----------
    unit, meaning
        Coherent SI unit, and what it is in words.

    Examples
    --------
    >>> input("rad", "front steer angle").meaning
    'front steer angle'
    """
    return Input(unit, meaning)


def output(unit: str, meaning: str) -> Any:
    """Declare an output that the model's ``outputs`` method returns.

    Parameters
    ----------
    unit, meaning
        Coherent SI unit, and what it is in words.

    Examples
    --------
    >>> output("m/s^2", "lateral acceleration").unit
    'm/s^2'
    """
    return Output(unit, meaning)
