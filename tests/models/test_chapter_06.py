"""Cars: both coordinate systems, understeer and oversteer, free steering, and a car with a trailer."""

import numpy as np
import pytest
import sympy as sp
from agreement import SETS, agree, crossing, growth, varied

from ucrit import criteria, critical, find_model, load, modes, verdict
from ucrit.analyses.linear.steady import steady_turn
from ucrit.analyses.linear.transfer import transfer
from ucrit.analyses.stability.limits import limit
from ucrit.analyses.stability.static import static_stability
from ucrit.checks import check_model
from ucrit.core.derivation.derive import symbolic
from ucrit.core.derivation.linear import linear_system

SEEDS = range(SETS)
CARS = ("car", "car-inertial", "car-free-control", "car-trailer")


@pytest.mark.parametrize("name", CARS)
def test_every_check_passes(name):
    check_model(find_model(name)).raise_if_failed()


def test_both_coordinate_systems_give_one_quadratic():
    road, body = (symbolic(find_model(name)).polynomial for name in ("car-inertial", "car"))
    assert road.zeros == 2
    assert road.expressions[2:] == body.expressions


def test_inertial_coordinates_have_two_positions_that_are_recognised():
    car = load("oversteering-car-on-the-road")
    found = verdict(car)
    assert (found.rigid_positions, found.stable) == (2, True)
    assert {mode.name for mode in modes(car) if mode.eigenvalue == 0} == {"lateral position", "heading"}
    body = modes(load("oversteering-car")).eigenvalues
    assert modes(car).eigenvalues[2:] == pytest.approx(body, rel=1e-12)


def test_the_criterion_is_the_books():
    for name in ("car", "car-inertial"):
        (condition,) = criteria(find_model(name))
        assert str(condition) == "C_f*C_r*(a + b)**2 - U**2*m*(C_f*a - C_r*b) > 0"
        assert condition.failure == "divergence"
        assert str(condition.boundary("U")) == "U**2 = C_f*C_r*(a + b)**2/(m*(C_f*a - C_r*b))"


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("name", ["oversteering-car", "oversteering-car-on-the-road"])
def test_critical_speed_of_the_oversteering_car(name, seed):
    car = varied(load(name), seed)
    a, b, C_f, C_r = (car.values[n] for n in ("a", "b", "C_f", "C_r"))
    if a * C_f <= b * C_r:  # mirrored, it oversteers
        car = car.with_(a=b, b=a, C_f=C_r, C_r=C_f)
        a, b, C_f, C_r = b, a, C_r, C_f
    U = np.sqrt(C_f * C_r * (a + b) ** 2 / (car.m * (a * C_f - b * C_r)))
    found = agree(car, "U", U)
    assert (found.kind, found.stable) == ("divergence", "below")
    assert found.closed_form is not None


@pytest.mark.parametrize("seed", SEEDS)
def test_an_understeering_or_neutral_car_is_stable_at_every_speed(seed):
    car = varied(load("understeering-car"), seed)
    car = car.with_(C_r=max(car.C_r, 1.01 * car.a * car.C_f / car.b))
    assert len(critical(car)) == 0
    assert verdict(car).stable
    assert len(critical(load("neutral-car"))) == 0


def test_shipped_cars_are_what_they_are_called():
    for name in ("ford-escort", "bmw-320i", "vw-vanagon", "neutral-car"):
        assert steady_turn(load(name)).handling == "neutral"
    assert steady_turn(load("understeering-car")).handling == "understeer"
    assert steady_turn(load("oversteering-car")).handling == "oversteer"


def test_commonroad_cars_have_equal_cornering_coefficients_per_load():
    for name in ("ford-escort", "bmw-320i", "vw-vanagon"):
        car = load(name)
        per_load = 21.92 * 9.81 * car.m / (car.a + car.b)
        assert car.C_f == pytest.approx(per_load * car.b, rel=1e-12)
        assert car.C_r == pytest.approx(per_load * car.a, rel=1e-12)


def test_static_stability_of_the_car_does_not_decide():
    over, under = static_stability(load("oversteering-car")), static_stability(load("understeering-car"))
    assert over.formula == under.formula == "(C_r*b - C_f*a)/(I_z*U)"
    assert (over.stable, over.dynamic, over.decides) == (False, True, False)
    assert (under.stable, under.dynamic, under.decides) == (True, True, True)
    fast = static_stability(load("oversteering-car", {"U": 50}))
    assert (fast.stable, fast.dynamic, fast.decides) == (False, False, False)


def test_static_stability_is_one_term_of_what_decides():
    """a_0 is the static moment and a positive term that fades with speed."""
    polynomial = symbolic(find_model("car")).polynomial
    p = symbolic(find_model("car")).traced.parameters
    moment = p["m"] * (p["b"] * p["C_r"] - p["a"] * p["C_f"])
    rest = sp.expand(polynomial.expressions[0] - p["U"] ** 2 * moment)
    assert sp.factor(rest) == p["C_f"] * p["C_r"] * (p["a"] + p["b"]) ** 2


