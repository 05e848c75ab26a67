"""Gains: poles come out as asked, costs are least, and what cannot be moved or seen is named."""

import numpy as np
import pytest
import scipy.linalg
from hypothesis import given, settings
from hypothesis import strategies as st

import ucrit
from ucrit import Model, UcritError, coordinate, input, load, param, state
from ucrit.catalogue import load as load_vehicle
from ucrit.control import close, kalman, lqr, observer, place, reaching_time, state_feedback
from ucrit.core.contract.files import write_vehicle
from ucrit.core.numeric.compiled import state_space

CAR = load("oversteering-car")
MOTORCYCLE = load("motorcycle-lean")
PLANE = load("navion-lateral")

real = st.floats(-20, -0.5)


def polynomial(vehicle):
    return np.poly(state_space(vehicle).A)


@settings(max_examples=20, deadline=None)
@given(real, st.floats(0, 10), st.sampled_from(["delta_f", "delta_r"]), st.floats(5, 60))
def test_a_car_s_two_poles_are_placed_at_will_from_either_end(re, im, end, U):
    poles = [re + 1j * im, re - 1j * im]
    np.testing.assert_allclose(
        polynomial(place(CAR.with_(U=U), end, poles)), np.poly(poles), rtol=1e-7, atol=1e-9 * 500
    )


@pytest.mark.parametrize("inputs", [["delta_f", "delta_r"], "delta_f"])
def test_repeated_poles_as_often_as_possible(inputs):
    np.testing.assert_allclose(polynomial(place(CAR, inputs, [-5, -5])), [1, 10, 25], rtol=1e-8)


def test_four_states_and_two_inputs():
    inputs = list(type(PLANE).declaration.inputs)[:2]
    poles = [-1 + 1j, -1 - 1j, -2, -3]
    np.testing.assert_allclose(polynomial(place(PLANE, inputs, poles)), np.poly(poles), rtol=1e-6)


def test_least_cost_is_that_of_the_equation_of_riccati():
    Q, R = np.diag([1e-3, 2.0]), np.array([[3.0]])
    A, B, _, _ = state_space(CAR)
    P = scipy.linalg.solve_continuous_are(A, B[:, :1], Q, R)
    K = np.linalg.solve(R, B[:, :1].T @ P)
    found = lqr(CAR, "delta_f", {"V": 1e-3, "r": 2.0}, 3.0)
    np.testing.assert_allclose([[found.K_delta_f_V, found.K_delta_f_r]], K, rtol=1e-10)
    np.testing.assert_allclose(A.T @ P + P @ A - P @ B[:, :1] @ K + Q, 0, atol=1e-8 * np.abs(P).max())


@settings(max_examples=10, deadline=None)
@given(st.lists(real, min_size=2, max_size=2), st.lists(st.floats(-40, -21), min_size=2, max_size=2))
def test_observer_and_feedback_keep_their_own_poles(slow, fast):
    poles = sorted([*slow, *fast])
    ridden = place(observer(MOTORCYCLE, "theta", fast), "delta_r", slow, estimated=True)
    np.testing.assert_allclose(polynomial(ridden), np.poly(poles), rtol=1e-6)


def test_an_accelerometer_shows_the_lateral_velocity_and_needs_no_rate():
    seen = observer(CAR, ["a_y", "r"], [-15, -20])
    found = sorted(ucrit.modes(seen).eigenvalues.real)
    np.testing.assert_allclose(found[:2], [-20, -15], rtol=1e-8)
    moved = ucrit.simulate(seen, 1.5, {"V": 0.5, "r": 0.1}, {"delta_f": 0.01}, tolerance=1e-8)
    np.testing.assert_allclose(moved["V_hat"][-1], moved["V"][-1], rtol=1e-6)


def test_least_variance_is_least_cost_of_the_transposed_system():
    A = state_space(CAR).A
    row = np.eye(2)[[1]]
    P = scipy.linalg.solve_continuous_are(A.T, row.T, np.diag([1.0, 0.1]), [[0.01]])
    L = P @ row.T / 0.01
    found = kalman(CAR, "r", {"V": 1.0, "r": 0.1}, 0.01)
    np.testing.assert_allclose([[found.L_V_r], [found.L_r_r]], L, rtol=1e-8)


def test_an_observer_that_does_not_know_what_changed_loses_the_separation():
    held = place(observer(CAR, "r", [-15, -20], own=["C_r", "m"]), "delta_r", [-4, -5], estimated=True)
    changed = held.with_(C_r=0.8 * CAR.C_r)
    assert changed.C_r_hat == CAR.C_r
    np.testing.assert_allclose(polynomial(held), np.poly([-15, -20, -4, -5]), rtol=1e-8)
    told = changed.with_(C_r_hat=changed.C_r)
    assert not np.allclose(polynomial(changed), polynomial(told), rtol=1e-3)


