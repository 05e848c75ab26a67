"""Branches of eigenvalues against families whose branches are known."""

import time

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from scipy.optimize import linear_sum_assignment

from ucrit.numerics.assignment import assign
from ucrit.numerics.tracking import refine_where, track, track_adaptive


def is_permutation(rows):
    return (np.sort(rows, axis=1) == np.arange(rows.shape[1])).all()


def shuffled(branches, vectors, seed):
    """Every row in random order; the order that restores the branches up to a constant permutation."""
    order = np.argsort(np.random.default_rng(seed).random(branches.shape), axis=1)
    columns = None if vectors is None else np.take_along_axis(vectors, order[:, None, :], axis=2)
    return np.take_along_axis(branches, order, axis=1), columns, order


def follows(permutation, order):
    """Whether every tracked branch is one and the same true branch at every point."""
    return (np.take_along_axis(order, permutation, axis=1) == order[0]).all()


COSTS = st.integers(1, 6).flatmap(lambda n: hnp.arrays(float, (20, n, n), elements=st.integers(0, 3).map(float)))


@settings(max_examples=100, deadline=None)
@given(COSTS)
def test_assignment_is_optimal(cost):
    links = assign(cost)
    assert is_permutation(links)
    for matrix, link in zip(cost, links, strict=True):
        assert matrix[np.arange(len(link)), link].sum() == matrix[linear_sum_assignment(matrix)].sum()


JUNK = st.sampled_from([0.0, 1.0, -1.0, 1e-20, 1e20, 1.0 + 1e-9]) | st.floats(-1e20, 1e20)


@settings(max_examples=200, deadline=None)
@given(
    st.tuples(st.integers(1, 12), st.integers(1, 6)).flatmap(
        lambda s: st.tuples(*[hnp.arrays(float, s, elements=JUNK)] * 2)
    )
)
def test_every_row_is_a_permutation_whatever_comes(parts):
    values = parts[0] + 1j * parts[1]
    tracked = track(values)
    assert is_permutation(tracked.permutation)
    assert (np.sort(tracked.branches, axis=1) == np.sort(values, axis=1)).all()
    assert refine_where(values, tracked.permutation).shape == (len(values) - 1,)
    assert is_permutation(track(parts[0]).permutation)


@settings(max_examples=100, deadline=None)
@given(
    st.lists(st.tuples(st.integers(-40, 40), st.integers(-40, 40)), min_size=2, max_size=5, unique=True),
    st.integers(0, 2**32 - 1),
    st.sampled_from([1e-20, 1.0, 1e20]),
)
def test_real_lines_cross_with_vectors(lines, seed, scale):
    if len({slope for _, slope in lines}) < len(lines):
        return
    p = np.linspace(-1.0, 1.013, 157)
    branches = np.array([start + slope * p for start, slope in lines]).T * scale
    n = len(lines)
    basis = np.linalg.qr(np.random.default_rng(seed).normal(size=(n, n)))[0]
    values, vectors, order = shuffled(branches, np.broadcast_to(basis, (len(p), n, n)), seed)
    assert follows(track(values, vectors, p).permutation, order)


@pytest.mark.parametrize("scale", [1e-20, 1.0, 1e20])
def test_real_lines_cross_by_their_slopes_alone(scale):
    p = np.linspace(-1, 1, 200)
    branches = np.stack([3 * p, -2 * p, 1 + 0 * p, 0.5 - p], axis=1) * scale
    values, _, order = shuffled(branches, None, 1)
    assert follows(track(values).permutation, order)


def test_crossing_exactly_at_a_point_and_halfway():
    for p in (np.arange(-5.0, 6.0), np.arange(-5.5, 6.0)):
        values = np.sort(np.stack([p, -p], axis=1), axis=1)
        branches = track(values).branches.real
        assert (branches == np.stack([p, -p], axis=1)).all() or (branches == np.stack([-p, p], axis=1)).all()


