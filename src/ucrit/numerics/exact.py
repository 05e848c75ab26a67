"""Exact polynomials in one variable over the rational numbers.

A polynomial is a sequence of coefficients in ascending powers, ``a[0] + a[1] x + ... + a[n] x^n``; the zero
polynomial is ``[]``. Coefficients may be int, float, Fraction or SymPy rationals; a float means exactly the
number it stores. Results that are defined up to a factor are primitive integer polynomials, because integers
are what Python does fast.
"""

from collections.abc import Sequence
from fractions import Fraction
from itertools import zip_longest
from math import gcd as integer_gcd
from math import isfinite, lcm
from numbers import Rational
from typing import Any

# A Mersenne prime: polynomials coprime modulo it are coprime, which settles most gcds in a millisecond.
_PRIME = 2**61 - 1


def rational(x: Any) -> Fraction:
    """The number `x` as a Fraction, without rounding.

    Raises
    ------
    ValueError
        If `x` is NaN or infinite.

    Examples
    --------
    >>> rational(0.5), rational(3)
    (Fraction(1, 2), Fraction(3, 1))
    """
    if isinstance(x, Rational):
        return Fraction(int(x.numerator), int(x.denominator))
    value = float(x)
    if not isfinite(value):
        raise ValueError(f"coefficient {value} is not a number: every coefficient must be finite")
    return Fraction(value)


