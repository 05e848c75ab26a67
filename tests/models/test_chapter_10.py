"""Wheelsets and trucks: creep, hunting speed by formula, Routh and eigenvalues, and the kinematic limit."""

import itertools
import math
from fractions import Fraction

import numpy as np
import pytest
from agreement import SETS, agree, crossing, varied

from ucrit import criteria, critical, find_model, load, modes
from ucrit.checks import check_model
from ucrit.core.numeric.compiled import compiled
from ucrit.core.numeric.motion import motion
from ucrit.numerics.routh import routh
from ucrit.parts.creep import contact_velocities, creepage

RAIL = ("wheelset", "wheelset-gravity", "rail-truck", "rail-truck-rigid")
SEEDS = range(SETS)


def hunting_speed(m, I, k_1, k_2, lateral_creep, yaw_creep, steering):
    """Return the exact critical speed of a wheelset.

    ``m y'' + e/V y' - e psi + k_1 y = 0`` and ``I psi'' + g/V psi' + h y + k_2 psi = 0``.
    """
    e, g, h = lateral_creep, yaw_creep, steering
    squared = (e * k_2 + g * k_1) / (e * I + g * m)
    return math.sqrt(e * g * squared / (e * h - g / e * (k_1 - m * squared) ** 2))


@pytest.mark.parametrize("name", RAIL)
def test_every_check_passes(name):
    check_model(find_model(name)).raise_if_failed()


def test_creepages_from_the_contact_points_velocities():
    V, y, dy, psi, dpsi, d, r_0, conicity = 30, 1e-6, 2e-5, 3e-6, 4e-5, 0.75, 0.46, 0.05
    (left, across), (right, same) = contact_velocities(V, y, psi, dy, dpsi, d, r_0, conicity)
    expected = conicity * y / r_0 + d * dpsi / V
    assert creepage(right, V) == pytest.approx(expected, rel=1e-5)
    assert creepage(left, V) == pytest.approx(-expected, rel=1e-5)
    assert creepage(across, V) == creepage(same, V) == pytest.approx(dy / V - psi, rel=1e-5)


def test_no_creep_in_the_kinematic_motion():
    V, y, psi, d, r_0, conicity = 30, 2e-3, 3e-3, 0.75, 0.46, 0.05
    points = contact_velocities(V, y, psi, V * math.tan(psi), -V * conicity * y / (r_0 * d), d, r_0, conicity)
    assert np.array(points) == pytest.approx(0, abs=V * psi**2)


@pytest.mark.parametrize("seed", SEEDS)
def test_wheelset_critical_speed(seed):
    wheelset = varied(load("wheelset"), seed)
    m, I, d, r_0, conicity, f_x, f_y, k_1, k_2, _ = wheelset.values.values()
    steering = 2 * f_x * conicity * d / r_0
    found = agree(wheelset, "V", hunting_speed(m, I, k_1, k_2, 2 * f_y, 2 * f_x * d**2, steering))
    assert (found.kind, found.stable) == ("flutter", "below")
    assert found.closed_form.power == 2
    frequency = math.sqrt((d**2 * f_x * k_1 + f_y * k_2) / (I * f_y + m * d**2 * f_x))
    assert found.frequency_hz == pytest.approx(frequency / (2 * math.pi), rel=1e-9)


@pytest.mark.parametrize("seed", SEEDS)
def test_large_creep_formula_is_low_by_the_second_order_of_stiffness_over_creep(seed):
    """Its error is ``d r_0 (m k_2 - I k_1)^2 / (8 lambda (I f_y + m d^2 f_x)^2)``."""
    wheelset = varied(load("wheelset"), seed).with_(f_x=4e7, f_y=5e7)

    def error(times):
        stiff = wheelset.with_(f_x=4e7 * times, f_y=5e7 * times)
        m, I, d, r_0, conicity, f_x, f_y, k_1, k_2, _ = stiff.values.values()
        inertia = I * f_y + m * d**2 * f_x
        formula = math.sqrt(d * r_0 * (d**2 * f_x * k_1 + f_y * k_2) / (conicity * inertia))
        expected = d * r_0 * (m * k_2 - I * k_1) ** 2 / (8 * conicity * inertia**2)
        return 1 - formula / critical(stiff)[0].value, expected

    (once, expected), (twice, _) = error(1), error(2)
    assert 0 <= once == pytest.approx(expected, rel=0.05)
    assert twice == pytest.approx(once / 4, rel=0.1)


def test_negative_conicity_diverges():
    assert str(criteria(find_model("wheelset")).conditions[0]) == "4*d*f_x*f_y*lambda_ + k_1*k_2*r_0 > 0"
    p = load("wheelset").values
    limit = -p["k_1"] * p["k_2"] * p["r_0"] / (4 * p["d"] * p["f_x"] * p["f_y"])
    found = critical(load("wheelset").with_(V=1), "lambda_", upper=0)
    assert [(c.kind, c.stable) for c in found] == [("divergence", "above")]
    assert found[0].value == pytest.approx(limit, rel=1e-12)


@pytest.mark.parametrize("seed", SEEDS)
def test_wheelset_under_load_critical_speed(seed):
    wheelset = varied(load("wheelset-with-load"), seed).with_(c_1=0, c_2=0)
    m, I, d, r_0, conicity, f_x, f_y, k_1, k_2, _, N, R, *_ = wheelset.values.values()
    k_1, k_2 = k_1 + 2 * N / R, k_2 - 2 * N * conicity * d
    steering = 2 * f_x * conicity * d / r_0
    agree(wheelset, "V", hunting_speed(m, I, k_1, k_2, 2 * f_y, 2 * f_x * d**2, steering))


def test_dampers_raise_the_critical_speed():
    damped = load("wheelset-with-load")
    assert critical(damped)[0].value > critical(damped.with_(c_1=0, c_2=0))[0].value


