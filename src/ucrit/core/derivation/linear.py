"""The linear object of a model: ``sum_k P_k q^(k) = Q u``, its explicit form and its characteristic polynomial.

All arithmetic is done in fields and rings of polynomials in the parameters, never on expression trees.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import sympy as sp

from ..formulas.settle import settled
from ..formulas.slopes import slopes_at
from .characteristic import CharacteristicPolynomial, characteristic_polynomial
from .explicit import Explicit, explicit
from .trace import Traced, trace

MAX_DIRECT = 1000
"""Operations in equations of motion above which these are differentiated piece by piece."""


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
        places = {chain[0].name: j for j, chain in enumerate(self.traced.q)}
        stated = getattr(self.traced.model, "twins", {})
        twins = [(places[copy], places[name], order) for copy, (name, order) in stated.items()]
        return characteristic_polynomial(self.P, self.traced.model.model_id(), self.bounds, twins)

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
        """Return the system with parameters replaced by exact numbers or other expressions.

        Numbers that are no ratio then, such as roots, are rounded to 40 digits.
        """
        swap = {k: sp.sympify(v) for k, v in values.items()}

        def put(M: sp.Matrix) -> sp.Matrix:
            return M.xreplace(swap).applyfunc(_rational)

        return LinearSystem(self.traced, tuple(map(put, self.P)), put(self.Q), tuple(map(put, self.C)), put(self.D))


def _rational(expression: Any) -> Any:
    numbers = [part for part in expression.atoms(sp.Pow, sp.Function) if part.is_number and not part.is_rational]
    return expression.xreplace({part: sp.Rational(str(part.n(40))) for part in numbers}) if numbers else expression


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
