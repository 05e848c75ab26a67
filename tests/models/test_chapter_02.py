"""Rigid bodies in moving axes and their specialisations; satellites that spin, tumble and turn over."""

import mpmath
import numpy as np
import pytest
import sympy as sp
from agreement import SETS, varied
from scipy.special import ellipj, ellipk

from ucrit import analyze, criteria, find_model, load, modes, simulate, verdict
from ucrit.core.derivation.derive import symbolic
from ucrit.core.derivation.trace import trace
from ucrit.models.car import Car
from ucrit.models.rigid_body import RigidBody
from ucrit.models.rigid_body_longitudinal import RigidBodyLongitudinal
from ucrit.models.rigid_body_plane import RigidBodyPlane
from ucrit.models.rigid_body_sphere import RigidBodySphere
from ucrit.models.rigid_body_symmetric import RigidBodySymmetric
from ucrit.models.satellite import Satellite
from ucrit.models.satellite_damped import SatelliteDamped
from ucrit.parts.rigid_body import angular_momentum, inertia_tensor, rate_in_space


def residuals(model, **values):
    """Return the equations of motion, by variable, with values put in for some of their symbols."""
    traced = trace(model)
    swap = {s: values[s.name] for r in traced.residuals for s in r.free_symbols if s.name in values}
    names = model.declaration.variables
    return {name: r.xreplace(swap) for name, r in zip(names, traced.residuals, strict=True)}


def by_name(residuals):
    """Make symbols of one name equal, whatever a model knows about their signs."""
    return {key: sp.expand(r.xreplace({s: sp.Symbol(s.name) for s in r.free_symbols})) for key, r in residuals.items()}


def rotation(t):
    """Return axes that turn about all three directions, as columns in fixed ones."""
    yaw, pitch, roll = 0.3 * t + t**2, mpmath.sin(t), 0.4 + t**3
    (c, s), (d, u), (e, v) = ((mpmath.cos(a), mpmath.sin(a)) for a in (yaw, pitch, roll))
    about_z, about_y = (
        mpmath.matrix([[c, -s, 0], [s, c, 0], [0, 0, 1]]),
        mpmath.matrix([[d, 0, u], [0, 1, 0], [-u, 0, d]]),
    )
    return about_z * about_y * mpmath.matrix([[1, 0, 0], [0, e, -v], [0, v, e]])


def slope(function, t):
    """Return the derivative of a vector or matrix of functions."""
    rows, columns = function(t).rows, function(t).cols
    return mpmath.matrix(
        [[mpmath.diff(lambda x, i=i, j=j: function(x)[i, j], t) for j in range(columns)] for i in range(rows)]
    )


def spin(t):
    """Return the rates of turning about the axes that turn."""
    S = rotation(t).T * slope(rotation, t)
    return S[2, 1], S[0, 2], S[1, 0]


INERTIA = inertia_tensor(7, 5, 3, 0.5, -0.25, 0.125)
VECTORS = {
    "velocity": lambda t: (t, t**2 + 1, mpmath.cos(t)),
    "angular momentum": lambda t: angular_momentum(INERTIA, spin(t)),
}


@pytest.mark.parametrize("name", VECTORS)
def test_rate_in_space_is_that_of_a_vector_that_is_turned_into_fixed_axes(name):
    vector = VECTORS[name]
    with mpmath.workdps(60):
        t = mpmath.mpf("0.7")
        in_space = slope(lambda x: rotation(x) * mpmath.matrix(vector(x)), t)
        own_rate = tuple(slope(lambda x: mpmath.matrix(vector(x)), t))
        derived = rotation(t) * mpmath.matrix(rate_in_space(vector(t), own_rate, spin(t)))
        assert mpmath.norm(in_space - derived) < 1e-12 * mpmath.norm(in_space)
        assert mpmath.norm(in_space - rotation(t) * mpmath.matrix(own_rate)) > 0.1


def test_symmetric_body_is_the_general_one_without_two_products():
    general = residuals(RigidBody, I_xy=0, I_yz=0)
    assert by_name(general) == by_name(residuals(RigidBodySymmetric))


def test_motion_in_the_plane_of_symmetry_needs_no_force_across():
    values = dict.fromkeys(["V", "p", "r", "V'", "p'", "r'", "Y", "L", "N"], 0)
    found = by_name(residuals(RigidBodySymmetric, **values))
    assert [found.pop(name) for name in ("V", "p", "r")] == [0, 0, 0]
    assert found == by_name(residuals(RigidBodyLongitudinal))


def test_plane_motion_is_the_general_one_held_by_a_force_and_two_moments():
    values = dict.fromkeys(["W", "p", "q", "W'", "p'", "q'"], 0)
    found = by_name(residuals(RigidBodySymmetric, **values))
    held = {name: found.pop(name) for name in ("W", "p", "q")}
    assert found == by_name(residuals(RigidBodyPlane))
    I_xz, r, dr = sp.symbols("I_xz r r'")
    Z, L, M = sp.symbols("Z L M")
    assert held == {"W": -Z, "p": -I_xz * dr - L, "q": -I_xz * r**2 - M}


