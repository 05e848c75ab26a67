"""Routh's criterion for bare polynomials: read, counted against known roots, and in symbols."""

import random

import numpy as np
import pytest
import sympy as sp

from ucrit import UcritError, routh


@pytest.mark.parametrize(
    "formula",
    [
        "s^4 + 2 s^3 + 3 s^2 + 4 s + 5",
        "s**4+2*s**3+3*s**2+4*s+5",
        "5 + 4s + 3s^2 + 2s^3 + s^4",
        "s(s(s(s + 2) + 3) + 4) + 5",
        " (s^2)(s^2 + 2s) + 3 s s + 2(2 s) + 5e0 ",
        [5, 4, 3, 2, 1],
        (5.0, 4, sp.Integer(3), np.float64(2), 1, 0),
    ],
)
def test_ways_of_writing_one_polynomial(formula):
    found = routh(formula)
    assert found.polynomial == "s^4 + 2 s^3 + 3 s^2 + 4 s + 5"
    assert [[int(x) for x in row] for row in found.array.rows] == [[1, 3, 5], [2, 4], [1, 5], [-6], [5]]
    assert (found.right_half_plane, found.settled) == (2, False)


def test_numbers_of_roots_against_roots_that_are_known():
    draw = random.Random(3)
    s = sp.Symbol("s")
    for _ in range(60):
        real = [draw.randint(-3, 3) for _ in range(draw.randint(1, 3))]
        pairs = [(draw.randint(-3, 3), draw.randint(1, 3)) for _ in range(draw.randint(0, 2))]
        product = sp.Mul(*(s - a for a in real), *((s - a) ** 2 + b**2 for a, b in pairs))
        found = routh(str(sp.expand(product)).replace("**", "^").replace("*", " "))
        parts = [*real, *(a for a, _ in pairs for _ in range(2))]
        assert found.right_half_plane == sum(a > 0 for a in parts)
        assert found.array.imaginary_axis == sum(a == 0 for a in parts)
        assert found.settled == all(a < 0 for a in parts)


def test_zero_pivot_and_zero_row_are_explained():
    assert "began with 0" in str(routh("s^5 + s^4 + 2s^3 + 2s^2 + 3s + 15"))
    assert "auxiliary polynomial s^2 + 4" in str(routh("s^4 + s^3 + 5s^2 + 4s + 4"))


def test_symbols_give_conditions_that_agree_with_the_roots():
    found = routh("s^3 + (2 + a) s^2 + (a b + 1)s + b", positive=["b"])
    a, b = sp.symbols("a b")
    conditions = [sp.sympify(c) for c in found.conditions]
    draw = np.random.default_rng(4)
    verdicts = set()
    for x, y in zip(draw.normal(0, 2, 200), draw.exponential(2, 200), strict=True):
        met = all(c.subs({a: x, b: y}) > 0 for c in conditions)
        assert met == bool(np.all(np.roots([1, 2 + x, x * y + 1, y]).real < 0))
        verdicts.add(met)
    assert verdicts == {True, False}


def test_conditions_of_third_order():
    found = routh("m s^3 + a s^2 + b s + c", positive=["m"])
    assert set(found.conditions) == {"c", "b", "a", "a*b - c*m"}
    assert found.verdict.startswith("stable if and only if")


def test_first_coefficient_of_unknown_sign():
    found = routh("a s + b")
    assert found.either_sign
    assert "perhaps after a change of all its signs" in found.verdict
    assert not routh("a s + b", positive="a").either_sign


@pytest.mark.parametrize(
    ("polynomial", "settled"),
    [("m s^2 + k", False), ("s^2 + k s", False), ("s^3 + K(s + 1)", False), ("m s + k", True), ("k s^2 + m", False)],
)
def test_settled_whatever_the_symbols(polynomial, settled):
    names = [name for name in ("m", "k") if name in polynomial]
    assert routh(polynomial, positive=names).settled is settled


def test_names_that_python_keeps_for_itself_and_another_variable():
    found = routh("z^2 + lambda z + pi", variable="z")
    assert found.conditions == ("lambda",)
    assert found.polynomial == "z^2 + lambda z + 3.14159"


def test_long_elements_are_written_below_the_array():
    text = str(routh("a_0 s^4 + a_1 s^3 + a_2 s^2 + a_3 s + a_4"))
    assert "s^1 |                      #1" in text
    assert "\n#1 = (a_0*a_3**2" in text
    assert "<table>" in routh("s + a")._repr_html_()


@pytest.mark.parametrize(
    ("formula", "words"),
    [
        ("", "cannot be read"),
        ("s +", "cannot be read"),
        ("s $ 2", "cannot be read at '$ 2'"),
        ("((((s)", "cannot be read"),
        ("s.real", "cannot be read at '.real'"),
        ("__import__('os')", "cannot be read at"),
        ("1/s", "no polynomial in s"),
        ("cos(s)", "no polynomial in s"),
        ("s^2 + tan s", "uses 'tan'"),
        ("s^(1/2)", "a power must be a whole number, got '1 / 2'"),
        ("s^n", "a power must be a whole number, got 'n'"),
        ("s^100", "powers may come to 99 at most, got 100"),
        ("2^99^99 s", "a power must be a whole number"),
        ("((2^99)^99) s", "powers may come to 99 at most"),
        ("x^2 + 1", "holds no s"),
        ("7", "holds no s"),
        ("0 s", "holds no s"),
        ("s/0", "finite"),
        ("sqrt(-1) s + 1", "finite real numbers"),
        ("-" * 5000 + "s", "no polynomial in s"),
        ([], "[] holds no s"),
        ([1, "k"], "got 'k'"),
        ([1, float("inf")], "got inf"),
    ],
)
def test_mistakes_are_refused_in_a_sentence(formula, words):
    with pytest.raises(UcritError) as error:
        routh(formula)
    assert words in str(error.value)
    assert "\n" not in str(error.value)


def test_positive_must_name_a_symbol():
    with pytest.raises(UcritError, match="there is no symbol 'kk' to be positive; did you mean 'k'"):
        routh("s + k", positive=["kk"])
