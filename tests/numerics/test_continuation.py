"""Continuation: closed-form curves with folds, branch points, near misses and ends are followed as they are."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ucrit.numerics.continuation import NoConvergenceError, follow, turning


def pitchfork(y):
    x, p = y
    return np.array([p * x - x**3]), np.array([[p - 3 * x**2, x]])


@settings(max_examples=12, deadline=None)
@given(st.floats(-3, 3), st.floats(-3, 3), st.floats(0.05, 20), st.floats(0, 6.2), st.sampled_from([1, -1]))
def test_a_circle_closes_and_has_its_folds(x, y, radius, angle, sense):
    centre = np.array([x, y])

    def circle(point):
        away = point - centre
        return np.array([away @ away / radius**2 - 1]), 2 * away[None] / radius**2

    out = np.array([np.cos(angle), np.sin(angle)])
    found = follow(
        circle, centre + radius * out, sense * np.array([-out[1], out[0]]), scale=radius, tests={"fold": turning(0)}
    )
    assert found.end == "closed"
    away = found.points - centre
    np.testing.assert_allclose(np.linalg.norm(away, axis=1), radius, rtol=1e-9)
    turned = np.unwrap(np.arctan2(away[:, 1], away[:, 0]))
    assert np.all(sense * np.diff(turned) > 0)
    assert abs(turned[-1] - turned[0]) == pytest.approx(2 * np.pi)
    folds = sorted(float(c.point.y[0]) for c in found.crossings)
    np.testing.assert_allclose(folds, [x - radius, x + radius], atol=1e-9 * (1 + radius + abs(x)))


@settings(max_examples=12, deadline=None)
@given(st.floats(-2, 2), st.floats(-2, 2), st.floats(0.01, 50), st.floats(1, 5))
def test_the_fold_of_the_normal_form_is_where_it_is(x0, p0, a, reach):
    """p = p0 + a (x - x0)^2."""

    def fold(y):
        return np.array([p0 + a * (y[0] - x0) ** 2 - y[1]]), np.array([[2 * a * (y[0] - x0), -1.0]])

    start = np.array([x0 - reach, p0 + a * reach**2])
    end = {"end": lambda y: x0 + reach - y[0]}
    found = follow(fold, start, np.array([1.0, 0]), tests={"fold": turning(1)}, stops=end)
    assert found.end == "end"
    (crossing,) = found.crossings
    np.testing.assert_allclose(crossing.point.y, [x0, p0], atol=1e-6 * reach)
    np.testing.assert_allclose(found.points[-1], [x0 + reach, p0 + a * reach**2], rtol=1e-9, atol=1e-9)
    assert np.all(np.diff(found.points[:, 0]) > 0)


@pytest.mark.parametrize("start", [([0, -1.0], [0, 1.0]), ([-1.0, 1.0], [1.0, -1.0])])
def test_a_pitchfork_is_crossed_straight_and_its_branch_point_found(start):
    found = follow(pitchfork, *map(np.array, start), stops={"end": lambda y: 1.1 - y[1]})
    (branch,) = [c.point.y for c in found.crossings if c.name == "branch"]
    np.testing.assert_allclose(branch, [0, 0], atol=2e-6)
    trunk = start[0][0] == 0
    if trunk:
        assert np.all(found.points[:, 0] == 0)
    else:
        np.testing.assert_allclose(found.points[:, 1], found.points[:, 0] ** 2, atol=1e-8)
        assert found.points[-1, 0] == pytest.approx(np.sqrt(1.1))


@settings(max_examples=10, deadline=None)
@given(st.floats(-8, -1.5))
def test_a_near_miss_is_never_jumped(exponent):
    """p x - x^3 + e: two curves that come within about e^(2/3) of each other."""
    e = 10**exponent

    def split(y):
        return pitchfork(y)[0] + e, pitchfork(y)[1]

    start = np.array([e / 1.0, -1.0])
    stop = {"right": lambda y: 1 - y[1], "left": lambda y: y[1] + 1.5}
    found = follow(split, start, np.array([0, 1.0]), stops=stop)
    assert found.end == "right"
    if np.any(found.points[:, 0] <= 0):  # too near to tell them apart: then it says so
        assert e < 1e-8
        assert "branch" in [c.name for c in found.crossings]
    else:
        assert not found.crossings


def test_what_cannot_be_followed_is_named():
    def kink(y):
        return np.array([y[1] - abs(y[0])]), np.array([[-np.sign(y[0]), 1.0]])

    def wall(y):
        with np.errstate(all="ignore"):
            root = np.sqrt(1 - y[1])
            return np.array([y[0] - root]), np.array([[1.0, 0.5 / root]])

    found = follow(kink, np.array([-1.0, 1]), np.array([1.0, -1]))
    assert found.end == "failed"
    assert found.reason
    assert np.abs(found.points[-1]).max() < 1e-5
    found = follow(wall, np.array([1.0, 0]), np.array([-1.0, 1]))
    assert found.end == "failed"
    assert found.points[-1, 1] == pytest.approx(1, abs=1e-3)
    with pytest.raises(NoConvergenceError, match=r"does not converge|singular"):
        follow(lambda y: (np.array([y @ y + 1]), 2 * y[None]), np.array([1.0, 0]), np.array([0, 1.0]))


def test_a_curve_that_never_ends_stops_after_so_many_points():
    line = follow(lambda y: (y[:1] - y[1:], np.array([[1.0, -1]])), np.zeros(2), np.ones(2), points=7)
    assert (line.end, len(line.points)) == ("points", 7)


@settings(max_examples=8, deadline=None)
@given(st.lists(st.floats(-6, 6), min_size=3, max_size=3))
def test_steps_do_not_depend_on_units(powers):
    """A cubic fold curve, its unknowns and equation in other units."""
    a, b, c = (10**p for p in powers)

    def cubic(y):
        x, p = y[0] / a, y[1] / b
        return c * np.array([x**3 - x - p]), c * np.array([[(3 * x**2 - 1) / a, -1 / b]])

    def followed(f, unit):
        tests, stops = {"fold": turning(1)}, {"end": lambda y: 1.5 * unit[0] - y[0]}
        return follow(f, np.array([-1.5, -1.875]) * unit, unit, scale=unit, tests=tests, stops=stops)

    one = followed(lambda y: (np.array([y[0] ** 3 - y[0] - y[1]]), np.array([[3 * y[0] ** 2 - 1, -1.0]])), np.ones(2))
    other = followed(cubic, np.array([a, b]))
    assert len(one.points) == len(other.points)
    np.testing.assert_allclose(other.points / [a, b], one.points, rtol=1e-6, atol=1e-6)
    folds = [crossing.point.y[0] / a for crossing in other.crossings]
    np.testing.assert_allclose(folds, [-(3**-0.5), 3**-0.5], atol=1e-8)


@pytest.mark.parametrize("slope", [3.0, 0.2, -0.5, -4.0, 500.0])
def test_a_curve_goes_round_the_corner_that_a_kink_of_the_equations_makes(slope):
    """``y = x`` up to x = 1, and straight on from there with another slope, however sharp the corner is."""

    def kinked(z):
        x, y = z
        beyond = max(x - 1, 0.0)
        return np.array([y - x - (slope - 1) * beyond]), np.array([[-1 - (slope - 1) * (x > 1), 1.0]])

    found = follow(
        kinked, np.zeros(2), np.ones(2), stops={"far": lambda z: 2 - z[0], "high": lambda z: 3 - abs(z[1])}, step=0.1
    )
    assert found.end in ("far", "high")
    x, y = found.points.T
    np.testing.assert_allclose(y, np.where(x < 1, x, 1 + slope * (x - 1)), atol=1e-9)
    assert x.max() > 1.003


def test_a_stability_that_changes_at_a_corner_is_a_crossing():
    def kinked(z):
        return np.array([abs(z[0] - 1) + z[0] - 1 - z[1]]), np.array([[1 + np.sign(z[0] - 1), -1.0]])

    tests = {"steep": lambda point: abs(point.tangent[1]) - abs(point.tangent[0])}
    found = follow(kinked, np.zeros(2), np.array([1.0, 0.0]), tests=tests, stops={"far": lambda z: 2 - z[0]})
    (crossing,) = found.crossings
    assert crossing.point.y[0] == pytest.approx(1, abs=1e-4)
