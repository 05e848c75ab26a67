"""The explicit form of linear equations: solved for one derivative of each variable, constraints eliminated."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import sympy as sp
from sympy.polys.matrices import DomainMatrix

from ..errors import ModelError
from .rings import Row, polynomial_field

if TYPE_CHECKING:
    from .linear import LinearSystem


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
    domain, elements, functions = polynomial_field(entries, system.bounds)
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
