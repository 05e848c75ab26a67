"""Formulas over several lines and numbers on the safe side."""

from __future__ import annotations

from decimal import Decimal

from hypothesis import given
from hypothesis import strategies as st

from ucrit.analyses.stability.advice import decimal_text, rounded
from ucrit.cli.wrap import number, shorten, wrap_formula

NAMES = st.sampled_from(["a", "C_f", "I_z", "lambda_", "U**2"])
FORMULAS = st.recursive(
    NAMES,
    lambda inner: st.one_of(
        st.lists(inner, min_size=2, max_size=5).map(lambda t: "(" + " + ".join(t) + ")"),
        st.tuples(inner, inner).map(lambda t: f"{t[0]}*{t[1]}"),
        st.tuples(inner, inner).map(lambda t: f"({t[0]} - {t[1]})"),
    ),
    max_leaves=40,
)


@given(FORMULAS, st.integers(30, 100))
def test_wrapping_keeps_every_character(text: str, width: int) -> None:
    lines = wrap_formula(text, width)
    assert "".join("".join(lines).split()) == "".join(text.split())


@given(st.lists(NAMES, min_size=2, max_size=60), st.integers(30, 100))
def test_wrapped_sums_fit(names: list[str], width: int) -> None:
    for line in wrap_formula(" + ".join(names), width):
        assert len(line) <= width
        assert line.strip()


@given(st.floats(1e-300, 1e300), st.integers(1, 15), st.sampled_from([-1, 0, 1]), st.sampled_from([-1, 1]))
def test_rounding_goes_the_way_it_should(size: float, digits: int, sense: int, sign: int) -> None:
    value = sign * size
    result = rounded(value, digits, sense)
    assert len(result.normalize().as_tuple().digits) <= digits
    assert abs(result - Decimal(value)) <= abs(Decimal(value)) * Decimal(10) ** (1 - digits)
    assert sense == 0 or (result - Decimal(value)) * sense >= 0
    assert Decimal(decimal_text(result)) == result


def test_numbers_as_people_write_them() -> None:
    assert [number(v) for v in (0.0, -0.0, 1.0, 80227.4, 1e-9, float("inf"), 12.346)] == [
        "0",
        "0",
        "1",
        "80230",
        "1e-9",
        "inf",
        "12.35",
    ]


def test_shortened_texts_end_at_a_word() -> None:
    assert shorten("one two three", 12) == "one two ..."
    assert shorten("one two", 12) == "one two"
