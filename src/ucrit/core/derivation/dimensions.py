"""Dimensional check of traced equations: every sum of like terms, every function of a pure number."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import sympy as sp

from ..errors import ModelError
from ..units import Dimension

if TYPE_CHECKING:
    from .trace import Traced

NUMBER = Dimension()


def check_dimensions(traced: Traced) -> None:
    """Raise `ModelError` naming the equation whose units clash.

    Multipliers of constraints take whatever unit makes their terms fit; a clash elsewhere is still found.
    """
    declared, known = traced.model.declaration, _known(traced)
    free = {chain[0] for chain in traced.q[len(declared.variables) :]}
    where, seen = traced.model.model_id(), dict[Any, Dimension | None]()
    for number, residual in enumerate(traced.residuals, 1):
        dimension_of(residual.xreplace(dict.fromkeys(free, sp.S.Zero)), known, f"{where}: equation {number}", seen)
    for output, expression in zip(declared.outputs.values(), traced.outputs, strict=True):
        found = dimension_of(expression, known, f"{where}: output {output.name}", seen)
        if found is not None and found != output.dimension:
            raise ModelError(f"{where}: output {output.name} is declared in {output.unit} but comes out in {found}")


def check_sum(traced: Traced, expression: Any, where: str) -> None:
    """Raise `ModelError` if an expression combines unlike units; its own unit may be any."""
    dimension_of(expression, _known(traced), where)


def _known(traced: Traced) -> dict[Any, Dimension]:
    """Return the dimensions of all declared symbols."""
    declared = traced.model.declaration
    known = {symbol: declared.parameters[name].dimension for name, symbol in traced.parameters.items()}
    per_second = Dimension(0, 0, -1)
    for variable, chain in zip(declared.variables.values(), traced.q, strict=False):
        known.update({symbol: variable.dimension.times(per_second, k) for k, symbol in enumerate(chain)})
    known.update(zip(traced.u, (i.dimension for i in declared.inputs.values()), strict=True))
    return known


def dimension_of(
    expression: Any, known: dict[Any, Dimension], where: str, seen: dict[Any, Dimension | None] | None = None
) -> Dimension | None:
    """Return the dimension of an expression, ``None`` for zero, which fits anything.

    What has been ``seen`` in the same sum or another is not looked into again.
    """
    seen = {} if seen is None else seen
    if expression not in seen:
        seen[expression] = _dimension_of(expression, known, where, seen)
    return seen[expression]


def _dimension_of(
    expression: Any, known: dict[Any, Dimension], where: str, seen: dict[Any, Dimension | None]
) -> Dimension | None:
    if expression.is_zero:
        return None
    if expression.is_Symbol:
        return known[expression]
    if expression.is_number:
        return NUMBER
    if isinstance(expression, sp.Piecewise):
        for relation in sp.And(*(condition for _, condition in expression.args)).atoms(sp.core.relational.Relational):
            _alike(relation, [dimension_of(side, known, where, seen) for side in relation.args], where)
        return _alike(expression, [dimension_of(value, known, where, seen) for value, _ in expression.args], where)
    parts = [dimension_of(argument, known, where, seen) for argument in expression.args]
    if expression.is_Mul:
        total = NUMBER
        for part in parts:
            total = total.times(part or NUMBER)
        return total
    if expression.is_Pow:
        if not expression.exp.is_number:
            raise ModelError(f"{where}: the exponent in '{expression}' is not a number")
        return NUMBER.times(parts[0] or NUMBER, float(expression.exp))
    if expression.is_Add or isinstance(expression, sp.Max | sp.Min | sp.atan2):
        return _alike(expression, parts, where)
    if isinstance(expression, sp.Abs):
        return parts[0]
    if isinstance(expression, sp.sign):
        return NUMBER
    for argument, part in zip(expression.args, parts, strict=True):
        if part not in (None, NUMBER):
            raise ModelError(f"{where}: '{expression}' is a function of '{argument}', which has the unit {part}")
    return NUMBER


def _alike(expression: Any, parts: list[Dimension | None], where: str) -> Dimension | None:
    units = {part for part in parts if part is not None}
    if len(units) > 1:
        terms = ", ".join(f"{arg} [{part}]" for arg, part in zip(expression.args, parts, strict=True))
        raise ModelError(f"{where} combines unlike units: {terms}")
    return NUMBER if isinstance(expression, sp.atan2) else next(iter(units), None)