def test_gains_are_parameters_for_every_analysis(tmp_path):
    held = place(CAR, "delta_r", [-4, -5])
    values = [c.value for c in ucrit.critical(held, "K_delta_r_r")]
    assert values
    assert np.all(np.abs(ucrit.modes(held.with_(K_delta_r_r=values[0])).eigenvalues.real).min() < 1e-6)
    path = tmp_path / "held.toml"
    path.write_text(write_vehicle(held), encoding="utf-8")
    again = load_vehicle(path)
    assert type(again) is type(held)
    assert again.values == held.values


class Two(Model):
    """Two masses side by side, one of which nothing moves and nothing shows."""

    k: float = param("1/s^2", "stiffness", above=0)
    h: float = param("1/s", "growth", above=0)
    x = coordinate("m", "first mass")
    z = state("m", "second mass")
    F = input("m/s^2", "push")

    def equations(self, x, dx, ddx, u):
        return ddx.x + self.k * x.x - u.F, dx.z - self.h * x.z


TWO = Two(k=4.0, h=4.0)


def test_a_motion_that_cannot_be_moved_may_stay_where_it_is():
    found = np.sort(state_space(place(TWO, "F", [-1, -2, 4])).A.diagonal())
    assert 4 in found.round(9)
    np.testing.assert_allclose(polynomial(place(TWO, "F", [-1, -2, 4])), np.poly([-1, -2, 4]), rtol=1e-9)


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        (lambda: place(TWO, "F", [-1, -2, -3]), "F cannot move the motion of eigenvalue 4 1/s, most of it in z"),
        (lambda: lqr(TWO, "F", [1, 1, 1], 1), "F cannot move the motion of eigenvalue 4 1/s"),
        (lambda: observer(TWO, "x", [-1, -2, -3]), "x does not show the motion of eigenvalue 4 1/s, most of it in z"),
        (lambda: place(CAR, "delta_f", [-1]), r"as many poles as states, 2 \(V, r\), got 1"),
        (lambda: place(CAR, "delta_f", [-1 + 1j, -2]), r"pole -1\+1j 1/s needs its conjugate"),
        (lambda: place(CAR, "delta_f", ["fast", -2]), "poles must be a list of complex numbers"),
        (lambda: place(CAR, "delta_q", [-1, -2]), "there is no input 'delta_q'; did you mean"),
        (lambda: place(CAR.with_(U=[10, 20]), "delta_f", [-1, -2]), "give one value each for U"),
        (lambda: place(PLANE, list(type(PLANE).declaration.inputs)[:2], [-1, -1, -1, -2]), "can be had 2 times, not 3"),
        (lambda: place(CAR, "delta_f", [-1, -2], estimated=True), "add an observer first"),
        (lambda: observer(CAR, "speed", [-1, -2]), "no state or output 'speed' to measure"),
        (lambda: observer(CAR, "r", [-1, -2], own=["Cf"]), "there is no parameter 'Cf'"),
        (lambda: lqr(CAR, "delta_f", {"rr": 1}, 1), "Q: there is no 'rr'"),
        (lambda: lqr(CAR, "delta_f", {"r": 1}, 0), "R: the weight of delta_f must be above 0, got 0"),
        (lambda: lqr(CAR, "delta_f", {"r": -1}, 1), "Q: the weight of r must be at least 0, got -1"),
        (lambda: lqr(CAR, "delta_f", {"r": "big"}, 1), "Q: the weight of r must be a number, got 'big'"),
        (lambda: lqr(CAR, "delta_f", [[1, 2], [0, 1]], 1), "Q must be symmetric"),
        (lambda: place(CAR, 3, [-1, -2]), "inputs must be a name or a list of names, got 3"),
        (lambda: place(CAR, "delta_f", [-1e12, -2e12]), "cannot move poles as far as -2e[+]12 1/s"),
        (lambda: close(type(CAR), state_feedback(CAR, "delta_f")), "close takes a vehicle"),
        (lambda: reaching_time(float("nan"), 1), "S must be a finite number, got nan"),
        (lambda: reaching_time(1, 1, q=-1), "q must be a finite number of at least 0, got -1"),
        (lambda: state_feedback(CAR), "name at least one input"),
        (lambda: state_feedback(CAR, "delta_f", states=["W"]), "there is no state 'W'"),
        (lambda: close(CAR, state_feedback(CAR, "delta_f"), K_delta_f_W=1), "there is no parameter 'K_delta_f_W'"),
        (lambda: ucrit.margins(CAR, "delta_f"), "no controller drives 'delta_f'; driven inputs: none"),
    ],
)
def test_what_is_not_possible_is_refused(wrong, message):
    with pytest.raises(UcritError, match=message):
        wrong()


def test_an_observer_with_values_of_its_own_that_trim_otherwise_is_told_which():
    airplane, poles = load("navion-from-geometry"), [-5, -6, -7, -8]
    for own in (["m"], ["m", "I_yy"]):
        with pytest.raises(
            UcritError, match="with m_hat of its own a controller has another basic motion than the veh"
        ):
            ucrit.modes(observer(airplane, ["q", "theta"], poles, own=own))
    assert len(ucrit.modes(observer(airplane, ["q", "theta"], poles, own=["I_yy"])).eigenvalues) == 8
