"""Criteria of the sine with dwell, on a yaw rate whose course is known."""

import numpy as np
import pytest
from scipy.integrate import quad

from ucrit import Model, SineWithDwell, UcritError, dwell_criteria, input, param, simulate, speed, state
from ucrit.core import Drawing
from ucrit.parts.shapes import car as shape

STEERED = SineWithDwell("0.05 rad", at=0.4)


class Turning(Model):
    """Body whose yaw rate follows its steering with a lag, made for a test."""

    T: float = param("s", "lag", above=0)
    G: float = param("1/s", "gain", above=0)
    U: float = speed("speed")
    r = state("rad/s", "yaw rate")
    delta_f = input("rad", "steer angle")

    def equations(self, x, dx, u):
        return self.T * dx.r + x.r - self.G * u.delta_f

    def drawing(self, x):
        return Drawing("top", shape(1, 1), turned=True, travel=(self.U, 0, x.r))


def judged(T, until=5.0):
    return dwell_criteria(simulate(Turning(T=T, G=4, U=20), until, inputs={"delta_f": STEERED}), STEERED)


@pytest.mark.parametrize("T", [0.2, 0.6, 1.5])
def test_what_is_left_decays_with_the_lag(T):
    found = judged(T)
    assert found.remainders[1] / found.remainders[0] == pytest.approx(np.exp(-0.75 / T), rel=1e-6)
    assert found.stable == bool(np.all(found.remainders <= [0.35, 0.2]))
    assert found.begin == 0.4
    assert found.complete == pytest.approx(0.4 + 1 / 0.7 + 0.5)


def test_a_quick_body_peaks_with_its_steering_and_moves_aside_as_far_as_its_heading_tells():
    found = judged(0.001)
    assert found.peak == pytest.approx(-4 * 0.05, rel=1e-4)
    omega = 2 * np.pi * 0.7

    def heading(t):
        return 4 * 0.05 * (1 - np.cos(omega * t)) / omega

    aside = quad(lambda t: 20 * np.sin(heading(t)), 0, 1.07)[0]
    assert found.displacement == pytest.approx(aside, rel=5e-3)
    assert found.responsive == (aside >= 1.83)


def test_the_verdict_is_the_same_for_both_directions_and_goes_into_files():
    other = SineWithDwell("-0.05 rad", at=0.4)
    left = dwell_criteria(simulate(Turning(T=0.6, G=4, U=20), 5, inputs={"delta_f": other}), other)
    right = judged(0.6)
    np.testing.assert_allclose(left.remainders, right.remainders, rtol=1e-9)
    assert left.displacement == pytest.approx(right.displacement)
    assert left.peak == pytest.approx(-right.peak)
    assert right.to_dataframe().shape[0] == 2
    assert "stable" in str(right)


def test_a_motion_too_short_is_refused():
    with pytest.raises(UcritError, match="must be followed until 4"):
        judged(0.2, until=3)
