"""Handling diagrams: gradients, limits and regions against closed forms and the linear analysis."""

from dataclasses import replace

import numpy as np
import pytest

from ucrit import UcritError, handling_diagram, load, plots, rollover, steady_turn
from ucrit.analyses.nonlinear.handling_words import sentences
from ucrit.analyses.nonlinear.steady_problem import CANNOT


@pytest.fixture(scope="module")
def spinning():
    return handling_diagram(load("spinning-car"))


@pytest.fixture(scope="module")
def ploughing():
    return handling_diagram(load("ploughing-car"))


def test_the_gradient_begins_as_the_linear_one(spinning, ploughing):
    linear = steady_turn(load("understeering-car"))
    for found in (spinning, ploughing):
        assert found.gradient[0] == pytest.approx(linear.gradient, rel=1e-9)
        assert found.gradient_deg_per_g[0] == pytest.approx(linear.gradient_deg_per_g, rel=1e-9)


def test_the_axles_grip_is_the_limit(spinning, ploughing):
    assert (spinning.limit, ploughing.limit) == ("spin", "plough-out")
    assert spinning.largest == pytest.approx(0.8 * 9.80665, rel=1e-9)
    assert ploughing.largest == pytest.approx(0.85 * 9.80665, rel=0.02)  # less, as the front wheels are steered


def test_slip_angles_are_the_tires_at_the_axles_share_of_the_load(spinning):
    """Brush tires solved for the slip: share (1 - (1 - s)^3) of the friction is a_y/(mu g)."""
    car = spinning.vehicle
    below = spinning.a_y < 0.99 * spinning.largest
    used = spinning.a_y[below] / (car.rear_mu * car.g)
    load_ = car.m * car.g * car.a / (2 * (car.a + car.b))
    slip = np.arctan((1 - np.cbrt(1 - used)) * 3 * car.rear_mu * load_ / car.rear_C)
    np.testing.assert_allclose(spinning.rear[below], slip, rtol=1e-6, atol=1e-12)


def test_regions_follow_each_other_to_the_spin(spinning, ploughing):
    assert [part.kind for part in spinning.ranges] == ["understeer", "oversteer", "unstable"]
    assert [part.kind for part in ploughing.ranges] == ["understeer"]
    under, over, unstable = spinning.ranges
    assert under.a_y[1] == over.a_y[0] < over.a_y[1] == unstable.a_y[0] == spinning.unstable_from
    peak = spinning.a_y[np.argmax(spinning.difference)]
    assert under.a_y[1] == pytest.approx(peak, rel=0.01)
    crest = spinning.curvature[np.argmax(spinning.delta)]
    assert unstable.curvature[0] == pytest.approx(crest, rel=0.02)
    assert np.isnan(ploughing.unstable_from)


def test_slower_cars_spin_later():
    """At low speed the damping of both axles keeps an oversteering car stable (Karnopp 2004, section 6.V)."""
    from_ = [handling_diagram(load("spinning-car").with_(U=U)).unstable_from for U in (15, 25, 50)]
    assert np.all(np.diff(from_) < 0)


def test_a_car_of_equal_axles_is_neutral_and_slides_on_both():
    car = load("ploughing-car").with_(b=1.25, front_C=4e4, rear_C=4e4, front_mu=0.9, rear_mu=0.9)
    found = handling_diagram(car)
    assert found.gradient[0] == pytest.approx(0, abs=1e-9)
    assert found.ranges[0].kind == "neutral"
    assert found.largest == pytest.approx(0.9 * car.g, rel=0.01)


