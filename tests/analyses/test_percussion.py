"""Centre of percussion: what a blow leaves at rest."""

import numpy as np
import pytest

from ucrit import UcritError, impulse_response, load, percussion
from ucrit.control import close, lag

CAR = load("oversteering-car")


@pytest.mark.parametrize("name", ["oversteering-car", "car-and-caravan", "four-wheel-car"])
def test_the_point_stays_at_rest_after_an_impulse(name):
    vehicle = load(name)
    found = percussion(vehicle, "delta_f")
    V, r = impulse_response(vehicle, "delta_f", [found.lateral, found.yaw], [0, 1]).values[0]
    assert found.velocity(0) == pytest.approx(V)
    assert abs(V + found.place * r) < 1e-9 * abs(V)
    assert eval(found.formula, {}, dict(vehicle.values)) == pytest.approx(float(found.place), rel=1e-12)


def test_problem_11_2_the_rear_axle_goes_along_or_against():
    """It stays where I_z = m a b, goes along with the front above that and against it below."""
    balanced = CAR.m * CAR.a * CAR.b
    found = percussion(CAR.with_(I_z=balanced * np.array([0.8, 1.0, 1.2])), "delta_f")
    np.testing.assert_allclose(found.place[1], -CAR.b)
    rear, front = found.velocity(-CAR.b), found.velocity(CAR.a)
    assert rear[0] < 0 < rear[2]
    assert np.all(front > 0)
    assert abs(rear[1]) < 1e-12 * front[1]
    assert "-1.5 m" not in str(found)
    assert "m to" in str(found)


def test_a_force_at_the_centre_of_mass_turns_nothing():
    found = percussion(load("navion-lateral"), "Y")
    assert np.isinf(found.place)
    assert found.formula == "infinite"
    assert "nowhere" in str(found)


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        (lambda: percussion(CAR, "delta"), "there is no input 'delta'"),
        (lambda: percussion(CAR, "delta_f", lateral="W"), "there is no state 'W'"),
        (lambda: percussion(load("motorcycle-lean"), "delta_f"), "say which states"),
        (lambda: percussion(close(CAR, lag(CAR, "delta_f"), tau_delta_f=0.1), "delta_f"), "acts through other states"),
    ],
)
def test_what_is_not_possible_is_refused(wrong, message):
    with pytest.raises(UcritError, match=message):
        wrong()
