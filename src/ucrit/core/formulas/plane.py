"""Length and direction of a plane vector of pure numbers, as functions that have a value where the vector vanishes.

Formulas keep them as they are until they are computed: on a basic motion without slip a length is then exactly zero,
and what is compared with it is decided there.
"""

from __future__ import annotations

from typing import Any

import sympy as sp

NOTHING = sp.Rational(1, 10**30)
"""Added to the square of a length that is computed, so that numbers can be divided by it."""


class _OfVector(sp.Function):  # type: ignore[misc]
    """Base of both: printed as what they are made of."""

    nargs = 2

    def written(self, added: Any = 0) -> Any:
        """Return the formula, with something added to the square of the length."""
        raise NotImplementedError

    def computed(self) -> Any:
        """Return the formula that numbers are put into."""
        return self.written(NOTHING)

    def _eval_is_extended_real(self) -> bool:
        return True

    def _eval_is_finite(self) -> bool:
        return True

    def _eval_evalf(self, prec: int) -> Any:
        return self.computed()._eval_evalf(prec)

    def _bracketed(self, printer: Any, *_: Any, **__: Any) -> str:
        return f"({printer._print(self.computed())})"

    _numpycode = _mpmathcode = _lambdacode = _pythoncode = _bracketed

    def _sympystr(self, printer: Any, *_: Any, **__: Any) -> str:
        text: str = printer._print(self.written())
        return text if self.func is Length else f"({text})"

    def _latex(self, printer: Any, *_: Any, **__: Any) -> str:
        text: str = printer._print(self.written())
        return text

    def _mathml_presentation(self, printer: Any, *_: Any, **__: Any) -> Any:
        return printer._print(self.written())


class Length(_OfVector):
    """Length of a vector (a, b)."""

    @classmethod
    def eval(cls, a: Any, b: Any) -> Any:
        """Return the size of the only component, if there is only one."""
        return sp.Abs(b) if a.is_zero else sp.Abs(a) if b.is_zero else None

    def fdiff(self, argindex: int = 1) -> Any:
        """Return the slope by a component: that component's share."""
        a, b = self.args
        return Share(a, b) if argindex == 1 else Share(b, a)

    def written(self, added: Any = 0) -> Any:
        """Return the square root of the sum of squares."""
        a, b = self.args
        return sp.sqrt(a**2 + b**2 + added)

    def _eval_is_nonnegative(self) -> bool:
        return True


class Share(_OfVector):
    """First component of the unit vector along (a, b); 0, the mean of all directions, where the vector vanishes."""

    @classmethod
    def eval(cls, a: Any, b: Any) -> Any:
        """Return what needs no length."""
        return sp.S.Zero if a.is_zero else sp.sign(a) if b.is_zero else None

    def fdiff(self, argindex: int = 1) -> Any:
        """Return the slope by a component."""
        a, b = self.args
        other = Share(b, a)
        return (other**2 if argindex == 1 else -other * self) / Length(a, b)

    def written(self, added: Any = 0) -> Any:
        """Return component over length."""
        a, b = self.args
        return a / sp.sqrt(a**2 + b**2 + added)


def computable(expression: Any) -> Any:
    """Return an expression with lengths and shares written out."""
    if not expression.has(_OfVector):
        return expression
    return expression.replace(lambda e: isinstance(e, _OfVector), lambda e: e.computed())
