"""Many matrices at once are judged as by their eigenvalues, however they are scaled."""

import numpy as np
import pytest

from ucrit.numerics.matrices import _judged, stable_matrices


def with_eigenvalues(random, real, count):
    """Random matrices of order 2 * len(real), similar to rotations with these real parts."""
    n = 2 * len(real)
    D = np.zeros((count, n, n))
    for i, growth in enumerate(real):
        w = random.uniform(0.1, 10, count)
        k = 2 * i
        D[:, k, k] = D[:, k + 1, k + 1] = growth
        D[:, k, k + 1], D[:, k + 1, k] = w, -w
    T = random.normal(size=(count, n, n))
    return T @ D @ np.linalg.inv(T)


@pytest.mark.parametrize("engine", ["numpy", "numba"])
@pytest.mark.parametrize("n", range(1, 13))
def test_random_matrices(n, engine):
    if engine == "numba":
        pytest.importorskip("numba")
    random = np.random.default_rng(n)
    A = random.normal(size=(700, n, n)) / np.sqrt(n) - 0.9 * np.eye(n)
    wanted = np.linalg.eigvals(A).real.max(axis=-1) < 0
    np.testing.assert_array_equal(stable_matrices(A, engine), wanted)
    scale = 10.0 ** random.uniform(-8, 8, size=(700, n))
    graded = A * scale[:, :, None] / scale[:, None, :] * 10.0 ** random.uniform(-100, 100, size=(700, 1, 1))
    np.testing.assert_array_equal(stable_matrices(graded, engine), wanted)
    assert 0 < wanted.mean() < 1


@pytest.mark.parametrize("engine", ["numpy", "numba"])
@pytest.mark.parametrize("distance", [1e-3, 1e-7, 1e-9])
def test_near_the_boundary(distance, engine):
    if engine == "numba":
        pytest.importorskip("numba")
    random = np.random.default_rng(3)
    A = with_eigenvalues(random, [-distance, -1.0, -2.0, -0.5], 200)
    well = np.linalg.cond(A) < 1e4
    assert stable_matrices(A[well], engine).all()
    A = with_eigenvalues(random, [distance, -1.0, -2.0, -0.5], 200)
    well = np.linalg.cond(A) < 1e4
    assert not stable_matrices(A[well], engine).any()


@pytest.mark.parametrize("engine", ["numpy", "numba"])
def test_marginal_matrices_are_not_stable(engine):
    if engine == "numba":
        pytest.importorskip("numba")
    A = np.zeros((3, 8, 8))
    A[:] = -np.eye(8)
    A[0, 0, 0] = 0
    A[1, :2, :2] = [[0, 3], [-3, 0]]
    A[2, 5, 5] = np.nan
    assert not stable_matrices(A, engine).any()
    assert stable_matrices(-np.eye(8), engine) == np.True_
    assert stable_matrices(np.zeros((0, 4, 4)), engine).shape == (0,)


@pytest.mark.parametrize("engine", ["numpy", "numba"])
def test_eigenvalues_moved_by_rounding_do_not_decide(engine):
    """Matrices of exact numbers, far from normal: of a zero, or of nearly marginal ones that coincide."""
    if engine == "numba":
        pytest.importorskip("numba")
    random = np.random.default_rng(5)
    marginal = np.diag([0.0, -1, -2, -3, -4, -5])
    stable = -(2.0**-10) * np.eye(6) + np.diag(np.ones(5), 1)
    for core, expected in ((marginal, False), (stable, True)):
        lower = [np.tril(random.integers(-3, 4, (6, 6)), -1) + np.eye(6) for _ in range(80)]
        changes = [L @ np.triu(random.integers(-3, 4, (6, 6)), 1) + L for L in lower]
        A = np.array([T @ core @ np.rint(np.linalg.inv(T)) for T in changes])
        assert np.abs(A).max() < 2**30
        assert (stable_matrices(A, engine) == expected).all()
    assert not stable_matrices(np.tile(A[:1] - core[0, 0] * np.eye(6), (2000, 1, 1)), engine).any()


def test_few_matrices_need_eigenvalues():
    A = np.random.default_rng(0).normal(size=(2000, 8, 8)) / np.sqrt(8) - 0.9 * np.eye(8)
    assert _judged(A)[1].mean() < 0.01


@pytest.mark.parametrize("bad", [1.0, np.zeros((2, 3)), np.zeros((4, 0, 0))])
def test_what_is_no_matrix_is_refused(bad):
    with pytest.raises(ValueError, match="shape"):
        stable_matrices(bad)
    with pytest.raises(ValueError, match="no engine"):
        stable_matrices(np.eye(2), "nimba")
