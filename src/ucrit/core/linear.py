"""The linear object of a model: ``sum_k P_k q^(k) = Q u``, its explicit form and its characteristic polynomial.

All arithmetic is done in fields and rings of polynomials in the parameters, never on expression trees.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import sympy as sp
from sympy.polys.rings import PolyElement, PolyRing

from .errors import ModelError
from .explicit import Explicit, explicit
from .factor import common_divisor
from .minors import determinant
from .rings import cleared_row, polynomial_field
from .settle import settled
from .slopes import slopes_at
from .trace import Traced, trace

MAX_DIRECT = 1000
"""Operations in equations of motion above which these are differentiated piece by piece."""


@dataclass(frozen=True)
class CharacteristicPolynomial:
    """``a_0 + a_1 s + ... + a_n s^n`` over a ring of polynomials in the parameters, free of common factors.

    ``functions`` maps those of the ring's symbols that stand for a function of parameters to that function.
    """

    ring: PolyRing
    coefficients: tuple[PolyElement, ...]
    functions: Mapping[Any, Any] = field(default_factory=dict)

    @property
    def zeros(self) -> int:
        """Number of roots that are zero whatever the parameters."""
        return next(i for i, a in enumerate(self.coefficients) if a)

    @property
    def expressions(self) -> tuple[Any, ...]:
        """The coefficients as SymPy expressions, ascending."""
        return tuple(a.as_expr().xreplace(dict(self.functions)) for a in self.coefficients)

    def degrees(self, symbol: Any) -> list[int] | None:
        """Degree of each coefficient in a parameter; ``None`` where it also occurs inside a function."""
        if any(f.has(symbol) for f in self.functions.values()):
            return None
        if symbol not in self.ring.symbols:
            return [0] * len(self.coefficients)
        index = self.ring.symbols.index(symbol)
        return [max((m[index] for m in a.itermonoms()), default=0) for a in self.coefficients]


@dataclass(frozen=True)
class LinearSystem:
    """Linear equations about the basic motion, in symbols.

    Attributes
    ----------
    P
        Matrices P_0, P_1, ... of ``sum_k P_k q^(k) = Q u``.
    Q
        Input matrix.
    outputs
        ``(C_k list, D)``: outputs ``y = sum_k C_k q^(k) + D u``.
    """

    traced: Traced
    P: tuple[sp.Matrix, ...]
    Q: sp.Matrix
    C: tuple[sp.Matrix, ...]
    D: sp.Matrix

    @cached_property
    def polynomial(self) -> CharacteristicPolynomial:
        """Characteristic polynomial ``det sum_k P_k s^k``."""
        return characteristic_polynomial(self.P, self.traced.model.model_id(), self.bounds)

    @property
    def bounds(self) -> dict[Any, Any]:
        """Declared parameters by their symbols."""
        declared = self.traced.model.declaration.parameters
        return {symbol: declared[name] for name, symbol in self.traced.parameters.items()}

    @cached_property
    def explicit(self) -> Explicit:
        """Equations solved for one derivative of each variable."""
        return explicit(self)

    def substituted(self, values: Mapping[Any, Any]) -> LinearSystem:
        """Return the system with parameters replaced by exact numbers or other expressions."""
        swap = {k: sp.sympify(v) for k, v in values.items()}
        return LinearSystem(
            self.traced,
            tuple(M.xreplace(swap) for M in self.P),
            self.Q.xreplace(swap),
            tuple(M.xreplace(swap) for M in self.C),
            self.D.xreplace(swap),
        )


def linearize(traced: Traced) -> LinearSystem:
    """Differentiate the residuals and outputs and evaluate them on the basic motion."""
    top, n, m = max(len(chain) for chain in traced.q), len(traced.q), len(traced.u)
    basic = dict(traced.basic)
    by = [symbol for chain in traced.q for symbol in chain] + list(traced.u)

    def matrices(expressions: Sequence[Any]) -> tuple[tuple[sp.Matrix, ...], sp.Matrix]:
        slopes = _slopes(settled(expressions, basic), by, basic)
        found = [sp.zeros(len(expressions), n) for _ in range(top)]
        places = [(k, j) for j, chain in enumerate(traced.q) for k in range(len(chain))]
        driven = sp.zeros(len(expressions), m)
        for (i, place), slope in slopes.items():
            if place < len(places):
                k, j = places[place]
                found[k][i, j] = slope
            else:
                driven[i, place - len(places)] = slope
        return tuple(found), driven

    (P, driven), (C, D) = matrices(traced.residuals), matrices(traced.outputs)
    return LinearSystem(traced, P, -driven, C, D)


def _slopes(expressions: Sequence[Any], by: Sequence[Any], basic: Mapping[Any, Any]) -> dict[tuple[int, int], Any]:
    """Return the slopes on the basic motion that are not zero; of long formulas piece by piece."""
    if sum(e.count_ops() for e in expressions) > MAX_DIRECT:
        return slopes_at(expressions, by, basic)
    found = {}
    for i, e in enumerate(expressions):
        for j, symbol in enumerate(by):
            if e.has(symbol):
                found[i, j] = sp.diff(e, symbol).xreplace(dict(basic))
    return found


def linear_system(model: Any, direction: int = 1, method: str = "") -> LinearSystem:
    """Trace and linearise a model class; see `trace` for the arguments."""
    return linearize(trace(model, direction, method))


def characteristic_polynomial(
    P: Sequence[sp.Matrix], where: str = "model", bounds: Mapping[Any, Any] | None = None
) -> CharacteristicPolynomial:
    """Return ``det sum_k P_k s^k`` with denominators cleared row by row and common factors removed.

    The leading coefficient's sign is chosen so that its first term is positive.
    """
    n = P[0].rows
    domain, elements, functions = polynomial_field([e for M in P for e in M], bounds or {})
    symbols = domain.symbols if domain.is_Composite else ()
    ring = PolyRing((*symbols, sp.Dummy("s")), sp.ZZ, "lex")
    s = ring.gens[-1]
    rows = []
    for i in range(n):
        entries = [[elements[k * n * n + i * n + j] for k in range(len(P))] for j in range(n)]
        rows.append(cleared_row(entries, domain, ring, s))
    found = determinant(rows, ring)
    if not found:
        raise ModelError(f"{where}: the equations of motion are not independent (their determinant is zero)")
    return _collect(found, symbols, functions)


def _collect(
    determinant: PolyElement, symbols: Sequence[Any], functions: Mapping[Any, Any]
) -> CharacteristicPolynomial:
    """Split a polynomial in parameters and ``s`` by powers of ``s``, and divide by what all parts share."""
    ring = PolyRing(tuple(symbols), sp.ZZ, "lex")
    parts: dict[int, dict[tuple[int, ...], Any]] = {}
    for monom, c in determinant.terms():
        parts.setdefault(monom[-1], {})[monom[:-1]] = c
    coefficients = [ring.from_dict(parts.get(k, {})) for k in range(max(parts) + 1)]
    common = ring.zero
    for a in coefficients:
        common = common_divisor(common, a)
    if coefficients[-1].LC * common.LC < 0:
        common = -common
    return CharacteristicPolynomial(ring, tuple(a.exquo(common) for a in coefficients), functions)
