"""Formulas over several lines, and numbers rounded so that they keep their promise."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence

from ..analyses.results.digits import decimal_text, rounded
from ..analyses.stability.advice import DIGITS

Place = tuple[int, int, int]

STEP = 2
"""Columns by which a line is indented for each bracket that is open where it starts."""


def wrap_formula(text: str, width: int) -> list[str]:
    """Break a formula before ``+``, ``-``, ``>`` or between factors, where the fewest brackets are open.

    >>> wrap_formula("a*(b + c)*(d - e) + f*(g + h) > 0", 24)
    ['a*(b + c)*(d - e)', '+ f*(g + h) > 0']
    """
    lines: list[str] = []
    places = list(_breaks(text))
    start = level = first = 0
    while True:
        indent = min(STEP * level, width // 2)
        room = width - indent
        if len(text) - start <= room:
            return [*lines, " " * indent + text[start:]]
        while first < len(places) and places[first][0] <= start:
            first += 1
        end, level = _best_break(places, first, start, room) or (len(text), 0)
        lines.append(" " * indent + text[start:end].rstrip())
        start = end + len(text[end:]) - len(text[end:].lstrip())


def _best_break(places: Sequence[Place], first: int, start: int, room: int) -> tuple[int, int] | None:
    """Return where to break within the room, and how many brackets are open there."""
    past = next((i for i in range(first, len(places)) if places[i][0] > start + room), len(places))
    near = places[first:past] or places[first : first + 1]
    late = [p for p in near if p[0] > start + room / 3] or near
    best = min(late, key=lambda p: (p[1:], -p[0]), default=None)
    return best and best[:2]


def _breaks(text: str) -> Iterator[Place]:
    """Yield places, open brackets there, and 1 for the less welcome break between factors."""
    depth = 0
    for i, c in enumerate(text):
        depth += (c == "(") - (c == ")")
        if c == " " and text[i + 1 : i + 2] in ("+", "-", ">"):
            yield i, depth, 0
        elif c == "*" and text[i - 1 : i] == ")" and text[i + 1 : i + 2] != "*":
            yield i + 1, depth, 1


def shorten(text: str, width: int) -> str:
    """Cut a text to a width, saying so by dots."""
    if len(text) <= width:
        return text
    kept = text[: max(width - 3, 0)]
    return (kept.rpartition(" ")[0] or kept).rstrip(" ,") + " ..."


def number(value: float, digits: int = DIGITS) -> str:
    """Return a number with a few significant digits, without an exponent where that is short.

    >>> number(80227.4), number(0.02345678), number(2.1e11), number(-3.0)
    ('80230', '0.02346', '2.1e+11', '-3')
    """
    if not math.isfinite(value):
        return f"{value:g}"
    return decimal_text(rounded(value, digits, 0))


def short_numbers(formula: str) -> str:
    """Return a formula with its decimals in six digits, for reading; whole numbers stay.

    >>> short_numbers("g - 0.2703094957173532*U**2 + 1.0862813934647584e-11*c > 100440")
    'g - 0.270309*U**2 + 1.08628e-11*c > 100440'
    """
    return re.sub(r"(?<![\w.])\d+\.\d+(?:e[-+]?\d+)?", lambda found: f"{float(found[0]):.6g}", formula)
