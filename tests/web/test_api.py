"""What the page is told is what Python tells; bad requests get a sentence; visitors do not disturb one another."""

from __future__ import annotations

import json
import math
import threading
import time
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import ucrit
from ucrit import UcritError, load
from ucrit.analyses.about.listing import template
from ucrit.catalogue import vehicle_names
from ucrit.parts.tires.linear import Linear
from ucrit.web import answers, beyond, downloads, motions, routes
from ucrit.web.subject import read_json, read_subject

CARAVAN = {"vehicle": "caravan"}


def plain(values: Any) -> list[float | None]:
    return [None if math.isnan(v) else v for v in values]


@pytest.mark.parametrize("name", vehicle_names())
def test_the_numbers_are_those_of_python(name: str) -> None:
    vehicle = load(name)
    parameter = type(vehicle).declaration.speed or next(iter(vehicle.values))
    low, high = sorted((0.5 * vehicle.values[parameter], 1.1 * vehicle.values[parameter]))
    told = answers.state(vehicle, {"along": parameter, "range": [low, high]})
    found = ucrit.analyze(vehicle).to_dict()
    assert json.loads(json.dumps(told["analysis"], allow_nan=False)) == {**found, "remedies": []}
    assert told["values"] == {k: float(v) for k, v in vehicle.values.items()}
    if told.get("locus") is None:
        assert all(mode["re"] == mode["im"] == 0 for mode in found["modes"])
        return
    path = ucrit.locus(vehicle, parameter, *told_range(told), points=answers.POINTS, depth=answers.DEPTH)
    assert told["locus"]["values"] == path.values.tolist()
    columns = [plain(column) for column in path.branches.real.T.tolist()]
    assert all(any(same(b["re"], column) for column in columns) for b in told["locus"]["branches"])
    edges = [c for c in ucrit.critical(vehicle, parameter) if path.values[0] <= c.value <= path.values[-1]]
    assert [c["value"] for c in told["critical"]] == [c.value for c in edges]


def told_range(told: dict[str, Any]) -> tuple[float, float]:
    return told["locus"]["values"][0], told["locus"]["values"][-1]


def same(drawn: list[float | None], column: list[float | None]) -> bool:
    return all(a is None or a == b for a, b in zip(drawn, column, strict=True))


@pytest.mark.parametrize(
    "name", ["caravan", "wheelset", "supermarket-cart-pushed-backward", "marble-on-a-hill", "explorer-1"]
)
def test_sliders_lie_within_bounds_and_around_the_vehicle(name: str) -> None:
    vehicle = load(name)
    for told in answers.opened(vehicle, {})["parameters"]:
        low, high = told["range"]
        declared = type(vehicle).declaration.parameters[told["name"]]
        assert low <= told["value"] <= high
        assert low < high
        assert declared.allows([low, high]).all()


def test_the_map_is_pythons(ask: Any) -> None:
    told = ask("/api/map", {**CARAVAN, "x": "U", "y": "a", "x_range": [1, 50], "y_range": [0.5, 8]}).json()
    x, y = (np.linspace(told[k]["low"], told[k]["high"], told[k]["count"]) for k in "xy")
    stable = ucrit.stability_map(load("caravan"), U=x, a=y).stable.T
    drawn = np.zeros(stable.shape, dtype=bool)
    for row, ends in zip(drawn, told["runs"], strict=True):
        for start, end in zip(ends[::2], ends[1::2], strict=True):
            row[start:end] = True
    assert (drawn == stable).all()
    assert 0 < told["share"] < 1


def test_a_remedy_of_the_page_works(ask: Any) -> None:
    told = ask("/api/remedies", CARAVAN).json()
    assert len(told["remedies"]) >= 5
    for remedy in told["remedies"]:
        changed = ask("/api/state", {**CARAVAN, "values": {remedy["parameter"]: remedy["value"]}}).json()
        assert changed["analysis"]["verdict"]["stable"], remedy