@pytest.mark.parametrize("seed", SEEDS)
def test_rigid_truck_critical_speed(seed):
    truck = varied(load("coach-truck-rigid"), seed).with_(c_s=0, c_t=0)
    m, I, b, d, r_0, conicity, f_x, f_y, N, R, k_s, k_t, *_ = truck.values.values()
    k_1, k_2 = k_s + 4 * N / R, k_t + 4 * N * b**2 / R - 4 * N * conicity * d
    turning = 4 * (f_x * d**2 + f_y * b**2)
    agree(truck, "V", hunting_speed(m, I, k_1, k_2, 4 * f_y, turning, 4 * f_x * conicity * d / r_0))


def test_rigid_truck_simplified_formula():
    truck = load("coach-truck-rigid").with_(c_s=0, c_t=0)
    p = truck.values
    base = p["d"] ** 2 * (p["f_x"] / p["f_y"] + (p["b"] / p["d"]) ** 2)
    gravity = 4 * p["N"] / p["R"]
    yaw = p["k_t"] + gravity * p["b"] ** 2 - 4 * p["N"] * p["lambda_"] * p["d"]
    squared = (yaw + base * (p["k_s"] + gravity)) / (p["I"] + p["m"] * base)
    wheelbase = 1 + p["f_y"] / p["f_x"] * (p["b"] / p["d"]) ** 2
    V = math.sqrt(p["r_0"] * p["d"] / p["lambda_"] * wheelbase * squared)
    assert critical(truck)[0].value == pytest.approx(V, rel=1e-2)


def test_stiff_primary_suspension_gives_the_rigid_truck():
    truck = load("coach-truck")
    p = truck.values
    kept = {n: p[n] for n in ("b", "d", "r_0", "lambda_", "f_x", "f_y", "k_s", "k_t", "c_s", "c_t", "V")}
    rigid = find_model("rail-truck-rigid")(
        m=p["m_f"] + 2 * p["m"], I=p["I_f"] + 2 * p["I"] + 2 * p["m"] * p["b"] ** 2, N=0, R=1, **kept
    )
    stiff = truck.with_(k_1=1e13, k_2=1e13)
    slow = sorted(modes(stiff).eigenvalues, key=abs)[:4]
    assert slow == pytest.approx(sorted(modes(rigid).eigenvalues, key=abs), rel=1e-4)


def test_truck_critical_speed_by_routh_and_eigenvalues():
    (found,) = critical(load("coach-truck"))
    assert found.kind == "flutter"
    assert found.stable == "below"
    assert crossing(load("coach-truck"), "V", found.value) == pytest.approx(found.value, rel=1e-9)


def unstable_roots(truck):
    numbers = [Fraction(value) for value in truck.arguments()]
    return routh(compiled(type(truck)).exact_coefficients(numbers)).right_half_plane


@pytest.mark.parametrize("seed", SEEDS)
def test_truck_routh_array_changes_where_the_eigenvalues_cross(seed):
    truck = varied(load("coach-truck"), seed)
    speeds = np.geomspace(5, 2000, 4000)
    first = int(np.argmax(modes(truck.with_(V=speeds)).growth > 0))
    assert first > 0
    V = crossing(truck, "V", speeds[first], within=2e-3)
    below, above = (unstable_roots(truck.with_(V=V * factor)) for factor in (1 - 1e-9, 1 + 1e-9))
    assert (below, above) == (0, 2)


def test_slow_wheelset_without_springs_follows_the_kinematic_path():
    def error(V):
        wheelset = load("wheelset").with_(k_1=1e-3, k_2=1e-3, V=V)
        oscillation = max(modes(wheelset).eigenvalues, key=lambda s: s.imag)
        klingel = V * math.sqrt(wheelset.lambda_ / (wheelset.r_0 * wheelset.d))
        return abs(oscillation.imag / klingel - 1)

    assert error(10) < 1e-3
    assert error(20) == pytest.approx(16 * error(10), rel=0.1)


def test_kinematic_wheelset_has_the_same_frequency():
    V, d, r_0, taper = 20, 0.75, 0.46, 0.05
    kinematic = find_model("wheelset-kinematic")(Psi=taper, r_0=r_0, l=2 * d, Omega=V / r_0)
    assert abs(modes(kinematic).eigenvalues) == pytest.approx(V * math.sqrt(taper / (r_0 * d)), rel=1e-12)


def test_rigid_truck_yawed_far_feels_the_velocities_of_its_contact_points():
    truck, rng = load("coach-truck-rigid").with_(N=0, k_s=0, k_t=0, c_s=0), np.random.default_rng(10)
    p = truck.values
    for y, dy, psi, dpsi in rng.uniform(-0.5, 0.5, (5, 4)):
        ahead, left = np.array([np.cos(psi), np.sin(psi)]), np.array([-np.sin(psi), np.cos(psi)])
        side_force = yaw_moment = 0
        for end, side in itertools.product((p["b"], -p["b"]), (1, -1)):
            x, across = end * ahead + side * p["d"] * left
            radius = p["r_0"] + side * p["lambda_"] * (y + end * np.sin(psi))
            slip = np.array([p["V"] - dpsi * across, dy + dpsi * x]) - p["V"] / p["r_0"] * radius * ahead
            force = -(p["f_x"] * slip @ ahead * ahead + p["f_y"] * slip @ left * left) / p["V"]
            side_force, yaw_moment = side_force + force[1], yaw_moment + x * force[1] - across * force[0]
        found = motion(type(truck)).rhs(np.array([y, dy, psi, dpsi]), np.array([]), list(p.values()))
        assert found[1::2] == pytest.approx([side_force / p["m"], yaw_moment / p["I"]], rel=1e-9)
