"""Airplanes' full linear models: published matrices and eigenvalues, and the names of the modes."""

import math

import numpy as np
import pytest

from ucrit import load, modes
from ucrit.core.numeric.compiled import state_space
from ucrit.core.numeric.motion import motion

FOOT = 0.3048

PRINTED = {
    "boeing-747": [
        [-0.006868, 0.01395, 0, -32.2],
        [-0.09055, -0.3151, 773.98, 0],
        [0.0001187, -0.001026, -0.4285, 0],
        [0, 0, 1, 0],
    ],
    "boeing-747-lateral": [
        [-0.0558, 0, -774, 32.2],
        [-0.003865, -0.4342, 0.4136, 0],
        [0.001086, -0.006112, -0.1458, 0],
        [0, 1, 0, 0],
    ],
}
IN_FEET = {"boeing-747": [1, 1, 0, 0], "boeing-747-lateral": [1, 0, 0, 0]}


@pytest.mark.parametrize("name", PRINTED)
def test_state_matrix_of_the_747_from_its_dimensional_derivatives(name):
    lengths = np.where(IN_FEET[name], FOOT, 1.0)
    # the derivatives are printed to four digits, but the moments of inertia to three
    A = state_space(load(name)).A * lengths / lengths[:, None]
    assert pytest.approx(A, rel=6e-3, abs=1e-12) == np.array(PRINTED[name])


# B. Jackson, NASA LaRCsim, navion_aero.c (1992): per unit of mass or inertia, in feet, per sideslip where so named
LARCSIM = {
    "navion": {"X_u": -0.0451, "X_w": 0.03607, "Z_u": -0.3697, "Z_w": -2.0244, "M_w": -0.05, "M_q": -2.0767},
    "navion-lateral": {
        "Y_v": -0.2543,
        "L_v": -15.982 / 176,
        "N_v": 4.495 / 176,
        "L_p": -8.402,
        "L_r": 2.193,
        "N_p": -0.3498,
        "N_r": -0.7605,
    },
}


@pytest.mark.parametrize(("name", "derivative"), [(name, d) for name, ds in LARCSIM.items() for d in ds])
def test_navion_has_the_derivatives_of_another_source(name, derivative):
    vehicle = load(name)
    force, of = derivative.split("_")
    per = {"L": "I_x", "M": "I_y", "N": "I_z"}.get(force, "m")
    length = FOOT if force in "LMN" and of in "uvw" else 1.0
    found = getattr(vehicle, derivative) / vehicle.values[per] * length
    coarse = derivative == "N_v"  # C_nbeta is given to two digits
    assert found == pytest.approx(LARCSIM[name][derivative], rel=0.013 if coarse else 1.2e-3)


def test_navion_frequencies_and_damping():
    found = {mode.name: mode for mode in modes(load("navion").with_(C_Lq=0))}
    short, slow = found["short period oscillation"], found["phugoid oscillation"]
    assert (abs(short.eigenvalue), short.damping_ratio) == pytest.approx((3.607, 0.696), abs=5e-4)
    assert (abs(slow.eigenvalue), slow.damping_ratio) == pytest.approx((0.2137, 0.0801), abs=5e-5)


LONGITUDINAL = {"phugoid": True, "short period": True}
LATERAL = {"Dutch roll": True, "roll": False, "spiral": False}


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("boeing-747", LONGITUDINAL),
        ("navion", LONGITUDINAL),
        ("navion-from-geometry", LONGITUDINAL),
        ("boeing-747-lateral", LATERAL),
        ("navion-lateral", LATERAL),
    ],
)
@pytest.mark.parametrize("seed", range(10))
def test_modes_have_their_names(name, expected, seed):
    rng = np.random.default_rng(seed)
    vehicle = load(name)
    near = vehicle.with_(**{key: value * rng.uniform(0.9, 1.1) for key, value in vehicle.values.items()})
    found = {mode.name.rpartition(" ")[0]: mode for mode in modes(near)}
    assert {motion: mode.oscillates for motion, mode in found.items()} == expected
    slow, fast = ("spiral", "roll") if expected is LATERAL else ("phugoid", "short period")
    assert abs(found[slow].eigenvalue) < abs(found[fast].eigenvalue)


def test_each_motion_names_one_mode_also_where_another_variable_takes_part_most():
    plane = load("boeing-747-lateral")
    factors = {"m": 1.6, "I_x": 0.55, "I_z": 1.6, "U": 0.85, "L_v": 1.3, "L_p": 0.65, "N_v": 0.5}
    odd = plane.with_(**{name: factor * plane.values[name] for name, factor in factors.items()})
    found = {mode.name.rpartition(" ")[0]: mode for mode in modes(odd)}
    spiral = found["spiral"]
    assert set(found) == set(LATERAL)
    assert max(spiral.participation, key=lambda state: spiral.participation[state]) == "r"  # declared for Dutch roll
    assert not spiral.oscillates
    assert found["Dutch roll"].oscillates


def test_the_non_linear_airplane_settles_on_level_flight_from_a_gust():
    from scipy.integrate import solve_ivp

    plane = load("navion-from-geometry")
    moving, arguments = motion(type(plane)), plane.arguments()
    w, u = moving.basic(arguments)
    gust = w + np.array([3.0, 2.0, 0.0, 0.05])
    flight = solve_ivp(lambda t, x: moving.rhs(x, u, arguments), (0, 400), gust, rtol=1e-8, atol=1e-8)
    assert flight.success
    slowest = min(-modes(plane).eigenvalues.real)
    assert np.linalg.norm(flight.y[:, -1] - w) < 10 * np.linalg.norm(gust - w) * math.exp(-slowest * 400)
