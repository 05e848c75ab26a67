"""Delays as they are: closed forms by the method of steps, several delays, delays among the controllers."""

import math
from fractions import Fraction

import numpy as np
import pytest

from ucrit import Model, Step, UcritError, input, load, param, simulate, simulate_delayed, state, step_response
from ucrit.control import Controller, close, delay, lag, lqr, state_feedback

MOTORCYCLE = load("motorcycle-steered-to-lean")
CAR = load("oversteering-car")


class Remembering(Model):
    """X' = -k X(t - T) - l X(t - S), which two inputs stand for."""

    k: float = param("1/s", "share of the first", default=1.0)
    l: float = param("1/s", "share of the second", default=0.0)
    X = state("m", "position")
    X_1 = input("m", "position some time before")
    X_2 = input("m", "position some other time before")

    def equations(self, x, dx, u):
        return dx.X + self.k * u.X_1 + self.l * u.X_2


def test_the_equation_with_one_delay_has_its_closed_form():
    """X' = -X(t - 1) after X = 1: a sum of (-1)^k (t - k + 1)^k/k! (R. D. Driver 1977, chapter V)."""
    times = np.linspace(0, 5, 51)
    moved = simulate_delayed(
        Remembering(), {"X_1": ("X", "1000 ms")}, 5, {"X": 1}, before={"X_1": "100 cm"}, times=times
    )
    terms = [np.where(times >= k - 1, (-1) ** k * (times - k + 1) ** k / math.factorial(k), 0) for k in range(7)]
    np.testing.assert_allclose(moved["X"], np.sum(terms, axis=0), atol=1e-11)


def test_two_delays_that_do_not_fit_one_another():
    """The same by polynomials in exact arithmetic, from kink to kink."""
    T, S, k, l, end = Fraction(1), Fraction(7, 10), 1, 2, Fraction(5, 2)
    pieces = [(Fraction(-9), Fraction(0), [Fraction(1)])]
    kinks = sorted({i * T + j * S for i in range(4) for j in range(5) if 0 < i * T + j * S < end} | {end})

    def shifted(p, by):
        return [sum(c * math.comb(i, j) * (-by) ** (i - j) for i, c in enumerate(p) if i >= j) for j in range(len(p))]

    def value(p, t):
        return sum(c * t**i for i, c in enumerate(p))

    at, x = Fraction(0), Fraction(1)
    for b in kinks:
        rate = [Fraction(0)] * 9
        for share, late in ((k, T), (l, S)):
            past = next(p for lo, hi, p in pieces if lo <= (at + b) / 2 - late <= hi)
            for i, c in enumerate(shifted(past, late)):
                rate[i] -= share * c
        p = [Fraction(0), *(c / (i + 1) for i, c in enumerate(rate))]
        p = p[: 1 + max(i for i, c in enumerate(p) if c)]
        p[0] = x - value(p, at)
        pieces.append((at, b, p))
        at, x = b, value(p, b)
    late = {"X_1": ("X", 1.0), "X_2": ("X", 0.7)}
    moved = simulate_delayed(Remembering(l=2.0), late, 2.5, {"X": 1}, before={"X_1": 1, "X_2": lambda t: 1.0})
    assert moved["X"][-1] == pytest.approx(float(x), abs=1e-11)


class LateRider(Controller):
    """Front steering by a lean angle and its rate that are seen late."""

    drives = ("delta_f",)
    G: float = param("1", "steer angle per lean angle")
    seen = input("rad", "lean angle that is seen")

    def law(self, u):
        return {"delta_f": self.G * u.seen}


def test_a_sensor_s_delay_is_that_of_the_wheel():
    bare = load("motorcycle-lean")
    seen = close(bare, LateRider, G=MOTORCYCLE.G)
    times = np.linspace(0, 2, 21)
    one = simulate_delayed(seen, {"seen": ("theta", 0.02)}, 2, {"theta": 0.01}, times=times)
    other = simulate_delayed(MOTORCYCLE, {"delta_f": 0.02}, 2, {"theta": 0.01}, times=times)
    np.testing.assert_allclose(one["theta"], other["theta"], atol=1e-12)


@pytest.mark.parametrize("order", [1, 3])
def test_a_delay_among_the_controllers_is_exact_and_shapes_go_on(order):
    late = close(CAR, delay(CAR, "delta_f", order), T_delta_f=0.1)
    times = np.linspace(0, 2, 41)
    moved = simulate(late, 2, inputs={"delta_f": Step("1 deg", at=0.55)}, times=times)
    plain = simulate(CAR, 2, inputs={"delta_f": "step 1 deg at 0.65 s"}, times=times)
    np.testing.assert_allclose(moved["r"], plain["r"], atol=1e-11)
    assert moved["delta_f_actual"][-1] == pytest.approx(moved["delta_f_demanded"][-1], rel=1e-12)


def test_the_approximation_comes_near_the_delay_as_its_order_grows():
    held = lqr(CAR, "delta_f", {"r": 1.0}, 1.0)
    errors = []
    for order in (1, 2, 4):
        slow = close(CAR, lag(CAR, "delta_f"), delay(CAR, "delta_f", order), tau_delta_f=0.05, T_delta_f=0.02)
        law = state_feedback(slow, "delta_f", states=("V", "r"))
        one = close(slow, law, K_delta_f_V=held.K_delta_f_V, K_delta_f_r=0.1)
        times = np.linspace(0.5, 2, 16)
        exact = simulate(one, 2, inputs={"delta_f": 1e-6}, times=times)["r"] / 1e-6
        errors.append(np.abs(step_response(one, "delta_f", "r", times).values[:, 0] - exact).max())
    assert errors[0] > 3 * errors[1] > 9 * errors[2]


def test_a_law_that_feeds_the_delay_s_states_back_is_followed_too():
    slow = close(CAR, delay(CAR, "delta_f"), T_delta_f=0.05)
    held = lqr(slow, "delta_f", {"r": 1.0}, 10.0)
    moved = simulate(held, 4, {"r": 0.1})
    assert abs(moved["r"][-1]) < 1e-3 < abs(moved["delta_f_delayed_1"]).max()


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        (lambda: simulate_delayed(MOTORCYCLE, {"delta_r": 0.1}, 1), "say what it is late of"),
        (lambda: simulate_delayed(MOTORCYCLE, {"delta_r": ("thet", 0.1)}, 1), "no state or output 'thet'.*theta"),
        (lambda: simulate_delayed(MOTORCYCLE, {"delta_r": ("p", 0.1)}, 1), r"cannot be what p \[.*\] was"),
        (lambda: simulate_delayed(MOTORCYCLE, {"delta_r": ("theta",)}, 1), "give a quantity and a delay"),
        (lambda: simulate_delayed(MOTORCYCLE, {"delta_f": "0.1 m"}, 1), "delay of delta_f"),
        (lambda: simulate_delayed(MOTORCYCLE, {"delta_f": 1e-6}, 1), "must be above 0.0001 s for 1 s"),
        (lambda: simulate_delayed(MOTORCYCLE, {"delta_f": 0.1}, 1, before={"delta_r": 1}), "'delta_r' is not late"),
        (lambda: simulate_delayed(MOTORCYCLE.with_(U=[9.0, 10.0]), {"delta_f": 0.1}, 1), "one value each for U"),
    ],
)
def test_what_is_not_possible_is_refused(wrong, message):
    with pytest.raises(UcritError, match=message):
        wrong()
