"""Branches of periodic solutions: normal forms whose amplitudes, folds and multipliers are known in closed form."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from ucrit.numerics.collocation import Field
from ucrit.numerics.cycle_branch import follow, follow_both_ways, settled
from ucrit.numerics.cycle_locate import at_parameter
from ucrit.numerics.cycle_points import Hopf
from ucrit.numerics.orbit import NODES, Orbit


def rotating(growth, growth_slope, by_parameter, omega, shear=0.0):
    """Return ``r' = r g(r^2, p)``, ``phi' = omega + shear r^2`` in the plane; slopes of g by r^2 and p are given."""

    def turn(x, p):
        square = x[0] ** 2 + x[1] ** 2
        return square, growth(square, p), omega + shear * square

    def rates(x, p):
        _, g, w = turn(x, p)
        return np.array([g * x[0] - w * x[1], w * x[0] + g * x[1]])

    def slopes(x, p):
        square, g, w = turn(x, p)
        d, e = 2 * growth_slope(square, p), 2 * shear
        A = np.empty((x.shape[1], 2, 2))
        A[:, 0, 0] = g + x[0] * (d * x[0]) - x[1] * e * x[0]
        A[:, 0, 1] = -w + x[0] * (d * x[1]) - x[1] * e * x[1]
        A[:, 1, 0] = w + x[1] * (d * x[0]) + x[0] * e * x[0]
        A[:, 1, 1] = g + x[1] * (d * x[1]) + x[0] * e * x[1]
        b = by_parameter(square, p)
        return A, np.stack([b * x[0], b * x[1]], axis=-1)

    return Field(rates, slopes)


def hopf(omega, at=0.0):
    return Hopf(at, np.zeros(2), omega, np.array([1, -1j]))


def quintic(a, b, omega, shear):
    """Return the field of ``g = p + a r^2 - b r^4``."""
    return rotating(lambda q, p: p + a * q - b * q**2, lambda q, p: a - 2 * b * q, lambda q, p: 1 + 0 * q, omega, shear)


def radius(point):
    return float(point.orbit.extremes()[1][0])


@settings(max_examples=12, deadline=None)
@given(
    a=st.floats(0.3, 3),
    b=st.floats(0.3, 3),
    omega=st.floats(0.5, 50),
    shear=st.floats(-0.1, 0.1),
    sign=st.sampled_from([-1, 1]),
)
def test_the_quintic_normal_form(a, b, omega, shear, sign):
    a *= sign
    depth = a * a / (4 * b)
    branch = follow(quintic(a, b, omega, shear * omega), hopf(omega), -2 * depth, 2 * depth)
    assert branch.end == "range"
    assert branch.points[-1].orbit.parameter == pytest.approx(2 * depth, rel=1e-9)
    for point in branch.points:
        r, p = radius(point), point.orbit.parameter
        assert p + a * r**2 - b * r**4 == pytest.approx(0, abs=1e-7 * (depth + abs(p)))
        assert point.orbit.period == pytest.approx(2 * math.pi / abs(omega + shear * omega * r**2), rel=1e-8)
        exponent = 2 * a * r**2 - 4 * b * r**4
        expected = math.exp(exponent * point.orbit.period)
        assert point.multipliers[0] == pytest.approx(expected, rel=1e-5, abs=1e-8)
        assert point.trivial < 1e-6
        if not point.fold and abs(expected - 1) > 1e-4:
            assert point.stable == (exponent < 0)
    first = branch.points[0].orbit.parameter
    assert (first < 0) == (a > 0)  # subcritical where the cubic term drives
    assert len(branch.folds) == (a > 0)
    for fold in branch.folds:
        assert fold.orbit.parameter == pytest.approx(-depth, rel=1e-8)
        assert radius(fold) ** 2 == pytest.approx(a / (2 * b), rel=1e-4)


@settings(max_examples=8, deadline=None)
@given(alpha=st.floats(0.01, 100), value=st.floats(0.05, 0.95))
def test_the_amplitude_at_a_value_of_the_parameter(alpha, value):
    field = rotating(lambda q, p: p - alpha * q, lambda q, p: -alpha + 0 * q, lambda q, p: 1 + 0 * q, 3.0)
    branch = follow(field, hopf(3.0), -1.0, 1.0)
    pairs = zip(branch.points, branch.points[1:], strict=False)
    (p, q), *others = [(p, q) for p, q in pairs if p.orbit.parameter < value <= q.orbit.parameter]
    assert not others
    found = at_parameter(field, p, q, value)
    assert found.orbit.parameter == value
    assert radius(found) == pytest.approx(math.sqrt(value / alpha), rel=1e-6)


def test_a_branch_may_end_in_another_equilibrium():
    """``g = p (1 - p) - r^2``: cycles between p = 0 and 1 alone."""
    field = rotating(lambda q, p: p * (1 - p) - q, lambda q, p: -1 + 0 * q, lambda q, p: 1 - 2 * p + 0 * q, 5.0)
    branch = follow(field, hopf(5.0), -1.0, 3.0)
    assert branch.end == "equilibrium"
    assert branch.points[-1].orbit.parameter == pytest.approx(1, abs=1e-2)
    assert max(radius(point) for point in branch.points) == pytest.approx(0.5, rel=1e-2)
    assert not branch.folds


def test_the_cycles_of_a_linear_field_are_not_followed():
    field = rotating(lambda q, p: p + 0 * q, lambda q, p: 0 * q, lambda q, p: 1 + 0 * q, 5.0)
    assert follow(field, hopf(5.0), -1.0, 1.0) is None


def test_progress_is_told():
    told = []
    branch = follow(quintic(-1, 1, 2.0, 0), hopf(2.0), -1.0, 1.0, progress=lambda *done: told.append(done))
    assert [done for done, _ in told] == sorted({done for done, _ in told})
    assert told[-1][0] <= len(branch.points) <= told[-1][1]


def test_a_cusped_law_has_a_straight_branch():
    """``g = p - r``: the amplitude grows in proportion to the parameter, as with laws that bend like ``abs(v) v``."""
    field = rotating(
        lambda q, p: p - np.sqrt(q), lambda q, p: -0.5 / np.sqrt(np.maximum(q, 1e-300)), lambda q, p: 1 + 0 * q, 4.0
    )
    branch = follow(field, hopf(4.0), -0.5, 0.5)
    assert branch.end == "range"
    for point in branch.points:
        assert radius(point) == pytest.approx(point.orbit.parameter, rel=1e-6)


def roessler():
    """Return right-hand side and slopes of ``x' = -y - z``, ``y' = x + a y``, ``z' = 0.2 + z (x - 4)``."""

    def rates(x, a):
        return np.array([-x[1] - x[2], x[0] + a * x[1], 0.2 + x[2] * (x[0] - 4)])

    def slopes(x, a):
        A = np.zeros((x.shape[1], 3, 3))
        A[:, 0, 1] = A[:, 0, 2] = -1
        A[:, 1, 0], A[:, 1, 1] = 1, a
        A[:, 2, 0], A[:, 2, 2] = x[2], x[0] - 4
        return A, np.stack([0 * x[0], x[1], 0 * x[0]], axis=-1)

    return Field(rates, slopes)


