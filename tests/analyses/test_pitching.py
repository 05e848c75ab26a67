"""Static margin and moment lines: arrays, units, formulas, refusals."""

import numpy as np
import pytest

from ucrit import UcritError, load, moment_line, static_margin


def value(formula, vehicle):
    return eval(formula, {"__builtins__": {}}, {name: float(v) for name, v in vehicle.values.items()})


@pytest.mark.parametrize("name", ["navion-from-geometry", "navion-plane", "model-glider"])
def test_the_formula_has_the_margins_value(name):
    vehicle = load(name)
    found = static_margin(vehicle)
    assert value(found.formula, vehicle) == pytest.approx(found.margin, rel=1e-12)
    tangent = moment_line(vehicle, angles=(-1e-4, 1e-4), points=3).slope
    assert tangent == pytest.approx([-found.margin], rel=1e-6)


def test_margin_in_metres_where_the_model_has_forces():
    found = static_margin(load("navion-plane"))
    assert found.unit == "m"
    assert found.neutral_point == found.margin
    assert "stable in pitch" in str(found)


def test_arrays():
    plane = load("navion-from-geometry")
    places = [0.2, 0.4, 0.6]
    found = static_margin(plane.with_(h=places))
    assert found.margin == pytest.approx([static_margin(plane.with_(h=h)).margin for h in places])
    assert found.stable.tolist() == [True, True, False]
    assert "arrays of h" in str(found)


def test_a_line_that_does_not_reach_its_trim_has_none():
    line = moment_line(load("navion-from-geometry"), "delta_e", [0.0], angles=(0.1, 0.2))
    assert np.isnan(line.trimmed).all()
    assert line.lift.shape == line.moment.shape == (1, 61)


@pytest.mark.parametrize("function", [static_margin, moment_line])
def test_a_vehicle_without_wings_is_refused(function):
    with pytest.raises(UcritError, match=r"car: static stability in pitch needs a downward velocity w \[m/s\]"):
        function(load("bmw-320i"))


def test_wrong_inputs_are_refused():
    plane = load("navion-from-geometry")
    with pytest.raises(UcritError, match="there is no input 'delta'; did you mean 'delta_e'"):
        moment_line(plane, "delta", [0.1])
    with pytest.raises(UcritError, match="give the name of an input together with its settings"):
        moment_line(plane, "delta_e")
    with pytest.raises(UcritError, match="a moment line is of one vehicle, got arrays for h"):
        moment_line(plane.with_(h=[0.1, 0.2]))
