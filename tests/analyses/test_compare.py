"""Comparison of vehicles: the facts, and a table of eighty columns."""

import pytest

from ucrit import UcritError, critical, load, modes, verdict
from ucrit.analyses.compare import compare


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
    assert '<th scope="col">Oversteering car</th>' in html


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
