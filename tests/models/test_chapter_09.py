"""Airplanes: wings, static stability and trim, phugoid, the plane model, and how they hang together."""

import math
from itertools import pairwise

import numpy as np
import pytest
import sympy as sp
from agreement import SETS, growth, varied

from ucrit import approximation, compare, critical, find_model, load, modes, moment_line, static_margin, trim
from ucrit.checks import check_model
from ucrit.core.derivation.derive import symbolic
from ucrit.core.numeric.compiled import state_space
from ucrit.parts import wings

MODELS = (
    "phugoid",
    "phugoid-without-drag",
    "airplane",
    "airplane-plane",
    "glider",
    "airplane-longitudinal",
    "airplane-longitudinal-coefficients",
    "airplane-lateral",
    "airplane-lateral-coefficients",
)
SEEDS = range(SETS)


@pytest.mark.parametrize("name", MODELS)
def test_every_check_passes(name):
    check_model(find_model(name)).raise_if_failed()


# 9a: sections


@pytest.mark.parametrize("camber", [-0.1, 0.0, 0.05, 0.2])
def test_a_thin_section_has_its_aerodynamic_centre_at_a_quarter_of_the_chord(camber):
    states = [wings.thin_section(alpha, camber) for alpha in (0.01, 0.07, 0.15)]
    for first, second in pairwise(states):
        assert wings.aerodynamic_center(*zip(first, second, strict=True)) == pytest.approx(0.25)
    about = [wings.moved_moment(c_m, c_l, 0, 0.25) for c_l, c_m in states]
    assert about == pytest.approx([-math.pi * camber / 4] * 3)


@pytest.mark.parametrize("camber", [-0.1, 0.05, 0.2])
@pytest.mark.parametrize("alpha", [0.03, 0.1])
def test_about_the_centre_of_pressure_the_moment_vanishes(alpha, camber):
    c_l, c_m = wings.thin_section(alpha, camber)
    place = wings.center_of_pressure(c_l, c_m)
    assert wings.moved_moment(c_m, c_l, 0, place) == pytest.approx(0, abs=1e-15)
    assert place == pytest.approx(0.25 + math.pi * camber / (4 * c_l))


def test_a_symmetric_section_has_its_centre_of_pressure_at_its_aerodynamic_centre():
    assert [wings.center_of_pressure(*wings.thin_section(alpha)) for alpha in (0.02, 0.1)] == pytest.approx(
        [0.25, 0.25]
    )


# 9b: static stability and trim


def book_slope(plane):
    """Return dC_M/dalpha by Karnopp 2004, eqs. (9.17) and (9.18) with tail efficiency, and dC_L/dalpha."""
    p = plane.values
    V = wings.tail_volume(plane.l_t, p["S_t"], p["c"], p["S"])
    tail = p["eta"] * p["a_t"] * (1 - p["epsilon"])
    return (p["h"] - p["h_0"]) * p["a"] - V * tail, p["a"] + p["S_t"] / p["S"] * tail


@pytest.mark.parametrize("seed", SEEDS)
def test_static_margin_is_the_books(seed):
    plane = varied(load("navion-from-geometry"), seed).with_(epsilon=0.45)
    moment, lift = book_slope(plane)
    found = static_margin(plane)
    assert found.margin == pytest.approx(-moment / lift, rel=1e-12)
    assert found.stable == (moment < 0)


@pytest.mark.parametrize("seed", SEEDS)
def test_at_the_neutral_point_moment_and_trim_do_not_change_with_lift(seed):
    plane = varied(load("navion-from-geometry"), seed).with_(epsilon=0.45)
    neutral = plane.with_(h=static_margin(plane).neutral_point)
    assert static_margin(neutral).margin == pytest.approx(0, abs=1e-12)
    angles = trim(neutral.with_(U=plane.U * np.array([0.9, 1.0, 1.2])))
    slopes = np.diff(angles["delta_e"]) / np.diff(angles["C_L"])
    assert slopes == pytest.approx([0, 0], abs=1e-12)