def test_plane_motion_with_the_forces_of_tires_is_the_car():
    body, car = trace(RigidBodyPlane), trace(Car)
    plane = dict(zip(RigidBodyPlane.declaration.variables, body.residuals, strict=True))
    U, V, r = (chain[0] for chain in body.q)
    _, Y, N = body.u
    I_zz, a, b, C_f, C_r, speed, delta_f, delta_r = sp.symbols("I_zz a b C_f C_r U delta_f delta_r")
    Y_f = -C_f * (sp.atan((V + a * r) / speed) - delta_f) * sp.cos(delta_f)
    Y_r = -C_r * (sp.atan((V - b * r) / speed) - delta_r) * sp.cos(delta_r)
    forces = {Y: Y_f + Y_r, N: a * Y_f - b * Y_r, U: speed}
    derived = by_name({name: plane[name].xreplace(forces) for name in "Vr"})
    expected = by_name(dict(zip("Vr", car.residuals, strict=True)))
    expected = {name: e.xreplace({sp.Symbol("I_z"): I_zz}) for name, e in expected.items()}
    assert {name: sp.expand(derived[name] - expected[name]) for name in "Vr"} == {"V": 0, "r": 0}


def test_moment_on_a_sphere_is_inertia_times_angular_acceleration():
    found = by_name(residuals(RigidBodySphere))
    I, L, M, N = sp.symbols("I L M N")
    assert [found[name] for name in "pqr"] == [
        I * sp.Symbol(rate) - moment for rate, moment in (("p'", L), ("q'", M), ("r'", N))
    ]


@pytest.mark.parametrize("name", ["large-airplane-body", "large-airplane-symmetric"])
def test_free_body_keeps_its_energy_and_its_momentum(name):
    body = load(name)
    found = simulate(body, 20, {"V": 5, "W": -3, "p": 0.5, "q": -0.3, "r": 0.4})
    v, w = (np.array([found[n] for n in names]) for names in ("UVW", "pqr"))
    I = np.array(body.inertia(), dtype=float)
    momentum, energy = I @ w, np.einsum("it,ij,jt->t", w, I, w)
    for kept in (np.sum(v**2, axis=0), np.sum(momentum**2, axis=0), energy):
        assert kept == pytest.approx(kept[0], rel=1e-10)
    assert np.ptp(w, axis=1).min() > 0.05


@pytest.mark.parametrize("seed", range(SETS))
def test_roots_of_a_spinning_satellite(seed):
    satellite = varied(load("satellite-middle-axis"), seed)
    I_xx, I_yy, I_zz, Omega = satellite.values.values()
    square = -(Omega**2) * (I_xx - I_yy) * (I_xx - I_zz) / (I_yy * I_zz)
    found = [s for s in modes(satellite).eigenvalues if s != 0]
    assert [s**2 for s in found] == pytest.approx([square, square], rel=1e-11)
    middle = min(I_yy, I_zz) < I_xx < max(I_yy, I_zz)
    assert verdict(satellite).state == ("unstable" if middle else "neutral")


@pytest.mark.parametrize(
    ("name", "state"),
    [
        ("satellite-largest-axis", "neutral"),
        ("satellite-middle-axis", "unstable"),
        ("satellite-smallest-axis", "neutral"),
        ("satellite-largest-axis-damped", "asymptotically stable"),
        ("explorer-1-rigid", "neutral"),
        ("explorer-1", "unstable"),
    ],
)
def test_verdict_for_each_axis(name, state):
    assert verdict(load(name)).state == state


def test_criterion_of_a_rigid_satellite():
    found = criteria(find_model("satellite"))
    assert found.kind == "neutral"
    assert [str(c) for c in found] == ["(I_xx - I_yy)*(I_xx - I_zz) > 0"]


def test_with_a_damper_only_the_largest_axis_is_stable():
    rng = np.random.default_rng(2)
    verdicts = set()
    for _ in range(300):
        x, y, z, Omega, J, c = 10 ** rng.uniform(-1, 1, 6)  # second moments of mass along the axes
        I_xx, I_yy, I_zz = y + z, z + x, x + y
        I_yy, J = I_yy / (1 + J), I_yy * J / (1 + J)
        satellite = SatelliteDamped(I_xx=I_xx, I_yy=I_yy, I_zz=I_zz, Omega=Omega, J=J, c=c)
        largest = I_xx > max(I_yy + J, I_zz)
        assert verdict(satellite).stable == largest
        assert all(condition.value(satellite) > 0 for condition in criteria(satellite)) == largest
        verdicts.add(largest)
    assert verdicts == {True, False}


