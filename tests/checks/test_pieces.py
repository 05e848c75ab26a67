"""The pieces that checks are made of: random parameters, random states, comparison, reports."""

import mpmath
import numpy as np
import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st

from ucrit.catalogue import find_model, load
from ucrit.checks import Check, Report, check_model
from ucrit.checks.matching import same_equations
from ucrit.checks.precise import numeric, same_up_to_factor
from ucrit.checks.sample import parameter_sets
from ucrit.checks.states import constraints, differs, random_states
from ucrit.checks.subject import Subject
from ucrit.core import Model, ModelError, param, state
from ucrit.core.derivation.derive import symbolic
from ucrit.models.trailer import Trailer
from ucrit.models.trailer_kinematic import TrailerKinematic
from ucrit.models.trailer_rigid_tire import TrailerRigidTire

numbers = st.floats(-1e3, 1e3).filter(lambda x: abs(x) > 1e-3)


def bounded(**bounds):
    class Bounded(Model):
        p: float = param("kg", "mass", **bounds)
        y = state("m", "position")

        def equations(self, x, dx):
            return dx.y

    return Bounded


@given(low=numbers, width=st.floats(1e-3, 1e6), sides=st.sampled_from(["low", "high", "both", "none"]))
def test_random_parameters_are_within_bounds(low, width, sides):
    bounds = {"above": low} if sides in ("low", "both") else {}
    bounds |= {"below": low + width} if sides in ("high", "both") else {}
    model = bounded(**bounds)
    (values,) = parameter_sets(model, np.random.default_rng(0), 50)
    assert model.declaration.parameters["p"].allows(values).all()


@pytest.mark.parametrize("direction", [1, -1])
def test_direction_is_that_of_the_speed(direction):
    values = parameter_sets(Trailer, np.random.default_rng(0), 50, direction)
    assert (np.sign(values[-1]) == direction).all()
    assert {*np.sign(parameter_sets(Trailer, np.random.default_rng(0), 50, 0)[-1])} == {1, -1}


def test_unbounded_parameters_take_both_signs():
    (values,) = parameter_sets(bounded(), np.random.default_rng(0), 50)
    assert {*np.sign(values)} == {1, -1}


def test_random_states_satisfy_the_constraint():
    subject = Subject.of(TrailerRigidTire, 0, None)
    states, traced = random_states(subject, "test"), subject.traced
    (lateral,) = constraints(traced)
    function = sp.lambdify([traced.states, list(traced.parameters.values())], lateral)
    assert np.abs(function(states.w, states.parameters)).max() < 1e-9
    assert np.abs(states.w).min(axis=1).max() > 0


@given(st.lists(st.integers(-9, 9), min_size=2, max_size=6), st.integers(1, 999))
def test_polynomials_are_equal_up_to_a_factor_only(coefficients, factor):
    left = [mpmath.mpf(c) for c in [*coefficients, 1]]
    right = [c * factor for c in left]
    assert same_up_to_factor(left, right)
    with mpmath.workdps(50):
        changed = right[0] + mpmath.mpf(10) ** -20
    assert not same_up_to_factor(left, [changed, *right[1:]])
    assert not same_up_to_factor(left, [mpmath.mpf(0), *right])


def test_rows_may_be_combined_but_not_changed():
    system = symbolic(Trailer)
    points = Subject.of(Trailer, 0, None).points("test")
    m, U = (system.traced.parameters[name] for name in ("m", "U"))
    mixed = sp.Matrix([[1, U], [m, 3]])
    assert same_equations(system, [mixed * P for P in system.P], mixed * system.Q, points)
    assert not same_equations(system, [mixed * system.P[0], *(P for P in system.P[1:])], None, points)
    singular = sp.Matrix([[1, U], [m, m * U]])
    assert not same_equations(system, [singular * P for P in system.P], None, points)


def test_fifty_digits():
    (value,) = numeric([sp.sqrt(2)], [])([])
    with mpmath.workdps(50):
        assert mpmath.almosteq(value**2, 2, mpmath.mpf(10) ** -48)


def test_differs_is_relative_to_each_row():
    rows = np.array([[1.0, 2.0], [1e-20, 2e-20]])
    assert not differs(rows, rows * (1 + 1e-12))
    assert differs(rows, rows + np.array([[0, 0], [0, 1e-22]]))
    assert differs(rows, np.full_like(rows, np.nan))


def test_report_reads_line_by_line():
    checks = (
        Check("one", True, "fine"),
        Check("two", None, "does not apply: no"),
        Check("three", False, "wrong"),
    )
    report = Report("cart", checks)
    assert str(report).splitlines() == [
        "cart: 1 of 2 checks failed",
        "pass  one: fine",
        "  -   two: does not apply: no",
        "FAIL  three: wrong",
    ]
    with pytest.raises(ModelError, match="cart: 1 of 2 checks failed: three: wrong"):
        report.raise_if_failed()
    Report("cart", checks[:2]).raise_if_failed()


def test_same_seed_same_report():
    assert check_model(TrailerKinematic, seed=3) == check_model(TrailerKinematic, seed=3)


@pytest.mark.parametrize("seed", range(5))
def test_verdict_does_not_depend_on_the_seed(seed):
    assert check_model(TrailerRigidTire, seed=seed).ok


def published_criteria(model, path=None):
    report = check_model(model, published=path)
    return next(check for check in report.checks if check.name == "published criteria")


def test_a_criterion_is_tested_far_from_the_boundary():
    slow = load("oversteering-car").with_(U=1.0)
    found = published_criteria(slow)
    assert found.passed, found.detail


def test_a_criterion_that_random_vehicles_cannot_test_does_not_apply(tmp_path):
    path = tmp_path / "caster.toml"
    path.write_text('[[criterion]]\nsource = "always stable"\nexpression = "a + b"\n')
    found = published_criteria(find_model("caster"), path)
    assert found.passed is None
    assert "all of 500 random vehicles are stable" in found.detail
    path.write_text('[[criterion]]\nsource = "wrong"\nexpression = "-a"\n')
    assert published_criteria(find_model("caster"), path).passed is False
