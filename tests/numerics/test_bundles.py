"""Many polynomials at once agree with exact ones, one at a time."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from ucrit.numerics.bundles import hurwitz_bundle, real_parts
from ucrit.numerics.determinants import hurwitz_polynomial

SMALL = st.integers(-9, 9).map(float)


@given(st.integers(3, 7).flatmap(lambda n: st.lists(st.lists(SMALL, min_size=1, max_size=3), min_size=n, max_size=n)))
def test_hurwitz_determinants_are_those_of_exact_arithmetic(rows):
    found = hurwitz_bundle([np.array([row, row]) for row in rows])
    exact = [float(c) for c in hurwitz_polynomial(rows)]
    exact += [0.0] * (found.shape[1] - len(exact))
    np.testing.assert_array_equal(found, [exact, exact])


def test_roots_are_found_and_what_is_none_is_left_out():
    p = np.array([np.poly([1, 2, -3])[::-1], [0, 0, -4, 1], [5, 0, 0, 0], [1.0, 0, 1, 0]])
    found = np.sort(real_parts(p), axis=1)
    np.testing.assert_allclose(found[0], [1, 2, np.inf])
    np.testing.assert_allclose(found[1, 0], 4)
    assert real_parts(np.zeros((2, 3))).shape == (2, 0)
    assert real_parts(np.array([[0.0, 0, 3], [0, 0, 1]])).shape == (2, 0)
