"""Margins: those of python-control, and what happens when they are used up."""

import warnings

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import control
import ucrit
from ucrit import load, margins
from ucrit.control import close, delay, lag, lqr, place, state_feedback
from ucrit.numerics.loops import from_roots, loop_margins, positive_roots

CAR = load("oversteering-car")
MOTORCYCLE = load("motorcycle-steered-to-lean")
REAR = load("motorcycle-steered-at-the-rear")


def slow_car():
    slow = close(CAR, lag(CAR, "delta_f"), delay(CAR, "delta_f", 3), tau_delta_f=0.05, T_delta_f=0.03)
    law = state_feedback(slow, "delta_f", states=("V", "r"))
    return close(slow, law, K_delta_f_V=0.0, K_delta_f_r=0.15)


@settings(max_examples=40, deadline=None)
@given(
    pairs=st.lists(st.tuples(st.floats(-5, 2), st.floats(-5, -0.1)), min_size=2, max_size=4),
    frequency=st.floats(0.1, 5),
)
def test_random_loops_against_python_control(pairs, frequency):
    """Open poles, some of them unstable, and closed ones, all stable, give the loop."""
    opened, closed = ([complex(p) for p in group] for group in zip(*pairs, strict=True))
    closed[:2] = [closed[0] + 1j * frequency, closed[0] - 1j * frequency]
    assume(min(map(abs, opened)) > 0.05)
    d = from_roots(np.array(opened))
    n = (from_roots(np.array(closed)) - d)[:-1]
    assume(np.abs(n).min() > 0.05)
    loop = control.tf(n[::-1], d[::-1])
    found = loop_margins(n, d)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        every = control.stability_margins(loop, returnall=True)
    up = min((g for g in every[0] if g > 1), default=np.inf)
    assert found.gain_up == pytest.approx(up, rel=1e-4)
    down = max((g for g in every[0] if 0 < g < 1), default=0.0)
    assert found.gain_down == pytest.approx(down, rel=1e-4)
    if len(every[1]):
        assert np.degrees(found.phase) == pytest.approx(np.min(np.abs(every[1])), abs=1e-3)
    omega = np.logspace(-3, 3, 4001)
    L = control.frequency_response(loop, omega).complex
    assert found.disk <= 2 / np.abs((1 - L) / (1 + L)).max() * (1 + 1e-9)
    assert found.disk == pytest.approx(2 / np.abs((1 - L) / (1 + L)).max(), rel=2e-3)


@pytest.mark.parametrize(("vehicle", "gain"), [(MOTORCYCLE, "G"), (REAR, "G"), (slow_car(), "K_delta_f_r")])
def test_the_gain_margins_are_the_critical_gains(vehicle, gain):
    (name,) = ucrit.control.driven(type(vehicle))
    found, present = margins(vehicle, name), vehicle.values[gain]
    factors = np.array([c.value for c in ucrit.critical(vehicle, gain)]) / present
    up = min((f for f in factors if f > 1), default=np.inf)
    down = max((f for f in factors if 0 < f < 1), default=0.0)
    np.testing.assert_allclose([float(found.gain_up), float(found.gain_down)], [up, down], rtol=1e-6)


def test_over_speed_in_one_go():
    U = np.linspace(5, 60, 12)
    found = margins(REAR.with_(U=U), "delta_r")
    each = [margins(REAR.with_(U=u), "delta_r") for u in U]
    for name in ("gain_up", "gain_down", "phase", "delay", "disk"):
        np.testing.assert_allclose(getattr(found, name), [float(getattr(m, name)) for m in each])
    lowest, highest = (c.value for c in ucrit.critical(REAR))
    np.testing.assert_array_equal(found.stable, (lowest < U) & (highest > U))
    assert np.isnan(found.disk[~found.stable]).all()
    assert found.table().data[1].dims == ("U",)


def test_least_cost_stands_half_the_gain_any_more_and_sixty_degrees():
    for r in (0.01, 1.0, 100.0):
        found = margins(lqr(CAR, "delta_r", {"r": 1.0}, r), "delta_r")
        assert found.gain_down <= 0.5
        assert found.gain_up == np.inf
        assert np.degrees(found.phase) >= 60 - 1e-6


def test_no_margins_without_stability_or_limits():
    assert "unstable" in str(margins(MOTORCYCLE.with_(U=5), "delta_f"))
    first_order = str(margins(place(CAR, "delta_r", [-40, -50]), "delta_r"))
    assert "to no limit" in first_order
    assert positive_roots(np.array([[1.0, 0.0], [-1.0, 1.0]])).tolist()[1] == [1.0]


def test_the_loop_of_an_observer_is_that_of_the_compensator():
    """Cut next to the vehicle, the observer knows the command, not what reaches the wheels."""
    from ucrit.control import kalman
    from ucrit.core.numeric.compiled import state_space

    bare = load("motorcycle-lean")
    seen = kalman(bare, "theta", {"p": 1e4}, 1e-4)
    held = lqr(seen, "delta_r", {"theta": 1.0}, 1.0, estimated=True)
    A, B, _, _ = state_space(bare)
    b, c = B[:, 1:], np.array([[1.0, 0.0]])
    K = np.array([[held.K_delta_r_theta, held.K_delta_r_p]])
    L = np.array([[held.L_theta_theta], [held.L_p_theta]])
    loop = control.ss(A - b @ K - L @ c, L, K, 0) * control.ss(A, b, c, 0)
    _, phase, modulus, *_ = control.stability_margins(loop)
    found = margins(held, "delta_r")
    assert np.degrees(found.phase) == pytest.approx(abs(phase), abs=1e-3)
    omega = np.logspace(-2, 4, 20001)
    L_at = control.frequency_response(loop, omega).complex
    assert found.disk == pytest.approx(2 / np.abs((1 - L_at) / (1 + L_at)).max(), rel=1e-3)
    assert modulus < 0.8
