"""Every real root of an exact polynomial: none missed, none invented, each to the nearest double.

Isolation is by Descartes' rule of signs and bisection (Collins and Akritas 1976; Basu, Pollack and Roy,
Algorithms in Real Algebraic Geometry, sec. 10.2): unlike Sturm chains its integers hardly grow.
Refinement bisects the doubles themselves, so it ends after at most 63 exact signs.
"""

import struct
from collections.abc import Callable, Sequence
from fractions import Fraction
from itertools import accumulate, pairwise
from math import inf
from typing import Any

from .exact import derivative, divmod_, gcd, primitive, rational, square_free

Interval = tuple[Fraction, Fraction]

_INFINITY_BITS = 0x7FF0_0000_0000_0000


def real_roots(p: Sequence[Any], lo: Any = -inf, hi: Any = inf) -> list[tuple[float, int]]:
    """All distinct real roots of `p` in the closed interval [`lo`, `hi`], ascending, with multiplicities.

    Parameters
    ----------
    p : coefficients in ascending powers: int, float (taken as the exact number it stores) or Fraction
    lo, hi : ends of the interval; both belong to it and may be infinite

    Returns
    -------
    list of (root, multiplicity) : each root is the double nearest to the exact root. Two different roots that
        round to the same double are both listed.

    Raises
    ------
    ValueError
        If `p` is the zero polynomial, a coefficient is not finite, or `lo` is above `hi`.

    Examples
    --------
    >>> real_roots([2, 0, -5, 0, 2], lo=0)
    [(0.7071067811865476, 1), (1.4142135623730951, 1)]
    >>> real_roots([0, 9, -6, 1])
    [(0.0, 1), (3.0, 2)]
    """
    return sorted(
        (refine(factor, interval), multiplicity)
        for factor, multiplicity in square_free(p)
        for interval in isolate(factor, lo, hi)
    )


def isolate(p: Sequence[Any], lo: Any = -inf, hi: Any = inf) -> list[Interval]:
    """Rational intervals, ascending, one for each distinct real root of `p` in the closed [`lo`, `hi`].

    An interval (x, x) is the root x itself; otherwise exactly one root lies strictly between the two ends.
    Intervals may touch, and an end of one may be a root that has its own interval (x, x); they never overlap.

    Raises
    ------
    ValueError
        If `p` is the zero polynomial, a coefficient is not finite, or `lo` is above `hi`.

    Examples
    --------
    >>> [(str(x), str(y)) for x, y in isolate([-2, 0, 1], 0, 2)]
    [('0', '2')]
    >>> isolate([-2, 0, 1], 2)
    []
    """
    if not lo <= hi:
        raise ValueError(f"interval from {lo} to {hi}: the lower end must not be above the upper end")
    f = primitive(p)
    if not f:
        raise ValueError("the polynomial is 0: it needs at least one non-zero coefficient")
    f = primitive(divmod_(f, gcd(f, derivative(f)))[0])  # the same roots, each of them simple
    bound = _root_bound(f)
    left, right = (bound if x > bound else -bound if x < -bound else rational(x) for x in (lo, hi))
    # A cut at 0 separates the roots by sign, so that `refine` can work on magnitudes.
    cuts = sorted({left, right} | ({Fraction(0)} if left < 0 < right else set()))
    found = [(x, x) for x in cuts if not _value(f, x)]
    for x, y in pairwise(cuts):
        found += _isolate_between(f, x, y)
    return sorted(found)


