"""Families of steady motions: equal to closed forms, stability by two criteria, and refusals in a sentence."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ucrit import UcritError, critical, handling_diagram, load, steady_family, steady_turn
from ucrit.core.numeric.motion import motion

INSIDE = {"alpha_f": (-0.3, 0.3), "alpha_r": (-0.3, 0.3)}


@pytest.mark.parametrize("name", ["understeering-car", "oversteering-car", "neutral-car"])
def test_gentle_turns_are_those_of_the_linear_closed_form(name):
    car = load(name)
    turns = steady_family(car, "a_y", 0.02, free="delta_f")
    gain = float(steady_turn(car).acceleration_gain(car.U))
    np.testing.assert_allclose(turns["a_y"], gain * turns["delta_f"], rtol=1e-6, atol=1e-12)
    assert turns.slope("a_y", "delta_f")[0] == pytest.approx(gain, rel=1e-10)
    assert turns["a_y"][-1] == pytest.approx(0.02, rel=1e-9)
    assert turns.end == "a_y is where it was to go"
    assert turns.stable.all()


def test_every_point_is_steady_and_its_rates_are_those_of_the_curve():
    car = load("spinning-car")
    turns = steady_family(car, "a_y", 12, free="delta_f", within=INSIDE)
    made, u = motion(type(car)), np.array([turns["delta_f"], turns["delta_r"]])
    rhs = made.rhs(np.array([turns["V"], turns["r"]]), u, car.arguments())
    assert np.abs(rhs).max() < 1e-8
    length = np.arange(len(turns["r"]))
    for name in ("beta", "alpha_r", "curvature"):
        by_hand = np.gradient(turns[name], length) / np.gradient(turns["delta_f"], length)
        smooth = np.abs(turns.slope(name, "delta_f")) < 20
        np.testing.assert_allclose(
            by_hand[smooth][2:-2], turns.slope(name, "delta_f")[smooth][2:-2], rtol=0.2, atol=0.3
        )


def test_a_car_at_the_limit_stays_there_and_diverges():
    car = load("spinning-car")
    turns = steady_family(car, "a_y", 12, free="delta_f", within=INSIDE)
    top = car.rear_mu * car.g
    assert turns.folds == ()  # a brush tire's force stays where it is; nothing turns back
    assert turns["a_y"].max() == pytest.approx(top)
    (change,) = turns.changes
    assert (change.kind, change.frequency_hz) == ("divergence", 0)
    steered = steady_family(car, "delta_f", 0.3)
    assert steered.folds == pytest.approx([change.values["delta_f"]])  # a fold in the steer angle is a divergence
    assert steered.changes[0].value == pytest.approx(change.values["delta_f"])
    assert steered.end == "delta_f is back where it began"


def test_constant_radius_with_rising_speed():
    car, radius = load("ploughing-car").with_(U=3.0), 60.0
    turns = steady_family(car, "U", "200 km/h", free="delta_f", hold={"curvature": 1 / radius}, within=INSIDE)
    np.testing.assert_allclose(turns["curvature"], 1 / radius, rtol=1e-9)
    np.testing.assert_allclose(turns["a_y"], turns["U"] ** 2 / radius, rtol=1e-9)
    fastest = steady_family(car.with_(U=40), "a_y", 12, free="delta_f", within=INSIDE)["a_y"].max()
    assert 0.99 * fastest < turns["a_y"].max() < fastest  # in a narrow turn the front forces point inwards and back
    assert turns.end.startswith("alpha_f")
    slow = steady_family(car, "U", 4, free="delta_f", hold={"curvature": 1 / radius})
    assert slow["delta_f"][0] == pytest.approx((car.a + car.b) / radius, rel=0.02)


@pytest.mark.parametrize(("name", "kind"), [("oversteering-car", "divergence"), ("caravan", "flutter")])
def test_changes_along_the_speed_are_the_critical_speeds(name, kind):
    vehicle = load(name).with_(U=5)
    exact = critical(vehicle)[0]
    family = steady_family(vehicle, "U", 60)
    assert family.changes[0].kind == kind
    assert family.changes[0].value == pytest.approx(exact.value, rel=1e-9)
    assert family.changes[0].frequency_hz == pytest.approx(exact.frequency_hz or 0, rel=1e-6)
    assert family.stable[0]
    assert not family.stable[-1]
    assert (name == "oversteering-car") == bool(family.branches)


@settings(max_examples=6, deadline=None)
@given(st.lists(st.floats(-0.5, 0.5), min_size=8, max_size=8))
def test_three_criteria_of_stability_agree_in_every_turn(powers):
    """Local slopes, the steer angle's slope against curvature, and eigenvalues (Karnopp 2004, section 6.V)."""
    car = load("spinning-car")
    names = ("m", "I_z", "a", "b", "front_C", "front_mu", "rear_C", "rear_mu")
    car = car.with_(**{n: car.values[n] * 2**p for n, p in zip(names, powers, strict=True)})
    turns = steady_family(car, "a_y", 20, free="delta_f", within={"alpha_f": (-0.2, 0.2), "alpha_r": (-0.2, 0.2)})
    side = {}
    for axle, arm in (("front", car.b), ("rear", car.a)):
        law, load_ = getattr(car, axle), car.m * car.g * arm / (2 * (car.a + car.b))
        slip, h = turns["alpha_f" if axle == "front" else "alpha_r"], 1e-6
        side[axle] = -2 * (law.side_force(load_, slip + h) - law.side_force(load_, slip - h)) / (2 * h)
    C_f, C_r = side["front"], side["rear"]
    local = (car.a + car.b) ** 2 * C_f * C_r / car.U**2 + car.m * (car.b * C_r - car.a * C_f)
    scale = (car.a + car.b) ** 2 * C_f * C_r / car.U**2 + car.m * (car.b * C_r + car.a * C_f)
    slope = turns.rates["delta_f"] * turns.rates["curvature"]
    clear = (np.abs(local) > 0.02 * scale) & (C_f > 0.02 * C_f[0]) & (C_r > 0.02 * C_r[0])
    assert clear.sum() > 5
    assert np.array_equal(local[clear] > 0, turns.stable[clear])
    assert np.array_equal(slope[clear] > 0, turns.stable[clear])


