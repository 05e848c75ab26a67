"""Stability changes along a parameter in which the characteristic polynomial is a polynomial: exactly, none missed."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import zip_longest
from typing import Any

from ...core.contract.model import Model
from ...core.numeric.compiled import compiled, direction
from ...numerics.determinants import hurwitz_polynomial
from ...numerics.exact import interpolate
from ...numerics.real_roots import real_roots
from ...numerics.routh import routh

Polynomial = list[Fraction]


def factor_polynomials(vehicle: Model, name: str) -> list[list[Polynomial]] | None:
    """Return the characteristic polynomial's factors, their coefficients as exact polynomials in one parameter.

    ``None`` where they are no polynomials in it. Roots that are zero whatever the parameters are left out.
    """
    functions = compiled(type(vehicle), direction(vehicle))
    degrees = functions.degrees(name)
    if degrees is None:
        return None
    arguments = {key: Fraction(float(value)) for key, value in vehicle.values.items()}
    nodes = [Fraction(k) for k in range(max(degrees) + 1)]
    rows = [functions.exact_factors([*{**arguments, name: node}.values()]) for node in nodes]
    return [
        [interpolate(nodes, [Fraction(v) for v in column]) for column in zip(*factor, strict=True)]
        for factor in zip(*rows, strict=True)
    ]


def exact_search(vehicle: Model, name: str, lo: float, hi: float) -> Any:
    """Return boundary values with the kinds that meet there, and the stability of the intervals between.

    ``None`` where the model is no polynomial in the parameter, or a boundary polynomial vanishes identically.
    """
    factors = factor_polynomials(vehicle, name)
    if factors is None:
        return None
    if len(factors) == 1 and len(factors[0]) > 2 and not any(any(p) for p in factors[0][1::2]):
        factors = [_undamped(factors[0])]
    edges: dict[float, set[str]] = {}
    for kind, p in [pair for a in factors for pair in _boundaries(a)]:
        if not any(p):
            return None
        for value, _ in real_roots(p, lo, hi) if len(p) > 1 else ():
            if lo < value < hi:
                edges.setdefault(value, set()).add(kind)
    values = sorted(edges)
    samples = [_between(x, y) for x, y in zip([lo, *values], [*values, hi], strict=True)]
    return [(v, edges[v]) for v in values], [all(_is_stable(a, at) for a in factors) for at in samples]


def _boundaries(a: list[Polynomial]) -> Iterator[tuple[str, Polynomial]]:
    """Return what vanishes where stability of one factor changes, with its kind."""
    yield "divergence", a[0]
    yield "order", a[-1]
    if len(a) > 2:
        yield "flutter", hurwitz_polynomial(a)


def _undamped(a: list[Polynomial]) -> list[Polynomial]:
    """Return p + p' for an even p: stable if and only if p has simple roots on the imaginary axis only."""
    slopes: list[Polynomial] = [*([(k + 1) * c for c in p] for k, p in enumerate(a[1:])), []]
    return [[x + y for x, y in zip_longest(p, q, fillvalue=Fraction(0))] for p, q in zip(a, slopes, strict=True)]


def _between(lo: float, hi: float) -> Fraction:
    if math.isinf(lo) and math.isinf(hi):
        return Fraction(0)
    if math.isinf(lo):
        return Fraction(hi) - 1 - abs(Fraction(hi))
    if math.isinf(hi):
        return Fraction(lo) + 1 + abs(Fraction(lo))
    return (Fraction(lo) + Fraction(hi)) / 2


def _is_stable(a: Sequence[Polynomial], at: Fraction) -> bool:
    numbers = [sum((c * at**k for k, c in enumerate(p)), Fraction(0)) for p in a]
    if not numbers[-1]:
        return False
    array = routh(numbers)
    return array.right_half_plane == 0 and array.imaginary_axis == 0