def test_motions_grow_and_die_as_the_eigenvalue_says() -> None:
    for speed, grows in ((15.0, False), (35.0, True)):
        film = motions.motion(load("caravan", at_speed=speed), {"mode": 0})["film"]
        body = np.array([[[float(v) for v in p.split(",")] for p in frame] for frame in film["bodies"][0]["corners"]])
        aside = body[:, :, 1].mean(axis=1) - np.array(film["centres"])[:, 1]
        third = len(aside) // 3
        first, last = np.ptp(aside[:third]), np.ptp(aside[-third:])
        assert (last > first) == grows


def test_a_disturbance_is_followed_by_the_nonlinear_equations(ask: Any) -> None:
    told = ask("/api/motion", {**CARAVAN, "disturb": "theta"}).json()
    assert "non-linear motion after theta = 0.0349 rad" in told["caption"]
    assert ask("/api/motion", {**CARAVAN, "disturb": "nothing"}).status == 400


@pytest.mark.parametrize("kind", downloads.KINDS)
def test_downloads(ask: Any, kind: str) -> None:
    answer = ask("/api/download", {**CARAVAN, "values": {"m": 1300}, "kind": kind})
    assert answer.status == 200
    assert "attachment" in answer.headers["content-disposition"]
    signs = {"png": b"\x89PNG", "svg": b"<svg", "csv": b"U [m/s],", "toml": b"1300.0", "report": b"<!DOCTYPE html>"}
    if kind == "json":
        vehicle = load("caravan").with_(m=1300)
        assert answer.json() == ucrit.analyze(vehicle).to_dict()
    else:
        assert signs[kind] in answer.content


@pytest.mark.parametrize("name", vehicle_names())
def test_a_vehicle_file_that_was_downloaded_can_be_loaded(name: str) -> None:
    text = downloads.download(load(name), {"kind": "toml"}).content.decode()
    again = read_subject({"toml": text})
    assert dict(again.values) == dict(load(name).values)
    assert type(again) is type(load(name))


TOLERANT = """model = "trailer-kinematic"
[parameters]
a = { value = 3, sd = 0.1 }
b = { value = 0.5, min = 0.4, max = 0.6 }
U = 20
[correlations]
a = { b = 0.3 }
"""


def test_tolerances_are_told_and_kept_where_they_still_hold() -> None:
    known = {p["name"]: p["known"] for p in answers.opened(read_subject({"toml": TOLERANT}), {})["parameters"]}
    assert known == {"a": {"sd": 0.1, "range": None}, "b": {"sd": None, "range": [0.4, 0.6]}, "U": None}

    def again(**values: float) -> Any:
        changed = read_subject({"toml": TOLERANT, "values": values})
        return read_subject({"toml": downloads.download(changed, {"kind": "toml"}).content.decode()})

    assert again(a=3.5).info.tolerances == read_subject({"toml": TOLERANT}).info.tolerances
    assert again(b=0.7).values["b"] == 0.7
    assert again(b=0.7).info.tolerances.names == ("a",)
    assert again(b=0.7).info.tolerances.correlations == ()


def test_tolerances_are_told_as_a_chance(ask: Any) -> None:
    told = ask("/api/sure", {**CARAVAN, "units": "mph", "values": {"U": 25}}).json()["sentence"]
    found = ucrit.uncertainty(load("caravan", {"U": 25}))
    assert f"critical speed {found.quantile(0.5) / 0.44704:.4g} mph in the middle" in told
    assert f"unstable at 55.92 mph in {100 * found.probability(25):.3g} % of all" in told
    assert ask("/api/sure", {"vehicle": "wheelset"}).json() == {"sentence": ""}
    outside = {"values": {name: 5 * load("caravan").values[name] for name in ("b", "k", "c")}}
    assert "standard" not in ask("/api/sure", {**CARAVAN, **outside}).json()["sentence"]


def test_laws_and_controllers_are_told() -> None:
    assert answers.opened(load("caravan-on-brush-tires"), {})["made"] == "the axle's tires: brush"
    assert "controllers: wheel-slip-control, stab" in answers.opened(load("car-with-stability-control"), {})["made"]