def test_released_wheel_weaves_where_the_held_one_does_not():
    released, held = load("released-steering-wheel"), load("understeering-car")
    assert len(critical(held)) == 0
    (found,) = critical(released)
    assert (found.kind, found.stable, found.mode) == ("flutter", "below", "weave")
    assert 0.5 < found.frequency_hz < 2
    slow = next(iter(modes(released)))
    assert slow.name == "weave"
    assert 0 < slow.damping_ratio < next(iter(modes(held))).damping_ratio


def test_free_and_fixed_control_are_one_vehicle():
    found = limit(find_model("car-free-control"), k_s=np.inf)
    p = symbolic(find_model("car-free-control")).traced.parameters
    fixed = symbolic(find_model("car")).polynomial.expressions
    names = {s.name: p[s.name] for e in fixed for s in e.free_symbols}
    swap = {s: names[s.name] for e in fixed for s in e.free_symbols}
    inertia = {names["I_z"]: p["I_z"] + p["I_s"]}
    for text, expected in zip(found.polynomial, fixed, strict=True):
        left = sp.sympify(text, locals={s.name: s for s in p.values()})
        assert sp.expand(left - expected.xreplace(swap).xreplace(inertia)) == 0
    released = load("released-steering-wheel").with_(k_s=1e9)
    slow = modes(released).eigenvalues[np.argsort(np.abs(modes(released).eigenvalues))[:2]]
    assert np.sort_complex(slow) == pytest.approx(
        np.sort_complex(modes(load("understeering-car")).eigenvalues), rel=1e-4
    )


@pytest.mark.parametrize("seed", SEEDS)
def test_critical_values_of_the_released_wheel_are_eigenvalue_crossings(seed):
    car = varied(load("released-steering-wheel"), seed)
    for found in critical(car):
        assert crossing(car, "U", found.value) == pytest.approx(found.value, rel=1e-9)
    for lo, hi in critical(car).stable_ranges():
        assert growth(car.with_(U=lo + 1 if np.isinf(hi) else (lo + hi) / 2)) < 0


@pytest.mark.parametrize("seed", SEEDS)
def test_divergence_of_a_car_with_compliant_steering(seed):
    car = varied(load("released-steering-wheel", {"k_s": 1e5, "c_s": 5e3, "C_f": 160e3, "C_r": 60e3}), seed)
    C = car.C_f * car.k_s / (car.k_s + car.e * car.C_f)
    excess = car.m * (car.a * C - car.b * car.C_r)
    found = [c.value for c in critical(car) if c.kind == "divergence"]
    if excess <= 0:
        assert not found
    else:
        U = np.sqrt(C * car.C_r * (car.a + car.b) ** 2 / excess)
        assert found == pytest.approx([U], rel=1e-9)
        assert crossing(car, "U", U) == pytest.approx(U, rel=1e-9)


def test_torque_steers_the_car_to_the_side_it_turns_to():
    assert transfer(load("released-steering-wheel"), "tau", "r").static_gain > 0
    gain = transfer(load("released-steering-wheel"), "tau", "a_y").static_gain
    car = load("released-steering-wheel")
    assert gain == pytest.approx((car.a + car.b) / (car.m * car.b * car.e), rel=1e-12)


def test_the_trailer_takes_speed_from_the_car():
    car, both = load("understeering-car"), load("car-and-caravan")
    assert len(critical(car)) == 0
    (found,) = critical(both)
    assert (found.kind, found.stable, found.mode) == ("flutter", "below", "sway")
    longer = both.with_(I_t=3500)
    damped = longer.with_(c=3000)
    assert critical(longer)[0].value < found.value
    assert critical(damped)[0].value > critical(longer)[0].value


@pytest.mark.parametrize("seed", SEEDS)
def test_critical_speeds_of_car_and_trailer_are_eigenvalue_crossings(seed):
    train = varied(load("car-and-caravan", {"I_t": 3000}), seed)
    found = critical(train)
    for value in found:
        assert crossing(train, "U", value.value) == pytest.approx(value.value, rel=1e-9)
    for lo, hi in found.stable_ranges():
        assert growth(train.with_(U=lo + 1 if np.isinf(hi) else (lo + hi) / 2)) < 0


@pytest.mark.parametrize("seed", SEEDS)
def test_divergence_of_car_and_trailer(seed):
    """Where a steady turn needs no steering, the hitch force of the turn counted in."""
    train = varied(load("car-and-caravan", {"C_f": 160e3, "C_r": 60e3, "c": 20e3}), seed)
    hitch = train.m_t * train.b_t / (train.a_t + train.b_t)
    front = (train.m * train.b - hitch * (train.h - train.b)) / (train.a + train.b)
    rear = (train.m * train.a + hitch * (train.a + train.h)) / (train.a + train.b)
    K = front / train.C_f - rear / train.C_r
    found = [c.value for c in critical(train) if c.kind == "divergence"]
    turn = steady_turn(train)
    assert turn.gradient == pytest.approx(K, rel=1e-9)
    if K < 0 and found:
        assert found == pytest.approx([turn.critical_speed], rel=1e-9)
    elif K >= 0:
        assert not found


def test_further_derivations_agree_in_symbols():
    for name, method in (
        ("car-inertial", "equations_newton"),
        ("car-free-control", "equations_two_bodies"),
        ("car-trailer", "equations_virtual_power"),
    ):
        first, second = linear_system(find_model(name)), linear_system(find_model(name), method=method)
        assert first.polynomial.expressions == second.polynomial.expressions
