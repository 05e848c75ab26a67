"""Conditions that a basic motion settles: near it only one branch of a formula counts, and the others are left out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import sympy as sp
from sympy.core.relational import Relational

STRICT = {">": sp.Gt, ">=": sp.Gt, "<": sp.Lt, "<=": sp.Lt}
OPPOSITE = {">": sp.Lt, ">=": sp.Lt, "<": sp.Gt, "<=": sp.Gt}


def settled(expressions: Sequence[Any], basic: Mapping[Any, Any]) -> list[Any]:
    """Return expressions without the branches that do not hold on and around the basic motion.

    A condition that holds as an equality there may hold to one side of it only: its branches stay.
    """
    values, known = {symbol: sp.sympify(value) for symbol, value in basic.items()}, {}

    def walk(e: Any) -> Any:
        if e not in known:
            known[e] = found(e)
        return known[e]

    def found(e: Any) -> Any:
        if isinstance(e, sp.Piecewise):
            return branches(e)
        if not e.args:
            return e
        args = [walk(a) for a in e.args]
        return e if all(new is old for new, old in zip(args, e.args, strict=True)) else e.func(*args)

    def branches(e: Any) -> Any:
        kept = []
        for value, condition in e.args:
            holds = verdict(walk(condition), values)
            if holds is not False:
                kept.append((walk(value), sp.true if holds else walk(condition)))
            if holds:
                break
        return sp.Piecewise(*kept)

    return [walk(e) for e in expressions]


def verdict(condition: Any, values: Mapping[Any, Any]) -> bool | None:
    """Return whether a condition holds around a point, ``None`` where that is open."""
    if isinstance(condition, sp.And | sp.Or):
        each = {verdict(part, values) for part in condition.args}
        decisive = isinstance(condition, sp.Or)
        return decisive if decisive in each else None if None in each else not decisive
    if isinstance(condition, sp.ITE):
        chosen = verdict(condition.args[0], values)
        each = {verdict(part, values) for part in condition.args[1:] if chosen is None}
        if chosen is None:
            return each.pop() if len(each) == 1 else None
        return verdict(condition.args[1 if chosen else 2], values)
    if isinstance(condition, Relational) and condition.rel_op in STRICT:
        sides = [side.xreplace(dict(values)) for side in condition.args]
        if any(side.is_extended_real is not True for side in sides):  # in a branch that cannot be, a pole
            return None
        if STRICT[condition.rel_op](*sides) == True:  # noqa: E712
            return True
        return False if OPPOSITE[condition.rel_op](*sides) == True else None  # noqa: E712
    return True if condition == True else False if condition == False else None  # noqa: E712
