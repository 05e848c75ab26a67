"""Shapes of inputs: their values, their kinks, their words."""

import math

import numpy as np
import pytest

from ucrit import Gust, Measured, Pulse, Ramp, Sine, SineWithDwell, Step, UcritError, load, simulate
from ucrit.analyses.motion.manoeuvre_text import SHAPES, parse_shape
from ucrit.analyses.motion.manoeuvres import Shape
from ucrit.core.contract.declare import input

QUANTITY = input("rad", "steer angle")
DEGREE = math.pi / 180


def signal(shape, until=10):
    return shape.signal(QUANTITY, "input delta", until)


def test_values_of_every_shape():
    expected = {
        Step("2 deg", at="1 s"): {0.999: 0, 1: 2, 5: 2},
        Ramp("2 deg", over=4, at=1): {1: 0, 2: 0.5, 5: 2, 6: 2},
        Sine("2 deg", 0.25, at=1, over=4): {0.5: 0, 2: 2, 4: -2, 5.1: 0},
        SineWithDwell("2 deg", 0.5, at=1, dwell=0.7): {1.5: 2, 2.5: -2, 3.19: -2, 3.2 + 0.25: -math.sqrt(2), 3.8: 0},
        Pulse("2 deg", over="500 ms", at=1): {0.9: 0, 1: 2, 1.4: 2, 1.5: 0},
        Gust("2 deg", over=2, at=1): {1: 0, 1.5: 1, 2: 2, 3: 0, 4: 0},
        Step(DEGREE) + Step("1 deg", at=2): {0: 1, 2: 2},
    }
    for shape, values in expected.items():
        made = signal(shape)
        for t, degrees in values.items():
            assert made(t) == pytest.approx(degrees * DEGREE, abs=1e-14), f"{shape} at {t} s"


def test_pieces_meet_without_a_jump_where_the_shape_has_none():
    for shape in (Ramp(1, 2, 1), Sine(1, 0.5, 1, 4), SineWithDwell(1), Gust(1, 2, 1)):
        made = signal(shape)
        for t, before, after in zip(made.breaks, made.pieces, made.pieces[1:], strict=False):
            assert before(t) == pytest.approx(after(t), abs=1e-14)


@pytest.mark.parametrize("example", [example for *_, example in SHAPES.values()])
def test_examples_of_the_grammar_are_shapes(example):
    shape = parse_shape(example.replace("m/s", "deg"), "input delta")
    assert isinstance(shape, Shape)
    assert np.isfinite([signal(shape)(t) for t in np.linspace(0, 9, 50)]).all()


def test_words_come_in_any_order_and_shapes_add_up():
    assert (
        parse_shape("pulse 2 deg over 1 s at 3 s", "")
        == Pulse("2 deg", "1 s", "3 s")
        == parse_shape("pulse 2 deg at 3 s over 1 s", "")
    )
    assert parse_shape("step 1 deg + step -1 deg at 2 s", "") == Step("1 deg") + Step("-1 deg", "2 s")
    assert parse_shape("2 deg", "") is None


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("stepp 2 deg", "input delta_f: there is no shape 'stepp'; did you mean 'step'?"),
        ("step", "step lacks a size; write it like 'step 2 deg at 1 s'"),
        ("ramp 2 deg", "ramp lacks a duration, 'over'"),
        ("sine 2 deg", "sine lacks a frequency, 'with'"),
        ("step 2 deg att 1 s", "step takes no 'att'; did you mean 'at'?"),
        ("step 2 deg at 1 s at 2 s", "step has 'at' twice, '1 s' and '2 s'"),
        ("step 2 deg at", "step has no value behind 'at'"),
        ("step 2 kg", "size is measured in rad, got '2 kg'"),
        ("step 2 deg at -1 s", "start must be at least 0 s, got -1 s"),
        ("pulse 2 deg over 0 s", "duration must be above 0 s"),
        ("sine 2 deg with 0 Hz", "frequency must be above 0 Hz"),
        ("dwell 2 deg with 1 m", "frequency is measured in Hz"),
        ("table", "a table is a file's name"),
        ("table no.csv", "there is no file 'no.csv'"),
    ],
)
def test_mistakes_name_the_thing(text, words):
    with pytest.raises(UcritError) as error:
        simulate(load("understeering-car"), 1, inputs={"delta_f": text})
    assert words in str(error.value)