def test_unequal_steps():
    p = np.cumsum(np.tile([0.1, 0.4, 0.02], 30)) - 7
    values = np.sort(np.stack([p, 2 - p, -20 + p**2], axis=1), axis=1)
    tracked = track(values, parameter=p).branches.real
    slopes = np.diff(tracked[:, np.argsort(tracked[0])], axis=0) / np.diff(p)[:, None]
    assert np.abs(np.diff(slopes, axis=0)).max() < 2.0


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_complex_pairs_keep_their_sides_and_their_identity(seed):
    source = np.random.default_rng(seed)
    p = np.linspace(0, 1, 400)
    c = source.normal(size=(2, 4))
    pairs = [c[k, 0] + c[k, 1] * np.sin(2 * p + c[k, 2]) + 1j * (2 * k + 2 + np.cos(3 * p + c[k, 3])) for k in (0, 1)]
    real = source.normal() + np.cos(4 * p)
    branches = np.stack([pairs[0], pairs[0].conj(), pairs[1], pairs[1].conj(), real], axis=1)
    values, _, order = shuffled(branches, None, seed)
    assert follows(track(values).permutation, order)


def no_side_is_swapped(branches):
    return not (np.sign(branches[1:].imag) * np.sign(branches[:-1].imag) < 0).any()


@pytest.mark.parametrize("points", [20, 21, 1000])
def test_real_pairs_that_turn_complex_and_back(points):
    p = np.linspace(-2, 2, points)
    root = np.emath.sqrt(np.sin(3 * p))
    values = np.stack([root, -root, -1 + 0 * p, 0 * p, 0 * p], axis=1).astype(complex)
    values, _, _ = shuffled(values, None, 3)
    tracked = track(values)
    assert is_permutation(tracked.permutation)
    assert no_side_is_swapped(tracked.branches)
    assert (np.ptp(tracked.branches, axis=0) == 0).sum() >= (3 if points == 1000 else 1)


@settings(max_examples=100, deadline=None)
@given(
    st.lists(
        st.lists(st.tuples(st.floats(-3, 3), st.sampled_from([0.0, 0.3, 1.0])), min_size=3, max_size=3),
        min_size=2,
        max_size=9,
    )
)
def test_sides_are_kept_in_any_real_spectra(rows):
    values = [[x + 1j * y for x, y in row] + [x - 1j * y for x, y in row] for row in rows]
    tracked = track(values)
    assert is_permutation(tracked.permutation)
    assert no_side_is_swapped(tracked.branches)


def test_complex_matrices_may_cross_the_real_axis():
    p = np.linspace(-1, 1, 21)
    values = np.stack([1j * p, 5 - 1j * p], axis=1)
    assert follows(track(values).permutation, np.tile([0, 1], (21, 1)))


def test_double_zeros_stay_and_are_not_in_doubt():
    p = np.linspace(1, 2, 50)
    values = np.stack([0 * p, -p, 0 * p, -p - 3 * p**2], axis=1)
    values, _, order = shuffled(values, None, 5)
    tracked = track(values)
    kinds = np.array([0, 1, 0, 3])
    assert follows(tracked.permutation, kinds[order])
    assert not refine_where(values, tracked.permutation).any()
    noisy = values + 1e-9 * np.random.default_rng(1).normal(size=values.shape)
    assert not refine_where(noisy, track(noisy).permutation).any()


def test_units_of_the_states_do_not_matter():
    p = np.linspace(-1, 1.01, 50)
    basis = np.random.default_rng(2).normal(size=(3, 3)) * np.array([[1e-12], [1.0], [1e12]])
    branches = np.stack([p, -p, 3 * p], axis=1)
    values, vectors, order = shuffled(branches, np.broadcast_to(basis, (50, 3, 3)), 2)
    assert follows(track(values, vectors).permutation, order)


def affine_family(seed, n=4):
    source = np.random.default_rng(seed)
    a, b = source.normal(size=(2, n, n))
    return lambda p: np.linalg.eig(a + p[:, None, None] * b)


@pytest.mark.parametrize("seed", range(100))
def test_random_families_have_no_jumps(seed):
    family = affine_family(seed)
    p = np.linspace(-2, 2, 4001)
    values, vectors = family(p)
    for tracked in (track(values), track(values, vectors, p)):
        assert is_permutation(tracked.permutation)
        assert (np.sort(tracked.branches, axis=1) == np.sort(values, axis=1)).all()
        assert no_side_is_swapped(tracked.branches)
        # Generic branches do not cross: the true continuation is the one of least total squared movement.
        step = np.abs(np.diff(tracked.branches, axis=0)) ** 2
        square = np.abs(values[1:, None, :] - values[:-1, :, None]) ** 2
        least = [s[linear_sum_assignment(s)].sum() for s in square]
        assert (step.sum(axis=1) <= np.array(least) * (1 + 1e-9)).sum() >= 3998


