"""Tolerances in vehicle files: read with units, kept by copies, written back, refused where they make no sense."""

import pickle

import pytest

from ucrit.catalogue import controlled, find_model, find_part, graph_model, load
from ucrit.core.contract.files import Find, parse_vehicle, write_vehicle
from ucrit.core.contract.tolerances import Tolerance
from ucrit.core.errors import UcritError

FIND = Find(find_model, find_part, controlled, graph_model)
GOOD = """model = "car"
source = "x"
[parameters]
m = { value = "1.1 t", sd = "20 kg" }
I_z = { value = 1800, sd = 100, min = 1500, max = 2100 }
a = { value = 1.2, min = "110 cm", max = 1.3 }
b = 1.4
C_f = "100 kN/rad"
C_r = 9e4
U = "50 km/h"
[correlations]
m = { I_z = 0.8 }
"""


def parse(text):
    return parse_vehicle(text, "x.toml", FIND)


def test_tolerances_are_read_kept_and_written():
    car = parse(GOOD)
    assert (car.m, car.I_z, car.a) == (1100, 1800, 1.2)
    tolerances = car.info.tolerances
    assert tolerances.entries == (
        Tolerance("m", 20.0),
        Tolerance("I_z", 100.0, 1500.0, 2100.0),
        Tolerance("a", 0.0, 1.1, 1.3),
    )
    assert tolerances.correlations == (("m", "I_z", 0.8),)
    assert tolerances.groups() == [("m", "I_z"), ("a",)]
    assert parse(write_vehicle(car)) == car
    assert pickle.loads(pickle.dumps(car)) == car
    assert car.with_(m=1200).info.tolerances == tolerances
    assert car.along("k", m=[1, 2], a=[1, 1.2]).info.tolerances == tolerances
    assert car != parse(GOOD.replace("0.8", "0.7"))
    assert not load("bmw-320i").info.tolerances


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('sd = "20 kg"', "ds = 20", "x.toml: car: mass m: there is no entry 'ds'; did you mean 'sd'?"),
        ('sd = "20 kg"', 'sd = "20 m"', "car: mass m: sd is measured in kg, got '20 m'"),
        ('sd = "20 kg"', "sd = 0", "mass m: sd must be above 0 kg and finite, got 0"),
        ('sd = "20 kg"', "sd = inf", "sd must be"),
        ('value = "1.1 t", ', "", "mass m: a tolerance stands beside a value"),
        (', sd = "20 kg"', "", "mass m: a tolerance is sd = ..., or min = ... and max = ..., or all three"),
        (", max = 1.3", "", "a tolerance is sd = ..., or min"),
        ("max = 1.3", "max = 1.1", "min must be below max, got 1.1 and 1.1 m"),
        ("max = 1.3", "max = 1.15", "the value 1.2 lies outside its range from 1.1 to 1.15 m"),
        ('min = "110 cm"', "min = -1", "car, min: centre of mass to front axle a must be above 0 m, got -1 m"),
        ('U = "50 km/h"', "U = { value = 9, sd = 1 }", "speed U has no tolerance: stability is judged at every speed"),
        ("I_z = 0.8", "b = 0.8", "'b' has no tolerance to be correlated; allowed: m, I_z, a"),
        ("I_z = 0.8", "m = 0.8", "the correlation of m and m must be a number between -1 and 1 for two parameters"),
        ("I_z = 0.8", "I_z = 1", "must be a number between -1 and 1 for two parameters, got 1"),
        ("m = { I_z = 0.8 }", "m = { I_z = 0.8 }\nI_z = { m = 0.8 }", "the correlation of I_z and m is given twice"),
        ("m = { I_z = 0.8 }", "m = 0.8", "correlations are written as m = { I_z = 0.8 }"),
    ],
)
def test_what_makes_no_sense_is_refused_in_one_sentence(old, new, message):
    assert old in GOOD
    with pytest.raises(UcritError) as caught:
        parse(GOOD.replace(old, new, 1))
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)