@pytest.mark.parametrize("seed", SEEDS)
def test_trim_balances_weight_drag_and_moments(seed):
    plane = varied(load("navion-from-geometry"), seed)
    flight, p = trim(plane), plane.values
    pressure = p["rho"] * p["U"] ** 2 / 2 * p["S"]
    assert flight["C_L"] * pressure == pytest.approx(p["m"] * p["g"])
    assert flight["C_M"] == pytest.approx(0, abs=1e-13)
    wing = p["a"] * flight["alpha"]
    assert flight["T"] == pytest.approx(pressure * (p["C_D0"] + p["k"] * wing**2))


def test_trim_over_the_range_of_centre_of_mass_and_speed():
    plane = load("navion-from-geometry")
    places = np.linspace(0.1, 0.5, 9)
    angles = trim(plane.with_(h=places, U=np.array([40.0, 60.0])))["delta_e"]
    assert angles.shape == (9, 2)
    assert np.all(np.diff(angles, axis=0) > 0)  # farther back: less up elevator
    assert np.all(angles[:, 0] < angles[:, 1])  # slower, statically stable: more up elevator
    margins = static_margin(plane.with_(h=places))
    assert np.diff(margins.margin) == pytest.approx(-np.diff(places))
    assert margins.neutral_point == pytest.approx(np.full(9, static_margin(plane).neutral_point))


def test_moment_lines_of_figure_9_4():
    plane = load("navion-from-geometry")
    level = trim(plane)
    settings = level["delta_e"] + np.array([-0.05, 0.0, 0.05])
    lines = moment_line(plane, "delta_e", settings)
    assert lines.slope == pytest.approx([-static_margin(plane).margin] * 3)
    assert lines.trimmed[1] == pytest.approx(level["C_L"])
    assert np.all(np.diff(lines.trimmed) < 0)  # elevator down: trimmed at less lift
    behind = plane.with_(h=static_margin(plane).neutral_point + 0.1)
    assert moment_line(behind).slope == pytest.approx([0.1])


def test_a_lifting_tail_that_cannot_be_trimmed_at_positive_lift():
    plane = load("navion-from-geometry")
    tail_lifts = moment_line(plane, "delta_e", [0.1], angles=(-0.3, 0.2))
    assert tail_lifts.slope[0] < 0
    assert tail_lifts.trimmed[0] < 0


@pytest.mark.parametrize("seed", SEEDS)
def test_elevator_down_turns_the_nose_down(seed):
    plane = varied(load("navion-from-geometry"), seed)
    elevator_to_pitch_rate = state_space(plane).B[2, 0]
    assert elevator_to_pitch_rate < 0


@pytest.mark.parametrize("seed", SEEDS)
def test_glider_of_problem_9_4(seed):
    glider = varied(load("model-glider"), seed)
    p = glider.values
    m = p["m_w"] + p["m_t"]
    a, b = p["m_t"] * p["l"] / m, p["m_w"] * p["l"] / m
    assert (glider.x_a, glider.l_t) == pytest.approx((a, b))
    assert a * p["m_w"] == pytest.approx(b * p["m_t"])
    pressure = p["rho"] * p["U"] ** 2 / 2
    slope = pressure * (a * p["S"] * p["a"] - b * p["S_t"] * p["a_t"])
    moment_per_angle = state_space(glider).C[1, 0] * p["U"]
    assert moment_per_angle == pytest.approx(slope)
    assert static_margin(glider).stable == (p["m_w"] / (p["S"] * p["a"]) > p["m_t"] / (p["S_t"] * p["a_t"]))


# 9c: estimates from the shape of a wing


@pytest.mark.parametrize("A", [2.0, 6.0, 20.0])
def test_elliptical_wing(A):
    a = wings.lift_slope(A)
    assert a == pytest.approx(2 * math.pi * A / (A + 2))
    assert wings.downwash_slope(a, A) == pytest.approx(4 / (A + 2))
    alpha = 0.1
    lift, downwash = a * alpha, wings.downwash_slope(a, A) * alpha
    assert wings.induced_drag(lift, A) == pytest.approx(lift * downwash / 2)
    assert lift == pytest.approx(2 * math.pi * (alpha - downwash / 2))  # a section's lift in the air that sinks there


