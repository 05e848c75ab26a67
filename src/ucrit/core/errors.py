"""Errors that a user can act on: one sentence with the thing, the value and what is allowed."""

from __future__ import annotations

from collections.abc import Iterable


class UcritError(ValueError):
    """Bad input, told in one sentence; front ends print it without a traceback."""


class ModelError(UcritError):
    """A declaration or an equation of a model that cannot be right."""


class MissingExtraError(UcritError):
    """A feature needs an optional package that is not installed."""


MOST_NAMES = 30
FIRST_NAMES = 10
"""Names that are told where none is near: so many of a longer list."""


def near_match(name: str, allowed: Iterable[str]) -> str:
    """Return ``"; did you mean 'x'?"`` for the closest allowed name, or those that are allowed if none is close.

    >>> near_match("C_ff", ["C_f", "C_r"])
    "; did you mean 'C_f'?"
    >>> near_match("CC", ["C", "c"])
    "; did you mean 'C'?"
    >>> near_match("zzz", ["C_f", "C_r"])
    '; allowed: C_f, C_r'
    """
    from difflib import get_close_matches

    choices, name = list(allowed), str(name)
    match = get_close_matches(
        name.lower(), [choice.lower() for choice in choices], n=1, cutoff=0.5 if len(name) < 4 else 0.55
    )
    if match:
        same = [choice for choice in choices if choice.lower() == match[0]]  # C and c may both be allowed
        return f"; did you mean '{max(same, key=lambda choice: sum(c in name for c in choice))}'?"
    if len(choices) > MOST_NAMES:
        return f"; allowed: {', '.join(choices[:FIRST_NAMES])} and {len(choices) - FIRST_NAMES} more"
    return f"; allowed: {', '.join(choices) if choices else 'none'}"
