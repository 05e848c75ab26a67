"""Generated code for a row of a grid, along which one parameter changes: what can be done once a row is taken out.

The characteristic coefficients become polynomials in that parameter; their coefficients, and those of the stability
conditions, are computed once for a row and evaluated at each point by Horner's rule.
"""

from __future__ import annotations

import ast
import math
from collections.abc import Sequence

from ..errors import UcritError
from .compiled import Compiled

MATH = {"arctan2": "atan2", "arctan": "atan", "arcsin": "asin", "arccos": "acos", "abs": "fabs"}
"""What NumPy's functions of one number are called in ``math``, where the name differs."""

Polynomial = tuple[str | None, ...]
"""Names or numbers of the coefficients, lowest first; ``None`` for one that is zero."""


class NotAPolynomialError(Exception):
    """Raised where a value depends on the inner parameter in another way."""


class Rows:
    """Statements that compute coefficients of polynomials in one variable, each product and sum once."""

    def __init__(self) -> None:
        self.steps: list[str] = []
        self._known: dict[str, str] = {}

    def name(self, expression: str) -> str:
        """Return the name of an expression's value, computed once."""
        if expression not in self._known:
            self._known[expression] = f"r{len(self._known)}"
            self.steps.append(f"{self._known[expression]} = {expression}")
        return self._known[expression]

    def plus(self, p: Polynomial, q: Polynomial, operator: str = "+") -> Polynomial:
        """Return a sum or a difference."""
        found: list[str | None] = []
        for k in range(max(len(p), len(q))):
            x, y = p[k] if k < len(p) else None, q[k] if k < len(q) else None
            if x and y:
                found.append(self.name(f"{x} {operator} {y}"))
            else:
                found.append(self.name(f"-{y}") if y and operator == "-" else x or y)
        return tuple(found)

    def times(self, p: Polynomial, q: Polynomial) -> Polynomial:
        """Return a product."""
        found: Polynomial = (None,) * (len(p) + len(q) - 1)
        for i, x in enumerate(p):
            for j, y in enumerate(q):
                if x and y:
                    term = y if x == "1.0" else x if y == "1.0" else self.name(f"{x} * {y}")
                    found = self.plus(found, (*(None,) * (i + j), term))
        return found

    @staticmethod
    def horner(p: Polynomial) -> str:
        """Return an expression for the value at ``x``."""
        text = ""
        for c in reversed(p):
            text = f"({text}*x + {c})" if text and c else f"({text}*x)" if text else c or ""
        return text or "0.0"


def polynomials(functions: Compiled, inner: int | None, rows: Rows) -> list[Polynomial]:
    """Return the deciding coefficients as polynomials in parameter number ``inner``, or as constants.

    The other parameters are called ``v0, v1, ...``.

    Raises
    ------
    NotAPolynomialError
        If they are none.
    UcritError
        If they contain a function that kernels do not have.
    """
    (function,) = ast.parse(functions.source).body
    assert isinstance(function, ast.FunctionDef)
    first, *steps, last = function.body
    assert isinstance(first, ast.Assign)
    assert isinstance(last, ast.Return)
    values: dict[str, Polynomial] = {
        name: (None, "1.0") if k == inner else (name,) for k, name in enumerate(_targets(first))
    }
    for step in steps:
        assert isinstance(step, ast.Assign)
        (name,) = _targets(step)
        values[name] = _value(step.value, values, rows)
    assert isinstance(last.value, ast.Tuple)
    found = [_value(node, values, rows) for node in last.value.elts][functions.structural_zeros :]
    if functions.undamped:
        following = [*found[1:], (None,)]
        found = [
            rows.plus(p, rows.times((f"{k + 1}.0",), q)) for k, (p, q) in enumerate(zip(found, following, strict=True))
        ]
    return found


def _targets(step: ast.Assign) -> list[str]:
    (target,) = step.targets
    return [node.id for node in ast.walk(target) if isinstance(node, ast.Name)]


