"""Transfer functions, rational in s and the parameters, with their zeros, poles and what cancels."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ...core.derivation.cramer import check_names
from ...core.errors import UcritError, near_match
from ...core.formulas.codegen import build
from ...core.numeric.cache import cached
from ...core.numeric.compiled import direction as direction_of
from ...core.record import Record
from .handover import HandOver

Array = npt.NDArray[Any]

SAME = 1e-9
"""A zero and a pole nearer than this share of their distance from the origin count as one."""


@dataclass(frozen=True)
class TransferFunction(HandOver, Record):
    """Transfer function from one input to one output.

    Attributes
    ----------
    model, input, output, unit
        Names, and the unit of output per input.
    numerator, denominator
        Coefficients in lowest terms, ascending in s, as text.
    text, latex, mathml
        The whole function, factored.
    cancelled
        Factors of the characteristic polynomial that the numerator has too, whatever the parameters: motions
        that this input and output do not see.
    vehicle
        The vehicle whose numbers are put in, ``None`` for a model without.
    """

    model: str
    input: str
    output: str
    unit: str
    numerator: tuple[str, ...]
    denominator: tuple[str, ...]
    text: str
    latex: str
    mathml: str
    cancelled: tuple[str, ...]
    vehicle: Model | None
    source: str = field(repr=False)
    parameters: tuple[str, ...] = field(repr=False)

    @cached_property
    def _function(self) -> Callable[..., tuple[Any, ...]]:
        return build(self.source, "coefficients")

    def coefficients(self) -> tuple[tuple[Any, ...], tuple[Any, ...]]:
        """Return numerator and denominator in numbers, ascending, each broadcast over what it depends on."""
        vehicle = self._numbers()
        arguments = dict(zip(vehicle.values, vehicle.arguments(), strict=True))
        values = self._function([arguments[name] for name in self.parameters])
        return values[: len(self.numerator)], values[len(self.numerator) :]

    def __call__(self, s: Any) -> Array:
        """Return complex values at s [1/s], shape (..., *s.shape) for array parameters of shape (...)."""
        s = np.asarray(s, dtype=complex)
        above, below = (self._at(part, s) for part in self.coefficients())
        with np.errstate(all="ignore"):
            return np.asarray(above / below)

    def _at(self, coefficients: tuple[Any, ...], s: Array) -> Array:
        total: Any = 0
        for c in reversed(coefficients):
            total = total * s + np.reshape(c, np.shape(c) + (1,) * s.ndim)
        return np.asarray(total)

    @property
    def static_gain(self) -> Any:
        """Value at s = 0 [unit], infinite where the input is integrated; an array for array parameters."""
        above, below = self.coefficients()
        with np.errstate(all="ignore"):
            gain = np.asarray(np.true_divide(above[0], below[0]))
        return gain if self._numbers().dims else float(gain)

    @property
    def poles(self) -> Array:
        """Roots [1/s] of the denominator."""
        return self._roots(1)

    @property
    def zeros(self) -> Array:
        """Roots [1/s] of the numerator."""
        return self._roots(0)

    def cancellations(self) -> list[complex]:
        """Return the poles [1/s] that a zero cancels for these parameters, to nine digits."""
        zeros, found = list(self.zeros), []
        for pole in self.poles:
            near = [z for z in zeros if abs(z - pole) <= SAME * max(abs(pole), abs(z))]
            if near:
                zeros.remove(near[0])
                found.append(complex(pole))
        return found

    @property
    def non_minimum_phase(self) -> bool:
        """Whether a zero lies in the right half plane that no pole cancels."""
        return bool(self._right_zeros())

    def _right_zeros(self) -> list[complex]:
        gone = self.cancellations()
        return [z for z in self.zeros if z.real > 0 and all(abs(z - p) > SAME * abs(p) for p in gone)]

    def _numbers(self) -> Model:
        if self.vehicle is None:
            raise UcritError(
                f"{self.model}: numbers need a vehicle: transfer(vehicle, '{self.input}', '{self.output}')"
            )
        return self.vehicle

    def _roots(self, part: int) -> Array:
        if self._numbers().dims:
            raise UcritError("zeros and poles are those of one vehicle: give scalar parameters")
        a = [float(c) for c in self.coefficients()[part]]
        filled = [k for k, c in enumerate(a) if c]
        if not filled:
            return np.zeros(0, dtype=complex)
        low, high = filled[0], filled[-1]
        size = abs(a[low] / a[high]) ** (1 / (high - low)) if high > low else 1.0
        scaled = [c * size**k for k, c in enumerate(a)]
        return np.asarray(np.sort_complex(size * np.roots(scaled[::-1]).astype(complex)))

    def remarks(self) -> list[str]:
        """Return in words what is worth knowing: cancelled motions, zeros that turn the response round."""
        found = [
            "a position (zero root) is not seen" if text == "s" else f"the motion of {text} is not seen"
            for text in self.cancelled
        ]
        if self.vehicle is None or self.vehicle.dims:
            return found
        for pole in self.cancellations():
            word = "growing " if pole.real > 0 else ""
            found.append(f"the {word}motion of pole {_number(pole)} is cancelled by a zero for these parameters")
        right = self._right_zeros()
        if right:
            where = ", ".join(map(_number, right))
            found.append(f"non-minimum phase: zero{'s' if len(right) > 1 else ''} at {where} 1/s" + self._turns(right))
        if math.isinf(self.static_gain):
            found.append("the input is integrated: a constant input gives an output that grows without bound")
        return found

    def _turns(self, right: list[complex]) -> str:
        stable = all(p.real < 0 for p in self.poles)
        odd = sum(z.imag == 0 for z in right) % 2
        return "; the response to a step starts opposite to where it ends" if stable and odd else ""

    def __str__(self) -> str:
        head = f"{self.output}/{self.input} [{self.unit}] = {self.text}"
        return "\n".join([head, *(f"    {remark}" for remark in self.remarks())])

    def _repr_latex_(self) -> str:
        return rf"$\displaystyle {self.latex}$"

    def _repr_html_(self) -> str:
        from html import escape

        remarks = "".join(f"<li>{escape(remark)}</li>" for remark in self.remarks())
        return f'<math display="block">{self.mathml}</math>' + (f"<ul>{remarks}</ul>" if remarks else "")


def _number(value: complex) -> str:
    return f"{value.real:.4g}" if value.imag == 0 else f"{value.real:.4g}{value.imag:+.4g}j"


def transfer(
    model: type[Model] | Model,
    input: str,
    output: str,
    *,
    where: Mapping[str, str | float] | None = None,
    direction: int | None = None,
) -> TransferFunction:
    """Derive the transfer function from an input to an output.

    Parameters
    ----------
    model
        A model class for symbols only, or a vehicle for symbols and numbers.
    input
        Name of a declared input.
    output
        Name of a variable, its rate (``"theta'"``), or a declared output.
    where
        Parameters replaced by formulas in the others or by numbers: ``{"C_r": "a*C_f/b"}`` makes a car
        neutral.
    direction
        +1 forward, -1 backing up; that of the vehicle's speed by default.

    Returns
    -------
    TransferFunction
        In lowest terms.

    Raises
    ------
    UcritError
        If there is no such input, output or parameter.

    Examples
    --------
    >>> from ucrit import find_model
    >>> print(transfer(find_model("car"), "delta_f", "r", where={"C_r": "a*C_f/b"}).text)
    (C_f*U*a)/(I_z*U*s + C_f*a*(a + b))
    """
    cls, vehicle = (model, None) if isinstance(model, type) else (type(model), model)
    sense = direction or (direction_of(vehicle) if vehicle else 1)
    check_names(cls, input, output)
    given = dict(where or {})
    for name in given:
        if name not in cls.declaration.parameters:
            known = near_match(name, cls.declaration.parameters)
            raise UcritError(f"{cls.model_id()}: there is no parameter '{name}'{known}")
    piece = f"transfer{sense:+d}-{input}-{output.replace(chr(39), '_dot')}"
    if given:
        import hashlib

        piece += "-" + hashlib.sha256(repr(sorted(given.items())).encode()).hexdigest()[:16]
    facts = cached(cls, piece, lambda: _derive(cls, sense, input, output, given))
    facts = {key: tuple(value) if isinstance(value, list) else value for key, value in facts.items()}
    return TransferFunction(cls.model_id(), input, output, _unit(cls, input, output), vehicle=vehicle, **facts)


def _unit(cls: type[Model], input: str, output: str) -> str:
    declared = cls.declaration
    if output in declared.outputs:
        unit = declared.outputs[output].unit
    else:
        base = output.rstrip("'")
        unit = declared.variables[base].state_unit(len(output) - len(base))
    per = declared.inputs[input].unit
    return (
        "1"
        if unit == per
        else unit
        if per == "1"
        else f"{unit}/({per})"
        if " " in per or "/" in per
        else f"{unit}/{per}"
    )


def _derive(cls: type[Model], direction: int, input: str, output: str, given: Mapping[str, Any]) -> dict[str, Any]:
    from ...core.derivation.cramer import cramer
    from ...core.derivation.derive import symbolic
    from ...core.formulas import typeset
    from ...core.formulas.codegen import generate
    from ...core.formulas.expressions import parse
    from .polynomials import factored_in_s, product

    system = symbolic(cls, direction)
    names = system.traced.parameters
    if given:
        formulas = {names[k]: parse(v, names, f"{cls.model_id()}: {k}") for k, v in given.items()}
        system = system.substituted(formulas)
    found = cramer(system, input, output)
    above, below = ([product(c, found.functions) for c in found.in_s(p)] for p in (found.numerator, found.denominator))
    top, bottom = (
        factored_in_s(found.numerator, found.functions),
        factored_in_s(found.denominator, found.functions),
    )
    symbols = [symbol for name, symbol in names.items() if name not in given]
    return {
        "numerator": [typeset.text(c) for c in above],
        "denominator": [typeset.text(c) for c in below],
        "text": f"({top['text']})/({bottom['text']})",
        "latex": rf"\frac{{{top['latex']}}}{{{bottom['latex']}}}",
        "mathml": f"<mfrac>{top['mathml']}{bottom['mathml']}</mfrac>",
        "cancelled": [factored_in_s(f, found.functions)["text"] for f in found.cancelled],
        "source": generate("coefficients", [symbols], [*above, *below]),
        "parameters": [symbol.name for symbol in symbols],
    }
