"""Ranges of parameter values as people type them."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.errors import UcritError
from ...core.units import to_si

Array = npt.NDArray[np.float64]

COUNT = 100
"""Points of a range that names no number of points."""

MAX_COUNT = 10_000_000

HOW = "write LO:HI, LO:HI:COUNT, LO:HI:COUNT:log or values separated by commas, then a unit if need be"

_PART = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?|log\b)?\s*(.*?)\s*$", re.DOTALL)


def parse_range(text: str, unit: str = "1", thing: str = "range") -> Array:
    """Return the values of a range in coherent SI units.

    ``"5:40"`` is 100 evenly spaced points, ``"5:40:36"`` 36 of them, ``"1e3:1e6:50:log"`` 50 points with one
    ratio between neighbours, ``"1, 2, 5"`` a list. A unit belongs to all numbers before it, back to the
    unit before: ``"20:130 km/h"``, ``"20:130:12 km/h"``, ``"500 kg, 1, 2 t"``. Without any unit
    numbers are SI.

    Parameters
    ----------
    text
        What was typed.
    unit
        Coherent SI unit of the quantity.
    thing
        What errors call it.

    Returns
    -------
    ndarray
        At least two finite values; a range (not a list) rises.

    Raises
    ------
    UcritError
        If the text is no range, runs backwards, is empty, or has too many points.

    Examples
    --------
    >>> parse_range("36:108:3 km/h", "m/s").round(9).tolist()
    [10.0, 20.0, 30.0]
    >>> parse_range("1, 2, 5")
    array([1., 2., 5.])
    """
    if ":" not in text:
        values = np.array(_numbers(text.split(","), unit, thing, text))
        if values.size < 2:
            raise UcritError(f"{thing}: one value, {text.strip()!r}, is no range; {HOW}")
        return values
    parts = text.split(":")
    if "," in text or len(parts) > 4:
        raise UcritError(f"{thing}: {text!r} is no range; {HOW}")
    low, high, count, log = _parts(parts, unit, thing, text)
    if low >= high:
        why = "runs backwards" if low > high else "is empty"
        raise UcritError(f"{thing}: the range {text!r} {why}; the first number must be below the second")
    if log and not low * high > 0:
        raise UcritError(f"{thing}: a logarithmic range cannot start at, end at or cross 0, got {text!r}")
    return np.asarray(np.geomspace(low, high, count) if log else np.linspace(low, high, count))


def _parts(parts: list[str], unit: str, thing: str, text: str) -> tuple[float, float, int, bool]:
    """Return both ends, the number of points, and whether the steps are logarithmic."""
    matches = [_match(part, thing, text) for part in parts]
    tail = matches[-1][2] if len(parts) > 2 else ""
    between = [match[2] for match in matches[2:-1]]
    if any(between) or (tail and matches[1][2]):
        raise UcritError(f"{thing}: {text!r} has a unit in a strange place; {HOW}")
    log = len(parts) == 4
    if (log and matches[3][1] != "log") or "log" in [match[1] for match in matches[:3]]:
        raise UcritError(f"{thing}: {text!r} is no range; 'log' comes fourth and nothing else does; {HOW}")
    ends = [parts[0], f"{parts[1]} {tail}"]
    low, high = _numbers(ends, unit, thing, text)
    return low, high, _count(matches[2][1] if len(parts) > 2 else str(COUNT), thing), log


def _count(text: str, thing: str) -> int:
    value = float(text)
    if not value.is_integer() or not 2 <= value <= MAX_COUNT:
        raise UcritError(f"{thing}: the number of points must be a whole number from 2 to {MAX_COUNT}, got {text}")
    return int(value)


def _match(part: str, thing: str, text: str) -> Any:
    match = _PART.match(part)
    if match is None or match[1] is None:
        raise UcritError(f"{thing}: {part.strip()!r} in {text!r} is not a number; {HOW}")
    return match


def _numbers(parts: list[str], unit: str, thing: str, text: str) -> list[float]:
    """Return numbers in SI units; each takes the next unit to its right."""
    matches = [_match(part, thing, text) for part in parts]
    units = [match[2] for match in matches]
    if any(units) and not units[-1]:
        raise UcritError(f"{thing}: {parts[-1].strip()!r} in {text!r} follows a unit and needs one too")
    for i in reversed(range(len(units) - 1)):
        units[i] = units[i] or units[i + 1]
    if "log" in [match[1] for match in matches]:
        raise UcritError(f"{thing}: 'log' in {text!r} is not a number; {HOW}")
    values = [to_si(f"{match[1]} {u}", unit, thing) for match, u in zip(matches, units, strict=True)]
    if not np.isfinite(values).all():
        raise UcritError(f"{thing} must be finite, got {text!r}")
    return values