def test_a_limit_that_is_not_reached_is_not_denied():
    clipped = {"front": "clipped", "rear": "clipped", "front_c_M": 0, "rear_c_M": 0}
    car = load("spinning-car", {**clipped, "front_c_F": 12, "rear_c_F": 12})
    found = handling_diagram(car)
    assert found.limit == "plough-out"  # its force is clipped at 5 degrees, where the family has a corner
    np.testing.assert_allclose(found.front[np.argmax(found.a_y)], np.radians(5), rtol=1e-5)
    lost = replace(found, limit="", family=replace(found.family, end=f"{CANNOT}: a reason that is long enough to wrap"))
    text = str(lost)
    assert "the limit is not known: the turns could not be followed to it" in text
    assert max(map(len, text.splitlines())) <= 80


@pytest.mark.parametrize("tire", ["brush-degressive", "dugoff", "pac2002-235-60r16", "pacejka-205-60r15"])
@pytest.mark.parametrize(("axle", "limit"), [("front", "plough-out"), ("rear", "spin")])
def test_the_axle_with_less_grip_gives_way_first_whatever_the_tires(tire, axle, limit):
    more = {"brush-degressive": {"C_max": 8e4, "F_max": 8e3, "mu": 0.9}, "dugoff": {"C": 4e4, "mu": 0.9}}.get(tire, {})
    friction = "LMUY" if tire.startswith("pac") else "mu"
    values = {f"{place}_{name}": value for place in ("front", "rear") for name, value in more.items()}
    car = load("spinning-car", {"front": tire, "rear": tire, **values, f"{axle}_{friction}": 0.6})
    found = handling_diagram(car)
    assert found.limit == limit
    assert found.largest == pytest.approx(found.a_y.max())
    crest = np.flatnonzero(np.diff(np.sign(np.diff(found.delta))) < 0)
    assert bool(crest.size) == (limit == "spin") == bool(np.isfinite(found.unstable_from))


def test_linear_tires_have_no_limit():
    found = handling_diagram(load("understeering-car"))
    assert found.limit == ""
    assert "no axle saturates within the slip angles looked at" in str(found)


def test_words_fit_eighty_columns_and_say_the_limit(spinning, ploughing):
    for found, word in ((spinning, "spins"), (ploughing, "ploughs out")):
        lines = sentences(found)
        assert max(map(len, lines)) <= 80
        assert word in lines[1]


def test_what_is_no_car_is_refused():
    for name, missing in (("caravan", "an output a_y"), ("car-and-caravan", "an output alpha_f")):
        with pytest.raises(UcritError, match=missing):
            handling_diagram(load(name))
    with pytest.raises(UcritError, match="a steer angle steering"):
        handling_diagram(load("spinning-car"), steer="steering")
    with pytest.raises(UcritError, match="rolling over needs"):
        rollover(load("spinning-car"))


def test_the_drawing_has_the_curves(spinning):
    axles, curve, steer = plots.plot_handling(spinning).get_axes()
    drawn = {line.get_gid(): line.get_xydata() for axes in (axles, curve, steer) for line in axes.lines}
    np.testing.assert_allclose(drawn["front-axle"][:, 0], np.rad2deg(spinning.front))
    np.testing.assert_allclose(drawn["front-axle"][:, 1], spinning.a_y / 9.80665)
    stable = spinning.stable
    np.testing.assert_allclose(drawn["steer-stable"][stable, 1], np.rad2deg(spinning.delta[stable]))
    assert np.isnan(drawn["steer-stable"][~stable, 1]).all()
    at = drawn["oversteer-unstable"][0]
    assert at[0] == pytest.approx(spinning.ranges[2].curvature[0])
    assert axles.get_xlabel() == "slip angle [deg]"
    (shade,) = [p for p in steer.patches if p.get_gid() == "unstable"]
    assert shade.get_x() == pytest.approx(spinning.ranges[2].curvature[0])
    wheelbase = spinning.vehicle.a + spinning.vehicle.b
    assert drawn["neutral"][-1, 1] == pytest.approx(np.rad2deg(wheelbase * spinning.curvature[-1]), rel=5e-3)


