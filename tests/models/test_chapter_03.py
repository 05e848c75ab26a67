"""Stability as a subject: marbles, a bowling ball on a stick and a mass on a spring stand for the concepts."""

import math

import numpy as np
import pytest
from agreement import SETS, agree, varied

from ucrit import SecondOrder, criteria, critical, find_model, forms, load, modes, routh, simulate, verdict

CONCEPTS = [
    ("marble-in-a-bowl", {}, "asymptotically stable", "stable"),
    ("marble-in-a-bowl", {"b": 0}, "neutral", "stable"),
    ("marble-on-the-flat", {}, "neutral", "neutral"),
    ("marble-on-a-hill", {}, "unstable", "unstable"),
    ("bowling-ball-on-a-stick", {}, "asymptotically stable", "stable"),
    ("bowling-ball-on-a-thin-stick", {}, "unstable", "unstable"),
    ("driven-mass", {}, "unstable", "stable"),
    ("driven-mass", {"b": 0}, "neutral", "stable"),
    ("driven-mass", {"b": 0.2, "k": -4}, "unstable", "unstable"),
]


@pytest.mark.parametrize(("name", "changes", "state", "static"), CONCEPTS)
def test_static_and_dynamic_stability_are_told_apart(name, changes, state, static):
    found = verdict(load(name).with_(**changes))
    assert (found.state, found.static) == (state, static)
    if state == "unstable":
        how = "dynamically" if static == "stable" else "statically"
        assert str(found).startswith(f"{how} unstable")


@pytest.mark.parametrize("name", ["marble-in-a-bowl", "marble-on-the-flat", "marble-on-a-hill"])
def test_marble_does_what_its_verdict_says(name):
    state = verdict(load(name)).state
    x = simulate(load(name), 60 if state != "unstable" else 3, {"x": 1e-3})["x"]
    expected = {
        "asymptotically stable": abs(x[-1]) < 1e-8,
        "neutral": x[-1] == 1e-3,
        "unstable": x[-1] > 0.1 and np.all(np.diff(x) > 0),
    }
    assert expected[state]


@pytest.mark.parametrize("name", ["bowling-ball-on-a-thin-stick", "driven-mass", "satellite-middle-axis", "caravan"])
def test_small_disturbance_grows_with_the_eigenvalue(name):
    vehicle = load(name)
    found = modes(vehicle)
    growing, vector = found.eigenvalues[0], found.vectors[:, 0]
    basic = simulate(vehicle, 1e-3, times=[0]).values[0]
    small = 1e-9 * vector.real
    time = 2.0
    start = dict(zip(found.labels, basic + small, strict=True))
    moved = simulate(vehicle, time, start, times=[time]).values[0] - basic
    expected = (1e-9 * vector * np.exp(growing * time)).real
    assert growing.real > 0
    assert np.abs(moved - expected).max() < 1e-6 * np.abs(expected).max()


@pytest.mark.parametrize("seed", range(SETS))
def test_bowling_ball_stands_if_the_stick_is_stiff_enough(seed):
    ball = varied(load("bowling-ball-on-a-stick"), seed)
    p = ball.values
    found = agree(ball, "k", p["m"] * p["g"] * p["l"], rel=1e-9)
    assert found.kind == "divergence"
    assert found.closed_form.expression == "g*l*m"


def test_bowling_ball_on_a_thin_stick_leans_over_and_is_held_there():
    ball = load("bowling-ball-on-a-thin-stick").with_(c=10)
    theta = simulate(ball, 100, {"theta": 0.01})["theta"][-1]
    assert ball.k * theta == pytest.approx(ball.m * ball.g * ball.l * math.sin(theta), rel=1e-9)
    assert theta > 0.5


