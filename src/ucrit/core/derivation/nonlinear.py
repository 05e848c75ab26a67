"""The non-linear equations solved for the highest derivatives: ``M(x, u) z = f(x, u)``."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import sympy as sp

from ..errors import ModelError
from .trace import Traced


@dataclass(frozen=True)
class Explicit:
    """Mass matrix and right-hand side for the highest derivatives and the algebraic unknowns.

    ``implicit`` are algebraic unknowns that both depend on: ``M(z) z = f(z)`` is then a step of Newton's method.
    """

    M: sp.Matrix
    f: sp.Matrix
    implicit: tuple[Any, ...] = ()


def solve_for_highest(traced: Traced, *, iterated: bool = False) -> Explicit:
    """Split the residuals into the part with highest derivatives and the rest.

    An equation without highest derivatives (a constraint) is differentiated along the motion until it has some;
    the motion then keeps the constraint it starts on. Where it may be ``iterated``, algebraic unknowns (an equivalent
    control) may enter as they like.

    Raises
    ------
    ModelError
        If the equations are not linear in the highest derivatives or cannot be solved for them.
    """
    z = traced.highest
    residuals = list(traced.residuals)
    names = set(z)
    for i, residual in enumerate(residuals):
        for _ in range(3):
            if residual.free_symbols & names:
                break
            if residual.free_symbols & set(traced.u):
                raise ModelError(
                    f"{traced.model.model_id()}: equation {i + 1} is a constraint that an input moves; "
                    "write it with the input's rate, or as a force"
                )
            residual = traced.time_derivative(residual)
        residuals[i] = residual
    M = sp.Matrix(len(z), len(z), lambda i, j: sp.diff(residuals[i], z[j]))
    algebraic = [chain[0] for chain in traced.q if len(chain) == 1]
    implicit = tuple(symbol for symbol in algebraic if iterated and M.has(symbol))
    if M.free_symbols & (names - set(implicit)):
        raise ModelError(f"{traced.model.model_id()}: the equations are not linear in the highest derivatives")
    rest = dict.fromkeys(z, sp.S.Zero)
    if implicit:
        return Explicit(M, M * sp.Matrix(z) - sp.Matrix(residuals), implicit)
    return Explicit(M, sp.Matrix([-r.xreplace(rest) for r in residuals]))


def constraints(traced: Traced) -> list[Any]:
    """Return what must vanish at every instant: residuals free of highest derivatives and their own rates."""
    found, highest = [], set(traced.highest)
    for residual in traced.residuals:
        while residual.free_symbols and not residual.free_symbols & highest:
            found.append(residual)
            residual = traced.time_derivative(residual)
    return found
