"""Tire property files: what is read, and what is refused in one sentence."""

import re

import pytest

import ucrit
from ucrit import UcritError
from ucrit.catalogue import TIRES, tire_names
from ucrit.core.contract.files import write_vehicle
from ucrit.parts.tires.tir import read_tir

TEXT = (TIRES / "pacejka-205-60r15.tir").read_text()

VEHICLE = """
model = "sledge.py"
name = "Sledge"

[parts]
tire = "mine.tir"

[parameters]
m = 400
U = 20
"""

SLEDGE = '''
from ucrit import Model, param, slot, speed, state
from ucrit.parts.tires import Tire, slip_angle
from ucrit.parts.tires.brush import Brush


class Sledge(Model):
    """One body on one tire."""

    m: float = param("kg", "mass", above=0)
    g: float = param("m/s^2", "weight per mass", above=0, default=9.81)
    tire = slot(Brush, "the tire", kind=Tire)
    U: float = speed()
    V = state("m/s", "lateral velocity")

    def equations(self, x, dx):
        return self.m * dx.V - self.tire.side_force(self.m * self.g, slip_angle(x.V, self.U))
'''


@pytest.fixture
def changed(tmp_path):
    """Return a function that writes the book's file with something replaced, and reads it."""

    def read(old, new):
        path = tmp_path / "mine.tir"
        text = re.sub(old, new, TEXT, flags=re.MULTILINE)
        assert text != TEXT
        path.write_text(text)
        return read_tir(path, "mine.tir")

    return read


@pytest.mark.parametrize("name", tire_names())
def test_shipped_files(name):
    found = read_tir(TIRES / f"{name}.tir")
    of_1989 = found.formulas == "1989"
    assert ("the side force goes with the slip angle" if of_1989 else "x forward, y to the left, z up") in found.axes
    assert found.units["LENGTH"] == "meter"
    assert any("Source" in line for line in found.comments)
    law = found.law()
    assert law is found.law()
    assert of_1989 or law.parameters["FNOMIN"].default == found.values["FNOMIN"]


def test_versions_and_units_are_told(changed):
    assert read_tir(TIRES / "pac2002-235-60r16.tir").version == "PAC2002 (MF 5.2)"
    found = changed(r"^LENGTH = 'meter'", "LENGTH = 'mm'")
    assert (found.version, found.units["LENGTH"]) == ("MF 6.1", "mm")
    assert found.values["UNLOADED_RADIUS"] == pytest.approx(0.000313)
    assert found.values["NOMPRES"] == pytest.approx(220000e6)
    assert found.values["PKY1"] == -14.95


def test_other_units_of_the_same_tire_give_the_same_forces(changed):
    found = changed(
        r"'newton'((?:.|\n)*)0\.313((?:.|\n)*)INFLPRES = 220000\nNOMPRES  = 220000((?:.|\n)*)FNOMIN = 4000",
        r"'kN'\g<1>0.313\g<2>INFLPRES = 220\nNOMPRES  = 220\g<3>FNOMIN = 4",
    )
    mine, book = found.law(symmetric=False)(), ucrit.tire("pacejka-205-60r15:measured")
    assert mine.forces(3000, 0.04, 0.02) == pytest.approx(book.forces(3000, 0.04, 0.02))


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (r"^PKY1 = .*\n", "", r"mine.tir: section \[LATERAL_COEFFICIENTS\]: key PKY1 is missing; did you mean 'PVY1'"),
        (r"^FNOMIN = .*\n", "", r"mine.tir: section \[VERTICAL\]: key FNOMIN is missing"),
        (r"^FNOMIN = .*\n", "FNOMIN = -3\n", r"section \[VERTICAL\]: FNOMIN must be above 0, got -3"),
        (r"^RBX1 = .*\n", "", r"section \[LONGITUDINAL_COEFFICIENTS\]: key RBX1 is missing"),
        (r"^PKY2 = .*\n", "PKY2 = two\n", r"\[LATERAL_COEFFICIENTS\]: PKY2 must be a number, got 'two' in line \d+"),
        (r"^PKY2 = .*\n", "PKY2 = 2\nPKY2 = 3\n", r"PKY2 is given twice, as 2.0 and as 3.0"),
        (r"^PKY2 = .*\n", "PKY2 2.13\n", r"\[LATERAL_COEFFICIENTS\]: line \d+ is not KEY = value, got 'PKY2 2.13'"),
        (r"^FITTYP .*\n", "FITTYP = 5\n", r"section \[MODEL\]: FITTYP 5 is not supported; supported are 6 \(MF 5.2\)"),
        (r"^FITTYP .*\n", "", r"PROPERTY_FILE_FORMAT 'MF-TYRE' without FITTYP is not supported"),
        (r"^(FITTYP|PROPERTY).*\n", "", r"neither FITTYP nor PROPERTY_FILE_FORMAT tells the version"),
        (r"'newton'", "'newtons of old'", r"section \[UNITS\]: FORCE 'newtons of old' is no unit"),
        (r"^FORCE .*\n", "", r"section \[UNITS\]: key FORCE is missing"),
    ],
)
def test_what_is_wrong_is_named(changed, old, new, message):
    with pytest.raises(UcritError, match=message) as found:
        changed(old, new)
    assert len(str(found.value).splitlines()) == 1


