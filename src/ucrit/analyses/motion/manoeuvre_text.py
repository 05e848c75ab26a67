"""Shapes of inputs as text: ``step 2 deg at 1 s``, ``gust 15 m/s at 1 s over 0.5 s + step 3 m/s at 2 s``.

A text is a shape's name, its size, and pairs of a word and a value in any order; shapes are joined by ``+``. A text
that begins with a number is a constant.
"""

from __future__ import annotations

import re
from typing import Any

from ...core.errors import UcritError, near_match
from .manoeuvres import Gust, Measured, Pulse, Ramp, Shape, Sine, SineWithDwell, Step, Sum

WORDS = {"at": "at", "over": "over", "with": "frequency", "hold": "dwell"}
"""Words of the grammar and the arguments that they give."""

SHAPES: dict[str, tuple[type[Any], tuple[str, ...], tuple[str, ...], str]] = {
    "step": (Step, (), ("at",), "step 2 deg at 1 s"),
    "ramp": (Ramp, ("over",), ("at",), "ramp 2 deg at 1 s over 3 s"),
    "sine": (Sine, ("with",), ("at", "over"), "sine 2 deg with 0.5 Hz at 1 s over 4 s"),
    "dwell": (SineWithDwell, (), ("with", "at", "hold"), "dwell 5 deg with 0.7 Hz at 1 s hold 0.5 s"),
    "pulse": (Pulse, ("over",), ("at",), "pulse 2 deg at 1 s over 0.2 s"),
    "gust": (Gust, ("over",), ("at",), "gust 15 m/s at 1 s over 0.5 s"),
}
"""Shape, words it needs, words it may have, and an example."""

TABLE = "table"


def parse_shape(text: str, thing: str) -> Shape | None:
    """Return the shape that a text describes, ``None`` for a text that is no shape but a value.

    Parameters
    ----------
    text
        Such as ``"ramp 2 deg at 1 s over 3 s"`` or ``"table steer.csv column delta"``.
    thing
        What it is, for error messages.

    Raises
    ------
    UcritError
        One sentence about the word that is wrong or missing.

    Examples
    --------
    >>> parse_shape("step 2 deg at 1 s", "input delta_f")
    Step(size='2 deg', at='1 s')
    """
    if not re.match(r"\s*[A-Za-z]", text) or re.match(r"\s*[+-]?(nan|inf)", text, re.IGNORECASE):
        return None
    if text.split()[0].lower() == TABLE:
        return _table(text, thing)
    shapes = [_one(part, thing) for part in re.split(r"\s\+\s", text.strip())]
    return shapes[0] if len(shapes) == 1 else Sum(tuple(shapes))


def _one(text: str, thing: str) -> Shape:
    name, *rest = text.split()
    if name.lower() not in SHAPES:
        raise UcritError(f"{thing}: there is no shape '{name}'{near_match(name, [*SHAPES, TABLE])}")
    made, needed, allowed, example = SHAPES[name.lower()]
    found = _pairs(rest, name.lower(), thing, (*needed, *allowed), example)
    for word in ("size", *needed):
        if word not in found:
            raise UcritError(f"{thing}: {name} lacks {_meaning(word)}; write it like '{example}'")
    shape: Shape = made(**{WORDS.get(word, word): value for word, value in found.items()})
    return shape


def _pairs(words: list[str], name: str, thing: str, allowed: tuple[str, ...], example: str) -> dict[str, str]:
    """Return the value behind each word of a shape; the first is the size."""
    found: dict[str, str] = {}
    word, value = "size", list[str]()
    for token in [*words, ""]:
        is_word = token.isalpha() and bool(value) and (token in WORDS or _starts_pair(token, value))
        if token and not is_word and token not in WORDS:
            value.append(token)
            continue
        if value or word != "size":
            _take(found, word, value, f"{thing}: {name}", example)
        if token and token not in allowed:
            raise UcritError(f"{thing}: {name} takes no '{token}'{near_match(token, allowed)}")
        word, value = token, []
    return found


def _starts_pair(token: str, value: list[str]) -> bool:
    """Tell whether a word stands where a unit cannot: behind a number with its unit."""
    return len(value) > 1 and re.fullmatch(r"[a-z]{2,}", token) is not None


def _take(found: dict[str, str], word: str, value: list[str], thing: str, example: str) -> None:
    if not value:
        raise UcritError(f"{thing} has no value behind '{word}'; write it like '{example}'")
    if word in found:
        raise UcritError(f"{thing} has '{word}' twice, {found[word]!r} and {' '.join(value)!r}")
    found[word] = " ".join(value)


def _meaning(word: str) -> str:
    return {"size": "a size", "over": "a duration, 'over'", "with": "a frequency, 'with'"}[word]


def _table(text: str, thing: str) -> Measured:
    match = re.fullmatch(r"\s*table\s+(.+?)(?:\s+column\s+(\S+))?\s*", text, re.IGNORECASE)
    if match is None:
        raise UcritError(
            f"{thing}: a table is a file's name, such as 'table steer.csv' or 'table steer.csv column delta'"
        )
    return Measured(match[1], match[2] or "")
