"""A group: a pure number that formulas carry as one thing, although it is made of parameters.

Empirical laws have many coefficients; multiplied out, a matrix of a few of them has thousands of terms. Formulas keep
a group as they keep a sine: one symbol while polynomials are made, written out when they are printed or computed.
"""

from __future__ import annotations

from typing import Any

import sympy as sp


class Group(sp.Function):  # type: ignore[misc]
    """The identity, as a function that stays where it is."""

    nargs = 1

    @classmethod
    def eval(cls, content: Any) -> Any:
        """Return a number itself."""
        return content if content.is_number else None

    def fdiff(self, argindex: int = 1) -> Any:
        """Return its slope, one."""
        return sp.S.One

    def _eval_is_positive(self) -> bool | None:
        found: bool | None = self.args[0].is_positive
        return found

    def _eval_is_extended_real(self) -> bool | None:
        found: bool | None = self.args[0].is_extended_real
        return found

    def _eval_evalf(self, prec: int) -> Any:
        return self.args[0]._eval_evalf(prec)

    def _written(self, printer: Any, *_: Any, **__: Any) -> str:
        text: str = printer._print(self.args[0])
        return f"({text})"

    _numpycode = _mpmathcode = _lambdacode = _pythoncode = _sympystr = _written

    def _latex(self, printer: Any, *_: Any, **__: Any) -> str:
        return rf"\left({printer._print(self.args[0])}\right)"

    def _mathml_presentation(self, printer: Any, *_: Any, **__: Any) -> Any:
        row = printer.dom.createElement("mrow")
        for piece in ("(", self.args[0], ")"):
            if isinstance(piece, str):
                bracket = printer.dom.createElement("mo")
                bracket.appendChild(printer.dom.createTextNode(piece))
                row.appendChild(bracket)
            else:
                row.appendChild(printer._print(piece))
        return row