def tumble(satellite, spin_3, spin_1):
    """Return the exact motion without rates about the middle axis at time 0, and its period.

    Source: L. D. Landau, E. M. Lifshitz, Mechanics (1976), section 37; axes 1, 2, 3 by rising moments.
    """
    I_1, I_2, I_3 = (satellite.values[name] for name in ("I_zz", "I_xx", "I_yy"))
    twice_energy = I_1 * spin_1**2 + I_3 * spin_3**2
    square = (I_1 * spin_1) ** 2 + (I_3 * spin_3) ** 2
    assert I_1 < I_2 < I_3
    assert square > twice_energy * I_2
    low, high = twice_energy * I_3 - square, square - twice_energy * I_1
    rate = np.sqrt((I_3 - I_2) * high / (I_1 * I_2 * I_3))
    modulus = (I_2 - I_1) * low / ((I_3 - I_2) * high)

    def exact(t):
        sn, cn, dn, _ = ellipj(rate * t, modulus)
        return (
            np.sqrt(low / (I_2 * (I_3 - I_2))) * sn,
            np.sqrt(high / (I_3 * (I_3 - I_1))) * dn,
            np.sqrt(low / (I_1 * (I_3 - I_1))) * cn,
        )

    return exact, 4 * ellipk(modulus) / rate


@pytest.fixture(scope="module", params=[(3.0, 2.0), (6.0, 10.3), (0.5, 0.1)], ids=["wide", "near the edge", "slow"])
def tumbling(request):
    satellite = load("satellite-middle-axis")
    spin_3, spin_1 = request.param
    exact, period = tumble(satellite, spin_3, spin_1)
    times = np.linspace(0, 1, 101) * period
    start = {"p": 0, "q": spin_3, "r": spin_1}
    return satellite, exact, simulate(satellite, times[-1], start, times=times)


def test_tumble_is_that_of_the_elliptic_functions(tumbling):
    _, exact, found = tumbling
    size = np.abs(found.values).max()
    for name, expected in zip("pqr", exact(found.times), strict=True):
        assert np.abs(found[name] - expected).max() < 1e-9 * size


def test_tumble_comes_back_after_its_period_and_not_before(tumbling):
    _, _, found = tumbling
    size = np.abs(found.values).max()
    apart = np.abs(found.values - found.values[0]).max(axis=1)
    assert apart[-1] < 1e-9 * size
    assert apart[5:-5].min() > 1e-2 * size


def test_tumble_keeps_energy_and_angular_momentum(tumbling):
    satellite, _, found = tumbling
    I = np.array([satellite.values[name] for name in ("I_xx", "I_yy", "I_zz")])
    energy, square = (I * found.values**2).sum(axis=1), ((I * found.values) ** 2).sum(axis=1)
    assert energy == pytest.approx(energy[0], rel=1e-10)
    assert square == pytest.approx(square[0], rel=1e-10)


def test_energy_sink_turns_a_satellite_to_its_largest_axis():
    satellite = SatelliteDamped(I_xx=10, I_yy=18, I_zz=30, Omega=6, J=2, c=8)
    found = simulate(satellite, 200, {"q": 0.05})
    p, q, r, w = found.values.T
    H = np.hypot(np.hypot(10 * p, 20 * q + 2 * w), 30 * r)
    energy = (10 * p**2 + 18 * q**2 + 2 * (q + w) ** 2 + 30 * r**2) / 2
    assert list(H) == pytest.approx([H[0]] * len(H), rel=1e-10)
    assert np.all(np.diff(energy) <= 1e-11 * energy[0])
    assert energy[0] == pytest.approx(H[0] ** 2 / (2 * 10), rel=1e-3)
    assert energy[-1] == pytest.approx(H[0] ** 2 / (2 * 30), rel=1e-9)
    assert abs(r[-1]) == pytest.approx(H[0] / 30, rel=1e-9)


def test_explorer_1_turns_over_within_some_orbits():
    orbit = 115 * 60
    foldings = orbit * float(modes(load("explorer-1")).growth)
    assert 2 < foldings < 20


def test_satellite_is_a_rigid_body_without_loads():
    general = symbolic(RigidBody).traced.residuals[3:]
    names = dict.fromkeys(["I_xy", "I_xz", "I_yz", "L", "M", "N"], 0)
    expected = [r.xreplace({s: 0 for s in r.free_symbols if s.name in names}) for r in general]
    found = list(by_name(residuals(Satellite)).values())
    assert found == list(by_name(dict(enumerate(expected))).values())


def test_a_satellite_wobbles_and_its_spin_stays():
    assert "the wobble oscillation grows at 9.9 Hz, doubling in 670 s" in analyze(load("explorer-1")).sentence
    assert [mode.name for mode in modes(load("satellite-largest-axis"))] == ["spin rate", "wobble oscillation"]