def roessler_hopf(field):
    """Return where the lower equilibrium has a pair on the imaginary axis."""

    def equilibrium(a):
        z = (4 - math.sqrt(16 - 0.8 * a)) / (2 * a)
        return np.array([a * z, -z, z])

    def routh(a):
        c = np.poly(field.slopes(equilibrium(a)[:, None], a)[0][0])
        return c[1] * c[2] - c[3]

    a = brentq(routh, 1e-4, 0.3, xtol=1e-15)
    values, vectors = np.linalg.eig(field.slopes(equilibrium(a)[:, None], a)[0][0])
    k = int(np.argmax(values.imag))
    return Hopf(a, equilibrium(a), values[k].imag, vectors[:, k])


def test_a_period_doubling_is_flagged_and_its_multiplier_is_that_of_the_variational_equations():
    field = roessler()
    branch = follow(field, roessler_hopf(field), 0.0, 0.25)
    (kind, near), *_ = branch.events
    assert kind == "period doubling"
    pairs = zip(branch.points, branch.points[1:], strict=False)
    p, q = next((p, q) for p, q in pairs if p.orbit.parameter <= near <= q.orbit.parameter)
    found = at_parameter(field, p, q, near)

    def variational(t, w):
        A, _ = field.slopes(w[:3, None], near)
        return np.concatenate([field.rates(w[:3, None], near)[:, 0], (A[0] @ w[3:].reshape(3, 3)).ravel()])

    first = np.concatenate([found.orbit.at(np.array([0.0]))[:, 0], np.eye(3).ravel()])
    run = solve_ivp(variational, (0, found.orbit.period), first, method="DOP853", rtol=1e-10, atol=1e-10)
    expected = np.linalg.eigvals(run.y[3:, -1].reshape(3, 3))
    least = expected[np.argmin(np.abs(expected + 1))]
    assert least == pytest.approx(-1, abs=0.2)
    assert found.multipliers[0] == pytest.approx(least, rel=1e-5)


def test_a_closed_branch_is_followed_round_from_any_of_its_cycles():
    """``g = 1/4 - (r^2 - 1)^2 - p^2``: no equilibrium begins to oscillate, and the cycles are a closed curve."""
    field = rotating(
        lambda q, p: 0.25 - (q - 1) ** 2 - p**2, lambda q, p: -2 * (q - 1), lambda q, p: -2 * p + 0 * q, 3.0
    )
    mesh = np.linspace(0, 1, 21)
    shares = mesh[:-1, None] + np.diff(mesh)[:, None] * NODES
    wave = 1.2 * np.stack([np.cos(2 * np.pi * shares), np.sin(2 * np.pi * shares)], axis=-1)
    first = settled(field, Orbit(mesh, wave, 2.0, 0.1), -1.0, 1.0)
    branch, place = follow_both_ways(field, first, -1.0, 1.0)
    assert (branch.begin, branch.end, place) == ("closed", "closed", 0)
    assert branch.points[0].orbit.parameter == 0.1
    for point in branch.points:
        q, p = radius(point) ** 2, point.orbit.parameter
        assert (q - 1) ** 2 + p**2 == pytest.approx(0.25, abs=1e-6)
    assert sorted(p.orbit.parameter for p in branch.folds) == pytest.approx([-0.5, 0.5], abs=1e-7)
