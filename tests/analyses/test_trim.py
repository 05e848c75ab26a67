"""Basic motions as results: values, shapes, units, refusals."""

import json

import numpy as np
import pytest

from ucrit import UcritError, load, trim
from ucrit.catalogue import model_names
from ucrit.checks.sample import vehicles_of
from ucrit.core.numeric.motion import motion


@pytest.mark.parametrize("name", model_names())
def test_nothing_changes_on_the_basic_motion_but_positions(name):
    """On every trimmed motion the velocities are constant: their rates vanish."""
    for vehicle in vehicles_of(name)[:1]:
        found, moving = trim(vehicle), motion(type(vehicle))
        declared = type(vehicle).declaration
        w = np.array([found[label] for label in moving.labels])
        u = np.array([found[name] for name in declared.inputs])
        rates = dict(zip(moving.labels, moving.rhs(w, u, vehicle.arguments()), strict=True))
        size = 1 + max(map(abs, w), default=0)
        highest = [v.label(v.order - 1) for v in declared.variables.values() if v.order]
        assert max(abs(rates[label]) for label in highest) < 1e-10 * size


def test_arrays_span_dimensions_whatever_a_value_depends_on():
    plane = load("navion-from-geometry").with_(h=[0.2, 0.3, 0.4], U=[50.0, 60.0])
    found = trim(plane)
    assert {value.shape for value in found.values.values()} == {(3, 2)}
    one = trim(plane.with_(h=0.3, U=60.0))
    assert {name: value[1, 1] for name, value in found.values.items()} == pytest.approx(dict(one.values))


def test_table_has_units():
    plane = load("navion-from-geometry").with_(U=[50.0, 60.0])
    frame = trim(plane).to_dataframe()
    assert frame.attrs["units"]["delta_e"] == "rad"
    assert frame.attrs["units"]["T"] == "N"
    assert list(frame["U"]) == [50.0, 60.0]
    assert json.loads(trim(plane).to_json())["result"] == "trim"


def test_text():
    text = str(trim(load("navion-from-geometry")))
    assert "u = 53.6448 m/s" in text
    assert "deg)" in text
    assert "arrays of U" in str(trim(load("navion-from-geometry").with_(U=[50.0, 60.0])))


def test_an_unknown_name_is_refused():
    with pytest.raises(UcritError, match="airplane: the basic motion has no 'delta'; did you mean 'delta_e'"):
        trim(load("navion-from-geometry"))["delta"]


def test_units_of_rates():
    assert trim(load("caravan")).units["theta'"] == "rad/s"


def test_trim_of_arrays_prints_its_span():
    plane = load("navion-from-geometry").with_(U=[40.0, 60.0])
    angles = trim(plane)["delta_e"]
    shown = str(trim(plane))
    assert f"delta_e = {angles.min():.6g} to {angles.max():.6g} rad" in shown
    assert "theta = 0 rad\n" in shown