def test_a_kink_is_met_exactly():
    """Two short steps that a solver would overlook, and the same motion put together from three smooth ones."""
    car, width = load("understeering-car"), 1e-4
    found = simulate(car, 3, inputs={"delta_f": f"pulse 0.1 at 1 s over {width}"}, times=[1.5, 3])
    during = simulate(car, width, inputs={"delta_f": 0.1}, times=[width])
    start = {name: during[name][-1] for name in during.states}
    after = simulate(car, 2, start, times=[0.5 - width, 2 - width])
    assert np.abs(found["r"] - after["r"]).max() < 1e-11 * np.abs(after["r"]).max() + 1e-15
    assert found["r"][0] != 0


def table(path, text):
    path.write_text(text)
    return path


def test_a_table_with_units_is_its_straight_lines(tmp_path):
    path = table(tmp_path / "steer.csv", "time [ms],delta_f [deg],note [1]\n0,0,1\n1000,2,1\n3000,-2,1\n")
    car = load("understeering-car")
    found = simulate(car, 3, inputs={"delta_f": Measured(path)}, times=[0.5, 2, 2.5])
    assert found["delta_f"] == pytest.approx([DEGREE, 0, -DEGREE])
    ramps = Ramp("2 deg", over=1) + Ramp("-4 deg", over=2, at=1)
    assert found["r"] == pytest.approx(simulate(car, 3, inputs={"delta_f": ramps}, times=[0.5, 2, 2.5])["r"], rel=1e-9)
    other = simulate(car, 3, inputs={"delta_r": f"table {path} column delta_f"}, times=[0.5])
    assert other["delta_r"] == pytest.approx([DEGREE])


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("time [s],delta_f\n0,1\n1,2\n", "a column is headed by its name and unit"),
        ("time [s],delta [deg]\n0,1\n1,2\n", "has no column 'delta_f'; did you mean 'delta'?"),
        ("time [s],delta_f [m]\n0,1\n5,2\n", "delta_f is measured in rad, got '0 m'"),
        ("time [s],delta_f [rad]\n0,1\n5,two\n", "delta_f, line 3: a finite number is needed, got 'two'"),
        ("time [s];delta_f [rad]\n0;0,1\n1;0,2\n", "columns parted by commas and decimal points, got semicolons"),
        ("time [s],delta_f [rad]\n0,1\n5\n", "line 3: 2 columns are headed, got 1"),
        ("time [s],delta_f [rad]\n0,1\n5,1\n4,1\n", "line 4: times must ascend, got 4 s after 5 s"),
        ("time [s],delta_f [rad]\n0,1\n1,2\n", "must cover 0 s to 3 s, it goes from 0 s to 1 s"),
        ("time [s],delta_f [rad]\n", "needs a line of names and at least two lines of numbers"),
        ("time [s],delta_f [rad],delta_f [rad]\n0,1,1\n5,1,1\n", "heads two columns alike"),
    ],
)
def test_a_wrong_table_is_told_in_a_sentence(tmp_path, text, words):
    path = table(tmp_path / "steer.csv", text)
    with pytest.raises(UcritError) as error:
        simulate(load("understeering-car"), 3, inputs={"delta_f": Measured(path)})
    assert words in str(error.value)
    assert "steer.csv" in str(error.value)


def test_a_shape_is_added_to_the_basic_motion_and_a_number_is_the_input():
    plane = load("navion-from-geometry")
    trimmed = simulate(plane, 1, times=[1])["delta_e"][0]
    assert trimmed != 0
    stepped = simulate(plane, 1, inputs={"delta_e": Step("1 deg")}, times=[1])["delta_e"][0]
    assert stepped == pytest.approx(trimmed + DEGREE, rel=1e-12)
    assert simulate(plane, 1, inputs={"delta_e": "1 deg"}, times=[1])["delta_e"][0] == pytest.approx(DEGREE)
