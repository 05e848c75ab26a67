"""Reading formulas that users and data files give: numbers, names and ``+ - * / **``, never code."""

from __future__ import annotations

import ast
import operator
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import sympy as sp

from ..errors import UcritError, near_match
from .functions import grouped, length
from .plane import Share

OPERATORS = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: operator.pow,
}
SIGNS: dict[type[ast.unaryop], Any] = {ast.USub: operator.neg, ast.UAdd: operator.pos}
FUNCTIONS: dict[str, Any] = {
    name: getattr(sp, name) for name in ("sin", "cos", "tan", "asin", "atan", "atan2", "sqrt", "exp", "log")
}
FUNCTIONS |= {"tanh": sp.tanh, "sign": sp.sign, "abs": sp.Abs}
LAWS: dict[str, Any] = {
    **FUNCTIONS,
    "where": sp.Piecewise,
    "min": sp.Min,
    "max": sp.Max,
    "length": length,
    "grouped": grouped,
}
LAWS |= {"share": Share}
"""Functions of force laws: what depends on conditions, and what holds a plane vector or a group together."""
RELATIONS: dict[type[ast.cmpop], Any] = {ast.Lt: sp.Lt, ast.LtE: sp.Le, ast.Gt: sp.Gt, ast.GtE: sp.Ge}
LARGEST_POWER = 1000


def parse(
    formula: str | float, names: Mapping[str, Any], where: str, functions: Mapping[str, Any] | None = None
) -> Any:
    """Return a formula as an expression; ``names`` gives the meaning of each name (dots included:
    ``dx.theta``). ``functions`` are `FUNCTIONS` unless others are given; with `LAWS` there may be conditions.

    >>> m, a = sp.symbols("m a")
    >>> parse("m*a**2/2 + 0.25", {"m": m, "a": a}, "example")
    a**2*m/2 + 1/4
    >>> parse("where(abs(a) < m, a, m*sign(a))", {"m": m, "a": a}, "example", LAWS)
    Piecewise((a, m > Abs(a)), (m*sign(a), True))
    """
    if isinstance(formula, int | float) and not isinstance(formula, bool):
        return sp.Rational(str(formula))
    if not isinstance(formula, str):
        raise UcritError(f"{where}: a formula must be a number or a text, got {formula!r}")
    try:
        tree = ast.parse(formula.strip(), mode="eval").body
    except SyntaxError:
        raise UcritError(f"{where}: the formula '{formula}' cannot be read") from None
    reader = _Reader({"pi": sp.pi, **names}, f"{where}: the formula '{formula}'", functions or FUNCTIONS)
    found = reader.value(tree)
    if found.has(sp.zoo, sp.nan, sp.oo):
        raise UcritError(f"{reader.where} has no finite value")
    return found


@dataclass(frozen=True)
class _Reader:
    """Puts meanings for the names of a formula's tree."""

    names: Mapping[str, Any]
    where: str
    functions: Mapping[str, Any]

    def value(self, node: ast.expr) -> Any:
        """Return a number or an expression."""
        match node:
            case ast.Constant(value=int() | float() as number) if not isinstance(number, bool):
                return sp.Rational(str(number))
            case ast.Name() | ast.Attribute():
                name = ast.unparse(node)
                if name not in self.names:
                    raise UcritError(f"{self.where} uses '{name}'{near_match(name, self.names)}")
                return self.names[name]
            case ast.UnaryOp(op=sign, operand=operand) if type(sign) in SIGNS:
                return SIGNS[type(sign)](self.value(operand))
            case ast.BinOp(left=left, op=op, right=right) if type(op) in OPERATORS:
                return self._operation(type(op), self.value(left), self.value(right))
            case ast.Call(func=ast.Name(id=name), args=arguments, keywords=[]):
                return self._call(name, arguments)
        raise UcritError(f"{self.where} holds '{ast.unparse(node)}', which is no formula")

    def _operation(self, op: type[ast.operator], left: Any, right: Any) -> Any:
        if op is ast.Pow and right.is_number and abs(right) * max(1, *_digits(left)) > LARGEST_POWER:
            raise UcritError(f"{self.where} holds a power of {right}, which is too large to be computed")
        return OPERATORS[op](left, right)

    def _call(self, name: str, arguments: list[ast.expr]) -> Any:
        if name not in self.functions:
            raise UcritError(f"{self.where} uses the function '{name}'{near_match(name, self.functions)}")
        if name == "where" and len(arguments) == 3:
            yes, no = map(self.value, arguments[1:])
            return sp.Piecewise((yes, self._condition(arguments[0])), (no, True))
        try:
            if not arguments:
                raise TypeError
            return self.functions[name](*map(self.value, arguments))
        except TypeError:
            raise UcritError(f"{self.where} gives {name} {len(arguments)} values, which it does not take") from None

    def _condition(self, node: ast.expr) -> Any:
        """Return what is true or false: comparisons, joined by and, or and not."""
        match node:
            case ast.Compare(left=left, ops=ops, comparators=others) if all(type(op) in RELATIONS for op in ops):
                sides = [self.value(side) for side in (left, *others)]
                return sp.And(*(RELATIONS[type(op)](sides[k], sides[k + 1]) for k, op in enumerate(ops)))
            case ast.BoolOp(op=op, values=values):
                return (sp.And if isinstance(op, ast.And) else sp.Or)(*map(self._condition, values))
            case ast.UnaryOp(op=ast.Not(), operand=operand):
                return sp.Not(self._condition(operand))
            case ast.Call(func=ast.Name(id="where"), args=[_, _, _] as arguments, keywords=[]):
                return sp.ITE(*map(self._condition, arguments))
        raise UcritError(f"{self.where} holds '{ast.unparse(node)}' where a condition such as 'a < b' is needed")


def _digits(x: Any) -> tuple[int, int]:
    return (len(str(x.p)), len(str(x.q))) if x.is_Rational else (1, 1)
