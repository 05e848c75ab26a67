"""Slopes of large formulas by the chain rule over their shared pieces.

A formula of a thousand operations whose pieces occur again and again has slopes of a hundred thousand; taken piece by
piece, each is differentiated once (forward accumulation: A. Griewank and A. Walther, Evaluating Derivatives, 2nd
edition (2008), section 3.1).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import count
from typing import Any

import sympy as sp
from sympy.logic.boolalg import Boolean

Step = tuple[Any, Any]


@dataclass(frozen=True)
class Staged:
    """Slopes as a sequence of small formulas: each step names one, which later steps and ``slopes`` use.

    ``slopes`` has those that are not zero, by the place of the expression and of the variable.
    """

    steps: tuple[Step, ...]
    slopes: Mapping[tuple[int, int], Any]


def staged_slopes(expressions: Sequence[Any], variables: Sequence[Any]) -> Staged:
    """Differentiate expressions by variables; a sign's slope is zero also where it jumps."""
    pieces = (sp.Dummy(f"t{i}", real=True) for i in count())
    shared, results = sp.cse([sp.sympify(e) for e in expressions], symbols=pieces, order="none")
    names = (sp.Dummy(f"d{i}", real=True) for i in count())
    steps: list[Step] = []
    known: dict[Any, dict[int, Any]] = {v: {j: sp.S.One} for j, v in enumerate(variables)}
    for symbol, value in shared:
        steps.append((symbol, value))
        if not isinstance(value, Boolean) or value.is_Symbol:
            known[symbol] = _named(_gradient(value, known), steps, names)
    found = {(i, j): slope for i, e in enumerate(results) for j, slope in sorted(_gradient(e, known).items())}
    return Staged(tuple(steps), found)


def _gradient(value: Any, known: Mapping[Any, Mapping[int, Any]]) -> dict[int, Any]:
    """Return the slopes of a piece by those variables that it depends on."""
    terms: dict[int, list[Any]] = {}
    for symbol in sorted(value.free_symbols & known.keys(), key=str):
        if not known[symbol]:
            continue
        slope = value.diff(symbol).replace(sp.DiracDelta, lambda *_: sp.S.Zero)
        if slope != 0:
            for j, inner in known[symbol].items():
                terms.setdefault(j, []).append(_times(slope, inner))
    sums = {j: sp.Add(*each) for j, each in terms.items()}
    return {j: total for j, total in sums.items() if total != 0}


def _times(slope: Any, inner: Any) -> Any:
    """Multiply a slope by that of what is inside, branch by branch: one that does not count may have no slope."""
    if inner.is_number or not slope.has(sp.Piecewise):
        return slope * inner
    if slope.is_Add:
        return sp.Add(*(_times(term, inner) for term in slope.args))
    if slope.is_Mul:
        within = next((f for f in slope.args if f.is_Piecewise or (f.is_Add and f.has(sp.Piecewise))), None)
        if within is not None:
            return sp.Mul(*(_times(f, inner) if f is within else f for f in slope.args))
    if slope.is_Piecewise:
        return sp.Piecewise(*((_times(value, inner), holds) for value, holds in slope.args), evaluate=False)
    return slope * inner


def _named(gradient: dict[int, Any], steps: list[Step], names: Iterator[Any]) -> dict[int, Any]:
    """Give each slope of a piece a name of its own, but for numbers and names."""
    found = {}
    for j, slope in gradient.items():
        if slope.is_number or slope.is_Symbol:
            found[j] = slope
        else:
            found[j] = next(names)
            steps.append((found[j], slope))
    return found


def slopes_at(expressions: Sequence[Any], variables: Sequence[Any], point: Mapping[Any, Any]) -> dict[Any, Any]:
    """Return the slopes that are not zero at a point, by the places of expression and variable."""
    staged, values = staged_slopes(expressions, variables), dict(point)
    for symbol, value in staged.steps:
        values[symbol] = value.xreplace(values)
    found = {place: slope.xreplace(values) for place, slope in staged.slopes.items()}
    return {place: slope for place, slope in found.items() if slope != 0}