def test_a_long_wing_is_a_section():
    assert wings.lift_slope(1e9) == pytest.approx(2 * math.pi, rel=1e-8)


def test_the_navion_estimated_from_its_geometry():
    plane, measured = load("navion-from-geometry"), load("navion")
    A = 33.4**2 / 184
    assert plane.a == pytest.approx(wings.lift_slope(A), rel=1e-5)
    assert plane.epsilon == pytest.approx(wings.downwash_slope(plane.a, A), rel=1e-3)
    assert plane.k == pytest.approx(wings.induced_drag(1, A, 0.8), rel=1e-3)
    (found,) = (e for e in approximation(measured, plane).errors if e.name == "phugoid oscillation")
    assert abs(found.frequency) < 0.02


# 9d: phugoid


@pytest.mark.parametrize("seed", SEEDS)
def test_phugoid_frequency_and_damping(seed):
    plane = varied(load("navion-phugoid"), seed)
    (mode,) = modes(plane)
    assert abs(mode.eigenvalue) == pytest.approx(math.sqrt(2) * plane.g / plane.U)
    assert mode.damping_ratio == pytest.approx(plane.epsilon / math.sqrt(2))


@pytest.mark.parametrize("seed", SEEDS)
def test_phugoid_without_drag_neither_grows_nor_decays(seed):
    plane = varied(load("paper-airplane"), seed)
    (mode,) = modes(plane)
    assert mode.eigenvalue.imag == pytest.approx(math.sqrt(2) * plane.g / plane.U)
    assert abs(mode.eigenvalue.real) < 1e-12 * mode.eigenvalue.imag
    without = find_model("phugoid")(epsilon=0, **plane.values)
    assert modes(without).eigenvalues == pytest.approx(modes(plane).eigenvalues)


def test_lanchesters_approximation_beside_the_full_model():
    large = approximation(load("boeing-747"), load("boeing-747-phugoid"))
    light = approximation(load("navion"), load("navion-phugoid"))
    assert "-12.6 %" in str(large)
    assert "+19.9 %" in str(light)
    for found in (large, light):
        (error,) = found.errors
        full, simple = abs(error.full.eigenvalue), abs(error.simple.eigenvalue)
        assert error.frequency == pytest.approx((simple - full) / full)
        assert found.missing == ("short period oscillation",)


# 9e: plane model, and the car


def test_last_term_scales_with_the_square_of_speed():
    polynomial = symbolic(find_model("airplane-plane")).polynomial
    index = [s.name for s in polynomial.ring.symbols].index("U")
    powers = [{monom[index] for monom in a.itermonoms()} for a in polynomial.coefficients]
    assert powers == [{2}, {1}, {0}]


def test_with_lift_independent_of_speed_the_quadratic_is_the_cars():
    plane, car = (symbolic(find_model(name)).polynomial.expressions for name in ("airplane-plane", "car"))
    U, C_f, C_r, I_z, a, b, C, C_t, x_a, l_t, I_yy = sp.symbols("U C_f C_r I_z a b C C_t x_a l_t I_yy")
    wheels = {C: C_f / U**2, C_t: C_r / U**2, x_a: a, l_t: b, I_yy: I_z}
    plain = [[e.xreplace({s: sp.Symbol(s.name) for s in e.free_symbols}) for e in p] for p in (plane, car)]
    as_car = [sp.cancel(e.subs(wheels)) for e in plain[0]]
    for one, other in zip(as_car, plain[1], strict=True):
        assert sp.cancel(one * plain[1][-1] - other * as_car[-1]) == 0


