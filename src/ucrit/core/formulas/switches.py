"""Where equations have kinks: the comparisons that choose between cases of a law, and the arguments of sizes."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import combinations
from typing import Any

import sympy as sp
from sympy.core.relational import Relational

from .plane import computable


def switches(expressions: Iterable[Any]) -> list[Any]:
    """Return the values at whose zeros expressions may have kinks or jumps.

    What only a condition is made of, such as the size in ``where(abs(x) < 1, x, 0)``, has no kink that matters.

    >>> x, y = sp.symbols("x y", real=True)
    >>> sorted(map(str, switches([sp.Piecewise((x, abs(x) < 1), (0, True)) + abs(y)])))
    ['Abs(x) - 1', 'y']
    """
    found: dict[Any, None] = {}
    seen: set[Any] = set()

    def add(value: Any) -> None:
        if -value not in found:
            found[value] = None

    def walk(e: Any) -> None:
        if e in seen or not e.args:
            return
        seen.add(e)
        if isinstance(e, sp.Piecewise):
            for value, condition in e.args:
                for comparison in sorted(condition.atoms(Relational), key=sp.default_sort_key):
                    add(comparison.lhs - comparison.rhs)
                walk(value)
            return
        if isinstance(e, sp.Abs | sp.sign):
            add(e.args[0])
        elif isinstance(e, sp.Max | sp.Min):
            for a, b in combinations(e.args, 2):
                add(a - b)
        for part in e.args:
            walk(part)

    for expression in expressions:
        walk(computable(sp.sympify(expression)))
    return list(found)
