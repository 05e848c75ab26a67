"""Names, units and numbers as they are printed."""

import math

import pytest

from ucrit.plots.labels import axis_label, fixed, math_symbol, number, percent, quantity, split_symbol, unit_text

MINUS = "\N{MINUS SIGN}"


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("m", ("m", [], 0)),
        ("I_c", ("I", ["c"], 0)),
        ("theta'", ("θ", [], 1)),
        ("Omega_dot", ("Ω", ["dot"], 0)),
        ("lambda_", ("λ", [], 0)),
        ("Lamda", ("Λ", [], 0)),
        ("y1", ("y", ["1"], 0)),
        ("k_psi_2''", ("k", ["ψ", "2"], 2)),
        ("beta", ("β", [], 0)),
    ],
)
def test_symbols(name, expected):
    assert split_symbol(name) == expected


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("I_c", "$I_{c}$"),
        ("theta'", r"$\dot{θ}$"),
        ("x''", r"$\ddot{x}$"),
        ("trail_max", r"$\mathrm{trail}_{\mathrm{max}}$"),
    ],
)
def test_mathtext(name, expected):
    assert math_symbol(name) == expected


@pytest.mark.parametrize(("unit", "expected"), [("kg m^2", "kg m²"), ("1", ""), ("s^-1", "s⁻¹"), ("N/rad", "N/rad")])
def test_units(unit, expected):
    assert unit_text(unit) == expected


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (-0.28732, MINUS + "0.2873"),
        (90000.0, "90000"),
        (1.5e7, "1.5·10⁷"),
        (-2.5e-5, MINUS + "2.5·10⁻⁵"),
        (0.0, "0"),
        (-0.0, "0"),
        (math.inf, "∞"),
        (-math.inf, MINUS + "∞"),
        (math.nan, "\N{EN DASH}"),
    ],
)
def test_numbers(value, expected):
    assert number(value) == expected


@pytest.mark.parametrize(
    ("value", "expected"), [(-2.4, MINUS + "2.400"), (1234.0, "1234"), (0.0, "0"), (0.5, "0.5000")]
)
def test_columns_keep_zeros(value, expected):
    assert fixed(value) == expected


def test_shares_and_quantities():
    assert percent(0.0275) == "+2.8\N{NO-BREAK SPACE}%"
    assert percent(-0.5) == MINUS + "50\N{NO-BREAK SPACE}%"
    assert percent(math.inf) == "\N{EN DASH}"
    assert quantity(3.7, "m") == "3.7\N{NO-BREAK SPACE}m"
    assert axis_label("price in $", "c_1", "N s/m") == r"price in \$ $c_{1}$ [N s/m]"