@pytest.mark.parametrize("units", answers.SPEEDS)
def test_sentences_say_speeds_in_the_units_of_the_page(ask: Any, units: str) -> None:
    told = ask("/api/state", {**CARAVAN, "units": units}).json()
    size = {"si": "27.78 m/s (100 km/h)", "kmh": "100 km/h", "mph": "62.14 mph"}[units]
    assert told["word"] == f"Unstable at {size}"
    said = {"si": "23.24 m/s (83.6 km/h)", "kmh": "83.65 km/h", "mph": "51.98 mph"}[units]
    assert told["sentence"].startswith(f"Stable up to {said}; above it")
    assert told["analysis"]["verdict"]["sentence"] == ucrit.analyze("caravan").sentence


def test_a_visitor_does_not_wait_for_the_formulas_of_another_model() -> None:
    inside, go, told = threading.Event(), threading.Event(), list[str]()

    def slow(*_: Any) -> str:
        inside.set()
        go.wait(20)
        return "slow"

    first = threading.Thread(target=lambda: told.append(routes._worked("try", slow, load("caravan"), {})))
    first.start()
    assert inside.wait(20)
    told.append(routes._worked("try", lambda *_: "quick", load("wheelset"), {}))
    go.set()
    first.join()
    assert told == ["quick", "slow"]


def test_visitors_do_not_disturb_one_another(ask: Any) -> None:
    speeds = [10.0 + k for k in range(24)]
    told: dict[float, float] = {}

    def visit(speed: float) -> None:
        told[speed] = ask("/api/state", {**CARAVAN, "values": {"U": speed}}).json()["analysis"]["modes"][0]["re"]

    threads = [threading.Thread(target=visit, args=(speed,)) for speed in speeds]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    alone = {speed: ucrit.analyze("caravan", speed).modes[0].eigenvalue.real for speed in speeds}
    assert told == alone


def test_what_takes_too_long_or_breaks_is_told_in_a_sentence(
    ask: Any, monkeypatch: pytest.MonkeyPatch, capsys: Any
) -> None:
    monkeypatch.setattr(routes, "TIME_LIMIT", 0.2)
    monkeypatch.setitem(routes.SLOW, "remedies", lambda *_: time.sleep(0.6))
    answer = ask("/api/remedies", CARAVAN)
    assert answer.status == 503
    assert "takes longer than a page can wait" in answer.json()["error"]
    monkeypatch.setattr(routes, "TIME_LIMIT", 30)
    monkeypatch.setitem(routes.SLOW, "remedies", lambda *_: [][1])
    answer = ask("/api/remedies", CARAVAN)
    assert answer.status == 500
    assert b"Traceback" not in answer.content
    assert "IndexError" in capsys.readouterr().err


def test_turns_up_to_the_limit_are_pythons(ask: Any) -> None:
    told = ask("/api/handling", {"vehicle": "spinning-car", "units": "kmh"}).json()
    found = ucrit.handling_diagram(load("spinning-car"))
    assert told["told"][0] == "Steady turns at 100 km/h: the car spins: the rear axle saturates first"
    for name in ("a_y", "front", "rear", "difference", "curvature", "delta", "stable"):
        assert told[name] == getattr(found, name).tolist()
    assert not any("-17" in line or "-18" in line for line in beyond.handling(load("bmw-320i"), {})["told"])
    shown = {name: answers.opened(load(name), {})["turns"] for name in ("spinning-car", "bmw-320i", "caravan")}
    assert shown == {"spinning-car": True, "bmw-320i": True, "caravan": False}
    refused = ask("/api/handling", CARAVAN)
    assert refused.status == 400
    assert "a handling diagram needs" in refused.json()["error"]


