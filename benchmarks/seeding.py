"""Single errors of the kind that people make when they write equations of motion."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from typing import Any

from ucrit.core.contract.declare import Quantity
from ucrit.core.contract.model import Model

SWAPPED = {ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult}
OTHER = {
    "sin": "cos",
    "cos": "sin",
    "tan": "sin",
    "atan": "tan",
    "atan2": "atan2",
    "tanh": "atan",
    "sqrt": "abs",
}
RATES = ("x", "dx", "ddx")

Place = tuple[ast.AST, str, int | None]


def seeded(text: str, model: type[Model] | None, function: str = "") -> Iterator[tuple[str, str, str]]:
    """Yield (what was changed, original text, changed text) for every error that can be made in a file.

    With ``function`` only that function is changed, else all methods and the fixed numbers of classes.
    """
    tree = ast.parse(text)
    original = ast.unparse(tree)
    for where, root in _bodies(tree, function):
        known = {argument.arg for argument in root.args.args} if isinstance(root, ast.FunctionDef) else {"self"}
        for place in _places(root):
            node = _get(place)
            for what, other in _errors(node, model, known):
                _set(place, other)
                yield f"{where}: {what}", original, ast.unparse(ast.fix_missing_locations(tree))
                _set(place, node)


def _bodies(tree: ast.Module, function: str) -> Iterator[tuple[str, ast.AST]]:
    for node in tree.body:
        if isinstance(node, ast.FunctionDef) and node.name == function:
            yield node.name, node
        elif isinstance(node, ast.ClassDef) and function in ("", node.name):
            for item in node.body:
                if isinstance(item, ast.FunctionDef) and item.name != "drawing":
                    yield item.name, item
                elif isinstance(item, ast.Assign) and (
                    isinstance(item.value, ast.Constant) or _is_property(item.value)
                ):
                    yield "class body", item


def _is_property(node: ast.expr) -> bool:
    return isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "property"


def _places(root: ast.AST) -> Iterator[Place]:
    """Yield every place below a node that holds an expression, as parent, field and index."""
    fields = ("body", "value") if isinstance(root, ast.FunctionDef | ast.Assign) else root._fields
    for name in fields:
        value = getattr(root, name, None)
        items = list(enumerate(value)) if isinstance(value, list) else [(None, value)]
        for index, item in items:
            if isinstance(item, ast.AST) and not _is_docstring(item):
                if isinstance(item, ast.expr) and isinstance(getattr(item, "ctx", ast.Load()), ast.Load):
                    yield root, name, index
                yield from _places(item)


def _is_docstring(node: ast.AST) -> bool:
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)


def _get(place: Place) -> Any:
    parent, name, index = place
    value = getattr(parent, name)
    return value if index is None else value[index]


def _set(place: Place, node: ast.AST) -> None:
    parent, name, index = place
    if index is None:
        setattr(parent, name, node)
    else:
        getattr(parent, name)[index] = node


def _errors(node: ast.expr, model: type[Model] | None, known: set[str]) -> Iterator[tuple[str, ast.expr]]:
    match node:
        case ast.BinOp(left=left, op=ast.Pow(), right=right):
            yield "power dropped", left
            yield "power raised", ast.BinOp(left, ast.Pow(), ast.BinOp(right, ast.Add(), ast.Constant(1)))
        case ast.BinOp(left=left, op=op, right=right):
            yield "operator swapped", ast.BinOp(left, SWAPPED[type(op)](), right)
            yield "right operand dropped", left
            yield "left operand dropped", right
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            yield "sign dropped", operand
        case ast.Constant(value=int() | float() as number) if not isinstance(number, bool):
            yield "constant doubled", ast.Constant(2 * number if number else 1.0)
        case ast.Tuple(elts=[first, second, *rest]):
            yield "two entries swapped", ast.Tuple([second, first, *rest])
        case ast.Call(func=ast.Name(id=name), args=[argument]) if name in (*OTHER, "abs"):
            yield f"{name} dropped", argument
            if name in OTHER:
                yield "other function", ast.Call(ast.Name(OTHER[name]), [argument], [])
        case ast.Attribute(value=ast.Name(id=group), attr=name) if model is not None:
            for other_group, other in _other_names(group, name, model):
                if other_group in known:
                    yield "other name", ast.Attribute(ast.Name(other_group), other)


def _other_names(group: str, name: str, model: type[Model]) -> Iterator[tuple[str, str]]:
    """Yield names that can be confused with one: another of its unit, or another derivative."""
    declared = model.declaration
    kinds: dict[str, Any] = {
        "self": declared.parameters,
        "u": declared.inputs,
        **dict.fromkeys(RATES, declared.variables),
    }
    names: dict[str, Quantity] = kinds.get(group, {})
    if name not in names:
        return
    for other, quantity in names.items():
        if other != name and quantity.unit == names[name].unit:
            yield group, other
    if group in RATES:
        level = RATES.index(group)
        for other in {level - 1, level + 1} & set(range(declared.variables[name].order + 1)):
            yield RATES[other], name
