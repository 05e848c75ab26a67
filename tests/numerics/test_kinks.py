"""Limit cycles of laws with kinks: a piecewise linear oscillator of known period and multipliers."""

import mpmath as mp
import numpy as np
import pytest

from ucrit.numerics.collocation import Field
from ucrit.numerics.cycle_branch import follow
from ucrit.numerics.cycle_locate import at_parameter
from ucrit.numerics.cycle_points import Hopf
from ucrit.numerics.kinks import kinks, snapped
from ucrit.numerics.orbit import adapted_mesh

DAMPED = 1.5


def oscillator():
    """Return ``x' = y - F(x)``, ``y' = -x`` with the slope -p of F within ``abs(x) < 1`` and `DAMPED` beyond."""

    def rates(x, p):
        inner = np.clip(x[0], -1, 1)
        return np.array([x[1] + p * inner - DAMPED * (x[0] - inner), -x[0]])

    def slopes(x, p):
        A = np.zeros((x.shape[1], 2, 2))
        A[:, 0, 0], A[:, 0, 1], A[:, 1, 0] = np.where(np.abs(x[0]) < 1, p, -DAMPED), 1, -1
        return A, np.stack([np.clip(x[0], -1, 1), 0 * x[0]], axis=-1)

    return Field(rates, slopes, lambda x, p: np.abs(x[:1]) - 1)


def exact(p):
    """Return period and multiplier by matrix exponentials, the times in both zones solved for to 30 digits."""
    with mp.workdps(30):
        inner, outer = mp.matrix([[p, 1], [-1, 0]]), mp.matrix([[-DAMPED, 1], [-1, 0]])
        rest = mp.matrix([0, -(p + DAMPED)])  # where the outer zone's lines would rest

        def half(y, beyond, within):
            there = mp.expm(outer * beyond) * (mp.matrix([1, y]) - rest) + rest
            return there, mp.expm(inner * within) * there

        def misses(y, beyond, within):
            there, end = half(y, beyond, within)
            return [there[0] - 1, end[0] + 1, end[1] + y]

        _, beyond, within = mp.findroot(misses, (mp.mpf(1) / 2 + p, mp.mpf(2), mp.mpf(1)))
        assert beyond > 0 < within
        return 2 * (beyond + within), mp.exp(2 * (p * within - DAMPED * beyond))


@pytest.fixture(scope="module")
def branch():
    return follow(oscillator(), Hopf(0.0, np.zeros(2), 1.0, np.array([1, 1j])), -0.5, 1.5)


@pytest.mark.parametrize("p", [0.2, 0.7, 1.3])
def test_period_and_multiplier_of_the_piecewise_linear_oscillator(branch, p):
    period, multiplier = exact(p)
    a, b = next(
        (a, b)
        for a, b in zip(branch.points, branch.points[1:], strict=False)
        if a.orbit.parameter < p <= b.orbit.parameter
    )
    found = at_parameter(oscillator(), a, b, p)
    assert found.orbit.period == pytest.approx(float(period), rel=1e-9)
    assert found.multipliers[0] == pytest.approx(float(multiplier), rel=1e-7)
    assert found.trivial < 1e-7
    assert found.error < 1e-6
    assert len(found.orbit.widths) < 80


def test_the_mesh_holds_the_kinks(branch):
    for point in branch.points[3:]:
        shares = kinks(oscillator(), point.orbit)
        assert len(shares) == 4
        assert set(shares) <= set(point.orbit.mesh)
        assert set(shares) <= set(adapted_mesh(point.orbit, point.metric.states, 30, shares))


def test_kinks_are_put_on_a_mesh_without_passing_its_points():
    mesh = snapped(np.linspace(0, 1, 11), np.array([0.01, 0.02, 0.31, 0.32, 0.55]))
    assert {0.01, 0.02, 0.31, 0.32, 0.55} <= set(mesh)
    assert np.all(np.diff(mesh) > 0)
    assert (mesh[0], mesh[-1]) == (0, 1)
