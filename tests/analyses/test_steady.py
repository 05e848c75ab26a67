"""Steady turns: the book's gradients, speeds and gains, and agreement with critical speeds."""

import numpy as np
import pytest

from ucrit import UcritError, critical, load
from ucrit.analyses.linear.steady import GRAVITY, axle_loads, steady_turn
from ucrit.core.numeric.compiled import state_space

SPEEDS = np.linspace(1, 34, 34)
SEEDS = range(40)


def varied(name, seed):
    rng = np.random.default_rng(seed)
    car = load(name)
    return car.with_(**{key: value * 2 ** rng.uniform(-1, 1) for key, value in car.values.items()})


def K1(car):
    return car.m * (car.b * car.C_r - car.a * car.C_f) / ((car.a + car.b) * car.C_f * car.C_r)


@pytest.mark.parametrize("seed", SEEDS)
def test_understeer_gradients(seed):
    car = varied("understeering-car", seed)
    turn = steady_turn(car)
    front, rear = axle_loads(car)
    assert turn.wheelbase == pytest.approx(car.a + car.b, rel=1e-14)
    assert turn.gradient == pytest.approx(K1(car), rel=1e-9)
    assert turn.gradient_per_g == pytest.approx(front / car.C_f - rear / car.C_r, rel=1e-9)
    assert turn.gradient_deg_per_g == pytest.approx(np.rad2deg(turn.gradient_per_g), rel=1e-14)
    assert front + rear == pytest.approx(car.m * GRAVITY, rel=1e-14)


@pytest.mark.parametrize("seed", SEEDS)
def test_critical_speed_is_that_of_the_dynamics(seed):
    car = varied("oversteering-car", seed)
    turn, found = steady_turn(car), critical(car)
    if turn.handling == "oversteer":
        assert [c.value for c in found] == pytest.approx([turn.critical_speed], rel=1e-9)
        assert np.isnan(turn.characteristic_speed)
    else:
        assert len(found) == 0
        assert np.isnan(turn.critical_speed)


@pytest.mark.parametrize("name", ["understeering-car", "neutral-car", "oversteering-car"])
def test_gains_are_those_of_the_state_equations(name):
    cars = load(name).with_(U=SPEEDS)
    A, B, C, D = state_space(cars)
    states = -np.linalg.solve(A, B[..., :1])
    turn = steady_turn(load(name))
    assert turn.yaw_rate_gain(SPEEDS) == pytest.approx(states[:, 1, 0], rel=1e-10)
    assert turn.acceleration_gain(SPEEDS) == pytest.approx((C @ states + D[..., :1])[:, 0, 0], rel=1e-10)


def test_gains_of_figures_6_10_and_6_11():
    under, neutral, over = (steady_turn(load(f"{n}-car")) for n in ("understeering", "neutral", "oversteering"))
    L, U = 2.75, SPEEDS
    ch, crit = under.characteristic_speed, over.critical_speed
    assert neutral.yaw_rate_gain(U) == pytest.approx(U / L, rel=1e-12)
    assert neutral.acceleration_gain(U) == pytest.approx(U**2 / L, rel=1e-12)
    assert under.yaw_rate_gain(U) == pytest.approx(U / L / (1 + (U / ch) ** 2), rel=1e-12)
    assert under.acceleration_gain(U) == pytest.approx(ch**2 / L * (U / ch) ** 2 / (1 + (U / ch) ** 2), rel=1e-12)
    assert over.yaw_rate_gain(U) == pytest.approx(U / L / (1 - (U / crit) ** 2), rel=1e-12)
    assert over.acceleration_gain(U) == pytest.approx(U**2 / L / (1 - (U / crit) ** 2), rel=1e-12)
    assert under.acceleration_gain(ch) == pytest.approx(neutral.acceleration_gain(ch) / 2, rel=1e-12)
    assert under.acceleration_gain(1e6) == pytest.approx(ch**2 / L, rel=1e-6)
    assert over.yaw_rate_gain(0.999 * crit) > 100
    assert over.yaw_rate_gain(1.1 * crit) < 0


