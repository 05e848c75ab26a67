"""Formulas as the text form of bond graphs writes them, so that `ucrit.core.formulas.expressions` reads them back."""

from __future__ import annotations

from functools import cache
from typing import Any

NAMES = {"Abs": "abs", "Min": "min", "Max": "max", "Length": "length", "Share": "share", "Group": "grouped"}
"""SymPy's functions, and this package's own, whose names in the text form are others."""

BRANCHES = ("Piecewise", "And", "Or", "Not", "ITE")
COMPARISONS = ("<", "<=", ">", ">=")


def formula(x: Any) -> str:
    """Return an expression as text.

    >>> import sympy as sp
    >>> v = sp.Symbol("flow", real=True)
    >>> formula(sp.Piecewise((2 * v, abs(v) < 1), (sp.sign(v), True)))
    'where(abs(flow) < 1, 2*flow, sign(flow))'
    """
    return str(_printer().doprint(x))


def unnamed(x: Any) -> Any:
    """Return a function or a comparison of an expression that the text form has no name for; ``None`` without one."""
    from sympy.core.function import Application
    from sympy.core.relational import Relational

    from ..core.formulas.expressions import LAWS

    def named(function: Any) -> bool:
        name = function.func.__name__
        return NAMES.get(name, name) in LAWS or name in BRANCHES

    odd = [f for f in x.atoms(Application) if not named(f)]
    odd += [r for r in x.atoms(Relational) if r.rel_op not in COMPARISONS]
    return min(odd, key=str, default=None)


@cache
def _printer() -> Any:
    from sympy.printing.str import StrPrinter

    class Printer(StrPrinter):  # type: ignore[misc]
        """Conditions, corners and vectors by their names in the text form."""

        printmethod = "_bondtext"

        def _print_Function(self, x: Any) -> str:
            name = x.func.__name__
            return f"{NAMES.get(name, name)}({', '.join(map(self._print, x.args))})"

        _print_Abs = _print_Min = _print_Max = _print_Function

        def _print_Exp1(self, _: Any) -> str:
            return "exp(1)"

        def _print_Piecewise(self, x: Any) -> str:
            (value, condition), *others = x.args
            if condition == True:  # noqa: E712
                return str(self._print(value))
            otherwise = self._print(x.func(*others)) if others else "nan"
            return f"where({self._print(condition)}, {self._print(value)}, {otherwise})"

        def _print_ITE(self, x: Any) -> str:
            return f"where({', '.join(map(self._print, x.args))})"

        def _joined(self, x: Any, word: str) -> str:
            return word.join(f"({self._print(part)})" for part in sorted(x.args, key=str))

        def _print_And(self, x: Any) -> str:
            return self._joined(x, " and ")

        def _print_Or(self, x: Any) -> str:
            return self._joined(x, " or ")

        def _print_Not(self, x: Any) -> str:
            return f"not ({self._print(x.args[0])})"

    return Printer()
