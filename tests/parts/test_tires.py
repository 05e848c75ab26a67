"""Laws of tire forces: what every law must do, and what single laws are known for."""

import pickle
import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st

import ucrit
from ucrit import Model, UcritError, input, param, slot, speed, state
from ucrit.catalogue import TIRES, find_part, part_names, tire_names
from ucrit.core.numeric.motion import motion
from ucrit.parts.tires import Tire, axle_coefficient, magic_formula, slip_angle
from ucrit.parts.tires.brush import Brush
from ucrit.parts.tires.brush_moment import BrushMoment
from ucrit.parts.tires.dugoff import Dugoff
from ucrit.parts.tires.magic_formula import MagicFormula
from ucrit.parts.tires.magic_formula_89 import MagicFormula89
from ucrit.parts.tires.tir import read_tir

# Coefficients of an off-road tire as distributed with Project Chrono (BSD), HMMWV_Pac89Tire.json.
COEFFICIENTS_89 = {
    "a0": 1.49975,
    "a1": -4.84987,
    "a2": 812.450,
    "a3": 2613.924,
    "a4": 48.85791,
    "a6": -0.0087954,
    "a7": 0.376999,
    "b0": 1.500188,
    "b1": -15.77615,
    "b2": 1022.112,
    "b3": -2.553177,
    "b4": 208.7773,
    "b5": 0.007313491,
    "b6": -0.003764103,
    "b7": 0.1563307,
    "b8": -1.153100,
    "c0": 2.34,
    "c1": 0.990427,
    "c2": 2.96848,
    "c3": -0.277098,
    "c4": -0.944859,
    "c6": 0.0027699,
    "c7": -0.0001151,
    "c8": 0.10,
    "c9": -1.3329,
}
OLD = MagicFormula89.of(COEFFICIENTS_89)
OTHERS = tomllib.loads((Path(__file__).parent / "other_programs.toml").read_text())
ARMS = ("SSZ1", "SSZ2", "SSZ3", "SSZ4")

EVERY = {
    "linear": ucrit.tire("linear", C=60_000),
    "degressive": ucrit.tire("degressive", C_max=80_000, F_max=8000),
    "brush": ucrit.tire("brush", C=60_000, mu=0.8),
    "brush-degressive": ucrit.tire("brush-degressive", C_max=80_000, F_max=8000, mu=0.8),
    "brush-moment": ucrit.tire("brush-moment", C=60_000, mu=0.8, l_c=0.08),
    "dugoff": ucrit.tire("dugoff", C=60_000, C_x=90_000, mu=0.8),
    "magic-formula-89": OLD(),
    **{name: ucrit.tire(name) for name in tire_names()},
}
BOUNDED = ["brush", "brush-degressive", "brush-moment", "dugoff"]
LOADS = np.array([800.0, 3000.0, 6000.0])[:, None]
ALPHA = np.radians(np.linspace(-25, 25, 51))

some_load = st.floats(200, 8000)
some_angle = st.floats(-1.5, 1.5)
some_slip = st.floats(-1, 3)


class Sledge(Model):
    """One body on one tire that may brake."""

    m: float = param("kg", "mass", above=0)
    g: float = param("m/s^2", "weight per mass", above=0, default=9.81)
    tire = slot(Brush, "the tire", kind=Tire)
    U: float = speed()

    V = state("m/s", "lateral velocity")
    w = state("m/s", "what braking takes away")
    delta = input("rad", "steer angle")
    kappa = input("1", "longitudinal slip")

    def equations(self, x, dx, u):
        alpha = slip_angle(x.V, self.U) - u.delta
        F_x, F_y, _ = self.tire.forces(self.m * self.g, alpha, u.kappa)
        return self.m * dx.V - F_y, self.m * dx.w - F_x + self.m * self.g * x.w / self.U


def test_the_catalogue_is_covered():
    without_braking = {"clipped"}
    assert set(part_names(Tire)) | {*tire_names()} == {*EVERY, "magic-formula", *without_braking}


