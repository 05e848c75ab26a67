"""Matrices of linear equations taken from one form into another, in exact arithmetic; needs SymPy."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
import sympy as sp
from sympy.polys.matrices import DomainMatrix

from ...core.contract.model import Model
from ...core.derivation.linear import LinearSystem
from ...core.derivation.rings import polynomial_field
from ...core.derivation.trace import Traced
from ...core.errors import UcritError
from ...core.formulas import typeset

Matrices = Sequence[sp.ImmutableMatrix]


def exact(entry: Any) -> Any:
    """Return an entry as an exact expression: a number is the decimal that it prints.

    >>> exact(0.1)
    1/10
    """
    if isinstance(entry, sp.Expr) and entry.is_real is not False and not entry.has(sp.nan, sp.oo, sp.zoo):
        if entry.is_number and not entry.is_Rational:
            return sp.Rational(str(float(entry)))
        return entry.xreplace({f: sp.Rational(str(f)) for f in entry.atoms(sp.Float)})
    try:
        number = float(entry)
    except (TypeError, ValueError):
        number = math.nan
    if isinstance(entry, str | bool) or not math.isfinite(number):
        raise UcritError(f"entries must be finite real numbers or SymPy expressions, got {entry!r}")
    return sp.Integer(entry) if isinstance(entry, int) else sp.Rational(str(number))


def square(entries: Any, name: str) -> sp.ImmutableMatrix:
    """Return rows of numbers or expressions as a square matrix of exact entries."""
    rows = entries.tolist() if hasattr(entries, "tolist") else entries
    try:
        found = sp.ImmutableMatrix([[exact(entry) for entry in row] for row in rows])
    except (TypeError, ValueError) as error:
        if isinstance(error, UcritError):
            raise UcritError(f"{name}: {error}") from None
        raise UcritError(f"{name} must be a square matrix, given row by row, got {entries!r}") from None
    if not found.rows or found.rows != found.cols:
        raise UcritError(f"{name} must be a square matrix, got {found.rows} rows of {found.cols} entries")
    return found


def numeric(matrix: sp.ImmutableMatrix) -> npt.NDArray[np.float64]:
    """Return a matrix as floats; one with symbols is refused."""
    if matrix.free_symbols:
        names = ", ".join(sorted(s.name for s in matrix.free_symbols))
        raise UcritError(f"eigenvalues are numbers: give values for {names}")
    return np.array(matrix.tolist(), dtype=float).reshape(matrix.shape)


def text(value: Any) -> str:
    """Return a matrix, coefficients or names in one line, numbers to six digits."""
    if hasattr(value, "tolist"):
        return "[" + ", ".join(f"[{text(row)}]" for row in value.tolist()) + "]"
    if isinstance(value, list | tuple):
        return ", ".join(map(text, value))
    if isinstance(value, str):
        return value
    return f"{float(value):.6g}" if value.is_number else typeset.text(value)


def without_zeros(matrices: Matrices) -> Matrices:
    """Return ``P_0, P_1, ...`` without zero matrices at the end; equations without any rate are refused."""
    top = max((k for k, P in enumerate(matrices) if not P.is_zero_matrix), default=0)
    if top == 0:
        raise UcritError("the equations hold no rates, so they tell no motion")
    return matrices[: top + 1]


def companion(matrices: Matrices) -> tuple[sp.ImmutableMatrix, sp.ImmutableMatrix]:
    """Return E and A of ``E x' = A x`` with ``x = (q, q', ...)``, for ``sum_k P_k q^(k) = 0``."""
    *lower, highest = without_zeros(matrices)
    n, d = highest.rows, len(lower)
    E = sp.diag(sp.eye(n * (d - 1)), highest)
    above = sp.zeros(n * (d - 1), n).row_join(sp.eye(n * (d - 1)))
    A = above.col_join(sp.Matrix.hstack(*(-P for P in lower)))
    return sp.ImmutableMatrix(E), sp.ImmutableMatrix(A)


def solved_for_rates(matrices: Matrices, names: Sequence[str]) -> tuple[sp.ImmutableMatrix, tuple[str, ...]]:
    """Return A of ``x' = A x`` and the names of the states, a prime for each derivative.

    Equations without highest derivatives (constraints, parts without mass) lower the order; see
    `ucrit.core.derivation.explicit`.
    """
    P, n = without_zeros(matrices), matrices[0].rows
    q = tuple(tuple(sp.Dummy(f"{name}{k}") for k in range(len(P))) for name in names)
    traced = Traced(Model, {}, q, (), (), (), {})
    none = sp.zeros(n, 0), tuple(sp.zeros(0, n) for _ in P), sp.zeros(0, 0)
    e = LinearSystem(traced, tuple(P), *none).explicit
    states = [(j, k) for j, order in enumerate(e.orders) for k in range(order)]
    if not states:
        raise UcritError("the equations leave nothing free to move")
    highest = _solve(e.L, e.R)

    def row(j: int, k: int) -> list[Any]:
        if k + 1 < e.orders[j]:
            return [sp.Integer(state == (j, k + 1)) for state in states]
        return list(highest.row(j))

    return sp.ImmutableMatrix([row(j, k) for j, k in states]), tuple(names[j] + "'" * k for j, k in states)


def paired(A: sp.ImmutableMatrix) -> tuple[sp.ImmutableMatrix, sp.ImmutableMatrix, sp.ImmutableMatrix]:
    """Return M, B and K of a second-order set with the motion of ``x' = A x``.

    A state whose rate is independent of what was taken before becomes a coordinate with its rate; a state that
    is left over becomes one whose equation is of first order, with a zero row in M.
    """
    n, unit = A.rows, sp.eye(A.rows)
    taken: list[Any] = []
    second, first = [], []
    for i in range(n):
        if _independent([*taken, unit[i, :], A[i, :]]):
            second.append(i)
            taken += [unit[i, :], A[i, :]]
    for i in range(n):
        if _independent([*taken, unit[i, :]]):
            first.append(i)
            taken.append(unit[i, :])
    coordinates, count = [*second, *first], len(second)
    new = sp.Matrix.vstack(*(unit[i, :] for i in coordinates), *(A[i, :] for i in second))
    rates = sp.Matrix.vstack(*((A * A)[i, :] for i in second), *(A[i, :] for i in first))
    F = _solve(new.T, rates.T).T
    size = len(coordinates)
    M = sp.diag(sp.eye(count), sp.zeros(size - count))
    B = sp.diag(sp.zeros(count), sp.eye(size - count)) - F[:, size:].row_join(sp.zeros(size, size - count))
    return sp.ImmutableMatrix(M), sp.ImmutableMatrix(B), sp.ImmutableMatrix(-F[:, :size])


def _independent(rows: Sequence[Any]) -> bool:
    matrix = sp.Matrix.vstack(*rows)
    return matrix.rows <= matrix.cols and bool(_domain_matrix(matrix)[0].rank() == matrix.rows)


def _domain_matrix(*matrices: Any) -> tuple[Any, ...]:
    """Return matrices over one field of rational functions of the symbols."""
    domain, elements, _ = polynomial_field([entry for M in matrices for entry in M], {})
    found, start = [], 0
    for M in matrices:
        rows = [elements[start + i * M.cols : start + (i + 1) * M.cols] for i in range(M.rows)]
        found.append(DomainMatrix(rows, M.shape, domain))
        start += M.rows * M.cols
    return tuple(found)


def _solve(left: Any, right: Any) -> sp.Matrix:
    domain, _, back = polynomial_field([*left, *right], {})
    one, other = _domain_matrix(left, right)
    solved = one.lu_solve(other).to_list()
    return sp.Matrix(right.rows, right.cols, [domain.to_sympy(e).xreplace(back) for row in solved for e in row])
