"""Units: exponents of mass, length and time for declarations; quantities with any unit at the edges.

Declarations use coherent SI units only (``kg m^2``, ``N/rad``), read by a ten-line parser, because they are
read at every start. What a user types (``"110 km/h"``) goes through pint, imported only then.
"""

from __future__ import annotations

import math
import re
from functools import cache
from typing import Any, NamedTuple

from .errors import ModelError, UcritError


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


_TEXT = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(.*?)\s*$", re.DOTALL)


def to_si(value: Any, unit: str, thing: str) -> float:
    """Return ``value`` in the coherent SI ``unit``: a number as it is, a text by its own unit.

    Raises `UcritError` naming ``thing`` when the text is no quantity or has another dimension.

    >>> round(to_si("110 km/h", "m/s", "speed U"), 3)
    30.556
    """
    if isinstance(value, bool) or not isinstance(value, int | float | str):
        raise UcritError(f"{thing} must be a number or a text with a unit, got {value!r}")
    if not isinstance(value, str):
        return float(value)
    match = _TEXT.match(value)
    if match is None:
        raise UcritError(f"{thing} must be a number, if need be with a unit such as '{unit}', got {value!r}")
    number, text = float(match[1]), match[2]
    if text in ("", unit):
        return number
    return _convert(number, text, unit, thing)


def _convert(number: float, text: str, unit: str, thing: str) -> float:
    import pint

    try:
        factor = _registry().Quantity(number, text).to(unit.replace(" ", "*"))
    except pint.DimensionalityError:
        raise UcritError(f"{thing} is measured in {unit}, got '{number:g} {text}'") from None
    except Exception:  # pint raises many kinds, token errors among them, for texts that are no unit
        raise UcritError(f"{thing} is measured in {unit}, and '{text}' is not a unit that can be read") from None
    result = float(factor.magnitude)
    if not math.isfinite(result):
        raise UcritError(f"{thing} must be finite, got '{number:g} {text}'")
    return result


@cache
def _registry() -> Any:
    import pint

    return pint.UnitRegistry()
