"""Ranges with exact ends: decimals and common units as fractions, without rounding."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

from ...core.errors import UcritError
from ...core.units import exact_si

HOW = "give a pair of numbers, or write LO:HI with a unit if need be"


def exact_range(given: Any, unit: str, thing: str) -> tuple[Fraction, Fraction]:
    """Return both ends of a range in the coherent SI unit.

    Parameters
    ----------
    given
        A pair of numbers, or text such as ``"20:110 km/h"``; a unit belongs to the numbers before it without one.
    unit
        Coherent SI unit of the quantity.
    thing
        What errors call it.

    Raises
    ------
    UcritError
        If it is no range, is empty or runs backwards.

    Examples
    --------
    >>> exact_range("0.1:36 km/h", "m/s", "speed")
    (Fraction(1, 36), Fraction(10, 1))
    >>> exact_range((0.1, 2), "m", "length")
    (Fraction(1, 10), Fraction(2, 1))
    """
    if isinstance(given, str):
        parts = given.split(":")
        if len(parts) != 2 or not all(part.strip() for part in parts):
            raise UcritError(f"{thing}: {given!r} is no range; {HOW}")
        tail = parts[1].strip().lstrip("+-0123456789.eE").strip()
        if parts[0].strip().lstrip("+-0123456789.eE").strip() == "" and tail:
            parts[0] = f"{parts[0]} {tail}"
        low, high = (exact_si(part, unit, thing) for part in parts)
    else:
        try:
            one, other = given
        except (TypeError, ValueError):
            raise UcritError(f"{thing}: {given!r} is no range; {HOW}") from None
        low, high = (_number(x, unit, thing) for x in (one, other))
    if not low < high:
        why = "is empty" if low == high else "runs backwards"
        raise UcritError(f"{thing}: the range from {float(low):g} to {float(high):g} {why}")
    return low, high


def _number(x: Any, unit: str, thing: str) -> Fraction:
    if isinstance(x, str):
        return exact_si(x, unit, thing)
    if isinstance(x, bool) or not isinstance(x, int | float | Fraction):
        raise UcritError(f"{thing}: {x!r} is no number; {HOW}")
    if isinstance(x, float):
        if not math.isfinite(x):
            raise UcritError(f"{thing} must be finite, got {x}")
        return Fraction(repr(float(x)))
    return Fraction(x)
