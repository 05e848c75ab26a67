"""Functions of parameters inside polynomials: ``cos(beta)`` stands in for a symbol whose sign the bounds settle."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Any

import sympy as sp

from .declare import Parameter

Swap = dict[Any, Any]


def function_symbols(expressions: Iterable[Any], parameters: Mapping[Any, Parameter]) -> tuple[Swap, Swap]:
    """Return what replaces each function of parameters by a symbol, and what puts it back.

    Symbols are named as the function prints. Sines and cosines of one argument stay related only through
    what simplification did before; a relation between them is not known to the polynomials.
    """
    found: set[Any] = set()
    for expression in expressions:
        found |= {f for f in sp.sympify(expression).atoms(sp.Function) if f.free_symbols}
    outer = [f for f in found if not any(f in g.atoms(sp.Function) and f != g for g in found)]
    swap = {f: sp.Symbol(str(f), **_assumption(f, parameters)) for f in sorted(outer, key=str)}
    return swap, {symbol: f for f, symbol in swap.items()}


def _assumption(function: Any, parameters: Mapping[Any, Parameter]) -> dict[str, bool]:
    """Assumptions for a sine, cosine, tangent or exponential of one parameter, from the parameter's bounds."""
    if isinstance(function, sp.exp):
        return {"positive": True}
    parameter = parameters.get(function.args[0])
    if parameter is None:
        return {"real": True}
    lo, hi, half = parameter.lower, parameter.upper, math.pi / 2
    inside = {sp.cos: (-half, half), sp.sin: (0.0, math.pi), sp.tan: (0.0, half)}.get(function.func)
    if inside is None or not (inside[0] <= lo and hi <= inside[1]):
        return {"real": True}
    closed = (lo == inside[0] and parameter.above != lo) or (hi == inside[1] and parameter.below != hi)
    return {"nonnegative": True} if closed else {"positive": True}
