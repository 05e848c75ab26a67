"""Two-wheelers that lean: exact rolling, Lagrange's equation, and lean by front and rear steering."""

import math

import numpy as np
import pytest
import sympy as sp
from agreement import SETS, varied

from ucrit import criteria, find_model, load, modes, simulate, transfer
from ucrit.checks import check_model
from ucrit.core.derivation.derive import symbolic
from ucrit.core.derivation.trace import trace
from ucrit.core.numeric.motion import motion
from ucrit.parts.rolling import rolling_motion

SEEDS = range(SETS)


def times(vehicle):
    """Return tau1, tau2, tau3 and K of the book."""
    m, h, I_1, a, b, g, U = (vehicle.values[n] for n in ("m", "h", "I_1", "a", "b", "g", "U"))
    return math.sqrt((I_1 + m * h**2) / (m * g * h)), b / U, a / U, U**2 / (g * (a + b))


def test_every_check_passes():
    check_model(find_model("lean")).raise_if_failed()


@pytest.mark.parametrize("seed", SEEDS)
def test_wheels_move_where_they_point_at_large_steer_angles(seed):
    U, a, b, delta_f, delta_r = np.random.default_rng(seed).uniform([1, 0.3, 0.3, -1.2, -1.2], [30, 2, 2, 1.2, 1.2])
    V, r = rolling_motion(U, a, b, delta_f, delta_r)
    assert math.atan2(V + a * r, U) == pytest.approx(delta_f)
    assert math.atan2(V - b * r, U) == pytest.approx(delta_r)
    centre = np.array([-V / r, U / r])  # of the turn, in the body's axes
    for wheel, delta in ((np.array([a, 0]), delta_f), (np.array([-b, 0]), delta_r)):
        assert (centre - wheel) @ [math.cos(delta), math.sin(delta)] == pytest.approx(0, abs=1e-9 * abs(U / r))


def test_kinematics_for_small_steer_angles():
    U, a, b, front, rear, size = sp.symbols("U a b front rear size", positive=True)
    V, r = rolling_motion(U, a, b, size * front, size * rear)
    assert sp.simplify(sp.diff(r, size).subs(size, 0) - U * (front - rear) / (a + b)) == 0
    assert sp.simplify(sp.diff(V, size).subs(size, 0) - U * (b * front + a * rear) / (a + b)) == 0


def lagrange_equation():
    """Return Lagrange's equation of the leaning body, derived from velocities and energies, and what it holds."""
    t = sp.Symbol("t")
    m, h, I_1, I_2, I_3, g, U = sp.symbols("m h I_1 I_2 I_3 g U", positive=True)
    theta, V, r = (sp.Function(name)(t) for name in ("theta", "V", "r"))
    rate = theta.diff(t)
    place = sp.Matrix([0, h * sp.sin(theta), -h * sp.cos(theta)])
    velocity = sp.Matrix([U, V, 0]) + place.diff(t) + sp.Matrix([0, 0, r]).cross(place)
    spin = I_1 * rate**2 + I_2 * (r * sp.sin(theta)) ** 2 + I_3 * (r * sp.cos(theta)) ** 2
    kinetic = m * velocity.dot(velocity) / 2 + spin / 2
    lagrangian = kinetic - m * g * h * sp.cos(theta)
    equation = lagrangian.diff(rate).diff(t) - lagrangian.diff(theta)
    return equation, (t, theta, V, r), (m, h, I_1, I_2, I_3, g, U)


def test_the_model_is_lagranges_equation_in_first_order_form():
    equation, (t, theta, V, r), symbols = lagrange_equation()
    traced = trace(find_model("lean"))
    values = {traced.parameters[s.name]: s for s in symbols}
    (theta_0, theta_1), (p_0, p_1) = traced.q
    momentum = sp.solve(traced.residuals[0], p_0)[0]
    slope = sp.solve(traced.residuals[1], p_1)[0]
    kinematics = sp.solve(
        [e - s for e, s in zip(traced.outputs, sp.symbols("V_ r_"), strict=True)],
        [sp.tan(u) for u in traced.u],
    )
    motion_of = {theta_0: theta, theta_1: theta.diff(t), sp.Symbol("V_"): V, sp.Symbol("r_"): r}

    def along(expression):
        rewritten = expression.subs(kinematics)
        assert not rewritten.has(*traced.u)
        return rewritten.xreplace(values).subs(motion_of)

    assert sp.simplify(along(momentum).diff(t) - along(slope) - equation) == 0


def test_linear_equation():
    equation, (t, theta, V, r), (m, h, I_1, _, _, g, U) = lagrange_equation()
    size = sp.Symbol("size")
    small = equation.subs({theta: size * theta, V: size * V, r: size * r}).doit()
    linear = small.diff(size).subs(size, 0).doit()
    book = (I_1 + m * h**2) * theta.diff(t, 2) - m * g * h * theta + m * h * (V.diff(t) + r * U)
    assert sp.simplify(linear - book) == 0


