"""Long equations made readable: what stands in them more than once gets a name."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import count
from typing import Any

import sympy as sp

LONG = 500
"""Operations in one equation above which its repeated pieces are named."""

WORTH = 6
"""Operations that a piece must have to get a name."""


def named_pieces(expressions: Sequence[Any], taken: Iterable[str]) -> tuple[list[Any], dict[Any, Any]]:
    """Return expressions with names for the pieces that recur in them, and these pieces in the order of their use.

    Expressions of which none is long stay as they are. Names differ from those in ``taken``.
    """
    if all(sp.count_ops(e) <= LONG for e in expressions):
        return list(expressions), {}
    shared, left = sp.cse(expressions, symbols=(sp.Dummy() for _ in count()), order="none")
    written: dict[Any, Any] = {}
    pieces: dict[Any, Any] = {}
    names = _names(set(taken))
    for symbol, value in shared:
        piece = value.xreplace(written)
        if sp.count_ops(piece) < WORTH or piece.is_Boolean:
            written[symbol] = piece
        else:
            written[symbol] = next(names)
            pieces[written[symbol]] = piece
    return [e.xreplace(written) for e in left], pieces


def _names(taken: set[str]) -> Iterator[Any]:
    first = {name.partition("_")[0] for name in taken}
    letter = next(letter for letter in "pwznjefo" if letter not in first)
    return (sp.Symbol(f"{letter}_{i}", real=True) for i in count(1))
