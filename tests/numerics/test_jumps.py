"""Limit cycles through jumps of a law: relay oscillators of exact period and multipliers, and sliding."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import expm
from scipy.optimize import brentq

from ucrit.numerics.collocation import Field, SlidingError
from ucrit.numerics.cycle_branch import follow
from ucrit.numerics.cycle_locate import at_parameter
from ucrit.numerics.cycle_points import Hopf
from ucrit.numerics.kinks import settle
from ucrit.numerics.orbit import NODES, Metric, Orbit, Tangent, multipliers

B, C = np.array([0.0, 0, 1]), np.array([1.0, 0, 0])


def plant(poles):
    a = np.poly(poles)[1:]
    return np.array([[0, 1, 0], [0, 0, 1], [-a[2], -a[1], -a[0]]])


def relay(A):
    """Return ``x' = A x - p b sign(c x)``."""

    def rates(x, p):
        return A @ x - p * B[:, None] * np.sign(C @ x)

    def slopes(x, p):
        return np.broadcast_to(A, (x.shape[1], 3, 3)), (-B[:, None] * np.sign(C @ x)).T

    return Field(rates, slopes, lambda x, p: (C @ x)[None])


def driven(A, time):
    """Return ``exp(A t)`` and ``integral exp(A s) b ds``, by one exponential."""
    whole = expm(np.block([[A, B[:, None]], [np.zeros((1, 4))]]) * time)
    return whole[:3, :3], whole[:3, 3]


def exact(A):
    """Return half the period, the state after a switch, and the multipliers (K. J. Astrom, IMA 74 (1995) 1-25)."""

    def start(time):
        E, forced = driven(A, time)
        return np.linalg.solve(np.eye(3) + E, forced)

    half = brentq(lambda t: C @ start(t), 0.2, 60, xtol=1e-14)
    x = start(half)
    E, forced = driven(A, half)
    velocity = A @ (E @ x - forced) - B
    W = (np.eye(3) - np.outer(velocity, C) / (C @ velocity)) @ E
    squares = np.linalg.eigvals(W) ** 2
    return half, x, squares[np.argsort(-np.abs(squares))][:2]


@settings(max_examples=5, deadline=None)
@given(st.lists(st.floats(0.3, 3), min_size=3, max_size=3), st.floats(0.2, 5), st.floats(0.97, 1.03))
def test_a_relay_oscillates_with_the_exact_period_and_multipliers(poles, p, wrong):
    A = plant([-v for v in poles])
    half, x, expected = exact(A)
    mesh = np.linspace(0, 1, 41)
    times = 2 * half * (((mesh[:-1, None] + np.diff(mesh)[:, None] * NODES) + 0.29) % 1)
    states = np.array([_on(A, half, x, t) for t in times.ravel()]).reshape(*times.shape, 3)
    guess = Orbit(mesh, wrong * p * states, 2 * half * wrong, p)
    metric = Metric(np.abs(guess.values).max(axis=(0, 1)), guess.period, p)
    field = relay(A)
    found = settle(field, guess, Tangent(0 * guess.values, 0.0, 1.0, 0 * mesh), metric)
    assert found.orbit.period == pytest.approx(2 * half, rel=1e-8)
    assert found.orbit.extremes()[1][0] == pytest.approx(p * np.abs(states[..., 0]).max(), rel=1e-2)
    rest, trivial = multipliers(found.monodromy, field.rates(found.orbit.values[0, :1].T, p)[:, 0], metric.states)
    assert trivial < 1e-6
    np.testing.assert_allclose(np.poly(rest), np.poly(expected), atol=1e-6)


def _on(A, half, x, t):
    """Return the exact state a time after the switch from which the input is -b."""
    sign, t = (1, t) if t < half else (-1, t - half)
    E, forced = driven(A, t)
    return sign * (E @ x - forced)


BRAKE = 0.4


def braked():
    """Return ``x'' + x = 2 p x' - BRAKE sign(x')`` where ``abs(x) > 1``: friction that begins beyond a clearance."""

    def on(x):
        return np.abs(x[0]) > 1

    def rates(x, p):
        return np.array([x[1], -x[0] + 2 * p * x[1] - BRAKE * on(x) * np.sign(x[1])])

    def slopes(x, p):
        A = np.zeros((x.shape[1], 2, 2))
        A[:, 0, 1], A[:, 1, 0], A[:, 1, 1] = 1, -1, 2 * p
        return A, np.stack([0 * x[0], 2 * x[1]], axis=-1)

    return Field(rates, slopes, lambda x, p: np.array([np.abs(x[0]) - 1, x[1]]))


