"""Are two sets of linear equations the same up to combinations of their rows?"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import mpmath
import sympy as sp

from ..core.derivation.linear import LinearSystem
from .precise import DIGITS, EQUAL, Point, frequencies, matrix

TYPICAL = (10, 1)  # a polynomial whose root is of the size that vehicles' eigenvalues have, in 1/s


def same_equations(system: LinearSystem, P: Sequence[sp.Matrix], Q: sp.Matrix | None, points: Sequence[Point]) -> bool:
    """Tell whether ``sum P_k q^(k) = Q u`` is a regular combination of the rows of a derived system.

    The combination T is found at one frequency s from ``T P(s) = P_derived(s)`` and must hold at others.
    """
    symbols = list(system.traced.parameters.values())
    derived, given = [[matrix(M, symbols) for M in group] for group in (system.P, P)]
    inputs = [matrix(M, symbols) for M in (system.Q, Q) if M is not None and system.traced.u]
    with mpmath.workdps(DIGITS):
        for point in points:
            nodes = frequencies(TYPICAL, max(len(derived), len(given)) + 1)
            at = [[_at([M(point) for M in group], s) for group in (derived, given)] for s in nodes]
            if not mpmath.det(at[0][1]):
                return False
            if len(inputs) == 2:
                at.append([M(point) for M in inputs])
            inverse = mpmath.inverse(at[0][1])
            T, size = at[0][0] * inverse, at[0][0].apply(abs) * inverse.apply(abs)
            if not all(_same(one, T * other, size * other.apply(abs)) for one, other in at):
                return False
    return True


def _at(matrices: Sequence[Any], s: Any) -> Any:
    total = matrices[0] * mpmath.mpf(1)
    for k, M in enumerate(matrices[1:], 1):
        total = total + M * s**k
    return total


def _same(one: Any, other: Any, size: Any) -> bool:
    """Compare entry by entry, ``size`` bounding what rounding can have been blown up from."""
    return all(abs(one[k] - other[k]) <= EQUAL * (size[k] + abs(one[k])) for k in _keys(one))


def _keys(M: Any) -> list[tuple[int, int]]:
    return [(i, j) for i in range(M.rows) for j in range(M.cols)]


def response(system: LinearSystem, name_in: str, name_out: str) -> Callable[[Point, Sequence[Any]], list[Any]]:
    """Return a function that evaluates a transfer function at given frequencies ``s``."""
    declared = system.traced.model.declaration
    column, n = list(declared.inputs).index(name_in), len(system.traced.q)
    if name_out in declared.variables:
        pick = sp.zeros(1, n)
        pick[list(declared.variables).index(name_out)] = 1
        output, through = [pick], sp.zeros(1, 1)
    else:
        row = list(declared.outputs).index(name_out)
        output, through = [M[row, :] for M in system.C], system.D[row, column : column + 1]
    blocks = ([*system.P], [system.Q[:, column]], output, [through])
    evaluate = [[matrix(M, list(system.traced.parameters.values())) for M in block] for block in blocks]

    def at(point: Point, frequencies: Sequence[Any]) -> list[Any]:
        P, Q, C, D = ([M(point) for M in block] for block in evaluate)
        return [(_at(C, s) * mpmath.lu_solve(_at(P, s), Q[0]) + D[0])[0] for s in frequencies]

    return at
