import pytest

from ucrit.catalogue import controlled, find_model, find_part, graph_model, load, model_names, vehicle_names
from ucrit.core.contract.files import Find, parse_vehicle, vehicle_template, write_vehicle
from ucrit.core.errors import UcritError

GOOD = """model = "car"
name = "x"
[parameters]
m = "1.1 t"
I_z = 1800
a = 1.2
b = 1.4
C_f = "100 kN/rad"
C_r = 9e4
U = "50 km/h"
"""


FIND = Find(find_model, find_part, controlled, graph_model)


def parse(text):
    return parse_vehicle(text, "x.toml", FIND)


def test_units_in_files():
    car = parse(GOOD)
    assert (car.m, car.C_f, car.U) == pytest.approx((1100, 1e5, 50 / 3.6))


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("m = ", "mm = ", "x.toml: car: there is no parameter 'mm'; did you mean 'm'?"),
        ('"1.1 t"', '"1.1 m"', "x.toml: car: mass m is measured in kg, got '1.1 m'"),
        (
            "1800",
            "-1",
            "x.toml: car: yaw moment of inertia about the centre of mass I_z must be above 0 kg m^2",
        ),
        ("1800", "true", "must be a number or a text with a unit, got True"),
        ("1800", "1979-05-27", "must be a number"),
        ("1800", "", "x.toml: not valid TOML: Invalid value (at line 5, column 7)"),
        ('"car"', '"cra"', "x.toml: there is no model 'cra'; did you mean 'car'?"),
        ('"car"', "3", "x.toml: model must be a text in quotes, got 3"),
        ("[parameters]", "[parameter]", "x.toml: there is no entry 'parameter'; did you mean 'parameters'?"),
        ("[parameters]", "", "x.toml: there is no entry 'm'"),
        ('name = "x"', 'name = "x"\nname = "y"', "x.toml: not valid TOML: Cannot overwrite a value"),
        ("U = ", "# ", "x.toml: car: forward speed U is missing; it must be above 0 m/s"),
        ("1800", "nan", "must be finite, got nan"),
    ],
)
def test_wrong_files_are_refused_in_one_sentence(old, new, message):
    with pytest.raises(UcritError) as caught:
        parse(GOOD.replace(old, new, 1))
    assert str(caught.value).startswith(message) or message in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("name", vehicle_names())
def test_writing_and_reading_a_vehicle_loses_nothing(name):
    vehicle = load(name)
    again = parse_vehicle(write_vehicle(vehicle), name, FIND)
    assert again == vehicle


def test_names_with_quotes_and_line_breaks_survive():
    car = parse(GOOD).with_info(name='a "b" \\ c\n\x07d', source="é\u2028")
    again = parse_vehicle(write_vehicle(car), car.info.file, FIND)
    assert again == car


@pytest.mark.parametrize("name", model_names())
def test_a_template_only_lacks_numbers(name):
    text = vehicle_template(find_model(name))
    with pytest.raises(UcritError, match="is missing"):
        parse_vehicle(text, "new.toml", FIND)
    for parameter in find_model(name).declaration.parameters.values():
        size = 0.5 if parameter.sign else 0.1  # products of inertia are less than moments
        middle = (parameter.lower + parameter.upper) / 2
        value = next(x for x in (size, -size, middle) if parameter.allows(x))
        text = text.replace(f"# {parameter.name} = ", f"{parameter.name} = {value} ")
    assert parse_vehicle(text, "new.toml", FIND).model_id() == name


@pytest.mark.parametrize(
    ("path", "message"),
    [
        ("nowhere.toml", "there is no file 'nowhere.toml'"),
        ("caravann", "there is no vehicle 'caravann'; did you mean 'caravan'?"),
        ("/", "is a folder, not a file"),
    ],
)
def test_files_that_are_not_there(path, message):
    with pytest.raises(UcritError, match=message.replace("?", r"\?")):
        load(path)


def test_a_model_beside_its_vehicle_file(tmp_path):
    (tmp_path / "lag.py").write_text(
        "from ucrit import Model, param, state\n"
        "class Lag(Model):\n"
        "    'A lag (a source).'\n"
        "    T: float = param('s', 'time constant', above=0)\n"
        "    x = state('m', 'position')\n"
        "    def equations(self, x, dx):\n"
        "        return self.T * dx.x + x.x\n"
    )
    (tmp_path / "mine.toml").write_text('model = "lag.py"\n[parameters]\nT = "10 ms"\n')
    assert load(tmp_path / "mine.toml").values["T"] == 0.01
    (tmp_path / "wrong.toml").write_text('model = "lag.py:Lga"\n[parameters]\nT = 1\n')
    with pytest.raises(UcritError, match="did you mean 'Lag'"):
        load(tmp_path / "wrong.toml")
    (tmp_path / "bad.py").write_text("import ucrit\nx = 1/0\n")
    (tmp_path / "bad.toml").write_text('model = "bad.py"\n[parameters]\nT = 1\n')
    with pytest.raises(UcritError, match=r"cannot be run in line 2: ZeroDivisionError"):
        load(tmp_path / "bad.toml")


def test_binary_files_are_not_text(tmp_path):
    (tmp_path / "x.toml").write_bytes(b"\xff\xfe\x00\x01")
    with pytest.raises(UcritError, match="not a text file"):
        load(tmp_path / "x.toml")


def test_a_byte_order_mark_is_not_part_of_the_file(tmp_path):
    text = 'model = "trailer-kinematic"\n[parameters]\na = 3\nb = 0.5\nU = 20\n'
    (tmp_path / "x.toml").write_text(text, encoding="utf-8-sig")
    assert load(tmp_path / "x.toml").values["a"] == 3
    (tmp_path / "y.toml").write_text(text + "self = 1\n", encoding="utf-8")
    with pytest.raises(UcritError, match="there is no parameter 'self'"):
        load(tmp_path / "y.toml")


def test_a_change_puts_a_tire_into_a_slot(tmp_path, monkeypatch):
    """Of the file's values those stay that the new law has; a path of the command line begins where that is typed."""
    from ucrit.catalogue import TIRES, VEHICLES, load, read_vehicle

    car, other = load("spinning-car"), load("spinning-car", {"front": "dugoff", "rear": "linear"})
    assert other.ingredients()["parts"] == {"front": "dugoff", "rear": "linear"}
    assert (other.front_C, other.front_mu, other.rear_C) == (car.front_C, car.front_mu, car.rear_C)
    assert "rear_mu" not in other.values
    (tmp_path / "mine.tir").write_text((TIRES / "pacejka-205-60r15.tir").read_text())
    monkeypatch.chdir(tmp_path)
    mine = load("spinning-car", {"front": "mine.tir:SLIP=angle"})
    assert mine.ingredients()["parts"]["front"] == "mine.tir:SLIP=angle"
    text = (VEHICLES / "spinning-car.toml").read_text()
    for change, message in (
        ({"front": "bruch"}, "there is no tire law 'bruch'; did you mean 'brush'"),
        ({"front": 5}, "part front must be the name of a law in quotes, got 5"),
        ({"front": "brush-moment"}, "half length of the contact patch front_l_c is missing"),
        ({"front": "linear", "front_mu": 1}, "there is no parameter 'front_mu'"),
    ):
        with pytest.raises(UcritError, match=message):
            load("spinning-car", change)
    with pytest.raises(UcritError, match=r"'mine\.tir:SLIP=angle' is a file; name a law or a tire of the catalogue"):
        read_vehicle(text, "pasted", {"front": "mine.tir:SLIP=angle"})
