"""The characteristic polynomial ``det sum_k P_k s^k``, kept as the product of its blocks'.

What acts on others without being acted on, an actuator or the errors of an observer, has a polynomial of its own. Ten
states multiplied out are ten thousand terms; their factors have a few hundred.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from math import prod
from typing import Any

import sympy as sp
from sympy.polys.rings import PolyElement, PolyRing

from ..errors import ModelError
from ..formulas.factor import common_divisor
from ..formulas.minors import block_determinants
from ..formulas.twins import Twins, untwinned
from .rings import cleared_row, polynomial_field

Part = tuple[PolyElement, ...]


@dataclass(frozen=True)
class CharacteristicPolynomial:
    """``a_0 + a_1 s + ... + a_n s^n`` over a ring of polynomials in the parameters, free of common factors.

    ``parts`` holds its factors, each by its coefficients, ascending; ``functions`` maps those of the ring's symbols
    that stand for a function of parameters to that function.
    """

    ring: PolyRing
    parts: tuple[Part, ...]
    functions: Mapping[Any, Any] = field(default_factory=dict)

    @cached_property
    def coefficients(self) -> Part:
        """The coefficients multiplied out, ascending."""
        return tuple(product(self.parts, self.ring.one, lambda terms: sum(terms, self.ring.zero)))

    @property
    def order(self) -> int:
        """Number of roots."""
        return sum(len(part) - 1 for part in self.parts)

    @property
    def zeros(self) -> int:
        """Number of roots that are zero whatever the parameters."""
        return sum(map(_zeros, self.parts))

    @property
    def static(self) -> PolyElement:
        """The lowest coefficient that is not zero."""
        return prod((part[_zeros(part)] for part in self.parts), start=self.ring.one)

    @property
    def static_expression(self) -> Any:
        """The same as a SymPy expression, a product that is not multiplied out."""
        return sp.Mul(*(part[_zeros(part)].as_expr().xreplace(dict(self.functions)) for part in self.parts))

    @property
    def leading(self) -> PolyElement:
        """The highest coefficient."""
        return prod((part[-1] for part in self.parts), start=self.ring.one)

    @property
    def undamped(self) -> bool:
        """Whether all roots that are not zero come in pairs of opposite sign, factor by factor."""
        return not any(part[k] for part in self.parts for k in range(_zeros(part) + 1, len(part), 2))

    @property
    def expressions(self) -> tuple[Any, ...]:
        """The coefficients as SymPy expressions, ascending; products are left as they are."""
        swap = dict(self.functions)
        parts = [[a.as_expr().xreplace(swap) for a in part] for part in self.parts]
        return tuple(product(parts, sp.S.One, lambda terms: sp.Add(*terms)))

    @property
    def factors(self) -> list[Part]:
        """The parts without roots that are zero, and without those of no other root; one if any of them is undamped."""
        bare = [part[_zeros(part) :] for part in self.parts if len(part) > _zeros(part) + 1]
        if any(not any(part[1::2]) for part in bare):
            return [self.coefficients[self.zeros :]]
        return bare

    def bounds(self) -> tuple[list[Any], list[int]]:
        """Return sums of the sizes of all terms of each coefficient, and how often those round."""
        sizes = [[self.ring.from_dict({m: abs(c) for m, c in a.terms()}).as_expr() for a in p] for p in self.parts]
        units = [[len(a) + 6 * max((sum(m) for m in a.itermonoms()), default=0) + 8 for a in p] for p in self.parts]
        return (
            product(sizes, sp.S.One, lambda terms: sp.Add(*terms)),
            product(units, 0, lambda terms: max(terms) + len(terms), lambda a, b: a + b + 1),
        )

    def degrees(self, symbol: Any) -> list[int] | None:
        """Degree at most of each coefficient in a parameter; ``None`` where it also occurs inside a function."""
        if any(f.has(symbol) for f in self.functions.values()):
            return None
        if symbol not in self.ring.symbols:
            return [0] * (self.order + 1)
        index = self.ring.symbols.index(symbol)
        parts = [[max((m[index] for m in a.itermonoms()), default=0) for a in part] for part in self.parts]
        return product(parts, 0, max, lambda a, b: a + b)


def product(parts: Any, one: Any, add: Any, times: Any = lambda a, b: a * b) -> list[Any]:
    """Return the coefficients of a product of polynomials, ascending, with one's own sums and products."""
    found = [one]
    for part in parts:
        if len(found) == 1 and found[0] is one:
            found = list(part)
            continue
        pairs: list[list[Any]] = [[] for _ in range(len(found) + len(part) - 1)]
        for i, a in enumerate(found):
            for j, b in enumerate(part):
                pairs[i + j].append(times(a, b))
        found = [add(terms) for terms in pairs]
    return found


def _zeros(part: Part) -> int:
    return next(i for i, a in enumerate(part) if a)


def characteristic_polynomial(
    P: Sequence[sp.Matrix],
    where: str = "model",
    bounds: Mapping[Any, Any] | None = None,
    twins: Twins = (),
) -> CharacteristicPolynomial:
    """Return ``det sum_k P_k s^k`` with denominators cleared row by row and common factors removed.

    The leading coefficient's sign is chosen so that its first term is positive.
    """
    n = P[0].rows
    domain, elements, functions = polynomial_field([e for M in P for e in M], bounds or {})
    symbols = domain.symbols if domain.is_Composite else ()
    ring = PolyRing((*symbols, sp.Dummy("s")), sp.ZZ, "lex")
    chains = [[[elements[k * n * n + i * n + j] for k in range(len(P))] for j in range(n)] for i in range(n)]
    rows = [cleared_row(row, domain, ring, ring.gens[-1]) for row in untwinned(chains, twins, domain.zero)]
    found = list(block_determinants(rows, ring))
    if not all(found):
        raise ModelError(f"{where}: the equations of motion are not independent (their determinant is zero)")
    inner = PolyRing(tuple(symbols), sp.ZZ, "lex")
    parts = [part for block in found if len(part := _collect(block, inner)) > 1]
    return CharacteristicPolynomial(inner, tuple(parts) or ((inner.one,),), functions)


def _collect(determinant: PolyElement, ring: PolyRing) -> Part:
    """Split a polynomial in parameters and ``s`` by powers of ``s``, and divide by what all parts share."""
    parts: dict[int, dict[tuple[int, ...], Any]] = {}
    for monom, c in determinant.terms():
        parts.setdefault(monom[-1], {})[monom[:-1]] = c
    return primitive([ring.from_dict(parts.get(k, {})) for k in range(max(parts) + 1)])


def primitive(coefficients: Sequence[PolyElement]) -> Part:
    """Return coefficients with what they share divided out, the leading term positive."""
    common = coefficients[-1].ring.zero
    for a in coefficients:
        common = common_divisor(common, a)
    if coefficients[-1].LC * common.LC < 0:
        common = -common
    return tuple(a.exquo(common) for a in coefficients)
