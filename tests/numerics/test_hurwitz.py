"""Vectorised stability and root counts against exact arithmetic and eigenvalues."""

import math
from fractions import Fraction
from functools import reduce

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ucrit.numerics.exact import multiply
from ucrit.numerics.hurwitz import right_half_plane, stable
from ucrit.numerics.routh import routh

COEFFICIENT = st.integers(-3, 6) | st.floats(1e-3, 1e3) | st.floats(-10, 10)


@settings(max_examples=300, deadline=None)
@given(st.lists(COEFFICIENT, min_size=2, max_size=10).filter(lambda a: a[-1] != 0))
def test_count_equals_exact_count(a):
    exact = routh(a)
    assert int(right_half_plane(a)) == exact.right_half_plane
    if len(a) not in (4, 5) or all(float(c).is_integer() for c in a):
        assert bool(stable(a)) == (exact.right_half_plane == 0 == exact.imaginary_axis)


SIMPLE = [
    [0, 1],
    [1, 0, 1],
    [4, 0, 1],
    [1, 1],
    [2, 1],
    [-1, 1],
    [-3, 1],
    [2, 2, 1],
    [2, -2, 1],
    [5, -2, 1],
    [10, 2, 1],
]


@settings(max_examples=300, deadline=None)
@given(st.lists(st.sampled_from(SIMPLE), min_size=1, max_size=4), st.integers(-20, 20), st.integers(-5, 5))
def test_roots_on_the_axis_are_not_right_of_it(parts, whole, scale):
    a = reduce(multiply, parts)
    exact = routh(a)
    scaled = [float(Fraction(c) * Fraction(2) ** whole * Fraction(2) ** (12 * scale * k)) for k, c in enumerate(a)]
    assert right_half_plane(scaled) == exact.right_half_plane
    assert bool(stable(a)) == (exact.right_half_plane == 0 == exact.imaginary_axis)


@pytest.mark.parametrize("n", range(1, 10))
@pytest.mark.parametrize("spread", [0, 20])
def test_many_polynomials_at_once_equal_the_exact_counts(n, spread):
    source = np.random.default_rng(n)
    a = source.normal(size=(150, n + 1)) * 10.0 ** source.uniform(-spread, spread, size=(150, n + 1))
    half = a[:75]
    half[:] = np.abs(half)
    exact = [routh(row) for row in a]
    assert right_half_plane(a).tolist() == [array.right_half_plane for array in exact]
    assert stable(a.T).tolist() == [array.right_half_plane == 0 for array in exact]


@pytest.mark.parametrize("n", range(2, 9))
def test_known_roots_give_their_count(n):
    source = np.random.default_rng(n)
    points = 400
    real = source.normal(size=(points, n))
    a = np.ones((points, 1))
    for k in range(n):
        a = np.pad(a, [(0, 0), (1, 0)]) - real[:, k : k + 1] * np.pad(a, [(0, 0), (0, 1)])
    assert (right_half_plane(a) == (real > 0).sum(axis=1)).all()
    left = np.ones((points, 1))
    for k in range(n):
        left = np.pad(left, [(0, 0), (1, 0)]) + np.abs(real[:, k : k + 1]) * np.pad(left, [(0, 0), (0, 1)])
    assert stable(left.T).all()
    assert stable(-left.T).all()


@pytest.mark.parametrize("n", range(1, 8))
@pytest.mark.parametrize("factor", [1e-20, 1e20])
def test_bad_scaling(n, factor):
    # Roots -1 ... -n and +1 -2 ... -n times `factor`; coefficients span factor^n, to 1e-140 and 1e140.
    for first in (-1, 1):
        a = reduce(multiply, [[-first, 1], *[[k, 1] for k in range(2, n + 1)]])
        scaled = [float(c * Fraction(factor) ** (n - k)) for k, c in enumerate(a)]
        if max(map(abs, scaled)) < 1e100 and min(map(abs, scaled)) > 1e-100:
            assert bool(stable(scaled)) == (first < 0)
            assert right_half_plane(scaled) == (first > 0)


def test_roots_of_very_different_size():
    # -1e-20, -1, -1e20 and their mirror images
    for signs in [(1, 1, 1), (-1, 1, 1), (1, 1, -1), (-1, -1, -1)]:
        roots = [Fraction(s) * Fraction(10) ** e for s, e in zip(signs, (-20, 0, 20), strict=True)]
        a = [float(c) for c in reduce(multiply, [[x, 1] for x in roots])]
        assert right_half_plane(a) == sum(s < 0 for s in signs)
        assert bool(stable(a)) == all(s > 0 for s in signs)


@pytest.mark.parametrize("n", range(1, 8))
def test_marginal_is_not_stable(n):
    for parts in ([[0, 1]], [[1, 0, 1]]):
        a = reduce(multiply, [*parts, *[[1, 1]] * (n - len(parts[0]) + 1)])
        if len(a) == n + 1:
            assert not stable(a)
            assert right_half_plane(a) == 0


@pytest.mark.parametrize("n", range(1, 8))
def test_broadcasting_and_blocks_change_nothing(n):
    source = np.random.default_rng(n)
    shapes = [(), (300, 1), (1, 400), (300, 400), (400,), (1, 1)]
    a = [source.uniform(0.5, 4, size=shapes[k % 6]) for k in range(n + 1)]
    a[source.integers(n + 1)] *= -1.0 if n % 2 else 1.0
    dense = np.stack([np.broadcast_to(x, (300, 400)) for x in a], axis=-1)
    result = stable([*a, np.ones((300, 400))])
    assert result.shape == (300, 400)
    with_lead = np.concatenate([dense, np.ones((300, 400, 1))], axis=-1)
    assert (result == (right_half_plane(with_lead) == 0)).all()
    assert (result[7, 11], result[299, 399]) == (stable(with_lead[7, 11]), stable(with_lead[299, 399]))


@pytest.mark.parametrize("n", range(1, 7))
def test_points_without_an_answer_are_not_stable(n):
    a = np.ones(n + 1)
    for k in range(n + 1):
        assert not stable(np.where(np.arange(n + 1) == k, math.nan, a))
    assert stable([*[math.comb(n, k) for k in range(n)], [1.0, 0.0, -1.0]]).tolist() == [True, False, False]


def test_undamped_and_shape():
    a = np.broadcast_to([4.0, 0.0, 5.0, 0.0, 1.0], (3, 2, 5))
    assert right_half_plane(a).shape == (3, 2)
    assert not right_half_plane(a).any()
    assert right_half_plane([[7.0], [-7.0]]).tolist() == [0, 0]


@pytest.mark.parametrize("bad", [3.0, [], [[1, 0]], [[1, math.nan]], [[math.inf, 1]]])
def test_bad_coefficients_are_refused(bad):
    with pytest.raises(ValueError, match=r"coefficient"):
        right_half_plane(bad)


def test_too_few_coefficients_are_refused():
    with pytest.raises(ValueError, match="degree one or more"):
        stable([1.0])


@settings(max_examples=200, deadline=None)
@given(
    st.lists(st.tuples(st.integers(-2, 3), st.integers(-300, 290)), min_size=2, max_size=8).filter(lambda a: a[-1][0])
)
def test_any_doubles_are_counted_exactly(terms):
    a = [c * 10.0**e for c, e in terms]
    assert right_half_plane(a) == routh(a).right_half_plane
    if len(a) > 5:
        array = routh(a)
        assert bool(stable(a)) == (array.right_half_plane == 0 == array.imaginary_axis)