@pytest.mark.parametrize("seed", SEEDS)
def test_yaw_rate_gain_is_largest_at_the_characteristic_speed(seed):
    car = varied("understeering-car", seed)
    turn = steady_turn(car.with_(C_r=max(car.C_r, 1.01 * car.a * car.C_f / car.b)))
    ch = turn.characteristic_speed
    U = ch * np.linspace(0.01, 3, 5000)
    gains = turn.yaw_rate_gain(U)
    assert U[gains.argmax()] == pytest.approx(ch, rel=1e-3)
    assert turn.largest_yaw_rate_gain == pytest.approx(turn.yaw_rate_gain(ch), rel=1e-12)
    assert np.all(gains <= turn.largest_yaw_rate_gain)
    step = 1e-4 * ch
    assert abs(turn.yaw_rate_gain(ch + step) - turn.yaw_rate_gain(ch - step)) < 1e-9 * turn.largest_yaw_rate_gain


def test_steer_angle():
    turn = steady_turn(load("understeering-car"))
    assert turn.steer_angle(50, 20) == pytest.approx(2.75 / 50 + turn.gradient * 20**2 / 50, rel=1e-14)
    neutral = steady_turn(load("neutral-car"))
    assert neutral.steer_angle(50, 40) == pytest.approx(2.75 / 50, rel=1e-14)
    assert turn.curvature_gain(20.0) == pytest.approx(1 / (50 * turn.steer_angle(50, 20)), rel=1e-14)


def test_kinds_and_texts():
    assert [steady_turn(load(n)).handling for n in ("understeering-car", "neutral-car", "oversteering-car")] == [
        "understeer",
        "neutral",
        "oversteer",
    ]
    turn = steady_turn(load("oversteering-car"))
    assert turn.gradient_formula == "m*(C_r*b - C_f*a)/(C_f*C_r*(a + b))"
    assert turn.wheelbase_formula == "a + b"
    assert turn.critical_speed == pytest.approx(np.sqrt(1210), rel=1e-12)
    assert "critical speed 34.785 m/s" in str(turn)
    assert "characteristic speed 28.723 m/s" in str(steady_turn(load("understeering-car")))


def test_rear_steering_has_the_same_speeds_and_the_other_sign():
    front, rear = (steady_turn(load("oversteering-car"), steer) for steer in ("delta_f", "delta_r"))
    assert rear.wheelbase == -front.wheelbase
    assert rear.handling == "oversteer"
    assert rear.critical_speed == pytest.approx(front.critical_speed, rel=1e-14)
    assert rear.yaw_rate_gain(20.0) == pytest.approx(-front.yaw_rate_gain(20.0), rel=1e-14)


def test_arrays():
    turn = steady_turn(load("understeering-car").with_(C_f=np.array([75e3, 108e3, 120e3])))
    assert list(turn.handling) == ["understeer", "neutral", "oversteer"]
    assert turn.yaw_rate_gain([10.0, 20.0]).shape == (3, 2)
    assert turn.yaw_rate_gain(10.0).shape == (3,)
    assert np.isnan(turn.critical_speed[:2]).all()
    assert turn.critical_speed[2] > 0


@pytest.mark.parametrize(
    ("name", "missing"),
    [
        ("caravan", "a yaw rate r [rad/s] and a steer angle delta_f [rad]"),
        ("released-steering-wheel", "a steer angle delta_f [rad]"),
        ("oversteering-car-on-the-road", "a yaw rate r [rad/s]"),
    ],
)
def test_refusals(name, missing):
    with pytest.raises(UcritError) as error:
        steady_turn(load(name))
    model = type(load(name)).model_id()
    assert str(error.value) == f"{model}: a steady turn needs {missing}, which the model does not have"


def test_axle_loads_refuse_a_model_without_axles():
    with pytest.raises(UcritError, match=r"wheelset: axle loads need a parameter a \[m\]"):
        axle_loads(load("wheelset"))
