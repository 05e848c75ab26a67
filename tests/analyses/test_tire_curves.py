"""Curves of tires, the slope estimated from points, and the command that shows them."""

import json

import numpy as np
import pytest

import ucrit
from ucrit import UcritError, cornering_coefficient, load, tire, tire_curves
from ucrit.plots import plot_tire

BRUSH = tire("brush", C=60_000, mu=0.8)
MF = tire("pac2002-235-60r16")
ROADS = {"dry": 1.0, "ice": 0.1}


def test_curves_hold_the_forces_of_the_law():
    curves = tire_curves(MF, [2000, 4000], ROADS, alpha=[0.0, 0.05], kappa=[-1, 0, 0.1], beta=[0.1], gamma=0.02)
    assert curves.F_y.shape == (2, 2, 2)
    assert curves.envelope_x.shape == (2, 2, 1, 3)
    assert curves.F_y[0, 1, 1] == MF.forces(4000, 0.05, 0, 0.02).F_y
    assert curves.F_x[1, 0, 2] == MF.on_road(0.1).forces(2000, 0.0, 0.1, 0.02).F_x
    assert curves.envelope_y[0, 1, 0, 0] == MF.forces(4000, 0.1, -1, 0.02).F_y
    assert curves.locked[0, 1] == -curves.F_x[0, 1, 0]
    assert curves.cornering_coefficient.tolist() == MF.cornering_coefficient(np.array([2000.0, 4000.0])).tolist()


def test_peaks():
    curves = tire_curves(MF, [4000])
    fine = np.linspace(0, 0.35, 200_001)
    forces = -MF.side_force(4000, fine)
    force, angle = (float(x[0, 0]) for x in curves.peak_side)
    assert (force, angle) == (pytest.approx(forces.max(), rel=1e-5), pytest.approx(fine[forces.argmax()], abs=2e-3))
    assert curves.peak_braking[0][0, 0] > curves.locked[0, 0] > 0.5 * 4000
    sliding = tire_curves(BRUSH, [4000])
    assert sliding.peak_side[0][0, 0] == sliding.peak_braking[0][0, 0] == sliding.locked[0, 0] == pytest.approx(3200)
    assert np.isnan(tire_curves(tire("linear", C=60_000)).peak_side[1]).all()


def test_the_envelope_stays_within_friction():
    curves = tire_curves(BRUSH, [4000])
    size = np.hypot(curves.envelope_x, curves.envelope_y)
    assert (size <= 3200 * (1 + 1e-9)).all()
    assert size[0, 0, -1].min() > 3190


def test_the_limit_of_friction_is_the_brushs_circle_and_near_an_ellipse():
    round_ = tire_curves(BRUSH, [2000, 4000])
    np.testing.assert_allclose(np.hypot(round_.limit_x, round_.limit_y)[0, 1], 3200, rtol=1e-3)
    for name in ("pac2002-235-60r16", "pacejka-205-60r15", "hmmwv-pac89"):
        curves = tire_curves(tire(name), [4000])
        x, y = curves.limit_x[0, 0], -curves.limit_y[0, 0]
        assert (x[0], x[-1], y.max()) == pytest.approx((x.min(), x.max(), curves.peak_side[0][0, 0]), rel=0.03)
        assert x[-1] == pytest.approx(curves.F_x.max(), rel=5e-3)
        ellipse = np.hypot(x / x.max(), y / y.max())
        assert 0.85 < ellipse.min() <= ellipse.max() < 1.15
        for theta in np.linspace(0, np.pi, 7):  # nothing reaches beyond
            direction = np.cos(theta), np.sin(theta)
            inside = curves.envelope_x * direction[0] - curves.envelope_y * direction[1]
            assert inside.max() <= (x * direction[0] + y * direction[1]).max() * (1 + 2e-3)


def test_tables(tmp_path):
    curves = tire_curves(MF, [2000, 4000], ROADS, kappa=[-1, 0, 1])
    found = curves.to_xarray()
    assert found["F_y"].sel(road="ice", load=4000)[3] == curves.F_y[1, 1, 3]
    assert len(curves.to_dataframe()) == 2 * 2 * 161
    assert json.loads(curves.to_json())["variables"]["M_z"]["unit"] == "N m"


