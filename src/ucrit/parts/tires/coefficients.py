"""Coefficients of empirical tire laws, as floats for numbers and as exact fractions for symbols."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any

from ...core.contract.part import Part
from ...core.errors import UcritError, near_match
from ...core.formulas.functions import atan


class Coefficients:
    """The numbers of a law, read as attributes; one that the law does without is its neutral value.

    Exact where the part's parameters are symbols: a decimal as it was written keeps formulas short.
    """

    def __init__(self, law: Part, neutral: Mapping[str, float], dropped: Collection[str] = ()) -> None:
        self._law, self._neutral, self._dropped = law, neutral, dropped
        self._exact = any(hasattr(value, "free_symbols") for value in law.__dict__.values())

    def __getattr__(self, name: str) -> Any:
        value = 0 if name in self._dropped else self._law.constants.get(name, self._neutral.get(name, 0))
        if self._exact and isinstance(value, float):
            import sympy

            value = sympy.Rational(str(value))
        self.__dict__[name] = value
        return value


def curve(x: Any, C: Any, E: Any) -> Any:
    """Return the argument of the magic formula's sine or cosine, ``C atan(x - E (x - atan x))`` with ``x = B slip``."""
    bent = atan(x)
    return C * atan(x - E * (x - bent))


def check_switches(law: type[Part], allowed: Mapping[str, tuple[Any, ...]]) -> None:
    """Raise `UcritError` where a law has a switch in a place that it does not have."""
    for name, values in allowed.items():
        chosen = law.constants.get(name, values[0])
        if chosen not in values:
            near = near_match(str(chosen), [str(v) for v in values])
            raise UcritError(f"{law.part_id()}: switch {name} cannot be {chosen!r}{near}")
