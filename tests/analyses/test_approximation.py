"""Errors of a simple model, mode by mode."""

import pytest

from ucrit import UcritError, approximation, load


def test_a_model_approximates_itself_without_error():
    plane = load("boeing-747")
    found = approximation(plane, plane)
    assert [(e.frequency, e.damping) for e in found.errors] == [(0, 0), (0, 0)]
    assert found.missing == ()
    assert "not in it" not in str(found)


def test_errors_are_relative_to_the_full_model():
    plane = load("navion-phugoid")
    slower = plane.with_(U=1.25 * plane.U, epsilon=2 * plane.epsilon)
    (error,) = approximation(plane, slower).errors
    assert error.frequency == pytest.approx(-0.2)
    assert error.damping == pytest.approx(plane.epsilon / 2**0.5)


def test_models_without_a_mode_in_common_are_refused():
    with pytest.raises(UcritError, match="the two models have no mode in common: phugoid oscillation"):
        approximation(load("boeing-747"), load("boeing-747-lateral"))