def refine(p: Sequence[Any], interval: tuple[Any, Any]) -> float:
    """The double nearest to the one simple root of `p` in an isolating `interval`, as returned by `isolate`.

    Parameters
    ----------
    p : coefficients of a polynomial that has a simple root in the interval
    interval : (x, y), rational; the root lies strictly between x and y, or x = y is the root

    Returns
    -------
    float : correctly rounded (ties to even); infinite if the root rounds beyond the largest double

    Raises
    ------
    ValueError
        If `p` does not change sign in the interval.

    Examples
    --------
    >>> refine([-2, 0, 1], (1, 2))
    1.4142135623730951
    """
    f = primitive(p)
    lo, hi = (rational(x) for x in interval)
    if lo == hi:
        return -refine(f, (-lo, -lo)) if lo < 0 else _nearest_double(lambda x: _sign(x - lo))
    # An end may be another root; then the slope there tells the sign just inside.
    before = _sign(_value(f, lo)) or _sign(_value(derivative(f), lo))
    after = _sign(_value(f, hi)) or -_sign(_value(derivative(f), hi))
    if before == after:
        raise ValueError(f"the polynomial has the same sign at {lo} and {hi}: the interval must isolate a simple root")
    if lo < 0 < hi:
        centre = _sign(_value(f, Fraction(0)))
        return refine(f, (0, 0) if not centre else (lo, 0) if centre == after else (0, hi))
    if lo < 0:
        mirrored = [-x if k % 2 else x for k, x in enumerate(f)]
        return -refine(mirrored, (-hi, -lo))
    return _nearest_double(lambda x: -1 if x <= lo else 1 if x >= hi else after * _sign(_value(f, x)))


def _nearest_double(side: Callable[[Fraction], int]) -> float:
    """The double nearest to a number r >= 0 of which only the sign of x - r is known, as `side(x)`."""
    low, high = 0, _INFINITY_BITS  # the bits of non-negative doubles, read as integers, are in order
    while high - low > 1:
        middle = (low + high) // 2
        if side(Fraction(_double(middle))) <= 0:
            low = middle
        else:
            high = middle
    top = Fraction(_double(high)) if high < _INFINITY_BITS else Fraction(2**1024)
    tie = side((Fraction(_double(low)) + top) / 2)
    return _double(low if tie > 0 or (tie == 0 and low % 2 == 0) else high)


def _double(bits: int) -> float:
    """The double with the given 64 bits."""
    value: float = struct.unpack("<d", struct.pack("<q", bits))[0]
    return value


def _isolate_between(f: list[int], lo: Fraction, hi: Fraction) -> list[Interval]:
    """Isolating intervals of the roots of the square-free `f` strictly between two numbers."""
    found: list[Interval] = []
    pending = [(_to_unit_interval(f, lo, hi - lo), lo, hi)]
    while pending:
        g, x, y = pending.pop()
        changes = _sign_changes(_shift(g[::-1]))  # Descartes for the roots of g between 0 and 1
        if changes == 1:
            found.append((x, y))
        elif changes > 1:
            middle = (x + y) / 2
            left = [c << (len(g) - 1 - k) for k, c in enumerate(g)]
            right = _shift(left)
            if not right[0]:
                found.append((middle, middle))
            pending += [(left, x, middle), (right, middle, y)]
    return found


def _to_unit_interval(f: list[int], start: Fraction, width: Fraction) -> list[int]:
    """A positive multiple of ``f(start + width x)``."""
    # With start = p/q: scale x by 1/q, shift by the integer p, then scale by q width.
    p, q = start.numerator, start.denominator
    scaled = primitive([c * q ** (len(f) - 1 - k) for k, c in enumerate(f)])
    return primitive([c * (width * q) ** k for k, c in enumerate(_shift(scaled, p))])


def _shift(f: list[int], by: int = 1) -> list[int]:
    """The polynomial ``f(x + by)``."""
    row, shifted = f[::-1], []
    while row:
        row = list(accumulate(row) if by == 1 else accumulate(row, lambda total, c: total * by + c))
        shifted.append(row.pop())
    return shifted


def _root_bound(f: list[int]) -> Fraction:
    """A power of two above the magnitude of every root (Fujiwara 1916)."""
    degree, lead = len(f) - 1, f[-1].bit_length() - 1
    ratios = [-(-(c.bit_length() - lead) // (degree - k)) for k, c in enumerate(f[:-1]) if c]
    return Fraction(2) ** (max(ratios, default=0) + 1)


def _value(f: list[int], x: Fraction) -> int:
    """A positive multiple of ``f(x)``, without a single division."""
    numerator, denominator = x.numerator, x.denominator
    total, power = 0, 1
    for c in reversed(f):
        total = total * numerator + c * power
        power *= denominator
    return total


def _sign(x: int | Fraction) -> int:
    return (x > 0) - (x < 0)


def _sign_changes(terms: list[int]) -> int:
    """The number of sign changes in a sequence, zeros ignored."""
    return sum((x > 0) != (y > 0) for x, y in pairwise([x for x in terms if x]))