def test_limit_cycles_are_pythons(ask: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    gear = {"vehicle": "nose-gear", "values": {"k": -10, "V": 21}, "units": "kmh"}
    told = ask("/api/cycles", gear).json()
    found = ucrit.limit_cycles(load("nose-gear", {"k": -10, "V": 21}))
    branch = found.branches[0]
    assert told["told"][0].startswith(f"Straight running is stable below {3.6 * branch.critical.value:.4g} km/h;")
    assert told["told"][-1] == "psi is the swivel angle."
    x = [v for piece in told["branches"][0]["pieces"] for v in piece["x"]]
    y = [v for piece in told["branches"][0]["pieces"] for v in piece["y"]]
    assert set(x) == {branch.critical.value, *branch.values}
    assert max(y) == pytest.approx(math.degrees(branch.amplitudes[:, branch.states.index("psi")].max()))
    calm = ask("/api/cycles", {"vehicle": "ford-escort"}).json()
    assert calm == {"told": list(ucrit.limit_cycles(load("ford-escort")).sentences), "branches": []}
    monkeypatch.setattr(beyond, "PATIENCE", 0.0)
    refused = ask("/api/cycles", gear)
    assert refused.status == 400
    assert "ucrit cycles has no such limit" in refused.json()["error"]


def test_a_motion_that_goes_on_for_too_long_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(motions, "PATIENCE", 0.0)
    with pytest.raises(UcritError, match="takes longer than a page can wait"):
        motions.motion(load("shimmying-caster"), {"disturb": "x"})


@settings(max_examples=80)
@given(st.data(), st.sampled_from(["caravan", "wheelset", "shimmying-caster", "motorcycle-lean"]))
def test_extreme_values_get_an_answer_or_a_sentence(ask: Any, data: Any, name: str) -> None:
    names = st.sampled_from(list(load(name).values))
    values = data.draw(st.dictionaries(names, st.floats(1e-300, 1e300) | st.floats(1e-6, 1e6), max_size=3))
    answer = ask("/api/state", {"vehicle": name, "values": values})
    assert answer.status in (200, 400)


BAD = {
    "no subject": ({}, "names a vehicle"),
    "two subjects": ({"vehicle": "caravan", "toml": "x"}, "names a vehicle"),
    "misspelt": ({"vehicle": "carawan"}, "did you mean 'caravan'?"),
    "a path": ({"vehicle": "../../../../etc/passwd"}, "there is no vehicle"),
    "a file": ({"vehicle": "src/ucrit/data/vehicles/caravan.toml"}, "there is no vehicle"),
    "no text": ({"toml": 3}, "text of at most"),
    "a Python file": ({"toml": 'model = "evil.py"\n[parameters]'}, "'evil.py' is a file"),
    "a class in a file": ({"toml": 'model = "/tmp/evil.py:X"\n[parameters]'}, "is a file"),
    "a bond graph": ({"toml": 'model = "/etc/passwd.bonds"\n[parameters]'}, "is a file"),
    "a folder": ({"toml": 'model = "../../car"\n[parameters]'}, "is a file"),
    "self in a file": ({"toml": 'model = "car"\n[parameters]\nself = 2'}, "there is no parameter 'self'"),
    "units": ({"vehicle": "caravan", "units": "furlongs"}, "there are no units 'furlongs'"),
    "a file too long": ({"toml": "a." * 20000 + "b = 1"}, "at most 32 kB"),
    "a module": ({"toml": 'model = "os"\n[parameters]'}, "there is no model 'os'"),
    "a tire file": (
        {"toml": 'model = "car"\n[parts]\nfront = "/etc/x.tir"\n[parameters]'},
        "there is no slot",
    ),
    "not TOML": ({"toml": "model ="}, "not valid TOML"),
    "no such parameter": ({"vehicle": "caravan", "values": {"mm": 1}}, "did you mean 'm'?"),
    "self": ({"vehicle": "caravan", "values": {"self": 1}}, "there is no parameter 'self'"),
    "below a bound": ({"vehicle": "caravan", "values": {"m": -5}}, "mass m must be above 0 kg, got -5 kg"),
    "a list": ({"vehicle": "caravan", "values": {"m": [1, 2]}}, "must be a number"),
    "true": ({"vehicle": "caravan", "values": {"m": True}}, "must be a number"),
    "no number": ({"vehicle": "caravan", "values": {"m": "heavy"}}, "must be a number"),
    "a tower": ({"vehicle": "caravan", "values": {"m": "9 kg**9**9**9"}}, "measured in kg"),
    "an essay": ({"vehicle": "caravan", "values": {"m": "1" * 100}}, "at most 64 characters"),
    "no values": ({"vehicle": "caravan", "values": 7}, "values must be"),
    "a range": ({"vehicle": "caravan", "along": "U", "range": [5, 4]}, "two rising numbers"),
    "half a character": ({"vehicle": "\ud800"}, "there is no vehicle"),
    "half a range": ({"vehicle": "caravan", "along": "U", "range": [5]}, "must be two numbers"),
    "along nothing": ({"vehicle": "caravan", "along": "Q"}, "there is no parameter 'Q'"),
}


@pytest.mark.parametrize("case", BAD)
def test_what_is_wrong_is_told_in_a_sentence(ask: Any, case: str) -> None:
    body, sentence = BAD[case]
    answer = ask("/api/state", body)
    assert answer.status == 400
    assert sentence in answer.json()["error"]
    assert "\n" not in answer.json()["error"]


class OnTires(ucrit.Model):
    """A model with tires in a slot."""

    m: float = ucrit.param("kg", "mass", above=0)
    tire = ucrit.slot(Linear, "tires")
    y = ucrit.coordinate("m", "place")

    def equations(self, x: Any, ddx: Any) -> Any:
        """Nothing acts."""
        return self.m * ddx.y


def test_a_tire_file_is_not_read(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ucrit.catalogue.vehicles, "find_model", lambda name: OnTires)
    text = 'model = "on-tires"\n[parts]\ntire = "{}"\n[parameters]\n'
    for file in ("/etc/passwd.tir", "x.TIR:measured"):
        with pytest.raises(UcritError, match="is a file; name a law or a tire of the catalogue"):
            read_subject({"toml": text.format(file)})
    for shipped in ("pacejka-205-60r15", "brush"):
        with pytest.raises(UcritError, match="mass m is missing"):
            read_subject({"toml": text.format(shipped)})


def test_bodies_that_are_no_json(ask: Any) -> None:
    for body in (
        b"",
        b"{",
        b"[1]",
        b"null",
        b"\xff\xfe",
        b'{"a": NaN}',
        b"[" * 100_000,
        b'{"x": ' + b"9" * 5000 + b"}",
    ):
        answer = ask("/api/state", body, method="POST")
        assert answer.status == 400
        assert "JSON" in answer.json()["error"]


JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False) | st.text(max_size=12),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=8), inner, max_size=3),
    max_leaves=6,
)
KEYS = st.sampled_from(
    ["vehicle", "toml", "values", "along", "range", "x", "y", "x_range", "y_range", "mode", "disturb", "kind"]
)
WORK = [answers.opened, answers.state, answers.remedies, answers.plane, motions.motion, downloads.download]


@settings(max_examples=150)
@given(st.dictionaries(KEYS, JSON, max_size=5), st.booleans(), st.sampled_from(WORK))
def test_whatever_is_sent_is_answered_or_refused(body: dict[str, Any], known: bool, work: Any) -> None:
    body = {**body, **({"vehicle": "caravan-kinematic", "toml": None} if known else {})}
    told: list[str] = []
    try:
        read = read_json(json.dumps(body).encode())
        assert work(read_subject(read), read)
    except UcritError as error:
        told.append(str(error))
    assert "" not in told


@settings(max_examples=60)
@given(st.text(max_size=40), st.integers(0, 400))
def test_damaged_vehicle_files_are_loaded_or_refused(junk: str, place: int) -> None:
    text, told = template("caravan"), list[str]()
    try:
        read_subject({"toml": text[:place] + junk + text[place:]})
    except UcritError as error:
        told.append(str(error))
    assert "" not in told
