"""Functions for equations of motion: one name for floats, arrays and symbols.

Equations are run on numbers and, once, on SymPy symbols; these pick NumPy's or SymPy's version by argument, so
that neither package is imported for the other's sake.
"""

from __future__ import annotations

from typing import Any

import numpy as np


def _dispatch(name: str, numpy_name: str, meaning: str) -> Any:
    numeric = getattr(np, numpy_name)

    def function(*arguments: Any) -> Any:
        if any(hasattr(argument, "free_symbols") for argument in arguments):
            import sympy

            return getattr(sympy, name)(*arguments)
        return numeric(*arguments)

    function.__name__ = function.__qualname__ = name
    function.__doc__ = f"Return the {meaning} of floats, arrays or symbols (angles in rad)."
    return function


sin = _dispatch("sin", "sin", "sine")
cos = _dispatch("cos", "cos", "cosine")
tan = _dispatch("tan", "tan", "tangent")
asin = _dispatch("asin", "arcsin", "inverse sine")
atan = _dispatch("atan", "arctan", "inverse tangent")
atan2 = _dispatch("atan2", "arctan2", "angle of the point (second, first argument)")
sqrt = _dispatch("sqrt", "sqrt", "square root")
exp = _dispatch("exp", "exp", "exponential")
log = _dispatch("log", "log", "natural logarithm")
tanh = _dispatch("tanh", "tanh", "hyperbolic tangent")


def where(condition: Any, yes: Any, no: Any) -> Any:
    """Return ``yes`` where the condition holds and ``no`` elsewhere, for floats, arrays or symbols.

    >>> float(where(2 > 1, 3.0, 4.0))
    3.0
    """
    if isinstance(condition, bool | np.bool_):
        return yes if condition else no
    if any(hasattr(argument, "free_symbols") for argument in (condition, yes, no)):
        import sympy

        if condition in (True, False):
            return yes if condition else no
        return sympy.Piecewise((yes, condition), (no, True))
    return np.where(condition, yes, no)


def minimum(a: Any, b: Any) -> Any:
    """Return the smaller of two floats, arrays or symbols; its slope is that of the smaller one."""
    return where(a < b, a, b)


def maximum(a: Any, b: Any) -> Any:
    """Return the larger of two floats, arrays or symbols; its slope is that of the larger one."""
    return where(a > b, a, b)


def sign(a: Any) -> Any:
    """Return -1, 0 or 1, the sign of floats, arrays or symbols; its slope is zero, also where it jumps."""
    if hasattr(a, "free_symbols"):
        return where(a > 0, 1, where(a < 0, -1, 0))
    return np.sign(a)


def grouped(a: Any) -> Any:
    """Return a pure number unchanged; as a formula of parameters, it is then carried as one thing.

    >>> grouped(0.5)
    0.5
    """
    if getattr(a, "free_symbols", None):
        from .grouped import Group

        return Group(a)
    return a


def length(a: Any, b: Any) -> Any:
    """Return the length of a plane vector of pure numbers, without a corner where it vanishes.

    Formulas can divide by it and be differentiated: where both components vanish its slope is zero.

    >>> float(length(-3.0, 4.0)), length(0, -2.0)
    (5.0, 2.0)
    """
    if _is_zero(a):
        return abs(b)
    if _is_zero(b):
        return abs(a)
    if hasattr(a, "free_symbols") or hasattr(b, "free_symbols"):
        import sympy

        from .plane import Length

        return Length(sympy.sympify(a), sympy.sympify(b))
    return sqrt(a * a + b * b)


def _is_zero(value: Any) -> bool:
    return bool(getattr(value, "is_zero", False)) or (isinstance(value, int | float) and value == 0)
