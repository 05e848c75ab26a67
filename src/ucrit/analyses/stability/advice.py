"""A remedy in words and few digits, rounded to the side on which it still helps."""

from __future__ import annotations

from dataclasses import dataclass
from decimal import Decimal
from typing import TYPE_CHECKING, Any

import numpy as np

from ...core.contract.possible import allowed
from ..results.digits import decimal_text, rounded
from .judge import judge
from .remedies import SPEEDS, Remedy

if TYPE_CHECKING:
    from .analyze import Analysis

DIGITS = 4

NOTHING = 1e-6
"""A boundary smaller than this share of the present value is zero, up to rounding."""


@dataclass(frozen=True)
class Advice:
    """What to do: ``at least 3.802``, ``below 0``; ``relative`` is the change's share of the present value."""

    word: str
    text: str
    relative: float | None


def advice(remedy: Remedy, found: Analysis) -> Advice:
    """Return a remedy that helps in words, its value with as few digits, from four on, as still help.

    Parameters
    ----------
    remedy
        One of the analysis' remedies, with a value.
    found
        The analysis; each candidate is tried at speeds up to the asked one.

    Examples
    --------
    >>> from ucrit import analyze
    >>> caravan = analyze("caravan")
    >>> advice(caravan.remedies[0], caravan).text
    '3.802'
    """
    assert remedy.value is not None
    rising = remedy.value > remedy.present
    if abs(remedy.value) < NOTHING * abs(remedy.present):
        return Advice("above" if rising else "below", "0", 1.0 if rising else -1.0)
    parameter = allowed(found.vehicle, remedy.parameter)
    for digits in range(DIGITS, 16):
        value = rounded(remedy.value, digits, 1 if rising else -1)
        if parameter.allows(float(value)) and _helps(found, remedy.parameter, float(value)):
            break
    else:
        value = Decimal(remedy.value)
    relative = (float(value) - remedy.present) / abs(remedy.present) if remedy.present else None
    return Advice("at least" if rising else "at most", decimal_text(value), relative)


def _helps(found: Analysis, parameter: str, value: float) -> bool:
    """Tell whether a value, rounded away from the boundary, is still within the stable range of it."""
    changes: dict[str, Any] = {parameter: value}
    name = type(found.vehicle).declaration.speed
    if name is not None and found.speed is not None:
        changes[name] = found.speed * np.linspace(0, 1, SPEEDS + 1)[1:]
    return bool(judge(found.vehicle.with_(**changes)).all())