def test_positions_that_matter_to_nothing_are_left_out():
    family = steady_family(load("oversteering-car-on-the-road"), "U", 30)
    assert family.eigenvalues.shape[1] == 3  # y is left out; psi, y' and psi' are not
    assert "y" in family.values


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"along": "a_z"}, "there is no quantity 'a_z'; did you mean"),
        ({"free": "delta"}, "there is no input or parameter 'delta'; did you mean 'delta_r'"),
        ({"free": ()}, "1 input or parameter must be free to move a_y, got none"),
        ({"free": ("delta_f", "delta_r")}, "1 input or parameter must be free"),
        ({"hold": {"curvature": 0.01}}, "2 inputs or parameters must be free to move a_y and hold curvature"),
        ({"free": ("delta_f", "delta_f"), "hold": {"beta": 0}}, "delta_f is named twice"),
        ({"hold": {"a_y": 1}}, "a_y cannot be moved and held"),
        ({"to": "3 m"}, "a_y"),
        ({"to": 0}, "is to move, but starts at 0 and ends there"),
        ({"free": "front_mu"}, "a_y stays as it is whatever front_mu does"),
        ({"step": 0}, "step must be above 0"),
        ({"along": "U", "to": -5, "free": "delta_f", "hold": {"curvature": 0.01}}, "U.*must be above 0 m/s, got -5"),
        ({"along": "U", "to": 40, "free": "delta_f", "hold": {"curvature": 1 / 50}}, "go no farther than curvature"),
    ],
)
def test_mistakes_are_refused_in_a_sentence(change, message):
    asked = {"along": "a_y", "to": 5, "free": "delta_f", **change}
    with pytest.raises(UcritError, match=message):
        steady_family(load("ploughing-car"), **asked)


def test_arrays_are_refused_and_names_indexed():
    with pytest.raises(UcritError, match="one vehicle"):
        steady_family(load("ploughing-car").with_(U=[10, 20]), "a_y", 3, free="delta_f")
    turns = steady_family(load("ploughing-car"), "a_y", 3, free="delta_f")
    with pytest.raises(UcritError, match="has no 'a_x'; did you mean"):
        turns["a_x"]
    frame = turns.to_dataframe()
    assert {"a_y", "delta_f", "stable", "eigenvalue_real[1]"} <= set(frame)
    assert frame.attrs["units"]["delta_f"] == "rad"


