"""Exact arithmetic and real roots against known roots, SymPy and mpmath at 50 digits."""

import math
import random
import time
from fractions import Fraction
from functools import reduce

import mpmath
import pytest
import sympy as sp
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from ucrit.numerics.determinants import hurwitz_polynomial
from ucrit.numerics.exact import derivative, divmod_, gcd, interpolate, multiply, primitive, square_free
from ucrit.numerics.real_roots import isolate, real_roots, refine

RATIONALS = st.fractions(-20, 20, max_denominator=50)
POLYNOMIALS = st.lists(RATIONALS, max_size=6)


def value(p, x):
    return sum((c * x**k for k, c in enumerate(p)), Fraction(0))


def product(parts):
    return reduce(multiply, parts, [Fraction(1)])


@settings(max_examples=100, deadline=None)
@given(POLYNOMIALS, POLYNOMIALS.filter(any), RATIONALS)
def test_division(p, q, x):
    quotient, remainder = divmod_(p, q)
    assert value(quotient, x) * value(q, x) + value(remainder, x) == value(p, x)
    assert len(remainder) < len(primitive(q))


@settings(max_examples=100, deadline=None)
@given(st.lists(RATIONALS, min_size=1, max_size=7, unique=True), st.data())
def test_interpolation(nodes, data):
    values = data.draw(st.lists(RATIONALS, min_size=len(nodes), max_size=len(nodes)))
    p = interpolate(nodes, values)
    assert [value(p, x) for x in nodes] == values
    assert len(p) <= len(nodes)


@settings(max_examples=100, deadline=None)
@given(*[st.lists(st.integers(-5, 5), min_size=1, max_size=5).filter(any)] * 3)
def test_gcd_equals_sympy(p, q, common):
    x = sp.Symbol("x")
    f, g = multiply(p, common), multiply(q, common)
    expected = sp.gcd(sp.Poly(f[::-1], x), sp.Poly(g[::-1], x)).primitive()[1]
    expected = -expected if expected.LC() < 0 else expected
    assert gcd(f, g) == [int(c) for c in expected.all_coeffs()[::-1]]


def test_gcd_of_polynomials_that_meet_only_modulo_the_prime():
    assert gcd([1, 2**61 - 1], [2, 2**61 - 1]) == [1]
    assert gcd([1, 1], [2**61, 1]) == [1]
    assert gcd([], [2, 4]) == [1, 2]
    assert gcd([], []) == []


@settings(max_examples=100, deadline=None)
@given(st.dictionaries(st.integers(-6, 6), st.integers(1, 4), min_size=1, max_size=3), st.booleans())
def test_square_free_finds_the_multiplicities(roots, complex_pair):
    parts = [[-x, 1] for x, times in roots.items() for _ in range(times)]
    factors = square_free(product(parts + [[2, 1, 3]] * 2 * complex_pair))
    for factor, times in factors:
        assert len(gcd(factor, derivative(factor))) == 1
        assert [x for x in range(-6, 7) if value(factor, x) == 0] == sorted(x for x in roots if roots[x] == times)
    assert sum((len(factor) - 1) * times for factor, times in factors) == sum(roots.values()) + 4 * complex_pair


ROOTS = st.dictionaries(
    RATIONALS | st.sampled_from([Fraction(0), Fraction(1), 1 + Fraction(1, 10**12), 1 + Fraction(1, 10**40)]),
    st.integers(1, 3),
    min_size=1,
    max_size=5,
)


@settings(max_examples=200, deadline=None)
@given(ROOTS, st.data())
def test_real_roots_are_all_found_to_the_nearest_double(roots, data):
    ends = st.sampled_from(sorted(roots)) | RATIONALS
    lo, hi = sorted([data.draw(ends), data.draw(ends)])
    hi = data.draw(st.sampled_from([hi, math.inf]))
    lo = data.draw(st.sampled_from([lo, -math.inf]))
    parts = [[-x, 1] for x, times in roots.items() for _ in range(times)]
    p = product([*parts, [5, 2, 1]])
    assert real_roots(p, lo, hi) == sorted((float(x), times) for x, times in roots.items() if lo <= x <= hi)
    intervals = isolate(p, lo, hi)
    assert len(intervals) == len([x for x in roots if lo <= x <= hi])
    for (x, y), root in zip(intervals, sorted(r for r in roots if lo <= r <= hi), strict=True):
        assert x == root == y or x < root < y
        assert lo <= x
        assert y <= hi


