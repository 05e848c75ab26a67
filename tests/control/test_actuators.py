"""Actuators: what they do to small motions, to large ones, and to the phase."""

import numpy as np
import pytest
import scipy.integrate

import control
import ucrit
from ucrit import UcritError, load, margins, simulate, simulate_delayed, to_control
from ucrit.control import broken, close, delay, lag, rate_limit, saturation, state_feedback
from ucrit.core.numeric.compiled import state_space

CAR = load("oversteering-car")
MOTORCYCLE = load("motorcycle-steered-to-lean")


@pytest.mark.parametrize("order", [1, 2, 3, 6])
def test_a_delay_passes_all_frequencies_and_has_the_phase_of_the_exponential(order):
    T = 0.1
    late = close(CAR, delay(CAR, "delta_f", order), T_delta_f=T)
    omega = np.array([0.1, 0.5]) * order / T
    found = ucrit.frequency_response(late, "delta_f", "delta_f_actual", omega / (2 * np.pi)).values[..., 0]
    np.testing.assert_allclose(abs(found), 1, rtol=1e-9)
    exact = np.exp(-1j * omega * T)
    error = {1: (1e-4, 1.1e-2), 2: (1e-6, 2e-3), 3: (1e-7, 1e-3), 6: (1e-10, 1e-6)}[order]
    assert np.all(abs(found - exact) < error)
    num, den = control.pade(T, order)
    np.testing.assert_allclose(found, np.polyval(num, 1j * omega) / np.polyval(den, 1j * omega), rtol=1e-7)


def test_small_motions_know_no_limits_and_large_ones_do():
    limited = close(CAR, rate_limit(CAR, "delta_f"), tau_delta_f=0.02, rate_delta_f=0.3)
    free = close(CAR, lag(CAR, "delta_f"), tau_delta_f=0.02)
    np.testing.assert_allclose(state_space(limited).A, state_space(free).A)
    moved = simulate(limited, 0.4, inputs={"delta_f": 0.1}, tolerance=1e-7)
    assert np.abs(np.diff(moved["delta_f_actual"]) / np.diff(moved.times)).max() <= 0.3 * (1 + 1e-6)
    np.testing.assert_allclose(moved["delta_f_actual"][100], 0.3 * moved.times[100], rtol=1e-6)
    stopped = close(CAR, saturation(CAR, "delta_f"), max_delta_f=0.05)
    np.testing.assert_allclose(state_space(stopped).B, state_space(CAR).B)
    assert set(simulate(stopped, 0.1, inputs={"delta_f": 0.1})["delta_f_actual"]) == {0.05}


def test_a_law_drives_an_actuator_under_the_input_s_own_name():
    slow = close(CAR, lag(CAR, "delta_f"), tau_delta_f=0.1)
    held = close(slow, state_feedback(slow, "delta_f", "r"), K_delta_f_r=0.1)
    A, B, _, _ = state_space(CAR)
    expected = np.block([[A, B[:, :1]], [np.array([[0, -0.1 / 0.1]]), np.array([[-1 / 0.1]])]])
    np.testing.assert_allclose(state_space(held).A, expected, rtol=1e-12)
    assert {"delta_f_actual", "delta_f_actual_2"} <= set(type(held).declaration.outputs)


def test_a_loop_that_is_cut_returns_what_the_law_asks_for():
    cut = broken(type(MOTORCYCLE), "delta_f")
    loop = -to_control(cut(**MOTORCYCLE.values))["delta_f_return", "delta_f_cut"]
    closed = ucrit.modes(MOTORCYCLE).eigenvalues
    np.testing.assert_allclose(np.sort_complex(control.feedback(loop, 1).poles()), np.sort_complex(closed), rtol=1e-9)


@pytest.mark.parametrize(("T", "share"), [(0.9, 1), (1.1, -1)])
def test_the_delay_margin_is_where_the_exact_motion_begins_to_grow(T, share):
    """Share: +1 where the oscillation dies out, -1 where it grows."""
    late = T * float(margins(MOTORCYCLE, "delta_f").delay)
    moved = simulate_delayed(MOTORCYCLE, {"delta_f": late}, 8, {"theta": 1e-4}, tolerance=1e-8)
    early, later = abs(moved["theta"][100:200]).max(), abs(moved["theta"][300:]).max()
    assert share * (early - later) > 0.1 * early


def test_a_delayed_motion_is_that_of_the_linear_equation_with_delay():
    """The upright motorcycle for one delay: no steering comes back yet; then that of the first delay."""
    late, start = 0.2, 1e-6
    moved = simulate_delayed(MOTORCYCLE, {"delta_f": late}, 0.4, {"theta": start}, times=[0.2, 0.4])
    A, B, _, _ = state_space(type(MOTORCYCLE)._plant(**{k: v for k, v in MOTORCYCLE.values.items() if k != "G"}))
    first = scipy.linalg.expm(A * late) @ [start, 0]

    def rates(t, w):
        before = scipy.linalg.expm(A * t) @ [start, 0]
        return A @ w + B[:, 0] * MOTORCYCLE.G * before[0]

    second = scipy.integrate.solve_ivp(rates, (0, late), first, rtol=1e-10, atol=1e-18).y[:, -1]
    np.testing.assert_allclose(moved["theta"], [first[0], second[0]], rtol=1e-7)


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        (lambda: lag(CAR, "delta"), "car: there is no input 'delta'"),
        (lambda: delay(CAR, "delta_f", 0), "whole number from 1 to 12, got 0"),
        (lambda: delay(CAR, "delta_f", "two"), "whole number from 1 to 12, got 'two'"),
        (lambda: close(CAR, lag(CAR, "delta_f"), tau_delta_f=0), "must be above 0 s"),
        (lambda: simulate_delayed(MOTORCYCLE, {"delta_f": 0}, 1), "delay must be above 0 s"),
        (lambda: simulate_delayed(MOTORCYCLE, {"delta": 0.1}, 1), "driven inputs: delta_f"),
        (lambda: ucrit.catalogue.controlled(type(CAR), ("lagg(delta_f)",)), r"no controller 'lagg\(delta_f\)'"),
        (lambda: ucrit.catalogue.controlled(type(CAR), ("lag(delta_f, 2, 3)",)), "3 arguments are not what lag takes"),
    ],
)
def test_what_is_not_possible_is_refused(wrong, message):
    with pytest.raises(UcritError, match=message):
        wrong()