def _value(node: ast.expr, values: dict[str, Polynomial], rows: Rows) -> Polynomial:
    match node:
        case ast.Constant(value=int() | float()):
            return (repr(float(ast.literal_eval(node))),)
        case ast.Name():
            return values[node.id]
        case ast.UnaryOp(op=ast.USub()):
            return rows.plus((None,), _value(node.operand, values, rows), "-")
        case ast.BinOp(op=ast.Add() | ast.Sub()):
            sign = "+" if isinstance(node.op, ast.Add) else "-"
            return rows.plus(_value(node.left, values, rows), _value(node.right, values, rows), sign)
        case ast.BinOp(op=ast.Mult()):
            return rows.times(_value(node.left, values, rows), _value(node.right, values, rows))
        case ast.BinOp(op=ast.Div()):
            below = _fixed(node.right, values, rows)
            return tuple(c and rows.name(f"{c} / {below}") for c in _value(node.left, values, rows))
    return (rows.name(_other(node, values, rows)),)


def _fixed(node: ast.expr, values: dict[str, Polynomial], rows: Rows) -> str:
    """Return the name of a value that does not change along a row."""
    value = _value(node, values, rows)
    if any(value[1:]):
        raise NotAPolynomialError
    return value[0] or "0.0"


def _other(node: ast.expr, values: dict[str, Polynomial], rows: Rows) -> str:
    """Return an expression of a function, power, comparison or choice of values that do not change along a row."""
    match node:
        case ast.Call(func=ast.Attribute(attr="where"), args=[condition, yes, no]):
            return f"{_fixed(yes, values, rows)} if {_fixed(condition, values, rows)} else {_fixed(no, values, rows)}"
        case ast.Call(func=ast.Name(id="abs")):
            return f"abs({_fixed(node.args[0], values, rows)})"
        case ast.Call(func=ast.Attribute(attr="maximum" | "minimum" as name)):
            return f"{name[:3]}({', '.join(_fixed(x, values, rows) for x in node.args)})"
        case ast.Call(func=ast.Attribute(attr=name)):
            arguments = ", ".join(_fixed(x, values, rows) for x in node.args)
            if not hasattr(math, MATH.get(name, name)):
                raise UcritError(
                    f"compiled maps do not know the function {name} in the coefficients; take engine='numpy'"
                )
            return f"math.{MATH.get(name, name)}({arguments})"
        case ast.Attribute(attr=name):
            return f"math.{MATH.get(name, name)}"
        case ast.BinOp(op=ast.Pow()):
            return f"{_fixed(node.left, values, rows)} ** {_fixed(node.right, values, rows)}"
        case ast.Compare(ops=[operator], comparators=[right]):
            sign = ast.unparse(ast.Compare(ast.Name("x"), [operator], [ast.Name("y")])).split()[1]
            return f"{_fixed(node.left, values, rows)} {sign} {_fixed(right, values, rows)}"
    raise NotAPolynomialError


def conditions(a: Sequence[Polynomial], rows: Rows) -> list[tuple[Polynomial, bool]]:
    """Return what must be positive for stability at degree 1 to 4, and whether it changes its sign with ``a``.

    The order is that of `ucrit.numerics.rounded.slacks`; there the leading coefficient is positive.
    """
    if len(a) == 4:
        product = rows.plus(rows.times(a[1], a[2]), rows.times(a[0], a[3]), "-")
        return [(a[3], True), (a[0], True), (a[2], True), (product, False)]
    if len(a) == 5:
        inside = rows.plus(rows.times(a[2], a[3]), rows.times(a[4], a[1]), "-")
        product = rows.plus(rows.times(a[1], inside), rows.times(a[0], rows.times(a[3], a[3])), "-")
        return [(c, True) for c in (a[4], a[0], a[1], a[3], product)]
    return [(c, True) for c in reversed(a)]