@pytest.mark.parametrize("seed", range(30))
def test_adaptive_tracking_from_few_points_equals_dense_tracking(seed):
    family = affine_family(seed)
    dense = np.linspace(-2, 2, 8001)
    values, vectors = family(dense)
    fine = track(values, vectors, dense)
    # Compare over the longest range without a meeting of real roots: there the branches have identities.
    real = (values.imag != 0).sum(axis=1)
    cuts = np.concatenate([[0], np.flatnonzero(np.diff(real)) + 1, [len(dense)]])
    widest = np.argmax(np.diff(cuts))
    first, last = cuts[widest], cuts[widest + 1] - 1
    picked = np.unique(np.linspace(first, last, 15).astype(int))
    coarse = track_adaptive(family, dense[picked])
    branches = coarse.branches
    expected = np.take_along_axis(fine.branches, np.argsort(fine.permutation[first])[None, :].repeat(8001, 0), axis=1)
    assert coarse.vectors.shape == (len(picked), 4, 4)
    assert coarse.shapes.shape == (len(picked), 4, 4)
    np.testing.assert_allclose(branches, expected[picked], rtol=1e-9, atol=1e-9)


def test_adaptive_tracking_calls_in_batches():
    calls = []

    def family(p):
        calls.append(len(p))
        return np.sort(np.stack([np.sin(10 * p), np.sin(10 * p + 1), 0.3 + 0 * p], axis=1)), None

    p = np.linspace(0, 1, 12)
    tracked = track_adaptive(family, p)
    assert tracked.permutation.shape == (12, 3)
    assert is_permutation(tracked.permutation)
    assert calls[0] == 12
    assert 2 <= len(calls) <= 9
    order = np.argsort(tracked.branches[0].real)
    expected = np.stack([0 * p + 0.3, np.sin(10 * p + 1), np.sin(10 * p)], axis=1)
    np.testing.assert_allclose(tracked.branches.real[:, order], expected[:, np.argsort(expected[0])])


def test_adaptive_tracking_stops_when_everything_is_in_doubt():
    source = np.random.default_rng(0)
    calls = []

    def junk(p):
        calls.append(len(p))
        return source.normal(size=(len(p), 4)), None

    tracked = track_adaptive(junk, np.linspace(1, 0, 100), max_depth=30)
    assert is_permutation(tracked.permutation)
    assert sum(calls) <= 2000


def test_one_point_and_one_value():
    assert track([[3, 1, 2]]).permutation.tolist() == [[0, 1, 2]]
    assert track([[1], [9], [2]]).permutation.tolist() == [[0], [0], [0]]
    assert track_adaptive(lambda p: (p[:, None], None), [1.0]).branches.tolist() == [[1.0]]
    assert refine_where([[1], [9]], [[0], [0]]).tolist() == [False]
    assert track([[0, 0], [0, 0]]).branches.tolist() == [[0, 0], [0, 0]]


def test_bad_arrays_are_refused():
    for bad, word in [([1, 2], "shape"), ([[np.nan]], "finite"), (np.zeros((0, 2)), "shape"), (3.0, "shape")]:
        with pytest.raises(ValueError, match=word):
            track(bad)
    values = [[1, 2], [1, 2]]
    with pytest.raises(ValueError, match="eigenvectors of shape"):
        track(values, np.zeros((2, 2)))
    with pytest.raises(ValueError, match="rise or fall"):
        track(values, parameter=[1, 1])
    with pytest.raises(ValueError, match="rise or fall"):
        track(values, parameter=[1, 2, 3])
    with pytest.raises(ValueError, match="permutation"):
        refine_where(values, [[0, 0], [0, 1]])


def test_a_hundred_thousand_points_take_less_than_a_second():
    p = np.linspace(-2, 2, 100_000)
    values, vectors = affine_family(0)(p)
    best = np.inf
    for _ in range(3):
        start = time.process_time()
        track(values, vectors, p)
        best = min(best, time.process_time() - start)
    assert best < 1.0
