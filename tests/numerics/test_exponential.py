"""Exponentials of stacks of matrices against SciPy's, closed forms and high precision."""

import mpmath
import numpy as np
import pytest
import scipy.linalg
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from ucrit.numerics.exponential import expm


@given(st.integers(1, 6), st.floats(1e-3, 30), st.integers(0, 2**32 - 1))
def test_each_matrix_of_a_stack_has_its_exponential(n, size, seed):
    A = np.random.default_rng(seed).normal(size=(2, 3, n, n)) * np.array([1e-9, 0.3, 1])[:, None, None] * size
    for ours, one in zip(expm(A).reshape(-1, n, n), A.reshape(-1, n, n), strict=True):
        assert_allclose(ours, scipy.linalg.expm(one), atol=1e-11 * np.abs(ours).max())


def test_a_badly_scaled_matrix_keeps_its_digits():
    A = np.array([[0, 1, 0, 0], [-4e6, -3, 1e7, 0], [0, 0, 0, 1], [1e-3, 0, -9, -1e-2]])
    with mpmath.workdps(60):
        exact = np.array(mpmath.expm(mpmath.matrix(A.tolist())).tolist(), dtype=float)
    assert np.abs(expm(A) - exact).max(axis=1) == pytest.approx(0, abs=1e-11 * np.abs(exact).max())
    assert np.all(np.abs(expm(A) - exact) <= 1e-11 * np.abs(exact).max(axis=1, keepdims=True))


@pytest.mark.parametrize("t", [0.0, 1e-12, 1.0, 1e6])
def test_closed_forms(t):
    assert_allclose(expm([[0, t], [0, 0]]), [[1, t], [0, 1]], rtol=1e-12)
    assert_allclose(expm([[-t]]), [[np.exp(-t)]], rtol=1e-12)
    turn = expm([[0, t], [-t, 0]])
    assert_allclose(turn, [[np.cos(t), np.sin(t)], [-np.sin(t), np.cos(t)]], atol=1e-15 * max(t, 100))


def test_what_is_too_large_is_not_finite():
    assert expm(np.zeros((0, 0))).shape == (0, 0)
    assert not np.isfinite(expm([[1e4, 1e4], [0.0, 1e4]])).all()
