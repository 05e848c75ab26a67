"""Generated functions: single points by Python's floats, and NumPy's where those have no number."""

import numpy as np
import pytest

from ucrit.core.formulas.codegen import build, build_for_points

SOURCE = """def f(g0, g1):
    x, y, = g0
    z, = g1
    return (numpy.where((x > 0), numpy.sqrt(x)*y, numpy.sin(z)), numpy.sign(y)*numpy.arctan2(y, z), x/y, 2.0, )
"""


@pytest.mark.parametrize("point", [(4.0, -0.3, 0.7), (-4.0, 0.3, 0.7), (1.0, 0.0, 0.7), (np.inf, 1.0, np.nan)])
def test_a_point_is_as_an_array_of_one(point):
    x, y, z = point
    arrays, points = build(SOURCE, "f"), build_for_points(SOURCE, "f")
    with np.errstate(all="ignore"):
        expected = arrays((np.array([x]), np.array([y])), (np.array([z]),))
        found = points(np.array([x, y]), (z,))
        several = points((np.array([x, 1.0]), y), (z,))
    np.testing.assert_array_max_ulp(np.array(found), np.array([np.ravel(v)[0] for v in expected]), 1)
    assert several[2].shape == (2,)
