"""Expressions as text, LaTeX and MathML, with positive terms first: ``a*b*m - I_c``, not ``-I_c + a*b*m``."""

from __future__ import annotations

from functools import cache
from typing import Any


class _PositiveFirst:
    def _as_ordered_terms(self, expr: Any, order: Any = None) -> list[Any]:
        terms = list(super()._as_ordered_terms(expr, order=order))  # type: ignore[misc]
        return sorted(terms, key=lambda term: bool(term.could_extract_minus_sign()))


@cache
def _printers() -> tuple[Any, Any, Any]:
    from sympy.printing.latex import LatexPrinter
    from sympy.printing.mathml import MathMLPresentationPrinter
    from sympy.printing.str import StrPrinter

    class Text(_PositiveFirst, StrPrinter):  # type: ignore[misc]
        pass

    class Latex(_PositiveFirst, LatexPrinter):  # type: ignore[misc]
        pass

    class MathML(_PositiveFirst, MathMLPresentationPrinter):  # type: ignore[misc]
        pass

    return Text(), Latex(), MathML()


def text(expression: Any) -> str:
    """Return an expression as plain text that Python and SymPy read back."""
    return str(_printers()[0].doprint(expression))


def latex(expression: Any) -> str:
    """Return an expression as LaTeX."""
    return str(_printers()[1].doprint(expression))


def mathml(expression: Any) -> str:
    """Return an expression as presentation MathML, to be put inside a ``<math>`` element."""
    return str(_printers()[2].doprint(expression)).replace("<mo><</mo>", "<mo>&lt;</mo>")
