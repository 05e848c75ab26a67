"""Brake-based stability control: which wheel is braked, slips in bounds, a spin that is prevented, both sides alike."""

import numpy as np
import pytest

from ucrit import SineWithDwell, dwell_criteria, load, modes, simulate
from ucrit.control import close
from ucrit.control.laws.stability_control import StabilityControl
from ucrit.control.laws.wheel_slip_control import WheelSlipControl
from ucrit.control.laws.yaw_rate_within_friction import YawRateWithinFriction
from ucrit.core.numeric.motion import motion

WHEELS = ("fl", "fr", "rl", "rr")
BARE, CAR = load("car-on-worn-rear-tires"), load("car-with-stability-control")
FAST = {"tolerance": 1e-5}


def outputs(car, **changes):
    """Outputs on the basic motion with some states and inputs changed."""
    made = motion(type(car))
    w, u = (v.copy() for v in made.basic(car.arguments()))
    inputs = list(type(car).declaration.inputs)
    for name, value in changes.items():
        if name in inputs:
            u[inputs.index(name)] = value
        else:
            w[made.labels.index(name)] = value
    return dict(zip(type(car).declaration.outputs, made.outputs(w, u, car.arguments()), strict=True))


@pytest.mark.parametrize(
    ("r", "wanted", "braked"),
    [
        (0.4, 0.2, "fl"),  # right turn, oversteer: the outer front wheel
        (-0.4, -0.2, "fr"),  # left turn, oversteer
        (0.2, 0.4, "rr"),  # right turn, understeer: the inner rear wheel
        (-0.2, -0.4, "rl"),  # left turn, understeer
        (0.2, -0.2, "fl"),  # the steering is reversed, the car still turns right: too much of it
    ],
)
def test_the_braked_wheel_is_that_of_figure_11_2(r, wanted, braked):
    found = outputs(CAR, r=r, wanted=wanted)
    added = {wheel: found[f"added_{wheel}"] for wheel in WHEELS}
    assert added.pop(braked) == pytest.approx(CAR.G * (abs(r - wanted) - CAR.e_0))
    assert set(added.values()) == {0.0}


@pytest.mark.parametrize("wheel", WHEELS)
def test_a_brake_turns_the_car_to_its_own_side(wheel):
    braked = {**dict.fromkeys(("brake_fl", "brake_fr", "brake_rl", "brake_rr"), 0.0), f"brake_{wheel}": 500.0}
    assert np.sign(simulate(BARE, 0.2, inputs=braked, **FAST)["r"][-1]) == (1 if wheel.endswith("r") else -1)


def test_sideslip_counts_as_too_much_yaw_rate():
    sliding = outputs(CAR, v_y=-0.2 * CAR.U)  # the tail is out to the left, as in a spin to the right
    beyond = np.arctan(0.2) - CAR.beta_0
    assert sliding["error"] == pytest.approx(CAR.G_beta * beyond)
    assert outputs(CAR, v_y=0.05 * CAR.U)["error"] == 0


def test_the_driver_s_brakes_give_way_on_the_side_that_pulls():
    found = outputs(CAR, r=0.1, brake=8000.0)
    pull = CAR.G * (0.1 - CAR.e_0)
    own = CAR.share / 2 * 8000
    assert found["demand_fr"] == pytest.approx(max(own - pull, 0))
    assert found["demand_fl"] == pytest.approx(own + pull)
    assert outputs(CAR, r=0.04, brake=8000.0)["demand_fr"] == pytest.approx(own)


@pytest.mark.parametrize(("delta", "v"), [(0.01, 20.0), (-0.01, 30.0), (0.3, 20.0), (-0.3, 30.0)])
def test_the_desired_yaw_rate_is_that_of_a_steady_turn_within_friction(delta, v):
    free = v * delta / (CAR.a + CAR.b + CAR.K * v**2)
    bound = CAR.mu * CAR.g / v
    assert outputs(CAR, delta_f=delta, v_x=v)["steady"] == pytest.approx(np.clip(free, -bound, bound))


def test_near_the_basic_motion_the_laws_only_add_their_lags():
    own, bare = modes(CAR).eigenvalues, modes(BARE).eigenvalues
    added = [-1 / CAR.tau] * 4 + [-1 / CAR.tau_d]
    np.testing.assert_allclose(
        np.sort_complex(own), np.sort_complex([*bare, *added]), rtol=1e-6, atol=1e-6 * abs(bare).max()
    )


@pytest.mark.parametrize("mu", [1.0, 0.3])
def test_slip_stays_in_bounds_on_a_full_brake(mu):
    car = close(BARE, WheelSlipControl)
    demands = {"demand_fl": 2900, "demand_fr": 2900, "demand_rl": 1500, "demand_rr": 1500}
    roads = {"mu_left": mu, "mu_right": mu}
    held = simulate(car, 1.2, inputs=demands | roads, **FAST)
    settled = held.times > 0.3
    for wheel in WHEELS:
        slip = held[f"kappa_{wheel}"]
        assert slip[settled].min() > -(car.kappa_0 + car.band)
        assert slip.min() > -0.3
        assert slip[settled].max() < -0.02  # and the brakes do brake
    locked = simulate(BARE, 0.4, inputs={f"brake_{w}": 2900 for w in WHEELS} | roads, **FAST)
    assert locked["kappa_rl"][-1] < -0.9
    grip = (car.front_mu + car.rear_mu) / 2 * mu * car.g
    assert -held["a_x"][-1] > 0.8 * grip


def test_the_controlled_car_passes_where_the_other_spins_and_both_sides_are_alike():
    right, left = SineWithDwell("7 deg", at=0.1), SineWithDwell("-7 deg", at=0.1)
    spun = dwell_criteria(simulate(BARE, 3.8, inputs={"delta_f": right}, **FAST), right)
    assert not spun.stable
    held = simulate(CAR, 3.8, inputs={"delta_f": right}, **FAST)
    found = dwell_criteria(held, right)
    assert found.stable
    assert found.responsive
    mirrored = simulate(CAR, 3.8, inputs={"delta_f": left}, **FAST)
    np.testing.assert_allclose(mirrored["r"], -held["r"], atol=1e-4)
    np.testing.assert_allclose(mirrored["torque_fl"], held["torque_fr"], atol=2)


def test_on_two_sides_of_friction_it_brakes_straight_where_slip_control_alone_does_not():
    road = {"mu_left": 0.3, "brake": 9000}
    held = simulate(CAR, 6, inputs=road, **FAST)
    assert held.ended == "has slowed to a tenth of its speed"
    assert np.abs(held["beta"]).max() < 0.06
    alone = simulate(CAR.with_(relief=0, G=0), 6, inputs=road, **FAST)
    assert np.abs(alone["beta"]).max() > 0.5


def test_the_reference_needs_what_the_car_has():
    names = [c.model_id() for c in (WheelSlipControl, StabilityControl, YawRateWithinFriction)]
    assert type(CAR).ingredients()["controllers"] == names