PACEJKA = {"front": "pac2002-235-60r16", "rear": "pac2002-235-60r16", "rear_LMUY": 0.6}


@pytest.mark.parametrize(
    ("along", "to", "tires"), [("a_y", 9, {}), ("curvature", 0.1, {}), ("curvature", 0.1, PACEJKA)]
)
def test_a_family_ends_where_tires_have_given_all_they_can(along, to, tires):
    """On the plateau the car slides ever faster sideways; what rounding does there is no change of stability."""
    turns = steady_family(load("spinning-car", tires), along, to, free="delta_f")
    assert len(turns.unstable) < 600
    assert turns.end.startswith(f"{along} stays at ")
    assert " while V" in turns.end
    assert {change.kind for change in turns.changes} == {"divergence"}
    assert len(turns.changes) == len(set(turns.unstable)) - 1  # each motion that diverges is told once
    bounded = steady_family(load("spinning-car", tires), along, to, free="delta_f", within=INSIDE)
    assert bounded.changes[0].value == pytest.approx(turns.changes[0].value, rel=1e-9)


def test_a_family_ends_where_the_model_is_no_longer_good():
    turns = steady_family(load("four-wheel-car"), "delta_f", 0.5, free="drive", hold={"v_x": 27.8}, step=0.2)
    assert turns.end == "F_fr is at its least, 0 N"
    assert turns["F_fr"][-1] == pytest.approx(0, abs=1e-6)


@pytest.mark.parametrize(
    ("to", "within", "told"),
    [
        (math.inf, {}, "a_y must be a finite value to move to, at most 1e"),
        (1e308, {}, "a_y must be a finite value to move to, at most 1e"),
        (9, {"a_y": 1}, r"within needs the lowest and the highest value of a_y, such as \(-1, 1\), got 1"),
        (9, {"a_y": "xy"}, "within needs the lowest and the highest value"),
        (9, {"a_y": (1, 2, 3)}, "within needs the lowest and the highest value"),
        (9, {"a_y": (5, -5)}, "within has no room for a_y between 5 and -5"),
    ],
)
def test_where_a_family_cannot_go_is_told(to, within, told):
    with pytest.raises(UcritError, match=told):
        steady_family(load("spinning-car"), "a_y", to, free="delta_f", within=within)


def test_ends_are_told_with_units_and_slips_end_at_a_right_angle():
    found = str(handling_diagram(load("spinning-car")))
    assert "at 27.78 m/s (100 km/h)" in found
    assert "ends: alpha_r is at its least, -0.3 rad (-17.2 deg)" in found
    with pytest.raises(UcritError, match="slip must be above 0 rad and below a right angle"):
        handling_diagram(load("spinning-car"), slip=2)


@pytest.mark.parametrize("name", ["understeering-car", "oversteering-car", "neutral-car"])
def test_the_linear_car_on_a_constant_radius_keeps_the_understeer_formula(name):
    """delta = L/R + K a_y with K = m (b/C_f - a/C_r)/L while angles are small; with the model's own tangents always."""
    car = load(name)
    found = handling_diagram(car, radius="200 m")
    length = car.a + car.b
    front, rear = (car.m * x / C / length * found.a_y for x, C in ((car.b, car.C_f), (car.a, car.C_r)))
    np.testing.assert_allclose(found.curvature, 1 / 200, rtol=1e-9)
    np.testing.assert_allclose(
        np.tan(found.delta - front / np.cos(found.delta)) + np.tan(rear), length / 200, rtol=1e-7
    )
    K, slow = car.m * (car.b / car.C_f - car.a / car.C_r) / length, found.a_y < 2
    np.testing.assert_allclose(found.delta[slow], length / 200 + K * found.a_y[slow], rtol=5e-3)
    assert slow.sum() > 20


def test_a_car_that_brakes_its_wheels_is_followed_past_where_it_begins_to():
    """The braking begins beyond a dead band, a kink of the equations, so that the family has a corner."""
    found = handling_diagram(load("car-with-stability-control"), radius="50 m", step=0.1)
    begun = int(np.argmax(found.family["added_rr"] > 1))
    assert found.a_y[begun] == pytest.approx(4.99, abs=0.05)
    assert found.family["error"][begun] < -load("car-with-stability-control").values["e_0"]
    assert found.largest > 7
    assert "cannot be followed" not in found.family.end
