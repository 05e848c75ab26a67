"""Units: exponents of mass, length and time for declarations; quantities with any unit at the edges.

Declarations use coherent SI units only (``kg m^2``, ``N/rad``), read by a ten-line parser, because they are
read at every start. What a user types (``"110 km/h"``) goes through pint, imported only then.
"""

from __future__ import annotations

import math
import re
from fractions import Fraction
from functools import cache
from numbers import Real
from typing import Any, NamedTuple

from .errors import ModelError, UcritError, near_match


class Dimension(NamedTuple):
    """Exponents of mass, length and time; angles are ratios of lengths."""

    mass: float = 0
    length: float = 0
    time: float = 0

    def times(self, other: Dimension, power: float = 1) -> Dimension:
        """Return the dimension of ``self * other**power``."""
        return Dimension(*(a + power * b for a, b in zip(self, other, strict=True)))

    def __str__(self) -> str:
        parts = [f"{n}^{e:g}" if e != 1 else n for n, e in zip(("kg", "m", "s"), self, strict=True) if e]
        return " ".join(parts) or "1"


COHERENT = {
    "1": Dimension(),
    "rad": Dimension(),
    "kg": Dimension(1),
    "m": Dimension(0, 1),
    "s": Dimension(0, 0, 1),
    "Hz": Dimension(0, 0, -1),
    "N": Dimension(1, 1, -2),
    "Pa": Dimension(1, -1, -2),
    "J": Dimension(1, 2, -2),
    "W": Dimension(1, 2, -3),
}


@cache
def dimension(unit: str) -> Dimension:
    """Return the dimension of a coherent SI unit such as ``"kg m^2"`` or ``"N s/rad"``.

    >>> str(dimension("N s/m"))
    'kg s^-1'
    """
    total = Dimension()
    for sign, name, power in re.findall(r"(/?)\s*([A-Za-z]+|1)(?:\^(-?\d+))?", unit):
        if name not in COHERENT:
            raise ModelError(f"unit '{unit}': '{name}' is not a coherent SI unit; allowed: {', '.join(COHERENT)}")
        total = total.times(COHERENT[name], (-1 if sign else 1) * int(power or 1))
    if re.sub(r"(/?)\s*([A-Za-z]+|1)(?:\^(-?\d+))?|\s", "", unit) or not unit:
        raise ModelError(f"unit '{unit}' cannot be read; write it like 'kg m^2' or 'N/rad'")
    return total


COMMON = {
    "km/h": ("m/s", "5/18"),
    "mph": ("m/s", "0.44704"),
    "t": ("kg", "1000"),
    "g": ("kg", "1/1000"),
    "cm": ("m", "1/100"),
    "mm": ("m", "1/1000"),
    "kN": ("N", "1000"),
    "kN/m": ("N/m", "1000"),
    "N/mm": ("N/m", "1000"),
    "kN/rad": ("N/rad", "1000"),
}
"""Units met in most vehicle files: coherent unit and factor. Starting pint takes longer than most analyses."""

_TOWER = re.compile(r"\d\s*(\^|\*\*)|(\^|\*\*)[\s(+-]*\d{3}")
"""Powers of numbers and powers above 99: no unit has them, and computing ``9**9**9`` would take for ever."""

_TEXT = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(.*?)\s*$", re.DOTALL)


def to_si(value: Any, unit: str, thing: str) -> float:
    """Return ``value`` in the coherent SI ``unit``: a number as it is, a text by its own unit.

    Raises `UcritError` naming ``thing`` when the text is no quantity or has another dimension.

    >>> round(to_si("110 km/h", "m/s", "speed U"), 3)
    30.556
    """
    value = of_quantity(value, unit, thing)
    if isinstance(value, bool) or not isinstance(value, Real | str):
        raise UcritError(f"{thing} must be a number or a text with a unit, got {value!r}")
    if isinstance(value, Real):
        return _finite(value, thing)
    match = _TEXT.match(value)
    if match is None:
        raise UcritError(f"{thing} must be a number, if need be with a unit such as '{unit}', got {value!r}")
    number, text = float(match[1]), match[2]
    if text in ("", unit):
        return number
    if COMMON.get(text, ("", ""))[0] == unit and 1e-99 < abs(number) < 1e99:
        return float(Fraction(match[1]) * Fraction(COMMON[text][1]))
    return _convert(number, text, unit, thing)


def of_quantity(value: Any, unit: str, thing: str) -> Any:
    """Return the numbers of a quantity of pint in the coherent SI ``unit``, and anything else as it is."""
    if not (hasattr(value, "magnitude") and hasattr(value, "units")):
        return value
    try:
        return value.to(unit.replace(" ", "*")).magnitude
    except Exception:  # of whichever registry the quantity is
        raise UcritError(f"{thing} is measured in {unit}, got '{value}'") from None


def _finite(value: Real, thing: str) -> float:
    try:
        return float(value)
    except OverflowError:
        raise UcritError(f"{thing} must be finite, got a number above 1.8e308") from None


def _convert(number: float, text: str, unit: str, thing: str) -> float:
    import pint

    wrong = UcritError(
        f"{thing} is measured in {unit}, and {text!r} is not a unit that can be read{_meant(text, unit)}"
    )
    if _TOWER.search(text):
        raise wrong
    try:
        factor = _registry().Quantity(number, text).to(unit.replace(" ", "*"))
    except pint.DimensionalityError:
        raise UcritError(f"{thing} is measured in {unit}, got {f'{number:g} {text}'!r}") from None
    except Exception:  # pint raises many kinds, token errors among them, for texts that are no unit
        raise wrong from None
    result = float(factor.magnitude)
    if not math.isfinite(result):
        raise UcritError(f"{thing} must be finite, got {f'{number:g} {text}'!r}")
    return result


def _meant(text: str, unit: str) -> str:
    """Return what the writer of a text that is no unit may have meant."""
    if re.match(r",\d", text):
        return "; the decimal sign is a point"
    near = near_match(text, [unit, *(name for name, (coherent, _) in COMMON.items() if coherent == unit)])
    return near if "did you mean" in near else ""


@cache
def _registry() -> Any:
    import pint

    return pint.UnitRegistry()


def exact_si(text: str, unit: str, thing: str) -> Fraction:
    """Return what a text says in the coherent SI ``unit``, exactly; other units than common ones round to a double.

    Raises `UcritError` naming ``thing`` when the text is no quantity or has another dimension.

    >>> exact_si("0.1", "m", "length"), exact_si("90 km/h", "m/s", "speed")
    (Fraction(1, 10), Fraction(25, 1))
    """
    rounded = to_si(text, unit, thing)
    match = _TEXT.match(text)
    if match is None or not math.isfinite(rounded):
        raise UcritError(f"{thing} must be a finite number, if need be with a unit such as '{unit}', got {text!r}")
    coherent, factor = (unit, "1") if match[2] in ("", unit) else COMMON.get(match[2], ("", ""))
    if coherent != unit or abs(rounded) < 1e-99:  # tiny numbers may have a billion digits
        return Fraction(rounded)
    return Fraction(match[1]) * Fraction(factor)
