"""Formulas over several lines, and numbers rounded so that they keep their promise."""

from __future__ import annotations

import math
from collections.abc import Iterator

from ..analyses.results.digits import decimal_text, rounded
from ..analyses.stability.advice import DIGITS

STEP = 2
"""Columns by which a line is indented for each bracket that is open where it starts."""


def wrap_formula(text: str, width: int) -> list[str]:
    """Break a formula before ``+``, ``-``, ``>`` or between factors, where the fewest brackets are open.

    >>> wrap_formula("a*(b + c)*(d - e) + f*(g + h) > 0", 24)
    ['a*(b + c)*(d - e)', '+ f*(g + h) > 0']
    """
    lines: list[str] = []
    depth, rest = 0, text
    while True:
        indent = min(STEP * depth, width // 2)
        room = width - indent
        if len(rest) <= room:
            return [*lines, " " * indent + rest]
        at, level = _best_break(rest, room)
        lines.append(" " * indent + rest[:at].rstrip())
        depth, rest = max(depth + level, 0), rest[at:].lstrip()


def _best_break(text: str, room: int) -> tuple[int, int]:
    """Return where to break within the room, and how many brackets are then open."""
    possible = [b for b in _breaks(text) if b[0] > 0]
    breaks = [b for b in possible if b[0] <= room] or possible[:1] or [(len(text), 0, 0)]
    late = [b for b in breaks if b[0] > room / 3] or breaks
    at, depth, _ = min(late, key=lambda b: (b[1:], -b[0]))
    return at, depth


def _breaks(text: str) -> Iterator[tuple[int, int, int]]:
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