@pytest.mark.parametrize("unit", ["rad", "deg"])
def test_the_coefficient_from_points(unit):
    alpha = np.linspace(-0.03, 0.04, 12)
    given = np.degrees(alpha) if unit == "deg" else alpha
    assert cornering_coefficient(given, -50_000 * alpha + 1e6 * alpha**3 + 30, unit) == pytest.approx(50_000)
    assert cornering_coefficient(given, MF.side_force(4000, alpha), unit) == pytest.approx(
        float(MF.cornering_coefficient(4000)), rel=0.01
    )


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        (lambda: tire_curves(3), "tire_curves needs a tire"),
        (lambda: tire_curves(BRUSH, [0]), "load must be above 0 N, got 0 N"),
        (lambda: tire_curves(BRUSH, ["x"]), "loads must be a list of numbers"),
        (lambda: tire_curves(BRUSH, [[1.0]]), "loads must be a list of finite numbers"),
        (lambda: tire_curves(BRUSH, alpha=[10]), "slip angles must be within a quarter turn"),
        (lambda: tire_curves(BRUSH, kappa=[-2]), "longitudinal slip must be at least -1, where the wheel is locked"),
        (lambda: tire_curves(tire("linear", C=1), roads=ROADS), "linear: the law knows no friction"),
        (lambda: cornering_coefficient([1, 2, 3], [1, 2, 3], "degr"), "did you mean 'deg'"),
        (lambda: cornering_coefficient([1, 2], [1, 2]), "three or more points"),
    ],
)
def test_what_cannot_be_is_refused(wrong, message):
    with pytest.raises(UcritError, match=message):
        wrong()


def test_the_drawing_has_the_curves():
    curves = tire_curves(MF, [2000, 4000])
    figure = plot_tire(curves)
    side, load, along, both = figure.get_axes()
    np.testing.assert_allclose(side.lines[1].get_ydata(), -curves.F_y[0, 1] / 4000)
    drawn = {line.get_gid(): line for line in both.lines}
    np.testing.assert_allclose(drawn["limit"].get_xdata(), curves.limit_x[0, 1] / 1000)
    np.testing.assert_allclose(both.lines[1].get_xdata(), curves.envelope_x[0, 1, 0] / 1000)
    np.testing.assert_allclose(drawn["locked"].get_ydata(), -curves.envelope_y[0, 1, :, 0] / 1000)
    np.testing.assert_allclose(drawn["spinning"].get_xdata(), curves.envelope_x[0, 1, :, -1] / 1000)
    linear = plot_tire(tire_curves(tire("linear", C=60_000))).get_axes()[3]
    assert "limit" not in {line.get_gid() for line in linear.lines}
    assert len(load.lines) == 4
    assert along.lines[0].get_ydata().max() == pytest.approx(curves.peak_braking[0][0, 0] / 2000, rel=1e-3)
    assert len(ucrit.plot(tire_curves(BRUSH, [4000], ROADS)).get_axes()[0].lines) == 2


@pytest.mark.parametrize("wrong", [type(BRUSH), type("Odd", (), {"forces": 1})(), load("spinning-car")])
def test_what_is_no_tire_is_refused(wrong):
    with pytest.raises(UcritError, match="tire_curves needs a tire, as from"):
        tire_curves(wrong)


@pytest.mark.filterwarnings("error")
def test_loads_at_which_a_law_gives_no_number_are_refused():
    with pytest.raises(UcritError, match=r"the law gives no forces at a load of 1e\+09 N"):
        tire_curves(tire("pacejka-205-60r15"), [4000, 1e9])


def test_a_law_without_numbers_says_what_to_do():
    with pytest.raises(
        UcritError, match=r"'magic-formula' is a law, .* name a .tir file or a tire that is shipped: .*pac"
    ):
        tire("magic-formula")
