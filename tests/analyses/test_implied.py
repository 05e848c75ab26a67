"""Conditions that follow from others are not shown; those that do not, are."""

import pytest
import sympy as sp

from ucrit import criteria, find_model
from ucrit.analyses.stability.implied import implied


def polynomials(*texts):
    """Polynomials in b >= 0, c >= 0 and positive a, m, I."""
    names = {name: sp.Symbol(name, positive=True) for name in ("a", "m", "I")}
    names |= {name: sp.Symbol(name, nonnegative=True) for name in ("b", "c")}
    ring = sp.ring(list(names.values()), sp.ZZ)[0]
    return [ring.from_expr(sp.sympify(text, locals=names)) for text in texts]


@pytest.mark.parametrize(
    ("condition", "other", "follows"),
    [
        ("b", "a*b*m - I", True),  # b = 0 makes the other negative
        ("m*b + c", "a*b*m - I + c*a", True),
        ("m*b + c", "a*b*m - I*c + I", False),  # b = c = 0 leaves I > 0
        ("b", "I - a*b*m", False),
        ("b*c", "a*b*m - I", False),  # c = 0 alone makes it vanish, and the other can hold
        ("b - c", "a*b*m - I", False),  # may be negative
        ("b", "a*b", True),
        ("m*b", "c", False),
    ],
)
def test_what_follows(condition, other, follows):
    poly, given = polynomials(condition, other)
    try:
        assert implied(poly, [given]) is follows
    finally:
        assert implied(poly, []) is False


@pytest.mark.parametrize(
    ("model", "expected"),
    [
        ("trailer-rigid-tire-undamped", ["a*b*m - I_c"]),
        ("trailer-rigid-tire", ["U*(a*b*m - I_c) + c*(a + b)"]),
        (
            "trailer-undamped-hitch",
            ["(a*b*m - I_c)*(C*(I_c + b**2*m) + k*(a*b*m - I_c)*(a + b))"],
        ),
    ],
)
def test_criteria_of_trailers_whose_axle_may_be_under_the_centre_of_mass(model, expected):
    cls = find_model(model)
    assert cls.declaration.parameters["b"].at_least == 0
    assert [condition.expression for condition in criteria(cls)] == expected
