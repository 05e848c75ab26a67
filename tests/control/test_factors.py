"""Characteristic polynomials in factors: observers, actuators and references stand apart from what they follow."""

import numpy as np
import pytest

import ucrit
from ucrit import criteria, critical, load
from ucrit.control import close, delay, lag, observing, state_feedback
from ucrit.core.derivation.derive import symbolic
from ucrit.core.numeric.compiled import compiled, state_space

CAR = load("oversteering-car")


def observed(name, measured, **options):
    vehicle = load(name)
    law = observing(vehicle, measured, **options)
    gains = [n for n in law.declaration.parameters if n.startswith("L_")]
    own = {n: 1.1 * vehicle.values[n.removesuffix("_hat")] for n in law.declaration.parameters if n.endswith("_hat")}
    return close(vehicle, law, **{n: 0.1 * (k + 1) for k, n in enumerate(gains)}, **own)


@pytest.mark.parametrize(
    ("vehicle", "sizes"),
    [
        (observed("oversteering-car", "r"), [3, 3]),
        (observed("car-and-caravan", "r"), [5, 5]),
        (observed("motorcycle-lean", "theta"), [3, 3]),
        (observed("oversteering-car", "a_y"), [3, 3]),
        (observed("oversteering-car", "r", own=["m"]), [3, 3]),
    ],
)
def test_errors_of_an_observer_have_a_factor_of_their_own(vehicle, sizes):
    parts = symbolic(type(vehicle)).polynomial.parts
    assert sorted(map(len, parts)) == sizes
    a = np.array([float(c) for c in compiled(type(vehicle)).coefficients(vehicle.arguments())])
    expected = np.poly(state_space(vehicle).A)[::-1] * a[-1]
    np.testing.assert_allclose(a, expected, atol=1e-11 * np.abs(expected).max())


def test_estimated_feedback_separates_too_and_its_criterion_is_the_two_together():
    seen = observed("oversteering-car", "r")
    fed = close(seen, state_feedback(seen, "delta_f", estimated=True), K_delta_f_V=0.0, K_delta_f_r=0.1)
    assert sorted(map(len, symbolic(type(fed)).polynomial.parts)) == [3, 3]
    conditions = [c.expression for c in criteria(type(fed))]
    of_feedback = [c.expression for c in criteria(type(close(CAR, state_feedback(CAR, "delta_f"))))]
    of_observer = [c.expression for c in criteria(type(seen)) if "L_" in c.expression]
    assert set(of_feedback) | set(of_observer) <= set(conditions)


def test_factors_and_product_say_the_same():
    slow = close(CAR, lag(CAR, "delta_f"), delay(CAR, "delta_f"), tau_delta_f=0.05, T_delta_f=0.1)
    polynomial = symbolic(type(slow)).polynomial
    assert sorted(map(len, polynomial.parts)) == [2, 3, 3]
    assert polynomial.order == len(polynomial.coefficients) - 1 == 5
    np.testing.assert_allclose([c.value for c in critical(slow)], [c.value for c in critical(CAR)], rtol=1e-12)
    assert [c.expression for c in criteria(type(slow))] == [c.expression for c in criteria(type(CAR))]


def test_a_four_wheel_car_with_an_observer_answers():
    """Eighteen states, which took minutes multiplied out."""
    vehicle = observed("four-wheel-car", "v_y")
    values = ucrit.modes(vehicle).eigenvalues
    expected = ucrit.modes(load("four-wheel-car")).eigenvalues
    assert len(values) == 2 * len(expected)
    assert all(abs(values - value).min() < 1e-5 * abs(expected).max() for value in expected)