@pytest.mark.parametrize("name", EVERY)
def test_every_law(name):
    tire = EVERY[name]
    free = tire.forces(LOADS, ALPHA)
    mirrored = tire.forces(LOADS, -ALPHA)
    assert np.isfinite(np.broadcast_arrays(*free)).all()
    np.testing.assert_allclose(free.F_y, -mirrored.F_y, atol=1e-8)
    np.testing.assert_allclose(free.M_z, -np.asarray(mirrored.M_z), atol=1e-8)
    np.testing.assert_allclose(tire.side_force(LOADS, ALPHA), free.F_y, rtol=1e-12)
    assert (free.F_y * ALPHA <= 0).all()
    assert (np.asarray(free.M_z) * np.sign(ALPHA) >= -0.02 * abs(free.F_y)).all()
    h = 1e-7
    slope = (tire.side_force(LOADS, -h) - tire.side_force(LOADS, h)) / (2 * h)
    np.testing.assert_allclose(slope, tire.cornering_coefficient(LOADS) + 0 * LOADS, rtol=2e-5)
    slope = (tire.forces(LOADS, 0.0, h).F_x - tire.forces(LOADS, 0.0, -h).F_x) / (2 * h)
    np.testing.assert_allclose(slope, tire.slip_stiffness(LOADS) + 0 * LOADS, rtol=2e-4)
    assert pickle.loads(pickle.dumps(tire)) == tire
    ahead, behind = tire.forces(3000.0, 0.0, 0.1), tire.forces(3000.0, 0.0, -0.1)
    assert ahead.F_x > 0 > behind.F_x
    np.testing.assert_allclose([*ahead[1:], *behind[1:]], 0, atol=1e-9)


@pytest.mark.parametrize("name", EVERY)
def test_combined_slip_reduces_to_pure_and_is_mirrored(name):
    tire = EVERY[name]
    for kappa in (1e-13, np.full(3, 1e-13)[:, None]):
        np.testing.assert_allclose(tire.forces(LOADS, ALPHA, kappa).F_y, tire.side_force(LOADS, ALPHA), rtol=1e-6)
    left, right = tire.forces(LOADS, ALPHA, -0.08, 0.03), tire.forces(LOADS, -ALPHA, -0.08, -0.03)
    np.testing.assert_allclose(left.F_x + 0 * ALPHA, right.F_x + 0 * ALPHA, rtol=1e-9)
    for one, other in zip(left[1:], right[1:], strict=True):
        np.testing.assert_allclose(one, -np.asarray(other), rtol=1e-9, atol=1e-8)


