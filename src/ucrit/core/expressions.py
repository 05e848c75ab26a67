"""Reading formulas that users and data files give: numbers, names and ``+ - * / **``, never code."""

from __future__ import annotations

import ast
import operator
from collections.abc import Mapping
from typing import Any

import sympy as sp

from .errors import UcritError, near_match

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


def parse(formula: str | float, names: Mapping[str, Any], where: str) -> Any:
    """Return a formula as an expression; ``names`` gives the meaning of each name (dots included:
    ``dx.theta``).

    >>> m, a = sp.symbols("m a")
    >>> parse("m*a**2/2 + 0.25", {"m": m, "a": a}, "example")
    a**2*m/2 + 1/4
    """
    if isinstance(formula, int | float) and not isinstance(formula, bool):
        return sp.Rational(str(formula))
    if not isinstance(formula, str):
        raise UcritError(f"{where}: a formula must be a number or a text, got {formula!r}")
    try:
        tree = ast.parse(formula.strip(), mode="eval").body
    except SyntaxError:
        raise UcritError(f"{where}: the formula '{formula}' cannot be read") from None
    return _value(tree, {"pi": sp.pi, **names}, f"{where}: the formula '{formula}'")


def _value(node: ast.expr, names: Mapping[str, Any], where: str) -> Any:
    match node:
        case ast.Constant(value=int() | float() as number) if not isinstance(number, bool):
            return sp.Rational(str(number))
        case ast.Name() | ast.Attribute():
            name = ast.unparse(node)
            if name not in names:
                raise UcritError(f"{where} uses '{name}'{near_match(name, names)}")
            return names[name]
        case ast.UnaryOp(op=sign, operand=operand) if type(sign) in SIGNS:
            return SIGNS[type(sign)](_value(operand, names, where))
        case ast.BinOp(left=left, op=op, right=right) if type(op) in OPERATORS:
            return OPERATORS[type(op)](_value(left, names, where), _value(right, names, where))
        case ast.Call(func=ast.Name(id=name), args=arguments, keywords=[]):
            if name not in FUNCTIONS:
                raise UcritError(f"{where} uses the function '{name}'{near_match(name, FUNCTIONS)}")
            return FUNCTIONS[name](*(_value(argument, names, where) for argument in arguments))
    raise UcritError(f"{where} holds '{ast.unparse(node)}', which is no formula")
