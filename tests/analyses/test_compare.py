"""Comparison of vehicles: the facts, and a table of eighty columns."""

import numpy as np
import pytest

from ucrit import UcritError, critical, load, modes, verdict
from ucrit.analyses.stability.compare import compare
from ucrit.analyses.stability.static_term import static_term
from ucrit.catalogue import vehicle_names
from ucrit.core.numeric.compiled import compiled


def test_facts_are_those_of_each_vehicle():
    vehicles = [load("understeering-car"), load("oversteering-car"), load("caravan")]
    both = compare(*vehicles)
    for subject, vehicle in zip(both.subjects, vehicles, strict=True):
        assert subject.verdict == verdict(vehicle)
        assert [c.value for c in subject.speeds] == [c.value for c in critical(vehicle)]
        assert [m.eigenvalue for m in subject.modes] == [m.eigenvalue for m in modes(vehicle)]


def test_parameters_that_differ():
    both = compare(load("understeering-car"), load("oversteering-car"))
    assert both.differing == {"C_f": ("N/rad", (75e3, 120e3)), "C_r": ("N/rad", (90e3, 75e3))}
    other = compare(load("understeering-car"), load("released-steering-wheel"))
    assert other.differing["I_s"] == ("kg m^2", (None, 15.0))
    assert "m" not in other.differing


def test_table():
    text = str(compare(load("understeering-car"), load("oversteering-car")))
    lines = text.splitlines()
    assert max(map(len, lines)) <= 80
    assert lines[0].split("  ")[-1].strip() == "Oversteering car"
    assert any(line.startswith("critical speed [m/s]") and line.endswith("34.785") for line in lines)
    assert any(line.startswith("stable speeds [m/s]") and line.endswith("below 34.785") for line in lines)
    assert not any(line.startswith("model") for line in lines)


def test_car_and_airplane_differ_in_the_term_that_speed_turns():
    """Karnopp 2004, section 9.V: the airplane's last term grows with U squared, the car's may change its sign."""
    both = compare(load("bmw-320i"), load("navion-plane"))
    words = ("its sign may change with speed", "grows like U**2, its sign does not depend on speed")
    assert ("static term a_0", words) in both.rows()
    assert max(map(len, str(both).splitlines())) <= 80
    assert "static term" not in str(compare(load("bmw-320i"), load("oversteering-car")))


@pytest.mark.parametrize("name", vehicle_names())
def test_the_static_term_does_what_is_said_of_it(name):
    vehicle = load(name)
    cls = type(vehicle)
    speed, words = cls.declaration.speed, static_term(cls)
    if not words:
        return
    U = abs(float(vehicle.values[speed])) * np.geomspace(0.01, 100, 41)
    a = compiled(cls, 1).coefficients(vehicle.with_(**{speed: U}).arguments())
    last = np.broadcast_to(a[compiled(cls, 1).structural_zeros] / a[-1], U.shape)
    if "positive" in words or "negative" in words:
        assert np.all((last > 0) == ("positive" in words))
    if "does not depend" in words:
        assert len(set(np.sign(last))) == 1
    if "U**2," in words:
        np.testing.assert_allclose(last / U**2, last[0] / U[0] ** 2, rtol=1e-9)


@pytest.mark.parametrize("count", [2, 3])
def test_width(count):
    names = ["car-and-caravan", "released-steering-wheel", "caravan"][:count]
    assert max(map(len, str(compare(*map(load, names))).splitlines())) <= 80


def test_models_without_a_speed_and_equal_names():
    wheelset = load("caravan")
    both = compare(wheelset, wheelset.with_(c=0))
    assert [s.name[-3:] for s in both.subjects] == ["(1)", "(2)"]
    assert ("stable speeds [m/s]", ("below 23.235", "none")) in both.rows()


def test_html():
    html = compare(load("understeering-car"), load("oversteering-car"))._repr_html_()
    assert html.startswith("<table>")
    assert ">Oversteering car</th>" in html


@pytest.mark.parametrize(
    ("vehicles", "message"),
    [
        ([], "a comparison needs two vehicles or more, got 0"),
        (["caravan"], "a comparison needs two vehicles or more, got 1"),
    ],
)
def test_too_few(vehicles, message):
    with pytest.raises(UcritError) as error:
        compare(*map(load, vehicles))
    assert str(error.value) == message


def test_arrays_are_refused():
    with pytest.raises(UcritError, match="scalar parameters, got arrays for U"):
        compare(load("caravan"), load("caravan").with_(U=[10.0, 20.0]))
