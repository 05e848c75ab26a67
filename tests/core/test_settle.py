"""Conditions settled on a basic motion, lengths of vectors, slopes piece by piece."""

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from ucrit.core.derivation.rings import polynomial_field
from ucrit.core.formulas.codegen import build, generate, renaming, write
from ucrit.core.formulas.functions import length, maximum, minimum, where
from ucrit.core.formulas.plane import Length, Share, computable
from ucrit.core.formulas.settle import settled
from ucrit.core.formulas.slopes import slopes_at, staged_slopes

X, Y, Z = sp.symbols("x y z", real=True)
P = sp.Symbol("p", positive=True)
STILL = {X: 0, Y: 0, Z: 0}


def test_a_branch_that_cannot_be_near_is_left_out():
    assert settled([maximum(X, P)], STILL) == [P]
    assert settled([where(X < P, X**2, Y)], STILL) == [X**2]
    assert settled([maximum(maximum(X, P) - 2 * P, Y)], {**STILL, Y: P}) == [Y]


def test_a_condition_that_just_holds_stays_open():
    bent = maximum(X, 0)
    assert settled([bent], STILL) == [bent]
    assert settled([where(X >= 0, X, Y)], STILL)[0].has(sp.Piecewise)


@pytest.mark.parametrize(("a", "b"), [(0.0, 0.0), (3.0, -4.0), (0.0, 2.0), (1e-8, 0.0)])
def test_lengths_are_lengths_and_have_no_slope_where_they_vanish(a, b):
    function = build(generate("f", [[X, Y]], [Length(X, Y), Length(X, Y).diff(X), Share(X, Y).diff(Y)]), "f")
    size, slope, bend = function((a, b))
    assert size == pytest.approx(np.hypot(a, b), abs=1e-14)
    assert slope == pytest.approx(a / np.hypot(a, b) if size > 1e-14 else 0, rel=1e-6)
    assert np.isfinite(bend)
    assert length(a, b) == pytest.approx(np.hypot(a, b))
    assert Length(X, Y).xreplace(STILL) == 0
    assert Length(X, Y).diff(X).xreplace(STILL) == 0
    assert str(Length(X, Y)) == "sqrt(x**2 + y**2)"


@settings(max_examples=40, deadline=None)
@given(st.lists(st.floats(0.2, 3), min_size=3, max_size=3))
def test_slopes_piece_by_piece_are_the_slopes(values):
    inner = sp.sqrt(X**2 + P * Y**2) * sp.sin(X * Y) + minimum(X, Y * Z) ** 2
    formulas = [inner**2 / (1 + inner), sp.atan2(inner, Z) + sp.Abs(inner - Z), Z * P]
    point = dict(zip((X, Y, Z), map(sp.Rational, values), strict=True))
    found = slopes_at(formulas, [X, Y, Z], point)
    for i, formula in enumerate(formulas):
        for j, variable in enumerate((X, Y, Z)):
            expected = formula.diff(variable).xreplace({**point, P: sp.Integer(2)})
            got = sp.sympify(found.get((i, j), 0)).xreplace({P: sp.Integer(2)})
            assert float(got) == pytest.approx(float(expected), rel=1e-9, abs=1e-9)


def test_a_branch_that_does_not_count_may_have_no_slope():
    root = sp.sqrt(X**2 + Y**2)
    share = sp.Piecewise((1 - root / 3, root > 0), (1, True))
    staged = staged_slopes([2 * X * (share + share**2), share**2], [X, Y])
    renamed = renaming([[X, Y]])
    steps = [(symbol, value.xreplace(renamed)) for symbol, value in staged.steps]
    slopes = [slope.xreplace(renamed) for slope in staged.slopes.values()]
    with np.errstate(all="ignore"):
        found = build(write("f", [2], steps, slopes), "f")(np.zeros(2))
    assert np.isfinite(found).all()
    assert dict(zip(staged.slopes, found, strict=True))[0, 0] == 4


def test_slopes_that_are_zero_are_not_kept():
    staged = staged_slopes([X**2 + P, Y * X], [X, Y, Z])
    assert set(staged.slopes) == {(0, 0), (1, 0), (1, 1)}


def test_square_roots_of_parameters_are_one_symbol():
    root = sp.sqrt(P**2 + 1)
    domain, elements, back = polynomial_field([P / root, root**3, 1 / root], {})
    assert list(back.values()) == [root]
    for element, formula in zip(elements, (P / root, root**3, 1 / root), strict=True):
        assert sp.simplify(domain.to_sympy(element).xreplace(back) - formula) == 0
    assert computable(Length(X, Y)).has(sp.Pow)