def test_families_are_drawn_with_their_changes(spinning):
    figure = plots.plot(spinning.family)
    (axes,) = figure.get_axes()
    points = {line.get_gid(): line.get_xydata() for line in axes.lines}
    change = spinning.family.changes[0]
    np.testing.assert_allclose(points["change"][0], [change.value, change.values["delta_f"]])
    assert axes.get_xlabel() == "lateral acceleration of the centre of mass $a_{y}$ [m/s²]"
    assert plots.plot(spinning).get_axes()


def test_at_a_constant_steer_angle_the_curvature_is_that_of_the_linear_car():
    """delta/(L + K U^2) (Karnopp 2004, section 6.IV); gentle enough that nothing bends."""
    car = load("understeering-car")
    found = handling_diagram(car, angle=1e-3, upto="40 m/s")
    K = float(steady_turn(car).gradient)
    np.testing.assert_allclose(found.curvature, 1e-3 / (car.a + car.b + K * found.speed**2), rtol=1e-4)
    assert (found.speed[0], found.speed[-1]) == pytest.approx((1, 40))
    np.testing.assert_allclose(found.delta, 1e-3, rtol=1e-9)


def test_the_three_tests_tell_one_gradient_and_one_limit(spinning):
    """On tires alone, which know neither the radius nor the speed."""
    circle = handling_diagram(spinning.vehicle, radius="300 m")
    held = handling_diagram(spinning.vehicle, angle="2 deg")
    np.testing.assert_allclose(circle.curvature, 1 / 300, rtol=1e-9)
    for found in (circle, held):
        assert found.limit == "spin"
        assert found.largest == pytest.approx(spinning.largest, rel=1e-3)
        assert found.gradient[0] == pytest.approx(spinning.gradient[0], rel=5e-3)  # the wheels are steered already
        assert [part.kind for part in found.ranges] == ["understeer", "oversteer", "unstable"]
        below = spinning.a_y < 0.75 * found.largest
        other = np.interp(
            spinning.a_y[below], found.a_y[: np.argmax(found.a_y)], found.difference[: np.argmax(found.a_y)]
        )
        np.testing.assert_allclose(other, spinning.difference[below], atol=2e-4)
        axes = plots.plot_handling(found).get_axes()[2]
        assert axes.get_xlabel() == "lateral acceleration [g]"
        assert max(map(len, sentences(found))) <= 80
    assert circle.turns.constant == "radius"
    assert "on a radius of 300 m, the speed rising" in str(circle)
    assert "at a steer angle of 2 deg, the speed rising" in str(held)


def test_the_drive_keeps_the_speed_that_rises():
    found = handling_diagram(load("four-wheel-car"), radius=60, upto=15, step=0.2)
    np.testing.assert_allclose(found.curvature, 1 / 60, rtol=1e-9)
    np.testing.assert_allclose(found.speed, found.family["v_x"])
    assert found.speed[-1] == pytest.approx(15)


@pytest.mark.parametrize(
    ("name", "asked", "message"),
    [
        ("spinning-car", {"radius": 60, "angle": 0.1}, "either the radius or the steer angle"),
        ("spinning-car", {"radius": "-3 m"}, "radius must be above 0 m, got -3 m"),
        ("spinning-car", {"angle": "2 m"}, "steer angle is measured in rad"),
        ("spinning-car", {"upto": 30}, "upto ends a test with rising speed"),
        ("spinning-car", {"radius": 60, "upto": 0.5}, "the speed must rise beyond 1 m/s"),
    ],
)
def test_tests_that_make_no_sense_are_refused(name, asked, message):
    with pytest.raises(UcritError, match=message):
        handling_diagram(load(name), **asked)


def test_a_gradient_that_is_rounding_is_told_as_none():
    assert "    understeer gradient at first 0 rad/(m/s^2) = 0 deg/g" in sentences(handling_diagram(load("bmw-320i")))
    assert "0.003333 rad/(m/s^2) = 1.873 deg/g" in "\n".join(sentences(handling_diagram(load("spinning-car"))))
