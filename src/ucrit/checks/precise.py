"""Comparison of expressions in fifty digits at random parameters, which leaves no doubt about equality."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any

import mpmath
import sympy as sp

DIGITS = 50
EQUAL = mpmath.mpf(10) ** -30

Point = Sequence[Any]


def numeric(expressions: Iterable[Any], symbols: Sequence[sp.Symbol]) -> Callable[[Point], list[Any]]:
    """Return a function that evaluates expressions in fifty digits.

    >>> p = sp.Symbol("p")
    >>> mpmath.nstr(numeric([sp.sqrt(p)], [p])([2])[0], 30)
    '1.41421356237309504880168872421'
    """
    function = sp.lambdify([list(symbols)], list(expressions), modules="mpmath")

    def evaluate(point: Point) -> list[Any]:
        with mpmath.workdps(DIGITS):
            return [mpmath.mpmathify(value) for value in function([mpmath.mpf(value) for value in point])]

    return evaluate


def matrix(expressions: sp.Matrix, symbols: Sequence[sp.Symbol]) -> Callable[[Point], Any]:
    """Return a function that evaluates a matrix in fifty digits."""
    evaluate = numeric(list(expressions), symbols)

    def build(point: Point) -> Any:
        values, (rows, columns) = evaluate(point), expressions.shape
        return mpmath.matrix([values[i * columns : (i + 1) * columns] for i in range(rows)] or [[]])

    return build


def same_up_to_factor(left: Sequence[Any], right: Sequence[Any]) -> bool:
    """Tell whether two polynomials, coefficients ascending, agree up to a factor free of the variable."""
    with mpmath.workdps(DIGITS):
        nodes = frequencies(left, max(len(left), len(right)) + 1)
        pairs = [(polynomial(left, s), polynomial(right, s)) for s in nodes]
        factor = pairs[0][0] / pairs[0][1]
        return all(abs(a - factor * b) <= EQUAL * abs(a) for a, b in pairs)


def polynomial(ascending: Sequence[Any], s: Any) -> Any:
    """Evaluate a polynomial by Horner's rule."""
    value = mpmath.mpf(0)
    for coefficient in reversed(ascending):
        value = value * s + coefficient
    return value


def frequencies(ascending: Sequence[Any], count: int) -> list[Any]:
    """Return complex numbers as large as the polynomial's roots, none of them a likely root."""
    nonzero = [(k, abs(a)) for k, a in enumerate(ascending) if a]
    (low, first), (high, last) = nonzero[0], nonzero[-1]
    size = (first / last) ** (mpmath.mpf(1) / (high - low)) if high > low else mpmath.mpf(1)
    return [size * (1 + mpmath.mpf(k) / 7) * mpmath.expj(mpmath.sqrt(2) + k) for k in range(count)]


def close(left: Any, right: Any, scale: Any = 0) -> bool:
    """Tell whether two numbers agree to thirty digits of themselves or of ``scale``."""
    return bool(abs(left - right) <= EQUAL * max(abs(left), abs(right), abs(scale)))
