import pytest
from hypothesis import given
from hypothesis import strategies as st

from ucrit.core.errors import ModelError, UcritError, near_match
from ucrit.core.units import Dimension, dimension, to_si


@pytest.mark.parametrize(
    ("unit", "expected"),
    [
        ("1", (0, 0, 0)),
        ("rad", (0, 0, 0)),
        ("kg m^2", (1, 2, 0)),
        ("N/rad", (1, 1, -2)),
        ("N s/m", (1, 0, -1)),
        ("N m s/rad", (1, 2, -1)),
        ("m/s^2", (0, 1, -2)),
        ("W/m^2", (1, 0, -3)),
        ("1/s", (0, 0, -1)),
    ],
)
def test_dimension_of_coherent_units(unit, expected):
    assert dimension(unit) == Dimension(*expected)


@pytest.mark.parametrize("unit", ["km", "deg", "kg*m", "", "m^x", "m/(s)"])
def test_other_units_are_refused_in_declarations(unit):
    with pytest.raises(ModelError, match="unit"):
        dimension(unit)


@pytest.mark.parametrize(
    ("value", "unit", "expected"),
    [
        ("110 km/h", "m/s", 110 / 3.6),
        ("2 t", "kg", 2000.0),
        ("3 deg", "rad", 0.05235987755982989),
        ("50 kN/rad", "N/rad", 5e4),
        ("800 N/deg", "N/rad", 800 * 57.29577951308232),
        ("1.5e3", "m", 1500.0),
        ("7 m", "m", 7.0),
        (4, "m", 4.0),
        ("2300 kg m^2", "kg m^2", 2300.0),
        ("1e-3 N m s/rad", "N m s/rad", 1e-3),
    ],
)
def test_quantities_are_converted(value, unit, expected):
    assert to_si(value, unit, "length l") == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize("value", ["5 kg", "5 parsnips", "fast", "", "5 m m", "1 2", "3 %(", "nan m", True, None, [1]])
def test_what_is_no_length_is_refused_in_one_sentence(value):
    with pytest.raises(UcritError, match="length l") as caught:
        to_si(value, "m", "length l")
    assert "\n" not in str(caught.value)


@given(st.text(max_size=30))
def test_any_text_converts_or_is_refused_by_name(text):
    try:
        outcome = str(to_si(text, "m/s", "speed U"))
    except UcritError as error:
        outcome = str(error).partition("speed U")[1]
    assert outcome


def test_near_match_prefers_the_close_name_and_else_lists_all():
    assert near_match("c_F", ["C_f", "C_r"]) == "; did you mean 'C_f'?"
    assert near_match("xyz", ["C_f", "C_r"]) == "; allowed: C_f, C_r"
    assert near_match("xyz", []) == "; allowed: none"
