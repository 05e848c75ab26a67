"""Sliding mode: the surface is reached in time and kept, whatever the law does not know."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import ucrit
from ucrit import Model, UcritError, input, load, param, simulate, state
from ucrit.catalogue import load as load_vehicle
from ucrit.control import (
    close,
    lag,
    observer,
    place,
    reaching_time,
    slide,
    sliding,
    sliding_eigenvalues,
)
from ucrit.core.contract.files import write_vehicle

CAR = load("oversteering-car")
NEUTRAL = load("neutral-car")


class Mass(Model):
    """Mass that a force pushes along a line (Karnopp 2004, Problem 11.4), and another force that nobody knows."""

    m: float = param("kg", "mass", above=0)
    X = state("m", "position")
    V = state("m/s", "velocity")
    F = input("N", "force")
    D = input("N", "disturbance")

    def equations(self, x, dx, u):
        return dx.X - x.V, self.m * dx.V - u.F - u.D


MASS = Mass(m=1.0)


def test_problem_11_4_the_surface_is_reached_in_time_and_the_rest_is_of_first_order():
    held = slide(MASS, "F", {"V": 1.0, "X": 2.0}, alpha=4.0, phi=1e-3)
    np.testing.assert_allclose(sliding_eigenvalues(MASS, "F", {"V": 1.0, "X": 2.0}), [-2, 0], atol=1e-12)
    moved = simulate(held, 3, {"X": 1.0}, times=np.linspace(0, 3, 601), tolerance=1e-8)
    reached = reaching_time(2.0, 4.0)
    S, t = moved["S"], moved.times
    np.testing.assert_allclose(S[t < reached - 0.01], (2.0 - 4.0 * t)[t < reached - 0.01], atol=1e-9)
    assert abs(S[t > reached + 0.01]).max() < 1e-3
    after = t > reached + 0.1
    np.testing.assert_allclose(moved["V"][after], -2 * moved["X"][after], atol=1e-3)


@settings(max_examples=5, deadline=None)
@given(S=st.floats(0.5, 3), q=st.floats(0.1, 5), push=st.floats(0, 1.5), m=st.floats(0.8, 1.25))
def test_the_surface_is_reached_and_kept_under_disturbance_and_with_another_mass(S, q, push, m):
    held = slide(MASS, "F", {"V": 1.0}, alpha=2.0, phi=1e-3, q=q, own=["m"]).with_(m=m)
    late = reaching_time(S, 2.0 / m, q / m, push / m)
    moved = simulate(held, late + 0.5, {"V": S}, {"D": push}, tolerance=1e-7)
    assert abs(moved["S"][-1]) < 1e-3
    assert late == pytest.approx(moved.times[np.argmax(abs(moved["S"]) < 2e-3)], abs=0.02 + late / 300)
    early = simulate(held, 0.9 * late, {"V": S}, {"D": push}, tolerance=1e-7)
    assert abs(early["S"][-1]) > 1e-3


@settings(max_examples=8, deadline=None)
@given(
    S=st.floats(-3, 3).filter(lambda S: abs(S) > 0.01),
    q=st.floats(0, 5),
    push=st.floats(-1.5, 1.5),
    m=st.floats(0.8, 1.25),
)
def test_the_law_that_jumps_reaches_the_surface_at_the_time_of_the_closed_form_and_keeps_it(S, q, push, m):
    held = slide(MASS, "F", {"V": 1.0}, alpha=2.0, phi=None, q=q, own=["m"]).with_(m=m)
    expected = reaching_time(S, 2.0 / m, q / m, push / m * np.sign(S))
    moved = simulate(held, expected + 0.5, {"V": S}, {"D": push})
    assert moved.events[-1].name.startswith("reaches S = 0")
    assert moved.events[-1].time == pytest.approx(expected, abs=1e-9)
    after = moved.times > expected + 1e-9
    assert abs(moved["S"][after]).max() < 1e-11
    np.testing.assert_allclose(moved["F"][after], -push, atol=1e-9)  # the equivalent control


def test_along_the_surface_the_motion_is_of_first_order():
    held = slide(MASS, "F", {"V": 1.0, "X": 2.0}, alpha=4.0, phi=None)
    moved = simulate(held, 3, {"X": 1.0}, {"D": lambda t: np.sin(3 * t)}, times=[1.0, 2.0])
    start = simulate(held, 1, {"X": 1.0}, {"D": lambda t: np.sin(3 * t)}).events[-1]
    np.testing.assert_allclose(moved["X"], start.states["X"] * np.exp(-2 * (moved.times - start.time)), rtol=1e-10)


def test_the_surface_is_left_where_the_disturbance_is_larger_than_alpha_and_reached_again():
    held = slide(MASS, "F", {"V": 1.0}, alpha=2.0, phi=None)
    moved = simulate(held, 3.5, {"V": 0.5}, {"D": lambda t: 3 * np.sin(t)})
    left = next(e.time for e in moved.events if e.name == "leaves S = 0")
    assert left == pytest.approx(np.arcsin(2 / 3), abs=1e-9)
    assert moved.events[-1].name == "reaches S = 0 from above"
    back = moved.events[-1].time  # the integral of 3 sin t - 2 is zero between
    assert 3 * (np.cos(left) - np.cos(back)) == pytest.approx(2 * (back - left), abs=1e-8)


def test_many_start_at_once():
    held = slide(MASS, "F", {"V": 1.0}, alpha=2.0, phi=None)
    moved = simulate(held, 2, {"V": [-1.0, 0.0, 2.0]}, times=[0.25, 2.0])
    np.testing.assert_allclose(moved["S"], [[-0.5, 0], [0, 0], [1.5, 0]], atol=1e-11)


def test_the_non_linear_car_slides_with_another_mass_and_other_tires():
    held = slide(CAR, "delta_f", "r", alpha=1.5, phi=None, reference=NEUTRAL, own=["m", "C_f"])
    moved = simulate(held.with_(m=1.2 * CAR.m, C_f=0.9 * CAR.C_f), 2, {"r": 0.2}, {"delta_f": 0.01})
    reached = moved.events[-1]
    assert reached.name == "reaches S = 0 from above"
    assert abs(moved["S"][moved.times > reached.time]).max() < 1e-10
    np.testing.assert_allclose(abs(ucrit.modes(held).eigenvalues).min(), 0, atol=1e-9)


@settings(max_examples=20, deadline=None)
@given(U=st.floats(5, 70), c=st.floats(-0.2, 0.2), end=st.sampled_from(["delta_f", "delta_r"]))
def test_one_eigenvalue_is_zero_for_every_surface(U, c, end):
    try:
        found = sliding_eigenvalues(CAR.with_(U=U), end, {"r": 1.0, "V": c})
    except ZeroDivisionError:
        return
    assert abs(found).min() < 1e-9 * max(1, abs(found).max())


def test_linear_part_has_the_reference_s_poles_the_layer_s_and_those_of_the_motion_while_it_slides():
    held = slide(CAR, "delta_f", "r", alpha=1.5, phi=0.05, q=3.0, reference=NEUTRAL)
    inner = [p for p in sliding_eigenvalues(CAR, "delta_f", {"r": 1.0}) if abs(p) > 1e-9]
    expected = [*ucrit.modes(NEUTRAL).eigenvalues, *inner, -3.0 - 1.5 / 0.05]
    np.testing.assert_allclose(np.sort_complex(ucrit.modes(held).eigenvalues), np.sort_complex(expected), rtol=1e-6)


def test_the_car_follows_its_reference_from_the_start_and_with_other_tires():
    held = slide(CAR, "delta_f", "r", alpha=4.0, phi=0.01, reference=NEUTRAL, own=["C_f", "C_r", "m"])
    for changed in (held, held.with_(C_f=0.8 * CAR.C_f, C_r=0.9 * CAR.C_r, m=1.2 * CAR.m)):
        moved = simulate(changed, 4, inputs={"delta_f": 0.002}, tolerance=1e-7)
        assert abs(moved["r"] - moved["r_d"]).max() < 0.01 * abs(moved["r_d"]).max()
    np.testing.assert_allclose(moved["r_d"][-1], 0.002 * ucrit.transfer(NEUTRAL, "delta_f", "r").static_gain, rtol=1e-4)


def test_estimates_in_place_of_the_lateral_velocity():
    seen = observer(CAR, "r", [-20, -25])
    held = slide(seen, "delta_f", "r", alpha=1.5, phi=0.05, reference=NEUTRAL, estimated=["V"])
    found = ucrit.modes(held).eigenvalues
    assert np.all(found.real < 0)
    for pole in (-20, -25, -1.5 / 0.05):
        assert abs(found - pole).min() < 1e-4 * abs(pole)


def test_file_and_class_of_the_catalogue_are_the_same(tmp_path):
    shipped = load("oversteering-car-in-sliding-mode")
    own = ["m", "I_z", "C_f", "C_r"]
    held = slide(CAR, "delta_f", "r", alpha=1.5, phi=0.05, reference=load("understeering-car"), own=own)
    assert type(held) is type(shipped)
    assert held.values == shipped.values
    path = tmp_path / "held.toml"
    path.write_text(write_vehicle(held), encoding="utf-8")
    assert load_vehicle(path).values == held.values


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        (lambda: sliding(MASS, "F", "X"), "F does not change X at once"),
        (lambda: sliding(MASS, "F"), "name the states"),
        (
            lambda: slide(close(CAR, lag(CAR, "delta_f"), tau_delta_f=0.02), "delta_f", "r", alpha=1, phi=None),
            r"behind lag\(delta_f\) a law that jumps would chatter",
        ),
        (lambda: sliding(CAR, "delta_f", "rr"), "there is no state 'rr'"),
        (lambda: slide(CAR, "delta_f", "r", alpha=-1, phi=0.1), "must be at least 0"),
        (lambda: slide(MASS, "F", {"V": 1.0, "X": -1.0}, alpha=1, phi=0.1), "zero at 1 1/s, in the right half plane"),
        (lambda: slide(load("motorcycle-lean"), "delta_r", "p", alpha=1, phi=0.1), "which grows: from delta_r"),
    ],
)
def test_what_is_not_possible_is_refused(wrong, message):
    with pytest.raises(UcritError, match=message):
        wrong()


def test_an_actuator_between_law_and_car_is_not_reckoned_with():
    slow = close(CAR, lag(CAR, "delta_f"), tau_delta_f=0.02)
    held = slide(slow, "delta_f", "r", alpha=1.5, phi=0.1, reference=NEUTRAL)
    assert np.all(ucrit.modes(held).eigenvalues.real < 0)
    assert place(CAR, "delta_f", [-3, -4]).K_delta_f_V != 0
