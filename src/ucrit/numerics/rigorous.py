"""Ranges of functions over many boxes at once, proved: interval arithmetic rounded outward, sharpened by slopes.

Each quantity carries an enclosure of its values over the box, one of its value at the box's centre, and one of its
partial derivatives; the mean value form (R. E. Moore, Interval Analysis (1966), chapter 6) makes excess widths shrink
with the square of the box. Every operation of IEEE doubles is within half a unit in the last place of the true
result, and bounds are moved by more than that. Bounds that overflow become NaN: not known.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
Pair = tuple[Any, Any]

WIDEN = 2.5e-16
"""More than one unit in the last place of the largest significand, so that subtracting it may itself be rounded."""

TINY = 1e-300
"""What products below the smallest double may lose, and much more."""

WAVE = 4e-15
"""Error allowed to sines, cosines and exponentials of NumPy: twenty times what its authors state (4 units)."""


def _out(low: Any, high: Any) -> Pair:
    """Move two bounds outward by what rounding may have moved them inward."""
    return low - (np.abs(low) * WIDEN + TINY), high + (np.abs(high) * WIDEN + TINY)


def _add(a: Pair, b: Pair) -> Pair:
    return _out(a[0] + b[0], a[1] + b[1])


def _multiply(a: Pair, b: Pair) -> Pair:
    products = a[0] * b[0], a[0] * b[1], a[1] * b[0], a[1] * b[1]
    low = np.minimum(np.minimum(products[0], products[1]), np.minimum(products[2], products[3]))
    high = np.maximum(np.maximum(products[0], products[1]), np.maximum(products[2], products[3]))
    return _out(low, high)


def _invert(a: Pair) -> Pair:
    crosses = ~((a[0] > 0) | (a[1] < 0))
    low, high = np.where(crosses, np.nan, a[1]), np.where(crosses, np.nan, a[0])
    return _out(1 / low, 1 / high)


def _negate(a: Pair) -> Pair:
    return -a[1], -a[0]


def exact_pair(value: Fraction) -> tuple[float, float]:
    """Return the doubles next to a number: the largest not above it and the smallest not below it.

    >>> low, high = exact_pair(Fraction(1, 10))
    >>> low < high, Fraction(low) < Fraction(1, 10) < Fraction(high), exact_pair(Fraction(3))
    (True, True, (3.0, 3.0))
    """
    near = float(value)
    if Fraction(near) == value:
        return near, near
    if Fraction(near) < value:
        return near, math.nextafter(near, math.inf)
    return math.nextafter(near, -math.inf), near


class Boxes:
    """Boxes in d dimensions, shape (d, N): exact ends, a centre inside, and how far the ends are from it."""

    def __init__(self, lower: Array, upper: Array) -> None:
        self.lower, self.upper = lower, upper
        self.centre = np.clip(lower + (upper - lower) / 2, lower, upper)
        self.reach = _out(lower - self.centre, upper - self.centre)

    def variables(self) -> list[Proved]:
        """Return the coordinates as quantities."""
        found = []
        for axis in range(len(self.lower)):
            slopes = np.zeros(self.lower.shape)
            slopes[axis] = 1
            ends, centre = (self.lower[axis], self.upper[axis]), (self.centre[axis], self.centre[axis])
            found.append(Proved(ends, centre, (slopes, slopes), self.reach))
        return found

    def centres(self) -> list[Proved]:
        """Return the coordinates of the centres, as constants."""
        return [Proved((c, c)) for c in self.centre]


class Proved:
    """Bounds of a function over N boxes that hold for sure; arithmetic with numbers.

    Attributes
    ----------
    ends
        Lower and upper bounds over the box, shape (N,) or one number.
    centre
        Bounds of the value at the centre; those of the box for a constant.
    slopes
        Bounds of the partial derivatives, shape (d, N), or ``None`` for a constant.

    Examples
    --------
    >>> (x,) = Boxes(np.array([[0.5]]), np.array([[1.5]])).variables()
    >>> y = x * (2 - x)
    >>> bool(0.49 < y.ends[0][0] <= 0.75), bool(1.0 <= y.ends[1][0] < 1.51)
    (True, True)
    """

    __array_ufunc__: Any = None

    def __init__(self, ends: Pair, centre: Pair | None = None, slopes: Pair | None = None, reach: Any = None) -> None:
        self.ends, self.slopes, self.reach = ends, slopes, reach
        self.centre = ends if centre is None or slopes is None else centre
        if slopes is not None:
            self._sharpen()

    def _sharpen(self) -> None:
        """Cut the range with the mean value form; a bound that is not a number loses to one that is."""
        assert self.slopes is not None
        change = _multiply(self.slopes, self.reach)
        total = self.centre
        for low, high in zip(*change, strict=True):
            total = _add(total, (low, high))
        self.ends = np.fmax(self.ends[0], total[0]), np.fmin(self.ends[1], total[1])

    @classmethod
    def constant(cls, value: float | int | Fraction) -> Proved:
        """Return a number; a float that is no integer stands for all numbers that round to it."""
        if isinstance(value, float):
            if value.is_integer():
                return cls((value, value))
            return cls((math.nextafter(value, -math.inf), math.nextafter(value, math.inf)))
        return cls(exact_pair(Fraction(value)))

    def _of(self, other: Any) -> Proved:
        return other if isinstance(other, Proved) else Proved.constant(other)

    def _reach(self, other: Proved) -> Any:
        return self.reach if self.slopes is not None else other.reach

    def __add__(self, other: Any) -> Proved:
        y = self._of(other)
        slopes = self.slopes if y.slopes is None else y.slopes
        if self.slopes is not None and y.slopes is not None:
            slopes = _add(self.slopes, y.slopes)
        return Proved(_add(self.ends, y.ends), _add(self.centre, y.centre), slopes, self._reach(y))

    __radd__ = __add__

    def __neg__(self) -> Proved:
        slopes = None if self.slopes is None else _negate(self.slopes)
        return Proved(_negate(self.ends), _negate(self.centre), slopes, self.reach)

    def __sub__(self, other: Any) -> Proved:
        return self + (-self._of(other))

    def __rsub__(self, other: Any) -> Proved:
        return self._of(other) + (-self)

    def __mul__(self, other: Any) -> Proved:
        y = self._of(other)
        one = None if self.slopes is None else _multiply(self.slopes, y.ends)
        two = None if y.slopes is None else _multiply(y.slopes, self.ends)
        slopes = _add(one, two) if one is not None and two is not None else one if two is None else two
        ends, centre = _multiply(self.ends, y.ends), _multiply(self.centre, y.centre)
        return Proved(ends, centre, slopes, self._reach(y))

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Proved:
        return self * self._of(other)._inverse()

    def __rtruediv__(self, other: Any) -> Proved:
        return self._of(other) * self._inverse()

    def _inverse(self) -> Proved:
        ends = _invert(self.ends)
        return self._through(ends, _invert(self.centre), _negate(_multiply(ends, ends)))

    def __pow__(self, exponent: Any) -> Proved:
        if exponent == 0.5:
            return self._root()
        if not isinstance(exponent, int):
            raise NotImplementedError(f"a power of {exponent}")
        power: Proved = Proved((1.0, 1.0))
        for _ in range(abs(exponent)):
            power = power * self
        return power if exponent >= 0 else 1 / power

    def __abs__(self) -> Proved:
        def size(a: Pair) -> Pair:
            nearest = np.where(a[0] > 0, a[0], np.where(a[1] < 0, -a[1], 0.0))
            return nearest, np.maximum(-a[0], a[1])

        low, high = self.ends
        slope = np.where(low >= 0, 1.0, -1.0), np.where(high <= 0, -1.0, 1.0)
        return self._through(size(self.ends), size(self.centre), slope)

    def _root(self) -> Proved:
        def root(a: Pair) -> Pair:
            return _out(np.sqrt(a[0]), np.sqrt(a[1]))

        ends = root(self.ends)
        return self._through(ends, root(self.centre), _multiply((0.5, 0.5), _invert(ends)))

    def _through(self, ends: Pair, centre: Pair, slope: Pair) -> Proved:
        """Return a function of this quantity from its range, its value at the centre and the range of its slope."""
        slopes = None if self.slopes is None else _multiply(self.slopes, slope)
        return Proved(ends, centre, slopes, self.reach)

    def _wave(self, value: Callable[[Any], Any], slope: Callable[[Any], Any]) -> Proved:
        """Return a function whose value and slope lie in [-1, 1] and change no faster than the argument."""

        def around(f: Callable[[Any], Any], a: Pair) -> Pair:
            middle = a[0] + (a[1] - a[0]) / 2
            reach = _out(middle, np.maximum(a[1] - middle, middle - a[0]))[1] + WAVE
            return np.fmax(f(middle) - reach, -1.0), np.fmin(f(middle) + reach, 1.0)

        return self._through(around(value, self.ends), around(value, self.centre), around(slope, self.ends))

    def times_sign(self, sign: Array) -> Proved:
        """Return the quantity times +1 or -1, which may differ between boxes."""

        def turn(a: Pair) -> Pair:
            return np.where(sign > 0, a[0], -a[1]), np.where(sign > 0, a[1], -a[0])

        return Proved(
            turn(self.ends), turn(self.centre), None if self.slopes is None else turn(self.slopes), self.reach
        )

    def __lt__(self, other: Any) -> bool:
        raise NotImplementedError("a comparison")

    __gt__ = __le__ = __ge__ = __lt__


class ProvedFunctions:
    """What stands for NumPy in generated code that runs on `Proved`; other functions raise NotImplementedError."""

    pi = math.pi

    @staticmethod
    def sin(x: Any) -> Any:
        """Sine."""
        return _lifted(x)._wave(np.sin, np.cos)

    @staticmethod
    def cos(x: Any) -> Any:
        """Cosine."""
        return _lifted(x)._wave(np.cos, lambda c: -np.sin(c))

    @classmethod
    def tan(cls, x: Any) -> Any:
        """Tangent."""
        return cls.sin(x) / cls.cos(x)

    @staticmethod
    def exp(x: Any) -> Any:
        """Exponential."""
        y = _lifted(x)

        def power(a: Pair) -> Pair:
            return _out(np.exp(a[0]) * (1 - WAVE), np.exp(a[1]) * (1 + WAVE))

        return y._through(power(y.ends), power(y.centre), power(y.ends))

    @staticmethod
    def sqrt(x: Any) -> Any:
        """Square root; not known where the argument may be negative."""
        return _lifted(x)._root()

    def __getattr__(self, name: str) -> Any:
        raise NotImplementedError(name)


def _lifted(x: Any) -> Proved:
    return x if isinstance(x, Proved) else Proved.constant(x)


def minors(a: Sequence[Proved], sizes: Sequence[int]) -> dict[int, Proved]:
    """Return leading principal minors of the Hurwitz matrix, by size, expanded by rows with shared minors."""
    n = len(a) - 1
    found: dict[int, Proved] = {}
    partial: dict[int, Proved] = {0: Proved((1.0, 1.0))}
    columns = max(sizes, default=0)
    for i in range(columns):
        following: dict[int, Proved] = {}
        for used, minor in partial.items():
            for j in range(columns):
                power = n - 2 * (j + 1) + i + 1
                if 0 <= power <= n and not used >> j & 1:
                    term = minor * a[power]
                    term = -term if (used >> j).bit_count() % 2 else term
                    key = used | 1 << j
                    following[key] = following[key] + term if key in following else term
        partial = following
        if i + 1 in sizes and 2 ** (i + 1) - 1 in partial:
            found[i + 1] = partial[2 ** (i + 1) - 1]
    return found