@pytest.mark.parametrize("seed", SEEDS)
def test_stability_does_not_change_with_speed_as_the_cars_does(seed):
    plane, car = varied(load("navion-plane"), seed), varied(load("oversteering-car"), seed)
    behind = plane.with_(x_a=3 * plane.C_t * plane.l_t / plane.C + plane.C_t * plane.l_t**2 / plane.m)
    assert [len(critical(p)) for p in (plane, behind)] == [0, 0]
    assert growth(plane) < 0 < growth(behind)
    assert growth(behind.with_(U=0.1 * plane.U)) > 0
    if car.b * car.C_r < car.a * car.C_f:
        assert len(critical(car)) == 1


@pytest.mark.parametrize("seed", SEEDS)
def test_slightly_unstable_statically_but_stable_dynamically(seed):
    plane = varied(load("navion-plane"), seed)
    p = plane.values
    neutral = p["C_t"] * p["l_t"] / p["C"]
    reserve = p["C_t"] * (neutral + p["l_t"]) ** 2 / p["m"]
    slightly = plane.with_(x_a=neutral + 0.5 * reserve)
    assert not static_margin(slightly).stable
    assert growth(slightly) < 0


def test_plane_and_car_side_by_side():
    rows = dict(compare(load("navion-plane"), load("oversteering-car")).rows())
    assert rows["stable speeds [m/s]"] == ("all", "below 34.785")


# the models of one airplane


def test_geometry_and_the_coefficients_that_follow_from_it_move_alike():
    plane = load("navion-from-geometry")
    p, flight = plane.values, trim(plane)
    k_t = p["eta"] * p["a_t"] * p["S_t"] / p["S"]
    moment, lift = book_slope(plane)
    wing = p["a"] * flight["alpha"]
    coefficients = find_model("airplane-longitudinal-coefficients")(
        **{name: p[name] for name in ("m", "S", "c", "rho", "g", "U")},
        I_y=p["I_yy"],
        C_L=flight["C_L"],
        C_D=p["C_D0"] + p["k"] * wing**2,
        C_Lalpha=lift,
        C_Dalpha=2 * p["k"] * wing * p["a"],
        C_malpha=moment,
        C_Lalphadot=2 * k_t * p["epsilon"] * p["l"] / p["c"],
        C_malphadot=-2 * k_t * p["epsilon"] * p["l"] * plane.l_t / p["c"] ** 2,
        C_Lq=2 * k_t * plane.l_t / p["c"],
        C_mq=-2 * k_t * (plane.l_t / p["c"]) ** 2,
    )
    assert modes(coefficients).eigenvalues == pytest.approx(modes(plane).eigenvalues, rel=1e-9)


# Stall: the published law, with its own exponentials, is an independent entry.


def blended(alpha, slope, stall, M):
    """Beard and McLain (2012), eqs. (4.9) and (4.10), as printed."""
    A, B = math.exp(-M * (alpha - stall)), math.exp(M * (alpha + stall))
    sigma = (1 + A + B) / ((1 + A) * (1 + B))
    plate = 2 * math.copysign(1, alpha) * math.sin(alpha) ** 2 * math.cos(alpha)
    return (1 - sigma) * slope * alpha + sigma * plate


@pytest.mark.parametrize("alpha", [-1.0, -0.3, -0.1, 0.02, 0.2, 0.25, 0.3, 1.2])
def test_stalling_lift_is_the_published_blend_of_attached_flow_and_flat_plate(alpha):
    for slope, stall, M in ((2 * math.pi, 0.25, 50.0), (4.7, 0.4, 20.0)):
        expected = blended(alpha, slope, stall, M)
        assert wings.stalling_lift(alpha, slope, stall, M) == pytest.approx(expected, rel=1e-12)


def test_lift_of_a_section_breaks_away_once():
    alpha = np.deg2rad(np.linspace(0, 30, 301))
    lift = wings.stalling_lift(alpha)
    highest = int(np.argmax(lift))
    assert np.deg2rad(10) < alpha[highest] < 0.25
    assert (np.diff(lift[:highest]) > 0).all()
    assert lift[highest:].min() < lift[highest] / 3
    assert wings.stalling_lift(-alpha) == pytest.approx(-lift)
