"""The linear object of a model: ``sum_k P_k q^(k) = Q u``, its explicit form and its characteristic polynomial.

All arithmetic is done in fields and rings of polynomials in the parameters, never on expression trees.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import sympy as sp
from sympy.polys.constructor import construct_domain
from sympy.polys.matrices import DomainMatrix
from sympy.polys.rings import PolyElement, PolyRing

from .errors import ModelError
from .generators import function_symbols
from .trace import Traced, trace

Row = list[list[Any]]  # row[j][k]: coefficient of the k-th derivative of variable j


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
    top = max(len(chain) for chain in traced.q)
    basic = dict(traced.basic)

    def jacobians(expressions: Sequence[Any]) -> tuple[sp.Matrix, ...]:
        return tuple(
            sp.Matrix(
                len(expressions),
                len(traced.q),
                lambda i, j, k=k: (
                    sp.diff(expressions[i], traced.q[j][k]).xreplace(basic) if k < len(traced.q[j]) else 0
                ),
            )
            for k in range(top)
        )

    def by_inputs(expressions: Sequence[Any]) -> sp.Matrix:
        size = len(expressions), len(traced.u)
        return sp.Matrix(*size, lambda i, j: sp.diff(expressions[i], traced.u[j]).xreplace(basic))

    return LinearSystem(
        traced,
        jacobians(traced.residuals),
        -by_inputs(traced.residuals),
        jacobians(traced.outputs),
        by_inputs(traced.outputs),
    )


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
    domain, elements, functions = _domain([e for M in P for e in M], bounds or {})
    symbols = domain.symbols if domain.is_Composite else ()
    ring = PolyRing((*symbols, sp.Dummy("s")), sp.ZZ, "lex")
    s = ring.gens[-1]
    rows = []
    for i in range(n):
        entries = [[elements[k * n * n + i * n + j] for k in range(len(P))] for j in range(n)]
        rows.append(_cleared_row(entries, domain, ring, s))
    determinant = DomainMatrix(rows, (n, n), ring.to_domain()).det()
    if not determinant:
        raise ModelError(f"{where}: the equations of motion are not independent (their determinant is zero)")
    return _collect(determinant, symbols, functions)


def _domain(expressions: Sequence[Any], bounds: Mapping[Any, Any]) -> tuple[Any, list[Any], dict[Any, Any]]:
    """Return a field of rational functions in the parameters, the expressions in it, and what its symbols stand for."""
    simple = [sp.trigsimp(e) if e.has(sp.sin, sp.cos, sp.tan) else e for e in map(sp.sympify, expressions)]
    swap, back = function_symbols(simple, bounds)
    domain, elements = construct_domain([e.xreplace(swap) for e in simple], field=True)
    return domain, elements, back


def _cleared_row(entries: Row, domain: Any, ring: PolyRing, s: PolyElement) -> list[PolyElement]:
    """Multiply a row by its common denominator and write it in the ring of parameters and ``s``."""
    pairs = [[_fraction(e, domain, ring) for e in chain] for chain in entries]
    common = ring.one
    for chain in pairs:
        for numerator, denominator in chain:
            if numerator:
                common = common.lcm(denominator)
    return [
        sum((num * common.exquo(den) * s**k for k, (num, den) in enumerate(chain) if num), ring.zero) for chain in pairs
    ]


def _fraction(element: Any, domain: Any, ring: PolyRing) -> tuple[PolyElement, PolyElement]:
    if not domain.is_Composite:
        return ring(int(element.numerator)), ring(int(element.denominator))
    num, content_n = element.numer.clear_denoms()[::-1]
    den, content_d = element.denom.clear_denoms()[::-1]
    return _lift(num, ring) * int(content_d), _lift(den, ring) * int(content_n)


def _lift(poly: PolyElement, ring: PolyRing) -> PolyElement:
    return ring.from_dict({(*monom, 0): int(c) for monom, c in poly.terms()})


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
        common = common.gcd(a)
    if coefficients[-1].LC * common.LC < 0:
        common = -common
    return CharacteristicPolynomial(ring, tuple(a.exquo(common) for a in coefficients), functions)


@dataclass(frozen=True)
class Explicit:
    """``L z = R w + Q u``: ``z`` the given derivative of each variable, ``w`` all lower ones (the state).

    ``orders[j]`` is the derivative of variable j that is solved for; a variable of order 0 is a combination of
    the others. ``C``, ``D`` give outputs from state and inputs once ``z`` is eliminated: ``y = Cw w + Cz z + D u``.
    """

    orders: tuple[int, ...]
    L: sp.Matrix
    R: sp.Matrix
    Q: sp.Matrix
    Cw: sp.Matrix
    Cz: sp.Matrix
    D: sp.Matrix


def explicit(system: LinearSystem) -> Explicit:
    """Bring the linear equations into explicit form, lowering the order of variables where it must be.

    Where the highest derivatives do not all appear independently (constraints, massless parts), a combination of
    equations free of them lowers the order of one variable at a time, until the leading matrix is regular: the
    reduction of a polynomial matrix to column-proper form by unimodular row operations
    (W. A. Wolovich, Linear Multivariable Systems (1974), section 2.5).
    """
    n, m = system.P[0].rows, system.Q.cols
    entries = [e for M in (*system.P, system.Q) for e in M]
    domain, elements, functions = _domain(entries, system.bounds)
    size = n * n

    def row(i: int) -> Row:
        chains = [[elements[k * size + i * n + j] for k in range(len(system.P))] for j in range(n)]
        start = len(system.P) * size + i * m
        return [*chains, *([-elements[start + j]] for j in range(m))]

    rows = [row(i) for i in range(n)]
    orders = _reduce(rows, n, domain, system.traced.model.model_id())
    for i in range(n):
        for j in range(n, n + m):
            if _degree(rows[i][j]) > 0:
                raise ModelError(
                    f"{system.traced.model.model_id()}: input {system.traced.u[j - n]} acts through its rate of change "
                    "on a constrained motion; declare its rate as the input"
                )
    return _assemble(system, rows, orders, domain, functions)


def _degree(chain: list[Any]) -> int:
    return max((k for k, c in enumerate(chain) if c), default=-1)


def _reduce(rows: list[Row], n: int, domain: Any, where: str) -> list[int]:
    orders = [max(_degree(r[j]) for r in rows) for j in range(n)]
    while True:
        leading = DomainMatrix([[_at(r[j], orders[j]) for j in range(n)] for r in rows], (n, n), domain)
        null = leading.transpose().nullspace().to_list() if n else []
        if not null:
            return orders
        if sum(orders) < 0:
            raise ModelError(f"{where}: the equations of motion are not independent")
        weights = null[0]
        combined = [_combine([r[j] for r in rows], weights, domain) for j in range(len(rows[0]))]
        deficits = [(orders[j] - _degree(combined[j]), j) for j in range(n) if _degree(combined[j]) >= 0]
        if not deficits:
            raise ModelError(f"{where}: the equations of motion are not independent")
        _, pivot = min(deficits)
        replaced = next(i for i, w in enumerate(weights) if w)
        rows[replaced] = combined
        for i in range(n):
            if i != replaced:
                _eliminate(rows[i], combined, pivot, domain)
        orders = [max(_degree(r[j]) for r in rows) for j in range(n)]


def _at(chain: list[Any], k: int) -> Any:
    return chain[k] if 0 <= k < len(chain) else chain[0] * 0


def _combine(chains: list[list[Any]], weights: list[Any], domain: Any) -> list[Any]:
    top = max(len(chain) for chain in chains)
    return [
        sum((w * chain[k] for w, chain in zip(weights, chains, strict=True) if k < len(chain)), domain.zero)
        for k in range(top)
    ]


def _eliminate(row: Row, by: Row, pivot: int, domain: Any) -> None:
    """Subtract derivatives of the equation ``by`` from ``row`` until variable ``pivot`` is of lower degree."""
    degree = _degree(by[pivot])
    while (shift := _degree(row[pivot]) - degree) >= 0:
        factor = row[pivot][degree + shift] / by[pivot][degree]
        for j, chain in enumerate(by):
            target = row[j] + [domain.zero] * (len(chain) + shift - len(row[j]))
            for k, c in enumerate(chain):
                target[k + shift] = target[k + shift] - factor * c
            row[j] = target


def _assemble(system: LinearSystem, rows: list[Row], orders: list[int], domain: Any, functions: Any) -> Explicit:
    n, m = system.P[0].rows, system.Q.cols

    def matrix(values: list[list[Any]], cols: int) -> sp.Matrix:
        return sp.Matrix(len(values), cols, [domain.to_sympy(v).xreplace(functions) for row in values for v in row])

    below = [(j, k) for j in range(n) for k in range(orders[j])]
    L = matrix([[_at(r[j], orders[j]) for j in range(n)] for r in rows], n)
    R = matrix([[-_at(r[j], k) for j, k in below] for r in rows], len(below))
    Q = matrix([[-_at(r[n + j], 0) for j in range(m)] for r in rows], m)
    outputs = system.D.rows

    for k, M in enumerate(system.C):
        for j in range(n):
            if k > orders[j] and any(M[:, j]):
                lowered = list(system.traced.model.declaration.variables)[j]
                raise ModelError(
                    f"{system.traced.model.model_id()}: an output uses derivative {k} of {lowered}, "
                    f"which a constraint replaces; write it with derivatives up to {orders[j]}"
                )

    def output(i: int, j: int, k: int) -> Any:
        return system.C[k][i, j] if k < len(system.C) else sp.S.Zero

    Cw = sp.Matrix(outputs, len(below), [output(i, j, k) for i in range(outputs) for j, k in below])
    Cz = sp.Matrix(outputs, n, [output(i, j, orders[j]) for i in range(outputs) for j in range(n)])
    return Explicit(tuple(orders), L, R, Q, Cw, Cz, system.D)
