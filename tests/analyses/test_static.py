"""Static stability: signs, formulas, and where it does not decide."""

import numpy as np
import pytest

from ucrit import UcritError, load
from ucrit.analyses.stability.static import static_stability
from ucrit.core.numeric.compiled import state_space


@pytest.mark.parametrize("seed", range(40))
def test_weathercock_moment_of_random_cars(seed):
    rng = np.random.default_rng(seed)
    car = load("oversteering-car")
    car = car.with_(**{name: value * 2 ** rng.uniform(-1, 1) for name, value in car.values.items()})
    found = static_stability(car)
    slope = (car.b * car.C_r - car.a * car.C_f) / (car.I_z * car.U)
    assert found.slope == pytest.approx(slope, rel=1e-9)
    assert found.stable == (slope > 0)
    assert not (found.stable and found.critical_speeds)


def test_both_coordinate_systems_agree():
    body = static_stability(load("oversteering-car"))
    road = static_stability(load("oversteering-car-on-the-road"), "psi")
    car = load("oversteering-car")
    assert road.slope == pytest.approx(-car.U * body.slope, rel=1e-12)
    assert (road.stable, road.dynamic) == (body.stable, body.dynamic) == (False, True)


def test_answer_through_another_variable():
    found = static_stability(load("caravan-active-steering"))
    assert (found.answer, found.formula) == ("theta''", "")
    A = state_space(load("caravan-active-steering")).A
    assert found.slope == pytest.approx(A[0, 1] * A[1, 0], rel=1e-14)


def test_kinematic_trailer_answers_with_its_rate():
    found = static_stability(load("caravan-kinematic"))
    assert found.answer == "theta'"
    assert found.formula == "-U/(a + b)"
    assert found.decides


def test_refusals():
    with pytest.raises(UcritError, match="cannot be displaced"):
        static_stability(load("oversteering-car"), "r")
    with pytest.raises(UcritError, match="give scalar parameters"):
        static_stability(load("oversteering-car").with_(U=[1.0, 2.0]))
