"""Corners of equations on a basic motion: laws that jump there, or bend, and so have no slope of their own."""

from __future__ import annotations

import cmath
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import sympy as sp
from sympy.core.relational import Relational

from .settle import settled

SMALL = 1e-9
"""Difference, for parameters of order 1, below which two sides of a law are the same."""

LAWS = (sp.Piecewise, sp.Abs, sp.sign, sp.Max, sp.Min)


def corners(expressions: Sequence[Any], by: Sequence[Any], basic: Mapping[Any, Any]) -> list[tuple[str, str]]:
    """Return where expressions jump (``"jump"``) or bend (``"kink"``) on a basic motion, as a text such as ``v``.

    The text is what vanishes there. A law that does not matter, as in ``v*abs(v)``, is left out.

    >>> x, v, F = sp.symbols("x v F", real=True)
    >>> corners([F * sp.sign(v), x + v * abs(v), sp.Max(x, 2 * x)], [x, v], {x: 0, v: 0})
    [('jump', 'v'), ('kink', 'x')]
    """
    found: dict[tuple[str, str], None] = {}
    for e in settled(expressions, basic):
        for law in sorted(e.atoms(*LAWS), key=sp.default_sort_key):
            for border, sides in _sides(law):
                if _vanishes(border, basic) and (kind := _corner(e, law, sides, by, basic)):
                    found[kind, str(border.as_independent(*basic, as_Add=False)[1])] = None
    return sorted(found)


def _sides(law: Any) -> Iterator[tuple[Any, tuple[Any, ...]]]:
    """Yield what changes its sign where a law may have a corner, and the branches that meet there."""
    if isinstance(law, sp.Piecewise):
        borders = {c.lhs - c.rhs: None for _, condition in law.args for c in sorted_comparisons(condition)}
        for border in borders:
            yield border, tuple(value for value, _ in law.args)
    elif isinstance(law, sp.Abs):
        yield law.args[0], (law.args[0], -law.args[0])
    elif isinstance(law, sp.sign):
        yield law.args[0], (sp.S.One, -sp.S.One)
    else:
        first, *others = law.args
        for other in others:
            yield first - other, (first, other)


def sorted_comparisons(condition: Any) -> list[Any]:
    """Return the comparisons of a condition in an order that does not change."""
    return sorted(condition.atoms(Relational), key=sp.default_sort_key)


def _vanishes(border: Any, basic: Mapping[Any, Any]) -> bool:
    return bool(border.free_symbols & basic.keys()) and _size(border.xreplace(dict(basic))) < SMALL


def _corner(e: Any, law: Any, sides: Sequence[Any], by: Sequence[Any], basic: Mapping[Any, Any]) -> str:
    """Tell how an expression differs between the sides of one of its laws: in value, in slope, or not at all."""
    at, held = dict(basic), sp.Dummy("law", real=True)
    whole = e.xreplace({law: held})
    inside = [symbol for symbol in by if e.has(symbol)]
    values = [side.xreplace(at) for side in sides]
    if any(not cmath.isfinite(_number(value)) for value in values):
        return ""
    results = [whole.xreplace({held: value, **at}) for value in values]
    if any(_size(result - results[0]) > SMALL for result in results[1:]):
        return "jump"
    across = whole.diff(held)
    for symbol in inside:
        along = whole.diff(symbol)
        slopes = [
            (along + across * side.diff(symbol)).xreplace({held: value, **at})
            for side, value in zip(sides, values, strict=True)
        ]
        if any(_size(slope - slopes[0]) > SMALL for slope in slopes[1:]):
            return "kink"
    return ""


def _size(expression: Any) -> float:
    return abs(_number(expression))


def _number(expression: Any) -> complex:
    """Put numbers of order 1, none of them a simple ratio of others, in for all symbols."""
    expression = sp.sympify(expression)
    symbols = sorted(expression.free_symbols, key=str)
    numbers = {s: sp.Float(0.61 + 0.37 * ((k * 0.6180339887) % 1), 30) for k, s in enumerate(symbols, 1)}
    try:
        return complex(expression.xreplace(numbers))
    except (TypeError, ValueError, ZeroDivisionError):
        return complex("nan")
