"""Python source from expressions: straight-line functions of floats, arrays or exact fractions.

Shared subexpressions are computed once, so that a factor depending on one array of a grid stays one-dimensional.
Polynomials with integer coefficients use only ``+ - *``, hence run on `fractions.Fraction` without rounding.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from itertools import count
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import sympy

MAX_PRODUCT = 8


def generate(name: str, arguments: Sequence[Sequence[sympy.Symbol]], expressions: Iterable[Any]) -> str:
    """Return the source of ``name(group_1, group_2, ...)``, which returns a tuple with one value an expression.

    Each argument is a sequence whose items are bound to the symbols of one group.
    """
    import sympy as sp

    from .plane import computable

    renamed = renaming(arguments)
    swapped = [computable(sp.sympify(e)).xreplace(renamed) for e in expressions]
    shared, results = sp.cse(swapped, symbols=(sp.Symbol(f"t{i}") for i in count()), order="none")
    return write(name, [len(group) for group in arguments], shared, results)


def renaming(arguments: Sequence[Sequence[sympy.Symbol]]) -> dict[Any, Any]:
    """Return the symbols that stand for those of the arguments in generated source: v0, v1, ..."""
    import sympy as sp

    flat = [symbol for group in arguments for symbol in group]
    return {symbol: sp.Symbol(f"v{i}", **symbol._assumptions_orig) for i, symbol in enumerate(flat)}


def write(name: str, sizes: Sequence[int], steps: Iterable[tuple[Any, Any]], results: Iterable[Any]) -> str:
    """Return the source of a function that takes steps, each a name and its value, and returns results.

    Arguments are groups of the given sizes; their items are called as by `renaming`.
    """
    printer = _printer()
    lines, position = [f"def {name}({', '.join(f'g{i}' for i in range(len(sizes)))}):"], 0
    for i, size in enumerate(sizes):
        if size:
            names = ", ".join(f"v{position + j}" for j in range(size))
            lines.append(f"    {names}, = g{i}")
        position += size
    lines += [f"    {printer.doprint(symbol)} = {printer.doprint(value)}" for symbol, value in steps]
    values = "".join(f"{printer.doprint(value)}, " for value in results)
    return "\n".join([*lines, f"    return ({values})", ""])


def _printer() -> Any:
    from sympy.printing.numpy import NumPyPrinter

    class Printer(NumPyPrinter):  # type: ignore[misc]
        """Powers as products: a general power of an array is fifty times slower, and inexact for fractions."""

        def _print_Pow(self, expr: Any, rational: bool = False) -> str:
            exponent = expr.exp
            if exponent.is_Integer and 1 < abs(int(exponent)) <= MAX_PRODUCT:
                base = self.parenthesize(expr.base, 100)
                product = "*".join([base] * abs(int(exponent)))
                return f"({product})" if exponent > 0 else f"(1/({product}))"
            return str(super()._print_Pow(expr, rational=rational))

        def _print_Max(self, expr: Any) -> str:
            return self._nested("numpy.maximum", expr)

        def _print_Min(self, expr: Any) -> str:
            return self._nested("numpy.minimum", expr)

        def _nested(self, name: str, expr: Any) -> str:
            text, *others = map(self._print, expr.args)
            for other in others:
                text = f"{name}({text}, {other})"
            return str(text)

        def _print_Piecewise(self, expr: Any) -> str:
            *pieces, (last, always) = expr.args
            text = self._print(last) if always == True else "numpy.nan"  # noqa: E712
            for value, condition in reversed(pieces if always == True else expr.args):  # noqa: E712
                text = f"numpy.where({self._print(condition)}, {self._print(value)}, {text})"
            return text

        def _print_Relational(self, expr: Any) -> str:
            return f"({self._print(expr.lhs)} {expr.rel_op} {self._print(expr.rhs)})"

    return Printer({"fully_qualified_modules": True})


def build(source: str, name: str, *, exact: bool = False, functions: Any = None) -> Callable[..., tuple[Any, ...]]:
    """Compile generated source and return its function.

    With ``exact=True`` it runs on fractions; functions other than arithmetic are then rounded to doubles. Another
    kind of number brings its own ``functions``, with NumPy's names.
    """
    import numpy

    namespace: dict[str, Any] = {"numpy": functions or (_ExactFunctions() if exact else numpy), "math": math}
    exec(compile(source, f"<generated {name}>", "exec"), namespace)
    function: Callable[..., tuple[Any, ...]] = namespace[name]
    return function


def build_for_points(source: str, name: str) -> Callable[..., tuple[Any, ...]]:
    """Compile generated source for arrays, and for single points at the speed of Python's own floats.

    Numbers that Python refuses, such as one over zero in a case that does not hold, are NumPy's matter.
    """
    arrays, floats = build(source, name), build(source, name, functions=_FloatFunctions())

    def either(*groups: Any) -> tuple[Any, ...]:
        if all(getattr(item, "ndim", 0) == 0 for group in groups for item in group):
            try:
                return floats(*([float(item) for item in group] for group in groups))
            except (ArithmeticError, ValueError):
                pass
        return arrays(*groups)

    return either


class _FloatFunctions:
    """NumPy's functions for single floats: those of `math`, which raise an error where NumPy's give no number."""

    where = staticmethod(lambda condition, yes, no: yes if condition else no)
    sign = staticmethod(lambda x: x if x != x else float((x > 0) - (x < 0)))
    arctan2, arctan, arcsin, arccos = math.atan2, math.atan, math.asin, math.acos
    sin, cos, tan, sqrt, exp, log, tanh, abs = (
        *(math.sin, math.cos, math.tan, math.sqrt, math.exp, math.log, math.tanh),
        abs,
    )

    def __getattr__(self, name: str) -> Any:
        import numpy

        return getattr(numpy, name)


class _ExactFunctions:
    """NumPy's functions for fractions: rounded to a double, then taken as that exact number."""

    @staticmethod
    def where(condition: bool, yes: Any, no: Any) -> Any:
        return yes if condition else no

    def __getattr__(self, name: str) -> Any:
        from fractions import Fraction

        import numpy

        function = getattr(numpy, name)

        def rounded(*x: Any) -> Fraction:
            return Fraction(float(function(*map(float, x))))

        return rounded if callable(function) else Fraction(function)
