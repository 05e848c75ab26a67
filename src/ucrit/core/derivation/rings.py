"""Fields and rings of polynomials in the parameters, in which all symbolic arithmetic is done.

Functions of parameters inside polynomials, such as ``cos(beta)``, become symbols whose sign the bounds settle.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import sympy as sp
from sympy.polys.constructor import construct_domain
from sympy.polys.rings import PolyElement, PolyRing

from ..contract.declare import Parameter
from ..errors import ModelError
from ..formulas.grouped import Group

MAX_TRIGSIMP = 400
"""Operations in expressions with sines and cosines above which those are not simplified: it would take minutes."""

Swap = dict[Any, Any]
Row = list[list[Any]]  # row[j][k]: coefficient of the k-th derivative of variable j


def function_symbols(expressions: Iterable[Any], parameters: Mapping[Any, Parameter]) -> tuple[Swap, Swap]:
    """Return what replaces each function or square root of parameters by a symbol, and what puts it back.

    Symbols are named as the function prints. Sines and cosines of one argument stay related only through
    what simplification did before; a relation between them is not known to the polynomials.
    """
    found: set[Any] = set()
    for expression in expressions:
        found |= {
            f for f in sp.sympify(expression).atoms(sp.Function, sp.Pow) if f.free_symbols and not _is_rational(f)
        }
    kept = {f: sp.sqrt(f.base) if f.is_Pow else f for f in found}
    outer = {f for f in kept.values() if isinstance(f, Group) or not any(g.has(f) and f != g for g in kept.values())}
    names = {f: sp.Symbol(str(f), **_assumption(f, parameters)) for f in sorted(outer, key=str)}
    swap = {f: names[root] ** (2 * f.exp) if f.is_Pow else names[f] for f, root in kept.items() if root in names}
    return swap, {symbol: f for f, symbol in names.items()}


def _is_rational(expression: Any) -> bool:
    """Tell a power that polynomials have, or that no square root makes one of, from other functions."""
    return bool(expression.is_Pow and (expression.exp.is_Integer or not (2 * expression.exp).is_Integer))


def _assumption(function: Any, parameters: Mapping[Any, Parameter]) -> dict[str, bool]:
    """Assumptions for a sine, cosine, tangent or exponential of one parameter, from the parameter's bounds."""
    if isinstance(function, sp.exp) or function.is_positive:
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


def polynomial_field(expressions: Sequence[Any], bounds: Mapping[Any, Any]) -> tuple[Any, list[Any], dict[Any, Any]]:
    """Return a field of rational functions in the parameters, the expressions in it, and what its symbols stand for."""
    simple = [sp.sympify(e) for e in expressions]
    waves = [e.has(sp.sin, sp.cos, sp.tan) for e in simple]
    if sum(e.count_ops() for e, wave in zip(simple, waves, strict=True) if wave) <= MAX_TRIGSIMP:
        simple = [sp.trigsimp(e) if wave else e for e, wave in zip(simple, waves, strict=True)]
    swap, back = function_symbols(simple, bounds)
    domain, elements = construct_domain([e.xreplace(swap) for e in simple], field=True)
    return domain, elements, back


def cleared_row(entries: Row, domain: Any, ring: PolyRing, s: PolyElement) -> list[PolyElement]:
    """Multiply a row by its common denominator and write it in the ring of parameters and ``s``."""
    pairs = [[integer_fraction(e, domain, ring) for e in chain] for chain in entries]
    common = ring.one
    for chain in pairs:
        for numerator, denominator in chain:
            if numerator:
                common = common.lcm(denominator)
    return [
        sum((num * common.exquo(den) * s**k for k, (num, den) in enumerate(chain) if num), ring.zero) for chain in pairs
    ]


def integer_fraction(element: Any, domain: Any, ring: PolyRing) -> tuple[PolyElement, PolyElement]:
    """Return numerator and denominator of a field element in a ring with one symbol more and integer coefficients."""
    if not domain.is_Composite:
        if not hasattr(element, "numerator"):
            raise ModelError("the equations hold terms that are no ratio of polynomials, which this analysis needs")
        return ring(int(element.numerator)), ring(int(element.denominator))
    num, content_n = element.numer.clear_denoms()[::-1]
    den, content_d = element.denom.clear_denoms()[::-1]
    return _lift(num, ring) * int(content_d), _lift(den, ring) * int(content_n)


def _lift(poly: PolyElement, ring: PolyRing) -> PolyElement:
    return ring.from_dict({(*monom, 0): int(c) for monom, c in poly.terms()})
