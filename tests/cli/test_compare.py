"""``ucrit compare``: vehicles side by side."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import Result

import ucrit

Run = Callable[..., Result]


def test_prints_sentences_and_the_table(run: Run) -> None:
    names = "understeering-car", "oversteering-car"
    result = run("compare", *names)
    assert result.exit_code == 0
    vehicles = [ucrit.load(name) for name in names]
    flat = " ".join(result.stdout.split())
    for vehicle in vehicles:
        assert vehicle.info.name in result.stdout
        assert ucrit.analyze(vehicle).sentence[1:] in flat
    assert str(ucrit.compare(*vehicles)) in result.stdout
    assert max(map(len, result.stdout.splitlines())) <= 80


def test_speed_is_asked_of_all(run: Run) -> None:
    text = run("compare", "understeering-car", "oversteering-car", "--upto", "140 km/h").stdout
    assert re.search(r"^speed \[m/s\] +38.889 +38.889$", text, re.MULTILINE)
    assert re.search(r"^verdict +stable +unstable$", text, re.MULTILINE)


def test_one_vehicle_with_itself_changed(run: Run) -> None:
    text = run("compare", "caravan", "--set", "c=8000", "--set", "m=1.1 t").stdout
    assert "with c = 8000, m = 1.1 t" in text
    assert re.search(r"^m \[kg\] +1200 +1100$", text, re.MULTILINE)
    assert re.search(r"^c \[N m s/rad\] +4000 +8000$", text, re.MULTILINE)
    assert not re.search(r"^a \[m\]", text, re.MULTILINE)


def test_models_may_differ_and_lack_a_speed(run: Run) -> None:
    text = run("compare", "wheelset", "wheelset-1-in-20", "coach-truck").stdout
    assert max(map(len, text.splitlines())) <= 80
    assert re.search(r"^model +wheelset +wheelset- +rail-truck$", text, re.MULTILINE)
    assert re.search(r"^verdict +stable +neutral +stable$", text, re.MULTILINE)


def test_json_holds_the_analyses_and_the_differences(run: Run) -> None:
    found = json.loads(run("compare", "caravan", "understeering-car", "--json").stdout)
    assert list(found) == ["schema", "vehicles", "static_terms", "differing"]
    alone = [json.loads(run("analyze", name, "--json").stdout) for name in ("caravan", "understeering-car")]
    assert found["vehicles"] == alone
    differing = {entry["parameter"]: entry for entry in found["differing"]}
    assert differing["m"] == {"parameter": "m", "unit": "kg", "values": [1200, 1500]}
    assert differing["C_f"]["values"] == [None, 75e3]


def test_own_file(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(re.sub(r"(?m)^m = .*$", "m = 1400", run("new", "caravan").stdout, count=1))
    text = run("compare", "caravan", path).stdout
    assert re.search(r"^m \[kg\] +1200 +1400$", text, re.MULTILINE)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ([], "missing argument 'VEHICLE...'"),
        (["caravan"], "needs a second vehicle, or a change: 'ucrit compare caravan --set NAME=VALUE'"),
        (["caravan", "carvan"], "did you mean 'caravan'?"),
        (["caravan", "trailer"], "'trailer' is a model, not a vehicle"),
        (["caravan", "neutral-car", "--set", "c=1"], "2 vehicles are given"),
        (["caravan", "--set", "cc=1"], "there is no parameter 'cc'"),
        (["caravan", "--set", "c=-1"], "c must be at least 0 N m s/rad, got -1 N m s/rad"),
        (["caravan", "--set", "c"], "NAME=VALUE"),
        (["caravan", "--set", "U=1", "--upto", "2"], "the speed is given twice"),
        (["caravan", "wheelset-1-in-20", "--upto", "3"], "has no speed"),
        (["caravan", "neutral-car", "--upto", "3 kg"], "kg"),
        (["caravan", "neutral-car", "--jsn"], "did you mean '--json'?"),
    ],
)
def test_wrong_input(arguments: list[str], words: str, run: Run) -> None:
    result = run("compare", *arguments)
    assert result.exit_code == 2
    assert result.stdout == ""
    assert len(result.stderr.splitlines()) == 1
    assert result.stderr.startswith("ucrit: ")
    assert words in result.stderr