@pytest.mark.parametrize("steer", ["delta_f", "delta_r"])
def test_transfer_functions_in_symbols(steer):
    m, h, I_1, a, b, g, U, s = sp.symbols("m h I_1 a b g U s")
    tau1_2, tau2, tau3, K = (I_1 + m * h**2) / (m * g * h), b / U, a / U, U**2 / (g * (a + b))
    book = {
        "delta_f": -K * (tau2 * s + 1) / (tau1_2 * s**2 - 1),
        "delta_r": K * (1 - tau3 * s) / (tau1_2 * s**2 - 1),
    }
    found = transfer(find_model("lean"), steer, "theta")
    assert (
        sp.simplify(sp.sympify(found.text, locals={x.name: x for x in (m, h, I_1, a, b, g, U, s)}) - book[steer]) == 0
    )


@pytest.mark.parametrize("seed", SEEDS)
def test_poles_and_zeros(seed):
    vehicle = varied(load("motorcycle-lean"), seed)
    tau1, tau2, tau3, K = times(vehicle)
    front, rear = (transfer(vehicle, steer, "theta") for steer in ("delta_f", "delta_r"))
    assert sorted(modes(vehicle).eigenvalues.real) == pytest.approx([-1 / tau1, 1 / tau1])
    assert [float(z.real) for z in front.zeros] == pytest.approx([-1 / tau2])
    assert [float(z.real) for z in rear.zeros] == pytest.approx([1 / tau3])
    assert front(0) == pytest.approx(K)
    assert rear(0) == pytest.approx(-K)


def test_no_two_wheeler_is_stable_by_itself():
    assert criteria(find_model("lean")).settled is False
    names = {mode.name for mode in modes(load("motorcycle-lean"))}
    assert names == {"capsize divergence", "lean decay"}


def test_benchmark_bicycle_has_the_published_mass_and_stiffness():
    bicycle = load("benchmark-bicycle-lean")
    assert bicycle.I_1 + bicycle.m * bicycle.h**2 == pytest.approx(80.81722, rel=1e-9)
    assert bicycle.m * bicycle.h == pytest.approx(80.95, rel=1e-9)
    assert bicycle.a + bicycle.b == pytest.approx(1.02, rel=1e-12)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_step_of_the_steer_angle_makes_the_lean_rate_jump_but_not_its_momentum(seed):
    vehicle = varied(load("motorcycle-lean"), seed)
    moving, delta = motion(type(vehicle)), 0.3
    w = np.zeros(2)
    rate = moving.rhs(w, np.array([delta, 0.0]), vehicle.arguments())[0]
    V, _ = rolling_motion(vehicle.U, vehicle.a, vehicle.b, delta, 0.0)
    I_0 = vehicle.I_1 + vehicle.m * vehicle.h**2
    assert rate == pytest.approx(-vehicle.m * vehicle.h * V / I_0)
    assert rate < 0  # steered to the right it falls to the left


@pytest.mark.parametrize("seed", SEEDS)
def test_in_a_steady_turn_energy_less_that_of_turning_is_conserved(seed):
    """With the steer angles held, theta' dT/dtheta' - T + potential stays constant in the non-linear motion."""
    vehicle = varied(load("motorcycle-lean"), seed)
    traced = trace(type(vehicle))
    (theta, _), (p, _) = traced.q
    P = traced.parameters
    V, r = traced.outputs
    I_0 = P["I_1"] + P["m"] * P["h"] ** 2
    forward = P["U"] - r * P["h"] * sp.sin(theta)
    turning = (P["I_2"] * sp.sin(theta) ** 2 + P["I_3"] * sp.cos(theta) ** 2) * r**2 / 2
    quadratic = (p - P["m"] * P["h"] * V * sp.cos(theta)) ** 2 / (2 * I_0)
    H = quadratic - P["m"] * forward**2 / 2 - turning + P["m"] * P["g"] * P["h"] * sp.cos(theta)
    point = np.random.default_rng(seed).uniform(-0.5, 0.5, 4)
    rates = motion(type(vehicle)).rhs(point[:2], point[2:], vehicle.arguments())
    values = dict(zip((theta, p, *traced.u), point, strict=True)) | {P[n]: v for n, v in vehicle.values.items()}
    terms = [float(H.diff(x).subs(values)) * rate for x, rate in zip((theta, p), rates, strict=True)]
    assert abs(sum(terms)) < 1e-12 * max(map(abs, terms))


def test_the_linear_model_knows_no_pitch_and_yaw_inertia():
    names = {symbol.name for a in symbolic(find_model("lean")).polynomial.expressions for symbol in a.free_symbols}
    assert names == {"m", "h", "I_1", "g"}


@pytest.mark.parametrize("place", ["front", "rear"])
def test_a_wheel_that_is_steered_across_ends_the_motion(place):
    vehicle = load("motorcycle-lean")
    for shape, when in (("100 deg", 0.0), ("step -120 deg at 0.1 s", 0.1)):
        found = simulate(vehicle, 1, inputs={f"delta_{place[0]}": shape})
        assert found.ended == f"steers its {place} wheel across"
        assert found.times[-1] == pytest.approx(when)