@pytest.mark.parametrize("seed", range(SETS))
def test_frequency_damping_and_times_of_an_oscillator(seed):
    mass = varied(load("driven-mass"), seed)
    m, b, k = mass.values.values()
    for vehicle, time in ((mass, "time_to_double"), (mass.with_(b=-b), "time_to_half")):
        (mode,) = modes(vehicle)
        assert mode.frequency_hz == pytest.approx(math.sqrt(k / m - (b / (2 * m)) ** 2) / (2 * math.pi), rel=1e-12)
        assert mode.damping_ratio == pytest.approx(vehicle.b / (2 * math.sqrt(k * m)), rel=1e-12)
        assert getattr(mode, time) == pytest.approx(math.log(2) * 2 * m / abs(b), rel=1e-12)
        assert mode.shape["x'"] / mode.shape["x"] == pytest.approx(mode.eigenvalue, rel=1e-12)


@pytest.mark.parametrize("seed", range(SETS))
def test_critical_damping_is_flutter_and_critical_stiffness_divergence(seed):
    mass = varied(load("driven-mass"), seed)
    (flutter,) = critical(mass, "b")
    (divergence,) = critical(mass.with_(b=0.1), "k")
    assert (flutter.kind, flutter.value, flutter.stable) == ("flutter", 0, "above")
    assert flutter.frequency_hz == pytest.approx(math.sqrt(mass.k / mass.m) / (2 * math.pi), rel=1e-12)
    assert (divergence.kind, divergence.value, divergence.stable) == ("divergence", 0, "above")


def test_criteria_of_the_concepts():
    expected = {
        "marble": ["kappa > 0", "b > 0"],
        "bowling-ball": ["k - g*l*m > 0", "c > 0"],
        "oscillator": ["k > 0", "b > 0"],
    }
    assert {name: [str(c) for c in criteria(find_model(name))] for name in expected} == expected


def test_a_car_seen_from_the_road_has_two_rigid_positions_more_and_is_not_called_unstable():
    on_the_road = load("oversteering-car-on-the-road")
    p = on_the_road.values
    body_fixed = find_model("car")(**{name: p[name] for name in p})
    two, seen = forms(body_fixed), forms(on_the_road)
    assert (two.rigid_positions, seen.rigid_positions) == (0, 2)
    expected = sorted([*two.state_space.eigenvalues, 0, 0], key=lambda s: s.real)
    assert sorted(seen.second_order.eigenvalues, key=lambda s: s.real) == pytest.approx(expected, rel=1e-9)
    assert verdict(on_the_road).rigid_positions == 2
    assert verdict(on_the_road).state == verdict(body_fixed).state


def test_two_coupled_second_order_equations_and_routh():
    """Karnopp 2004, problem 3.7: two masses coupled by the stiffness matrix alone."""
    import sympy as sp

    m1, m2, b1, b2, k11, k12, k21, k22 = sp.symbols("m_11 m_22 b_11 b_22 k_11 k_12 k_21 k_22", real=True)
    form = SecondOrder([[m1, 0], [0, m2]], [[b1, 0], [0, b2]], [[k11, k12], [k21, k22]])
    expected = (
        k11 * k22 - k12 * k21,
        b1 * k22 + b2 * k11,
        m1 * k22 + m2 * k11 + b1 * b2,
        m1 * b2 + m2 * b1,
        m1 * m2,
    )
    assert [sp.expand(a - e) for a, e in zip(form.coefficients, expected, strict=True)] == [0] * 5
    a = sp.symbols("a0:5", real=True)
    last = sp.sympify(routh(a).conditions[-1], locals={s.name: s for s in a})
    assert sp.expand(last - (a[1] * a[2] * a[3] - a[0] * a[3] ** 2 - a[4] * a[1] ** 2)) == 0


def test_routh_gives_the_criterion_of_the_trailer_from_its_bare_polynomial():
    polynomial = "m I_c s^4 + C(I_c + m b^2)/U s^3 + (m C b + k(I_c + m a^2)) s^2 + k C (a + b)^2/U s + k C (a + b)"
    found = routh(polynomial, positive=["m", "I_c", "C", "U", "a", "b", "k"])
    (from_the_model,) = criteria(find_model("trailer-undamped-hitch"))
    assert found.conditions == (from_the_model.expression,)