@settings(max_examples=100, deadline=None)
@given(
    st.lists(st.integers(-(10**6), 10**6), min_size=2, max_size=9),
    st.lists(st.integers(-20, 20), min_size=9, max_size=9),
)
def test_irrational_roots_equal_mpmath(p, exponents):
    p = [Fraction(c) * Fraction(10) ** e for c, e in zip(p, exponents, strict=False)]  # 1e-20 to 1e26
    assume(p[-1] and p[0] and len(square_free(p)) == 1 and square_free(p)[0][1] == 1)
    found = [root for root, _ in real_roots(p)]
    chain = sp.Poly(primitive(p)[::-1], sp.Symbol("x"))
    assert len(found) == chain.count_roots()
    with mpmath.workdps(400):
        exact = [mpmath.mpf(c.numerator) / c.denominator for c in p]
        for root in found:
            near = mpmath.findroot(lambda x: mpmath.polyval(exact[::-1], x), mpmath.mpf(root), tol=1e-300, verify=False)
            assert float(near) == root


def test_roots_at_the_limits_of_doubles():
    assert real_roots([-(10**400), 1]) == [(math.inf, 1)]
    assert real_roots([10**400, 1]) == [(-math.inf, 1)]
    assert real_roots([-1, 10**400]) == [(0.0, 1)]
    assert real_roots([-5e-324, 1]) == [(5e-324, 1)]
    assert real_roots([-1.7976931348623157e308, 1]) == [(1.7976931348623157e308, 1)]
    tie = Fraction(1) + Fraction(1, 2**53)
    assert refine([-tie, 1], (0, 2)) == 1.0 == refine([-tie, 1], (tie, tie))
    assert refine([-tie - Fraction(1, 2**52), 1], (0, 2)) == 1 + 2**-51


def test_refine_takes_wide_intervals():
    assert refine([0, -1, 0, 1], (Fraction(-1, 2), Fraction(1, 2))) == 0.0
    assert refine([-6, 1, 1], (-10, 1)) == -3.0
    assert refine([0, -2, 1], (0, 3)) == 2.0


def test_wilkinson():
    p = product([[-k, 1] for k in range(1, 21)])
    assert real_roots(p) == [(float(k), 1) for k in range(1, 21)]
    assert real_roots(p, 3, 5) == [(3.0, 1), (4.0, 1), (5.0, 1)]


@pytest.mark.parametrize("bad", [[], [0, 0], [1, math.nan]])
def test_bad_polynomials_are_refused(bad):
    with pytest.raises(ValueError, match="coefficient"):
        real_roots(bad)


def test_bad_arguments_are_refused():
    with pytest.raises(ValueError, match="lower end"):
        real_roots([1, 1], 2, 1)
    with pytest.raises(ValueError, match="lower end"):
        isolate([1, 1], math.nan)
    with pytest.raises(ValueError, match="same sign"):
        refine([1, 0, 1], (0, 1))
    with pytest.raises(ValueError, match="divisor"):
        divmod_([1], [0])
    with pytest.raises(ValueError, match="distinct"):
        interpolate([1, 1], [1, 2])
    with pytest.raises(ValueError, match="value"):
        interpolate([1, 2], [1])
    assert real_roots([3]) == []


@pytest.mark.parametrize(("order", "degree", "limit"), [(4, 3, 0.005), (8, 4, 0.150)])
def test_critical_values_are_fast(order, degree, limit):
    source = random.Random(1)
    family = [[source.gauss(0, 1) * 10 ** source.uniform(-3, 4) for _ in range(degree + 1)] for _ in range(order + 1)]
    best = math.inf
    for _ in range(5):
        start = time.process_time()
        polynomial = hurwitz_polynomial(family)
        real_roots(polynomial, 0)
        best = min(best, time.process_time() - start)
    assert len(polynomial) > degree * (order - 1) - order
    assert best < limit