def test_a_file_of_the_formula_of_1989(tmp_path):
    text = (TIRES / "hmmwv-pac89.tir").read_text()
    assert read_tir(TIRES / "hmmwv-pac89.tir").version == "PAC89 (Pacejka '89)"
    for key, value, message in (
        ("a4", "", r"section \[LATERAL_COEFFICIENTS\]: key A4 is missing"),
        ("b2", "", r"section \[LONGITUDINAL_COEFFICIENTS\]: key B2 is missing"),
        ("c9", "c9 = x\n", r"section \[ALIGNING_COEFFICIENTS\]: C9 must be a number, got 'x'"),
    ):
        (tmp_path / "mine.tir").write_text(re.sub(rf"^{key} .*\n", value, text, flags=re.MULTILINE))
        with pytest.raises(UcritError, match=message):
            read_tir(tmp_path / "mine.tir")
    (tmp_path / "mine.tir").write_text(re.sub(r"^a9 .*\n", "a9 = 0.1\n", text, flags=re.MULTILINE))
    law = read_tir(tmp_path / "mine.tir").law
    assert law()().side_force(4000, 0.0) == 0 != law(symmetric=False)().side_force(4000, 0.0)
    turned = ucrit.tire("hmmwv-pac89:MOMENT=-1")
    assert turned.forces(4000, 0.05).M_z == -ucrit.tire("hmmwv-pac89").forces(4000, 0.05).M_z
    with pytest.raises(UcritError, match="hmmwv-pac89: there is no switch SLIP"):
        ucrit.tire("hmmwv-pac89:SLIP=angle")


def test_what_is_no_file(tmp_path):
    (tmp_path / "binary.tir").write_bytes(b"\0\1")
    for path, message in ((tmp_path / "no.tir", "there is no file"), (tmp_path / "binary.tir", "is not a text file")):
        with pytest.raises(UcritError, match=message):
            read_tir(path)
    with pytest.raises(UcritError, match="cannot be read"):
        read_tir(tmp_path)
    (tmp_path / "latin.tir").write_bytes(TEXT.encode().replace(b"2nd", "2\u00aa".encode("latin-1")))
    assert read_tir(tmp_path / "latin.tir").values["PKY2"] == 2.13


def test_a_vehicle_file_names_its_tire_and_is_written_back(tmp_path):
    (tmp_path / "mine.tir").write_text(TEXT)
    (tmp_path / "sledge.py").write_text(SLEDGE)
    (tmp_path / "vehicle.toml").write_text(VEHICLE)
    vehicle = ucrit.load(tmp_path / "vehicle.toml")
    C = float(ucrit.tire("pacejka-205-60r15").cornering_coefficient(400 * 9.81))
    assert ucrit.modes(vehicle).eigenvalues.real == pytest.approx([-C / 400 / 20])
    text = write_vehicle(vehicle, "sledge.py")
    assert 'tire = "mine.tir"' in text
    (tmp_path / "again.toml").write_text(text)
    again = ucrit.load(tmp_path / "again.toml")
    assert type(again).declaration.slots["tire"].law is type(vehicle).declaration.slots["tire"].law
    assert dict(again.values) == dict(vehicle.values)
    shipped = VEHICLE.replace("mine.tir", "pacejka-205-60r15")
    (tmp_path / "vehicle.toml").write_text(shipped)
    assert ucrit.load(tmp_path / "vehicle.toml").values["tire_FNOMIN"] == 4000
    (tmp_path / "vehicle.toml").write_text(VEHICLE.replace("mine.tir", "none.tir"))
    with pytest.raises(UcritError, match=r"there is no file '.*none\.tir'"):
        ucrit.load(tmp_path / "vehicle.toml")
