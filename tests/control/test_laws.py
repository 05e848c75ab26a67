"""The catalogue's laws: transfer functions and criteria as the book has them, in symbols."""

import numpy as np
import pytest
import sympy as sp

import ucrit
from ucrit import criteria, critical, find_model, load, simulate, step_response, transfer
from ucrit.catalogue import controller_names, find_controller
from ucrit.control import closed, state_feedback
from ucrit.core.derivation.derive import symbolic

LEAN, CAR = find_model("lean"), find_model("car")


def symbols_of(model):
    return {s.name: s for s in symbolic(model).traced.parameters.values()} | {"s": sp.Symbol("s")}


def same(found, expected, model):
    """Compare a transfer function's text with a formula, in the model's symbols."""
    names = symbols_of(model)
    short = {
        "K": "U**2/(g*(a + b))",
        "tau_1": "sqrt((I_1 + m*h**2)/(m*g*h))",
        "tau_2": "b/U",
        "tau_3": "a/U",
    }
    names |= {k: sp.sympify(v, names) for k, v in short.items() if {"h", "U"} <= set(names)}
    return sp.simplify(sp.sympify(found.text, names) - sp.sympify(expected, names)) == 0


def under(law, *more):
    return closed(LEAN, *map(find_controller, (law, *more)))


@pytest.mark.parametrize(
    ("model", "input", "output", "expected"),
    [
        (LEAN, "delta_f", "theta", "-K*(tau_2*s + 1)/(tau_1**2*s**2 - 1)"),
        (LEAN, "delta_r", "theta", "K*(1 - tau_3*s)/(tau_1**2*s**2 - 1)"),
        (
            under("lean-by-front-steering"),
            "theta_d",
            "theta",
            "G*K*(tau_2*s + 1)/(tau_1**2*s**2 + G*K*tau_2*s + G*K - 1)",
        ),
        (
            under("lean-by-front-steering"),
            "theta_d",
            "delta_f",
            "-G*(tau_1**2*s**2 - 1)/(tau_1**2*s**2 + G*K*tau_2*s + G*K - 1)",
        ),
        (
            under("lean-by-rear-gain"),
            "theta_d",
            "theta",
            "G*K*(1 - tau_3*s)/(tau_1**2*s**2 - G*K*tau_3*s + G*K - 1)",
        ),
        (
            under("lean-by-both-steerings"),
            "theta_d",
            "theta",
            "G*K*((tau_2 + rho*tau_3)*s + 1 - rho)/(tau_1**2*s**2 + G*K*(tau_2 + rho*tau_3)*s + G*K*(1 - rho) - 1)",
        ),
        (
            under("lean-by-rear-steering"),
            "theta_d",
            "theta",
            "G*K*(T_1*s + 1)*(1 - tau_3*s)/((tau_1**2*s**2 - 1)*(T_2*s + 1) + G*K*(T_1*s + 1)*(1 - tau_3*s))",
        ),
    ],
)
def test_leaning_vehicles_in_the_book_s_time_constants(model, input, output, expected):
    assert same(transfer(model, input, output), expected, model)


def test_yaw_rate_loops_are_those_of_the_problems():
    H = transfer(CAR, "delta_f", "r").text
    fed, led = (closed(CAR, find_controller(name)) for name in ("yaw-rate-feedback", "yaw-rate-reference"))
    assert same(transfer(fed, "r_d", "r"), f"G*({H})/(1 + G*({H}))", fed)
    assert same(transfer(led, "delta_f", "r"), f"({H})*(1 + G*U/(a + b))/(1 + G*({H}))", led)


def test_front_feedback_reaches_every_pair_of_poles():
    """Problem 11.1: both coefficients of the polynomial are linear in the two gains, with a regular matrix."""
    model = closed(CAR, state_feedback(CAR, "delta_f"))
    names = symbols_of(model)
    a = symbolic(model).polynomial.expressions
    gains = [names["K_delta_f_V"], names["K_delta_f_r"]]
    slopes = sp.Matrix([[sp.diff(a[i] / a[2], k) for k in gains] for i in (0, 1)])
    assert not slopes.free_symbols & set(gains)
    assert sp.factor(slopes.det()) != 0


def test_no_gain_holds_a_vehicle_steered_at_the_rear():
    found = criteria(under("lean-by-rear-gain"))
    assert found.settled is False
    assert set(found.conflict) == {"-G", "G*U**2 - g*(a + b)"}
    assert "cannot both hold" in str(found)
    G = np.concatenate([-np.logspace(-3, 3, 40), np.logspace(-3, 3, 40)])
    values = load("motorcycle-lean").values
    unstable = ucrit.sweep(under("lean-by-rear-gain")(**values, G=0.1), G=G, U=np.linspace(1, 60, 30))
    assert not unstable.stable.any()


def test_front_steering_first_goes_the_wrong_way():
    ridden = load("motorcycle-steered-to-lean")
    found = transfer(ridden, "theta_d", "delta_f")
    p = ridden.values
    unstable = np.sqrt(p["m"] * p["g"] * p["h"] / (p["I_1"] + p["m"] * p["h"] ** 2))
    np.testing.assert_allclose(sorted(found.zeros.real), [-unstable, unstable], rtol=1e-9)
    assert found.non_minimum_phase
    linear = step_response(ridden, "theta_d", "delta_f").values[..., 0]
    assert linear[0] * linear[-1] < 0
    full = simulate(ridden, 4, inputs={"theta_d": 0.3}, tolerance=1e-8)
    assert full["delta_f"][0] < 0 < full["delta_f"][-1]
    assert full["theta"][-1] > 0.3


def test_steady_turn_has_the_yaw_rate_asked_for_but_for_the_finite_gain():
    GK = "G*K/(G*K - 1)"
    for law, input, gain in (("lean-from-yaw-rate", "r_d", GK), ("lean-from-curvature", "kappa_d", f"U*{GK}")):
        model = under("lean-by-front-steering", law)
        names = symbols_of(model)
        text = transfer(model, input, "r").text
        K = sp.sympify("U**2/(g*(a + b))", names)
        expected = sp.sympify(gain, names | {"K": K})
        assert sp.simplify(sp.sympify(text, names).subs(names["s"], 0) - expected) == 0


def test_opposite_steering_of_both_wheels_lowers_the_lowest_speed():
    both = load("motorcycle-steered-at-both-ends")
    lowest = {rho: critical(both.with_(rho=rho))[0].value for rho in (0.0, -0.4, -0.8)}
    p = both.values
    for rho, speed in lowest.items():
        assert speed == pytest.approx(np.sqrt(p["g"] * (p["a"] + p["b"]) / (p["G"] * (1 - rho))), rel=1e-9)
    assert lowest[0.0] > lowest[-0.4] > lowest[-0.8]
    assert not critical(both.with_(rho=-0.95))  # the damping G (b + rho a) is lost: no speed is enough


def test_the_trailer_with_a_steered_axle_under_its_law_is_the_one_with_the_law_built_in():
    built, made = (
        find_model("trailer-active-steering"),
        closed(find_model("trailer-steered-axle"), find_controller("trailer-steering-by-yaw-rate")),
    )
    for sense in (1, -1):
        one, other = symbolic(built, sense), symbolic(made, sense)
        assert one.P == other.P
        assert one.Q == other.Q


@pytest.mark.parametrize("name", controller_names())
def test_every_controller_describes_itself(name):
    found = ucrit.describe_controller(name)
    assert set(found.law) == set(found.drives)
    assert found.to_dict()["controller"]["name"] == name
    assert str(found).startswith(f"{name}: ")