def primitive(p: Sequence[Any]) -> list[int]:
    """The integer polynomial without common factor that is a positive multiple of `p`, leading zeros dropped.

    Examples
    --------
    >>> primitive([0.5, -1.5, 0])
    [1, -3]
    """
    terms = _trimmed([x if type(x) is int else rational(x) for x in p])
    scale = lcm(*(x.denominator for x in terms))
    integers = [x.numerator * (scale // x.denominator) for x in terms]
    content = integer_gcd(*integers) or 1
    return [x // content for x in integers] if content > 1 else integers


def derivative(p: Sequence[Any]) -> list[Any]:
    """The derivative of `p`.

    Examples
    --------
    >>> derivative([5, 4, 3])
    [4, 6]
    """
    return [k * x for k, x in enumerate(p)][1:]


def multiply(p: Sequence[Any], q: Sequence[Any]) -> list[Any]:
    """The product of two polynomials with exact coefficients (int or Fraction).

    Examples
    --------
    >>> multiply([1, 1], [-1, 1])
    [-1, 0, 1]
    """
    product: list[Any] = [0] * (len(p) + len(q) - 1 if p and q else 0)
    for i, x in enumerate(p):
        for j, y in enumerate(q):
            product[i + j] += x * y
    return product


def divmod_(p: Sequence[Any], q: Sequence[Any]) -> tuple[list[Fraction], list[Fraction]]:
    """Quotient and remainder of `p` by `q` over the rationals, the remainder of lower degree than `q`.

    Raises
    ------
    ValueError
        If `q` is the zero polynomial.

    Examples
    --------
    >>> quotient, remainder = divmod_([1, 0, 1], [-1, 2])
    >>> [str(x) for x in quotient], [str(x) for x in remainder]
    (['1/4', '1/2'], ['5/4'])
    """
    rest = [rational(x) for x in p]
    divisor = _trimmed([rational(x) for x in q])
    if not divisor:
        raise ValueError("division by the polynomial 0: the divisor must have a non-zero coefficient")
    degree = len(divisor) - 1
    quotient = [Fraction(0)] * max(len(rest) - degree, 0)
    for k in reversed(range(len(quotient))):
        quotient[k] = factor = rest.pop() / divisor[-1]
        for j in range(degree):
            rest[k + j] -= factor * divisor[j]
    return _trimmed(quotient), _trimmed(rest)


def gcd(p: Sequence[Any], q: Sequence[Any]) -> list[int]:
    """The greatest common divisor: a primitive integer polynomial with positive leading coefficient.

    By the greatest common divisor of their values at one large integer (Char, Geddes and Gonnet, J. Symbolic
    Computation 7, 1989, pp. 31-48); where that finds none by the primitive remainder sequence (Knuth, The Art of
    Computer Programming 2, sec. 4.6.1, algorithm E). A test modulo a prime recognises coprime polynomials first.
    ``gcd([], []) == []``.

    Examples
    --------
    >>> gcd([-1, 0, 1], [1, 2, 1])
    [1, 1]
    """
    f, g = sorted((primitive(p), primitive(q)), key=len, reverse=True)
    if g and _coprime_modulo_prime(f, g):
        return [1]
    if len(g) > 1 and (common := _by_values(f, g)):
        return common
    while g:
        f, g = g, primitive(_pseudo_remainder(f, g))
    return [-x for x in f] if f and f[-1] < 0 else f


def square_free(p: Sequence[Any]) -> list[tuple[list[int], int]]:
    """The non-constant factors of `p` with simple roots, each with its multiplicity, which ascends.

    Yun's algorithm (von zur Gathen and Gerhard, Modern Computer Algebra, sec. 14.6).

    Raises
    ------
    ValueError
        If `p` is the zero polynomial.

    Examples
    --------
    >>> square_free(multiply([0, 1], multiply([-1, 1], [-1, 1])))
    [([0, 1], 1), ([-1, 1], 2)]
    """
    f = primitive(p)
    if not f:
        raise ValueError("the polynomial is 0: it needs at least one non-zero coefficient")
    zeros = next(k for k, x in enumerate(f) if x)  # powers of x alone are common, and cost most below
    f = f[zeros:]
    common = gcd(f, derivative(f))
    rest, slope = _exact_quotient(f, common), _exact_quotient(derivative(f), common)
    factors: list[tuple[list[int], int]] = []
    multiplicity = 1
    while len(rest) > 1:
        slope = [x - y for x, y in zip_longest(slope, derivative(rest), fillvalue=0)]
        factor = gcd(rest, slope)
        if len(factor) > 1:
            factors.append((factor, multiplicity))
        rest, slope = _exact_quotient(rest, factor), _exact_quotient(slope, factor)
        multiplicity += 1
    if zeros:
        same = next((factor for factor, m in factors if m == zeros), [1])
        factors = [(factor, m) for factor, m in factors if m != zeros] + [(multiply(same, [0, 1]), zeros)]
    return sorted(factors, key=lambda pair: pair[1])


def interpolate(nodes: Sequence[Any], values: Sequence[Any]) -> list[Fraction]:
    """The polynomial of lowest degree through all (`nodes[k]`, `values[k]`), by Newton's divided differences.

    Raises
    ------
    ValueError
        If two nodes are equal, or if there are not as many values as nodes.

    Examples
    --------
    >>> [int(x) for x in interpolate([0, 1, 2], [1, 2, 5])]
    [1, 0, 1]
    """
    x = [rational(node) for node in nodes]
    table = [rational(value) for value in values]
    if len(table) != len(x):
        raise ValueError(f"{len(x)} nodes but {len(table)} values: each node needs one value")
    if len(set(x)) < len(x):
        raise ValueError(f"the {len(x)} nodes are not distinct: every node may occur once")
    for order in range(1, len(x)):
        for k in reversed(range(order, len(x))):
            table[k] = (table[k] - table[k - 1]) / (x[k] - x[k - order])
    p: list[Fraction] = []
    for node, value in zip(reversed(x), reversed(table), strict=True):
        p = [up - node * same for up, same in zip([Fraction(0), *p], [*p, Fraction(0)], strict=True)]
        p[0] += value
    return _trimmed(p)


def _trimmed(p: Sequence[Any]) -> list[Any]:
    """`p` without zeros at the end."""
    terms = list(p)
    while terms and not terms[-1]:
        terms.pop()
    return terms


def _pseudo_remainder(f: list[int], g: list[int]) -> list[int]:
    """The remainder of a multiple of `f` by `g`, within the integers."""
    rest, degree, lead = list(f), len(g) - 1, g[-1]
    while len(rest) > degree:
        top, offset = rest.pop(), len(rest) - degree
        if top:
            common = integer_gcd(top, lead)
            keep, take = lead // common, top // common
            rest = [keep * x for x in rest]
            for j in range(degree):
                rest[offset + j] -= take * g[j]
    return rest


def _exact_quotient(f: list[int], g: list[int]) -> list[int]:
    """`f` / `g` for a primitive divisor `g` of `f`; by Gauss's lemma the quotient is integral."""
    rest, degree = _trimmed(f), len(g) - 1
    quotient = [0] * max(len(rest) - degree, 0)
    for k in reversed(range(len(quotient))):
        quotient[k] = factor = rest.pop() // g[-1]
        for j in range(degree):
            rest[k + j] -= factor * g[j]
    return quotient


def _by_values(f: list[int], g: list[int]) -> list[int]:
    """The greatest common divisor of primitive `f` and `g`, or nothing: its value divides those of both at any place.

    At a place beyond twice the smaller of the largest coefficients its coefficients are the digits of the values'
    divisor, unless other factors of the values happen to have a divisor too, which the division shows.
    """
    place = 2 * min(max(map(abs, f)), max(map(abs, g))) + 29
    for _ in range(3):
        rest, digits = integer_gcd(_value(f, place), _value(g, place)), list[int]()
        while rest:
            rest, digit = divmod(rest, place)
            over = 2 * digit > place
            digits.append(digit - place * over)
            rest += over
        found = primitive(digits)
        if found and not any(_pseudo_remainder(f, found)) and not any(_pseudo_remainder(g, found)):
            return [-x for x in found] if found[-1] < 0 else found
        place = 3 * place + 1
    return []


def _value(p: list[int], place: int) -> int:
    total = 0
    for x in reversed(p):
        total = total * place + x
    return total


def _coprime_modulo_prime(f: list[int], g: list[int]) -> bool:
    """True proves that `f` and `g` have no common factor; False proves nothing."""
    u, v = [x % _PRIME for x in f], [x % _PRIME for x in g]
    if not u[-1]:  # the prime could hide a common factor only together with the leading coefficient
        return False
    while len(v) > 1 or (v and not v[-1]):
        if not v[-1]:
            v.pop()
            continue
        inverse = pow(v[-1], -1, _PRIME)
        while len(u) >= len(v):
            factor, offset = u.pop() * inverse % _PRIME, len(u) - len(v) + 1
            for j in range(len(v) - 1):
                u[offset + j] = (u[offset + j] - factor * v[j]) % _PRIME
        u, v = v, u
    return bool(v)