@pytest.mark.parametrize("name", EVERY)
def test_symbols_give_the_numbers(name):
    tire = EVERY[name]
    F, alpha, kappa = sp.Symbol("F", positive=True), sp.Symbol("alpha", real=True), sp.Symbol("kappa", real=True)
    symbols = {key: sp.Symbol(key, positive=True) for key in type(tire).parameters}
    formulas = type(tire).bound(symbols).forces(F, alpha, kappa)
    compute = sp.lambdify([F, alpha, kappa, *symbols.values()], tuple(formulas), "numpy", cse=True)
    values = [getattr(tire, key) for key in symbols]
    for at in ((3000.0, 0.04, 0.0), (3000.0, 0.04, -0.03), (5000.0, -0.3, 0.4)):
        with np.errstate(all="ignore"):
            found = compute(*at, *values)
        np.testing.assert_allclose(found, tire.forces(*at), rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("name", EVERY)
def test_every_law_fits_into_a_model(name):
    law = type(EVERY[name])
    values = {f"tire_{key}": getattr(EVERY[name], key) for key in law.parameters}
    vehicle = Sledge.fitted(tire=law)(m=400, U=20, **values)
    C, C_x = (float(slope(400 * 9.81)) for slope in (EVERY[name].cornering_coefficient, EVERY[name].slip_stiffness))
    np.testing.assert_allclose(sorted(ucrit.modes(vehicle).eigenvalues.real), sorted([-C / 400 / 20, -9.81 / 20]))
    slopes = motion(type(vehicle)).slopes(np.zeros((2, 1)), np.zeros((2, 1)), vehicle.arguments())
    np.testing.assert_allclose(slopes.B[0], [[C / 400, 0], [0, C_x / 400]], rtol=1e-9, atol=1e-9)


@given(some_load, some_angle, some_slip, st.sampled_from(BOUNDED))
def test_friction_is_never_exceeded(F_z, alpha, kappa, name):
    F_x, F_y, _ = EVERY[name].forces(F_z, alpha, kappa)
    assert np.hypot(F_x, F_y) <= 0.8 * F_z * (1 + 1e-9)
    assert F_x * kappa >= 0 >= F_y * alpha


@given(some_load, some_angle, st.sampled_from(["brush", "brush-degressive"]))
def test_the_force_of_a_locked_wheel_opposes_its_velocity(F_z, heading, name):
    """In axes of the road, whatever the angle by which the wheel is steered."""
    F_x, F_y, _ = EVERY[name].forces(F_z, heading, -1)
    along, across = F_x * np.cos(heading) + F_y * np.sin(heading), F_y * np.cos(heading) - F_x * np.sin(heading)
    np.testing.assert_allclose([along, across], [-0.8 * F_z, 0], rtol=1e-9, atol=1e-9 * F_z)


def test_a_spinning_wheel_of_the_brush_pushes_where_it_slides_to():
    F_x, F_y, _ = EVERY["brush"].forces(4000.0, 0.2, 30.0)
    assert np.hypot(F_x, F_y) == pytest.approx(3200)
    assert F_y / F_x == pytest.approx(-np.tan(0.2) / 30)


def test_the_brush_is_fialas():
    """The cubic in the slip, and the trail that begins at a third of the half length and ends at zero."""
    tire, C, mu, F_z = BrushMoment(C=60_000, mu=0.8, l_c=0.09), 60_000, 0.8, 4000
    for alpha in (0.01, 0.05, 0.1):
        t = C * np.tan(alpha)
        F_y = -(t - t * abs(t) / (3 * mu * F_z) + t**3 / (27 * (mu * F_z) ** 2))
        assert tire.side_force(F_z, alpha) == pytest.approx(F_y, rel=1e-12)
    small, sliding = tire.forces(F_z, 1e-6), tire.forces(F_z, 0.3)
    assert -small.M_z / small.F_y == pytest.approx(0.03, rel=1e-3)
    assert sliding.M_z == pytest.approx(0)


def test_dugoff_is_linear_up_to_half_the_friction():
    tire = Dugoff(C=50_000, C_x=50_000, mu=0.8)
    assert tire.side_force(4000, np.arctan(0.8 * 4000 / 2 / 50_000 * 0.999)) == pytest.approx(-1598.4)
    lam = 0.8 * 4000 / (2 * 50_000 * np.tan(0.1))
    assert tire.side_force(4000, 0.1) == pytest.approx(-50_000 * np.tan(0.1) * lam * (2 - lam))


def test_load_transfer_lowers_the_coefficient_of_an_axle():
    for name in ("degressive", "brush-degressive", *tire_names()):
        sums = [float(axle_coefficient(EVERY[name], 4000, transfer)) for transfer in (0, 1000, 2500)]
        assert sums[0] > sums[1] > sums[2]
    assert axle_coefficient(EVERY["linear"], 4000, 2500) == 120_000


def test_published_forces_of_the_pac2002_set():
    """Values of the set 235/60R16, upright, slip angle by its tangent."""
    tire = ucrit.tire("pac2002-235-60r16:measured")
    assert tire.forces(4850, 0.05, 0).F_y == pytest.approx(-3419.886, abs=1e-3)
    F_x, F_y, _ = tire.forces(4850, 0.05, 0.05)
    assert (F_x, F_y) == pytest.approx((3413.785, -3164.661), abs=1e-3)


def test_published_force_of_pacejkas_own_tire():
    law = read_tir(TIRES / "pacejka-205-60r15.tir").law
    assert law(symmetric=False)().side_force(4000, 0.05) == pytest.approx(-2084.607, abs=1e-3)
    assert law(symmetric=False, SLIP="angle")().side_force(4000, 0.05) == pytest.approx(-2083.134, abs=1e-3)


def by_other_program(table, *, without=(), **switches):
    """Return what another program gives, (N, 3), and what the same tire's law gives with these switches."""
    found = OTHERS[table]
    file = read_tir(TIRES / f"{found['tire']}.tir")
    file = replace(file, values={**file.values, **dict.fromkeys(without, 0.0)})
    kappa, alpha, gamma, F_z, *theirs = np.array(found["rows"]).T
    law = file.law(symmetric=False, **switches)
    one_by_one = [law().forces(*row) for row in zip(F_z, alpha, kappa, gamma, strict=True)]
    return np.array(theirs).T, np.array(one_by_one, dtype=float)


def test_forces_and_moment_of_the_edition_of_2006():
    """Another program's; its cosine of the slip angle is smaller by a guard against standstill."""
    chosen = {"LEAN": "quotient", "TRAIL": "leaning"}
    theirs, ours = by_other_program("edition-2006", **chosen)
    _, armless = by_other_program("edition-2006", without=ARMS, **chosen)
    V = OTHERS["edition-2006"]["speed"] / np.cos(np.array(OTHERS["edition-2006"]["rows"])[:, 1])
    ours[:, 2] -= (1 - V / (V + 0.1)) * armless[:, 2]
    np.testing.assert_allclose(ours, theirs, rtol=3e-9, atol=3e-8)


@pytest.mark.parametrize("version", ["mfeval", "mfeval-5_2"])
def test_forces_and_moment_of_mfeval(version):
    chosen = {"TRAIL": "mixed", "GROWTH": "signed", "BRAKED": "angle", "ARMS": "plain"}
    theirs, ours = by_other_program(version, SLIP="angle", CAMBER="angle", **chosen)
    np.testing.assert_allclose(ours, theirs, rtol=1e-10, atol=1e-9)


@pytest.mark.parametrize(("table", "without"), [("edition-2012", ARMS[2:]), ("edition-2012-pure", ARMS)])
def test_forces_and_moment_of_a_program_after_the_edition_of_2012(table, without):
    """It mixes alpha (in the pure side force) with tan alpha, and its arm of F_x takes no camber: 0.3 % remain."""
    theirs, ours = by_other_program(table, without=without, REST="upright", COSINES=2)
    np.testing.assert_allclose(ours, theirs, rtol=4e-3, atol=2e-2)


def test_a_symmetric_tire_is_near_the_mean_of_tire_and_mirror_image():
    file = read_tir(TIRES / "pac2002-235-60r16.tir")
    measured, mirrored = file.law(symmetric=False)(), file.law(symmetric=False, SIDE=-1)()
    alpha = np.radians(np.linspace(-4, 4, 9))
    np.testing.assert_allclose(mirrored.side_force(4000, alpha), -measured.side_force(4000, -alpha))
    mean = (measured.side_force(4000, alpha) + mirrored.side_force(4000, alpha)) / 2
    np.testing.assert_allclose(file.law()().side_force(4000, alpha), mean, atol=35)


@pytest.mark.parametrize(
    ("switch", "value", "changes"),
    [
        ("SLIP", "angle", (True, True, True)),
        ("CAMBER", "angle", (False, True, True)),
        ("LEAN", "quotient", (False, True, True)),
        ("TRAIL", "leaning", (False, False, True)),
        ("TRAIL", "mixed", (False, False, True)),
        ("GROWTH", "signed", (False, False, True)),
        ("REST", "upright", (False, False, True)),
        ("COSINES", 2, (False, False, True)),
        ("BRAKED", "angle", (False, False, True)),
        ("ARMS", "plain", (False, False, True)),
        ("MOMENT", -1, (False, False, True)),
    ],
)
def test_each_switch_changes_what_it_says(switch, value, changes):
    file = read_tir(TIRES / "pacejka-205-60r15.tir")
    file = replace(file, values={**file.values, "RBY4": 30.0, "LFZO": 0.9, "QDZ3": 0.1})
    laws = file.law(symmetric=False), file.law(symmetric=False, **{switch: value})
    book, other = (law().forces(4000, 0.06, 0.02, -0.05) for law in laws)
    assert tuple(a != b for a, b in zip(book, other, strict=True)) == changes


def test_every_switch_is_tried_and_told():
    (mark,) = test_each_switch_changes_what_it_says.pytestmark
    tried = {case[0] for case in mark.args[1]}
    elsewhere = {"FORMULAS", "SIDE", "SYMMETRIC"}
    assert tried | elsewhere == set(MagicFormula.switches)
    table = magic_formula.__doc__
    assert all(f"\n{name} " in table for name in MagicFormula.switches)
    named = ucrit.tire("pacejka-205-60r15:measured:SLIP=angle:COSINES=2")
    assert named.side_force(4000, 0.05) == pytest.approx(-2083.134, abs=1e-3)
    assert type(named).part_id() == "pacejka-205-60r15:measured:SLIP=angle:COSINES=2"
    for wrong, message in (
        ("SLOP=angle", "there is no switch SLOP; did you mean 'SLIP'"),
        ("SLIP=tangens", "switch SLIP cannot be 'tangens'; did you mean 'tangent'"),
        ("COSINES=3", "switch COSINES cannot be 3; allowed: 1, 2"),
    ):
        with pytest.raises(UcritError, match=message):
            ucrit.tire(f"pacejka-205-60r15:{wrong}")


def test_relaxation_lengths():
    pac = ucrit.tire("pac2002-235-60r16")
    expected = 2.1439 * np.sin(2 * np.arctan(4850 / (1.9829 * 4850))) * 0.344
    assert pac.relaxation_length(4850) == pytest.approx(expected)
    assert pac.longitudinal_relaxation_length(4850) == pytest.approx(2.3657 * 0.344)
    assert EVERY["brush"].relaxation_length(4000, 120_000) == 0.5
    book = ucrit.tire("pacejka-205-60r15")
    assert book.relaxation_length(4000, 100_000) == pytest.approx(float(book.cornering_coefficient(4000)) / 1e5)
    with pytest.raises(UcritError, match="pacejka-205-60r15: it has no PTY1 and no LATERAL_STIFFNESS"):
        book.relaxation_length(4000)


def test_the_formula_of_1989_by_hand():
    c, F, alpha = COEFFICIENTS_89, 4.0, np.degrees(0.08)
    D = c["a1"] * F**2 + c["a2"] * F
    B = c["a3"] * np.sin(2 * np.arctan(F / c["a4"])) / (c["a0"] * D)
    E = c["a6"] * F + c["a7"]
    by_hand = D * np.sin(c["a0"] * np.arctan(B * alpha - E * (B * alpha - np.arctan(B * alpha))))
    assert OLD().side_force(4000, 0.08) == pytest.approx(-by_hand)
    assert OLD().forces(4000, 0.05).M_z > 0


def test_scale_factors_and_roads():
    tire = ucrit.tire("pacejka-205-60r15")
    ice = tire.on_road(0.1)
    assert (ice.LMUX, ice.LMUY, ice.LKY) == (0.1, 0.1, 1)
    assert ice.cornering_coefficient(4000) == tire.cornering_coefficient(4000)
    assert abs(ice.side_force(4000, 0.3)) < 450
    double = ucrit.tire("pacejka-205-60r15", LKY=2)
    assert double.cornering_coefficient(4000) == pytest.approx(2 * tire.cornering_coefficient(4000))


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        (lambda: MagicFormula()(), "'MagicFormula' object is not callable|FNOMIN is missing"),
        (lambda: MagicFormula(FNOMIN=1, UNLOADED_RADIUS=1).side_force(1, 0.1), "the law needs coefficients"),
        (lambda: MagicFormula89.of({"a0": 1.3}), "coefficient a1 is missing"),
        (lambda: MagicFormula89().side_force(4000, 0.1), "the law needs its coefficients"),
        (lambda: MagicFormula.of({"SLIP": "tangens"}), "switch SLIP cannot be 'tangens'; did you mean 'tangent'"),
        (lambda: EVERY["linear"].on_road(0.5), "linear: the law knows no friction"),
        (lambda: ucrit.tire("brush", C=-1), "cornering coefficient C must be above 0 N/rad"),
        (lambda: find_part("pacejca-205", Tire), "did you mean 'pacejka-205-60r15'"),
        (lambda: ucrit.tire(3), "tire: name must be a text, got 3"),
    ],
)
def test_what_cannot_be_is_refused(wrong, message):
    with pytest.raises(UcritError, match=message):
        wrong()


def test_checks_of_a_model_with_a_file_tire():
    """All but one: the sledge has no source."""
    report = str(ucrit.check(Sledge.fitted(tire=find_part("pacejka-205-60r15", Tire))))
    for name in ("equations", "mirror symmetry", "compiled functions", "linearisation"):
        assert f"pass  {name}" in report
    assert report.count("FAIL") == 1
