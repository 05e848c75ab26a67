"""Periodic solutions by collocation: van der Pol's oscillator against integration, series and Liouville's formula."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from ucrit.numerics.collocation import Field, correct, error
from ucrit.numerics.orbit import NODES, Metric, Orbit, Tangent, adapted_mesh, multipliers

METRIC = Metric(np.array([2.0, 2.0]), 6.0, 1.0)


def rates(x, mu):
    return np.array([x[1], mu * (1 - x[0] ** 2) * x[1] - x[0]])


def slopes(x, mu):
    A = np.zeros((x.shape[1], 2, 2))
    A[:, 0, 1], A[:, 1, 0], A[:, 1, 1] = 1, -2 * mu * x[0] * x[1] - 1, mu * (1 - x[0] ** 2)
    return A, np.stack([0 * x[0], (1 - x[0] ** 2) * x[1]], axis=-1)


VAN_DER_POL = Field(rates, slopes)


def solved(mu, intervals, adaptations=0):
    """Return the limit cycle found from the circle of small mu, in steps of mu."""
    mesh = np.linspace(0, 1, intervals + 1)
    angle = 2 * np.pi * (mesh[:-1, None] + np.diff(mesh)[:, None] * NODES)
    found = Orbit(mesh, np.stack([2 * np.cos(angle), -2 * np.sin(angle)], axis=-1), 2 * np.pi, 0.0)
    steps = [*np.arange(0.5, mu, 0.5), mu, *[mu] * adaptations]
    for number, value in enumerate(steps):
        if number >= len(steps) - adaptations:
            found = found.on(adapted_mesh(found, METRIC.states, intervals))
        guess = Orbit(found.mesh, found.values, found.period, value)
        result = correct(VAN_DER_POL, guess, Tangent(0 * guess.values, 0.0, 1.0, 0 * guess.mesh), METRIC)
        found = result.orbit
    return result


def integrated(mu):
    """Return period and a dense solution from an upward crossing of x' = 0, by integration to thirteen digits."""

    def crossing(t, x):
        return x[1]

    crossing.direction = -1
    run = solve_ivp(
        lambda t, x: rates(x, mu), (0, 80), [2.0, 0.0], method="DOP853", rtol=1e-13, atol=1e-13, events=crossing,
        dense_output=True,
    )  # fmt: skip
    *_, before, last = run.t_events[0]
    return last - before, lambda times: run.sol(before + np.mod(times, last - before))


@pytest.mark.parametrize("mu", [0.3, 1.0, 4.0])
def test_the_period_and_the_states_are_those_of_integration(mu):
    period, states = integrated(mu)
    found = solved(mu, 60, adaptations=3).orbit
    assert found.period == pytest.approx(period, rel=2e-9)
    assert found.extremes()[1][0] == pytest.approx(states(0)[0], abs=4 * error(VAN_DER_POL, found, METRIC.states))


def test_the_period_of_small_mu_is_the_series():
    mu = 0.1
    series = 2 * math.pi * (1 + mu**2 / 16 - 5 * mu**4 / 3072)
    assert solved(mu, 30).orbit.period == pytest.approx(series, abs=20 * mu**6)
    assert solved(mu, 30).orbit.period != pytest.approx(2 * math.pi * (1 + mu**2 / 16), abs=1e-7)


def test_the_period_converges_with_order_eight():
    exact, _ = integrated(1.0)
    coarse, fine = (abs(solved(1.0, N).orbit.period - exact) for N in (20, 40))
    assert math.log2(coarse / fine) > 7


@pytest.mark.parametrize("mu", [0.3, 1.0, 2.0])
def test_the_multiplier_is_liouvilles(mu):
    found = solved(mu, 60, adaptations=2)
    (multiplier,), trivial = multipliers(
        found.monodromy, VAN_DER_POL.rates(found.orbit.values[0, :1].T, mu)[:, 0], METRIC.states
    )
    shares = np.linspace(0, 1, 20001)
    divergence = mu * (1 - found.orbit.at(shares)[0] ** 2)
    assert multiplier == pytest.approx(math.exp(found.orbit.period * np.trapezoid(divergence, shares)), rel=1e-6)
    assert trivial < 1e-8


@pytest.mark.parametrize("intervals", [8, 16, 32])
@pytest.mark.parametrize("adaptations", [0, 3])
def test_the_estimated_error_is_that_of_the_states(intervals, adaptations):
    found = solved(1.0, intervals, adaptations).orbit
    period, states = integrated(1.0)
    shares = np.linspace(0, 1, 4001)
    there = states(shares * period)
    apart = [np.abs(np.linalg.norm((there - state[:, None]), axis=0)).min() for state in found.at(shares[::20]).T]
    nearest = 0.5 * np.linalg.norm(np.diff(there), axis=0).max()  # half the spacing of the comparison
    estimate = error(VAN_DER_POL, found, METRIC.states)
    assert max(apart) <= 4 * estimate + nearest
    fine = solved(1.0, 80, 3).orbit
    measured = abs(found.extremes()[1] - fine.extremes()[1]).max() / 2
    assert measured < 2 * estimate


def test_a_mesh_is_fine_where_the_motion_is_quick():
    found = solved(4.0, 60, adaptations=3).orbit
    speed = np.abs(found.at(found.mesh[:-1])[1])
    assert found.widths[np.argmax(speed)] < 0.3 * found.widths.max()
    assert error(VAN_DER_POL, found, METRIC.states) < 0.02 * error(VAN_DER_POL, solved(4.0, 60).orbit, METRIC.states)


def test_no_solution_is_none():
    mesh = np.linspace(0, 1, 11)
    nothing = Orbit(mesh, np.full((10, 5, 2), np.nan), 6.0, 1.0)
    assert correct(VAN_DER_POL, nothing, Tangent(0 * nothing.values, 0.0, 1.0, 0 * nothing.mesh), METRIC) is None
