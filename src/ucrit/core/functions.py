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
sign = _dispatch("sign", "sign", "sign")
