"""Real parts of eigenvalues and their errors: bounds hold for random errors, and are not far too large."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ucrit.numerics.signs import real_parts


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(1, 6), st.sampled_from([0.0, 1e-9, 1e-3, 1.0]), st.integers(-6, 6))
def test_no_error_moves_a_real_part_by_more_than_is_told(seed, n, apart, power):
    """Random matrices, from defective ones to normal ones, in units that differ."""
    rng = np.random.default_rng(seed)
    T = rng.normal(size=(n, n)) + 3 * np.eye(n)
    jordan = np.triu(rng.normal(size=(n, n)), 1) + np.diag(-1 + apart * rng.normal(size=n))
    units = 10.0 ** (power * rng.random(n))
    A = units[:, None] * np.linalg.solve(T, jordan @ T) / units
    errors = 1e-9 * np.abs(A)
    values, wrong = real_parts(A, errors)
    for _ in range(10):
        other = np.sort(np.linalg.eigvals(A + errors * rng.uniform(-1, 1, (n, n))).real)[::-1]
        assert np.all(np.abs(other - values) <= 3 * wrong.max() + 1e-12 * np.abs(values).max())


def test_errors_are_of_the_size_that_they_have():
    values, wrong = real_parts(np.diag([-1.0, -2.0]), 1e-9 * np.diag([1.0, 2.0]))
    np.testing.assert_allclose(values, [-1, -2])
    np.testing.assert_allclose(wrong, [1e-9, 2e-9])
    _, wrong = real_parts(np.array([[0.0, 1.0], [0.0, 0.0]]), 1e-12 * np.ones((2, 2)))
    assert wrong.max() == pytest.approx(1e-6, rel=2)
