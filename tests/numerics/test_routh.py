"""Routh's array against polynomials built from known roots."""

import math
from fractions import Fraction
from functools import reduce

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from ucrit.numerics.exact import multiply
from ucrit.numerics.routh import all_decay, routh

SMALL = st.fractions(min_value=-4, max_value=4, max_denominator=4)


@st.composite
def factors(draw):
    """(coefficients, roots to the right, roots on the axis); few different values, so that roots repeat."""
    x = draw(st.sampled_from([Fraction(0), Fraction(1), Fraction(-1), Fraction(2)]) | SMALL)
    y = draw(st.sampled_from([Fraction(1), Fraction(2)]) | SMALL.filter(bool))
    kind = draw(st.sampled_from(["real", "pair", "opposite", "quadruple", "axis"]))
    if kind == "real":
        return [-x, 1], int(x > 0), int(x == 0)
    if kind == "pair":
        return [x * x + y * y, -2 * x, 1], 2 * (x > 0), 2 * (x == 0)
    if kind == "opposite":
        return [-y * y, 0, 1], 1, 0
    if kind == "axis":
        return [y * y, 0, 1], 0, 2
    both = multiply([x * x + y * y, -2 * x, 1], [x * x + y * y, 2 * x, 1])
    return both, 2 * (x != 0), 4 * (x == 0)


@settings(max_examples=400, deadline=None)
@given(st.lists(factors(), min_size=1, max_size=5), SMALL.filter(bool))
def test_counts_equal_the_known_roots(parts, lead):
    polynomial = reduce(multiply, (p for p, _, _ in parts), [lead])
    array = routh(polynomial)
    assert array.right_half_plane == sum(right for _, right, _ in parts)
    assert array.imaginary_axis == sum(axis for _, _, axis in parts)
    assert array.powers == tuple(range(len(polynomial) - 1, -1, -1))
    assert [len(row) for row in array.rows] == [power // 2 + 1 for power in array.powers]
    assert all(array.first_column)


@settings(max_examples=100, deadline=None)
@given(st.lists(factors(), min_size=1, max_size=4), st.integers(-60, 60), st.integers(-20, 20))
def test_counts_ignore_the_units_of_s_and_of_the_polynomial(parts, whole, scale):
    polynomial = reduce(multiply, (p for p, _, _ in parts), [1])
    scaled = [Fraction(2) ** whole * Fraction(10) ** (scale * k) * c for k, c in enumerate(polynomial)]
    assert routh(scaled).right_half_plane == routh(polynomial).right_half_plane
    assert routh(scaled).imaginary_axis == routh(polynomial).imaginary_axis


def test_epsilon_would_fail_here():
    # A zero pivot together with double roots on the axis.
    polynomial = reduce(multiply, [[1, 0, 1], [1, 0, 1], [2, 1, 1], [3, -1, 1]])
    array = routh(polynomial)
    assert any("began with 0" in note for note in array.notes)
    assert (array.right_half_plane, array.imaginary_axis) == (2, 4)


def test_zero_row_is_explained():
    array = routh([8, 8, 10, 2, 2])
    assert array.notes == ("row s^1 vanished; replaced by the derivative of the auxiliary polynomial 2 s^2 + 8",)
    assert array.rows == ((2, 10, 8), (2, 8), (2, 8), (4,), (8,))


def test_prints_as_a_textbook_does():
    assert str(routh([24, 14, 5, 3, 1])).splitlines() == [
        "s^4 |    1   5  24",
        "s^3 |    3  14",
        "s^2 |  1/3  24",
        "s^1 | -202",
        "s^0 |   24",
        "roots in the right half plane: 2, on the imaginary axis: 0",
    ]
    html = routh([1, 1])._repr_html_()
    assert "<tr><th>s<sup>1</sup></th><td>1</td></tr>" in html


def test_floats_are_exact():
    # 0.1 * 0.2 is not 0.02: the exact pivot is 0.1 * 0.2 - 0.02 * 1 with the stored numbers.
    exact = Fraction(0.1) * Fraction(0.2) - Fraction(0.02)
    assert exact != 0
    assert routh([0.02, 0.2, 0.1, 1.0]).right_half_plane == (0 if exact > 0 else 2)
    assert routh(np.array([0.02, 0.2, 0.1, 1.0])).rows[2][0] == exact / Fraction(0.1)
    assert routh([1e-200, 3.0, 3e200, 1e300]).right_half_plane == 0
    assert routh([1e-200, 3e-200, 3e200, 1e300]).right_half_plane == 2


def test_symbols():
    a, b, c, d = sp.symbols("a b c d", positive=True)
    array = routh([d, c, b, a])
    assert sp.cancel(array.rows[2][0] - (b * c - a * d) / b) == 0
    assert array.right_half_plane is None
    assert array.sign_changes is None
    assert array.imaginary_axis is None
    assert "s^3 |" in str(array)


def test_symbolic_zeros_are_recognised():
    a = sp.Symbol("a", positive=True)
    vanishing = (a**2 - 1) / (a - 1) - a - 1
    assert any("began with 0" in note for note in routh([1, 2, vanishing, 1]).notes)
    assert routh([1, a, 1 + a, a, 1 + 0 * a, vanishing]).powers[0] == 4
    undamped = routh([1, 0, a, 0, 1])
    assert "row s^3 vanished" in undamped.notes[0]
    assert sp.cancel(undamped.rows[1][0] - 4) == 0


def test_sympy_numbers_count_as_numbers():
    assert routh([sp.Rational(1, 2), sp.Float(0.5), sp.Integer(3)]).right_half_plane == 0


def test_leading_zeros_are_left_out_with_a_note():
    array = routh([1, 2, 0, 0.0])
    assert array.powers == (1, 0)
    assert array.notes[0] == "the coefficient of s^3 is zero and was left out"


def test_roots_at_zero_lie_on_the_axis():
    assert routh([0, 0, 0, 1]).imaginary_axis == 3
    assert routh([0, -1, 1]).right_half_plane == 1
    assert routh([5]).imaginary_axis == 0


@pytest.mark.parametrize("bad", [[], [0, 0.0], [1, math.nan], [1, math.inf], ["1", 2], [1j, 1], [sp.oo, 1], [sp.I, 1]])
def test_bad_input_is_refused(bad):
    with pytest.raises(ValueError, match="coefficient"):
        routh(bad)


@given(st.lists(st.integers(-3, 9), min_size=1, max_size=9).filter(any), st.integers(1, 4))
def test_all_decay_is_the_count_of_none(terms, below):
    for a in (terms, [Fraction(abs(x), below) for x in terms], [0.1 * x for x in terms]):
        while not a[-1]:
            a = a[:-1]
        array = routh(a)
        assert all_decay(a) == (array.right_half_plane == 0 == array.imaginary_axis)
