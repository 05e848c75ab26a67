"""Hurwitz determinants against SymPy's and against their definition."""

from fractions import Fraction

import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from ucrit.numerics.determinants import determinant, hurwitz_determinants, hurwitz_matrix, hurwitz_polynomial
from ucrit.numerics.exact import multiply

SMALL = st.integers(-3, 3)


@settings(max_examples=150, deadline=None)
@given(st.integers(0, 5).flatmap(lambda n: st.lists(st.lists(SMALL, min_size=n, max_size=n), min_size=n, max_size=n)))
def test_determinant_equals_sympy(matrix):
    assert determinant(matrix) == sp.Matrix(len(matrix), len(matrix), lambda i, j: matrix[i][j]).det()


@settings(max_examples=150, deadline=None)
@given(st.lists(SMALL, min_size=2, max_size=8))
def test_minors_equal_their_definition(a):
    # Few different values, so that minors vanish on the way.
    matrix = sp.Matrix(hurwitz_matrix(a))
    assert hurwitz_determinants(a) == [matrix[:k, :k].det() for k in range(1, len(a))]
    assert hurwitz_determinants([Fraction(x, 3) for x in a])[0] == Fraction(a[-2], 3)


def test_minors_of_ring_elements():
    ring = sp.ring("a,b,c,d,e", sp.ZZ)
    a, b, c, d, e = ring[1:]
    assert hurwitz_determinants([e, d, c, b, a])[2] == b * c * d - a * d**2 - b**2 * e
    assert hurwitz_determinants([a, a, a, a, a, a])[1] == 0


def test_minors_with_a_given_division():
    x = sp.Symbol("x")
    minors = hurwitz_determinants([x, 1, x, 1 + x, x, 1], divide=lambda u, v: sp.cancel(u / v))
    expected = sp.Matrix(hurwitz_matrix([x, 1, x, 1 + x, x, 1]))
    assert [sp.expand(m - expected[: k + 1, : k + 1].det()) for k, m in enumerate(minors)] == [0] * 5


POLYNOMIALS = st.lists(st.lists(SMALL | st.floats(-9, 9), max_size=4), min_size=2, max_size=7)


@settings(max_examples=100, deadline=None)
@given(POLYNOMIALS, st.fractions(-5, 5, max_denominator=7))
def test_hurwitz_polynomial_equals_the_minor_at_every_point(coefficients, p):
    a = [sum((Fraction(c) * p**k for k, c in enumerate(polynomial)), Fraction(0)) for polynomial in coefficients]
    polynomial = hurwitz_polynomial(coefficients)
    minor = hurwitz_determinants(a)[-2] if len(a) > 2 else 1
    assert sum(c * p**k for k, c in enumerate(polynomial)) == minor
    assert not polynomial or polynomial[-1] != 0


def test_hurwitz_polynomial_vanishes_where_a_pair_crosses():
    # (s^2 + (2 - p) s + 3)(s^2 + s + 1): on the axis at p = 2
    pair = [[3], [2, -1], [1]]
    other = [[1], [1], [1]]
    product = [[Fraction(0)] * 2 for _ in range(5)]
    for i, x in enumerate(pair):
        for j, y in enumerate(other):
            for k, c in enumerate(multiply(x, y)):
                product[i + j][k] += c
    polynomial = hurwitz_polynomial(product)
    assert sum(c * 2**k for k, c in enumerate(polynomial)) == 0
    assert polynomial[0] != 0


@pytest.mark.parametrize("call", [lambda: hurwitz_determinants([1]), lambda: hurwitz_polynomial([[1]])])
def test_too_few_coefficients_are_refused(call):
    with pytest.raises(ValueError, match="at least two"):
        call()


def test_bad_matrix_and_bad_numbers_are_refused():
    with pytest.raises(ValueError, match="square"):
        determinant([[1, 2]])
    with pytest.raises(ValueError, match="finite"):
        hurwitz_polynomial([[1.0], [float("nan")], [1.0]])
