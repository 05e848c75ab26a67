"""Ranges of functions over many boxes at once: interval arithmetic sharpened by slopes (mean value form).

Each quantity carries its value at the box's centre, an enclosure of its values and one of its partial derivatives,
so that the excess width shrinks with the square of the box (R. E. Moore, Interval Analysis (1966), chapter 6). Bounds
are not rounded outward: they hold to a few rounding units.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from .rounded import conditions

Array = npt.NDArray[np.float64]


def _product(a: Array, b: Array, c: Array, d: Array) -> tuple[Array, Array]:
    """Range of the products of numbers in [a, b] and [c, d]."""
    ac, ad, bc, bd = a * c, a * d, b * c, b * d
    return np.minimum(np.minimum(ac, ad), np.minimum(bc, bd)), np.maximum(np.maximum(ac, ad), np.maximum(bc, bd))


def _scaled(ends: Any, factor: Any) -> tuple[Array, Array]:
    """Range of the products of numbers between two ends and a factor."""
    low, high = ends[0] * factor, ends[1] * factor
    if np.ndim(factor) == 0:
        return (high, low) if factor < 0 else (low, high)
    return np.minimum(low, high), np.maximum(low, high)


class Enclosure:
    """Values of a function over N boxes in d dimensions; arithmetic with numbers and arrays (N,) of constants.

    Attributes
    ----------
    centre, lower, upper
        Shape (N,): the value at the centre, and bounds over the box.
    slopes
        Shape (2, d, N): bounds of the partial derivatives over the box.
    half
        Shape (d, N): half the width of the boxes.

    Examples
    --------
    >>> x = Enclosure.variable(0, np.array([[1.0, 3.0]]).T, np.array([[0.5, 0.5]]).T)
    >>> square = x * x
    >>> square.lower.tolist(), square.upper.tolist()
    ([0.25], [2.25])
    """

    __array_ufunc__: Any = None
    centre: Array
    lower: Array
    upper: Array
    slopes: Array
    half: Array

    def __init__(self, centre: Array, lower: Array, upper: Array, slopes: Array, half: Array) -> None:
        reach = (np.abs(slopes).max(axis=0) * half).sum(axis=0)
        self.centre, self.slopes, self.half = centre, slopes, half
        self.lower, self.upper = np.fmax(lower, centre - reach), np.fmin(upper, centre + reach)

    @classmethod
    def variable(cls, axis: int, centres: Array, half: Array) -> Enclosure:
        """Return one coordinate over boxes with centres and half widths of shape (d, N)."""
        slopes = np.zeros((2, *half.shape))
        slopes[:, axis] = 1
        return cls(centres[axis], centres[axis] - half[axis], centres[axis] + half[axis], slopes, half)

    def __add__(self, other: Any) -> Enclosure:
        if not isinstance(other, Enclosure):
            return Enclosure(self.centre + other, self.lower + other, self.upper + other, self.slopes, self.half)
        ends = self.lower + other.lower, self.upper + other.upper
        return Enclosure(self.centre + other.centre, *ends, self.slopes + other.slopes, self.half)

    __radd__ = __add__

    def __neg__(self) -> Enclosure:
        return Enclosure(-self.centre, -self.upper, -self.lower, -self.slopes[::-1], self.half)

    def __sub__(self, other: Any) -> Enclosure:
        difference: Enclosure = self + (-other)
        return difference

    def __rsub__(self, other: Any) -> Enclosure:
        difference: Enclosure = -self + other
        return difference

    def __mul__(self, other: Any) -> Enclosure:
        if not isinstance(other, Enclosure):
            slopes = np.stack(_scaled(self.slopes, other))
            return Enclosure(self.centre * other, *_scaled((self.lower, self.upper), other), slopes, self.half)
        ends = _product(self.lower, self.upper, other.lower, other.upper)
        one = _product(self.slopes[0], self.slopes[1], other.lower, other.upper)
        two = _product(other.slopes[0], other.slopes[1], self.lower, self.upper)
        slopes = np.stack([one[0] + two[0], one[1] + two[1]])
        return Enclosure(self.centre * other.centre, *ends, slopes, self.half)

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Enclosure:
        quotient: Enclosure = self * (1 / other)
        return quotient

    def __rtruediv__(self, other: Any) -> Enclosure:
        crosses = (self.lower <= 0) & (self.upper >= 0)
        lower, upper = np.where(crosses, np.nan, 1 / self.upper), np.where(crosses, np.nan, 1 / self.lower)
        inverse = self._through(
            1 / self.centre, lower, upper, *(-x for x in _product(lower, upper, lower, upper)[::-1])
        )
        inverse.lower[crosses], inverse.upper[crosses] = -np.inf, np.inf
        quotient: Enclosure = inverse * other
        return quotient

    def __pow__(self, exponent: int) -> Enclosure:
        if exponent < 0:
            return 1 / self ** (-exponent)
        power: Any = 1
        for _ in range(exponent):
            power = power * self
        return power  # type: ignore[no-any-return]

    def __abs__(self) -> Enclosure:
        nearest = np.where(self.lower > 0, self.lower, np.where(self.upper < 0, -self.upper, 0.0))
        slope = np.where(self.lower >= 0, 1.0, -1.0), np.where(self.upper <= 0, -1.0, 1.0)
        return self._through(np.abs(self.centre), nearest, np.maximum(-self.lower, self.upper), *slope)

    def _through(self, centre: Array, lower: Array, upper: Array, least: Array, most: Array) -> Enclosure:
        """Return a function of this quantity from its range and that of its derivative."""
        return Enclosure(
            centre, lower, upper, np.stack(_product(self.slopes[0], self.slopes[1], least, most)), self.half
        )

    def _wave(self, value: Callable[[Any], Array], slope: Callable[[Any], Array]) -> Enclosure:
        """Return a function whose value and slope lie in [-1, 1] and change no faster than the argument."""
        reach = np.maximum(self.upper - self.centre, self.centre - self.lower)
        f, df = value(self.centre), slope(self.centre)
        ends = [np.clip(x, -1, 1) for x in (f - reach, f + reach, df - reach, df + reach)]
        return self._through(f, *ends)


class EnclosureFunctions:
    """What stands for NumPy in generated code that runs on enclosures; other functions raise `AttributeError`."""

    pi = math.pi

    @staticmethod
    def sin(x: Any) -> Any:
        """Sine."""
        return x._wave(np.sin, np.cos) if isinstance(x, Enclosure) else np.sin(x)

    @staticmethod
    def cos(x: Any) -> Any:
        """Cosine."""
        return x._wave(np.cos, lambda c: -np.sin(c)) if isinstance(x, Enclosure) else np.cos(x)

    @classmethod
    def tan(cls, x: Any) -> Any:
        """Tangent."""
        return cls.sin(x) / cls.cos(x)

    @staticmethod
    def exp(x: Any) -> Any:
        """Exponential."""
        if not isinstance(x, Enclosure):
            return np.exp(x)
        ends = np.exp(x.lower), np.exp(x.upper)
        return x._through(np.exp(x.centre), *ends, *ends)

    @staticmethod
    def sqrt(x: Any) -> Any:
        """Square root; not a number where the argument may be negative."""
        if not isinstance(x, Enclosure):
            return np.sqrt(x)
        lower, upper = np.sqrt(x.lower), np.sqrt(x.upper)
        return x._through(np.sqrt(x.centre), lower, upper, 0.5 / upper, 0.5 / lower)


def excluded(a: Sequence[Any], count: int) -> npt.NDArray[np.bool_]:
    """Tell in which boxes all points are stable, or none is, from enclosures of the coefficients."""
    if len(a) == 1:
        return np.ones(count, dtype=bool)
    lower, upper = _range(a[-1], count)
    sign = np.where(upper < 0, -1.0, 1.0)
    fixed = (lower > 0) | (upper < 0)
    a = [c * sign for c in a]
    stable, unstable = np.array(fixed), np.zeros(count, dtype=bool)
    before = np.array(fixed)
    for c in conditions(a):
        lower, upper = _range(c, count)
        # up to degree 4 each condition is needed by itself; in Routh's column only as long as those before hold
        unstable |= (upper <= 0) & fixed & (before if len(a) > 5 else True)
        before &= lower > 0
        stable &= lower > 0
    for c in a:
        unstable |= (_range(c, count)[1] <= 0) & fixed
    return np.asarray(stable | unstable)


def _range(c: Any, count: int) -> tuple[Array, Array]:
    ends = (c.lower, c.upper) if isinstance(c, Enclosure) else (c, c)
    return np.broadcast_to(ends[0], (count,)), np.broadcast_to(ends[1], (count,))