def flown(x, time, p):
    """Return the state after a time, by an event-wise exponential: exact but for where the events are."""
    A = np.array([[0, 1], [-1, 2 * p]])

    def force(state, ahead):
        return np.array([0.0, -BRAKE * np.sign(ahead[1]) * (abs(ahead[0]) > 1)])

    def moved(state, t, f):
        whole = expm(np.block([[A, f[:, None]], [np.zeros((1, 3))]]) * t)
        return whole[:2, :2] @ state + whole[:2, 2]

    def values(state):
        return np.array([state[0] - 1, state[0] + 1, state[1]])

    while time > 1e-15:
        f = force(x, moved(x, 1e-7, 0 * x))
        steps = np.linspace(1e-9, time, 50)
        signs = np.array([np.sign(values(moved(x, t, f))) for t in steps])
        turned = np.flatnonzero(np.any(signs[1:] != signs[:-1], axis=1))
        if not turned.size:
            return moved(x, time, f)
        k = turned[0]
        row = np.flatnonzero(signs[k + 1] != signs[k])[0]
        t = brentq(lambda t, x=x, f=f, row=row: values(moved(x, t, f))[row], steps[k], steps[k + 1], xtol=1e-15)
        x, time = moved(x, t, f), time - t
    return x


def test_multipliers_of_a_branch_through_jumps_are_those_of_the_flow():
    """From the Hopf point, where all is linear, to cycles with six crossings; two are kinks' as well as jumps'."""
    field = braked()
    branch = follow(field, Hopf(0.0, np.zeros(2), 1.0, np.array([1, 1j])), -0.5, 0.055)
    assert branch.end == "range"
    p = 0.05
    a, b = next(
        (a, b)
        for a, b in zip(branch.points, branch.points[1:], strict=False)
        if a.orbit.parameter < p <= b.orbit.parameter
    )
    found = at_parameter(field, a, b, p)
    x, step = found.orbit.values[0, 0], 1e-6
    np.testing.assert_allclose(flown(x, found.orbit.period, p), x, atol=1e-7)
    flow = np.array(
        [
            (flown(x + d, found.orbit.period, p) - flown(x - d, found.orbit.period, p)) / (2 * step)
            for d in step * np.eye(2)
        ]
    ).T
    assert found.multipliers[0] == pytest.approx(np.linalg.det(flow), rel=1e-5)
    assert found.trivial < 1e-7
    assert found.error < 1e-6


def test_a_branch_whose_cycles_grow_for_ever_ends():
    """Beyond the fold the friction matters less and less, and the parameter goes to zero."""
    branch = follow(braked(), Hopf(0.0, np.zeros(2), 1.0, np.array([1, 1j])), -0.5, 0.08)
    assert branch.end == "endless"
    (fold,) = branch.folds
    work, gain = 4 * BRAKE * (2 - 1), 2 * np.pi * 2**2  # of a sine of amplitude 2
    assert fold.orbit.parameter == pytest.approx(work / gain, rel=2e-2)


def test_a_cycle_that_would_slide_is_refused():
    """``x' = y - sign(x)`` and ``y' = -x``: on x = 0 both sides push back wherever abs(y) < 1."""

    def rates(x, p):
        return np.array([x[1] + p * x[0] - 2 * np.sign(x[0]), -x[0]])

    def slopes(x, p):
        return np.broadcast_to([[p, 1.0], [-1, 0]], (x.shape[1], 2, 2)), np.stack([x[0], 0 * x[0]], axis=-1)

    mesh = np.linspace(0, 1, 21)
    angle = 2 * np.pi * (mesh[:-1, None] + np.diff(mesh)[:, None] * NODES) + 0.4
    guess = Orbit(mesh, np.stack([np.sin(angle), np.cos(angle)], axis=-1), 2 * np.pi, 0.1)
    field = Field(rates, slopes, lambda x, p: x[:1])
    with pytest.raises(SlidingError):
        settle(field, guess, Tangent(0 * guess.values, 0.0, 1.0, 0 * mesh), Metric(np.ones(2), 6.0, 1.0))
