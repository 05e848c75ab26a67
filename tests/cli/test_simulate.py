"""``ucrit simulate`` and ``ucrit analyze --audit``, through the same door as a user."""

from __future__ import annotations

import csv
import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from click.testing import Result

from ucrit import load, simulate

Run = Callable[..., Result]


def test_it_tells_the_end_the_events_and_the_peaks(run: Run) -> None:
    text = run("simulate", "motorcycle-lean", "--until", "10 s", "--initial", "theta=1 deg").stdout
    flat = " ".join(text.split())
    assert "It falls over at 1.538 s: the end." in flat
    assert "1.53778 s falls over theta = 1.571" in flat
    assert "At the end it grows at" in flat
    assert max(map(len, text.splitlines())) <= 80


def test_growth_and_frequency_are_those_of_the_mode(run: Run) -> None:
    text = run("simulate", "caravan", "--until", "20", "--initial", "theta=1e-3").stdout
    assert "At the end it grows at 0.1173 1/s and 0.7545 Hz." in text
    still = run("simulate", "caravan", "--until", "20").stdout
    assert "has come to rest or to a steady state" in still


def test_what_is_written_is_what_python_gets(run: Run, tmp_path: Path) -> None:
    files = [tmp_path / f"run.{ending}" for ending in ("csv", "nc", "json", "png", "html")]
    options = [word for path in files for word in ("--out", path)]
    arguments = ("--until", "3", "--input", "delta_f=step 2 deg at 1 s", "--points", "31", "--set", "m=1.6 t")
    text = run("simulate", "understeering-car", *arguments, *options).stdout
    expected = simulate(
        load("understeering-car", {"m": 1600}), 3, inputs={"delta_f": "step 2 deg at 1 s"}, times=np.linspace(0, 3, 31)
    )
    rows = list(csv.DictReader(files[0].read_text().splitlines()))
    assert [float(row["r [rad/s]"]) for row in rows] == expected["r"].tolist()
    assert json.loads(files[2].read_text())["variables"]["r"]["values"] == expected["r"].tolist()
    for path in files:
        assert path.stat().st_size > 1000
        assert f"Written to {path}" in text.replace("\n", " ") or path.name in text
    assert sorted(tmp_path.iterdir()) == sorted(files)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--input", "delta_f=stepp 2 deg"), "input delta_f: there is no shape 'stepp'; did you mean 'step'?"),
        (("--input", "delta=2 deg"), "there is no input 'delta'"),
        (("--input", "delta_f"), "an input is given as NAME=VALUE"),
        (("--initial", "VV=1"), "there is no such state"),
        (("--initial", "V=1", "--initial", "V=2"), "initial value V is given twice"),
        (("--out", "run.avi"), "the output 'run.avi' must end in .csv"),
        (("--method", "Radaw"), "there is no method 'Radaw'; did you mean 'Radau'?"),
        (("--enlarge", "3"), "--enlarge is for an animation"),
        (("--out", "none/run.csv"), "cannot be written"),
        (("--points", "1"), "'--points'"),
    ],
)
def test_mistakes_are_one_sentence(run: Run, arguments: tuple[str, ...], words: str) -> None:
    done = run("simulate", "understeering-car", "--until", "1", *arguments)
    assert done.exit_code == 2
    assert done.stdout == ""
    assert words in done.stderr
    assert len(done.stderr.splitlines()) == 1


def test_a_vehicle_that_cannot_be_drawn_is_refused_before_it_is_followed(run: Run, tmp_path: Path) -> None:
    done = run("simulate", "explorer-1", "--until", "1e9", "--out", tmp_path / "spin.gif")
    assert "cannot be shown in motion" in done.stderr
    assert not list(tmp_path.iterdir())


def test_audit_is_one_line_and_in_the_json(run: Run) -> None:
    flat = " ".join(run("analyze", "caravan", "--audit").stdout.split())
    assert (
        "Audit: the non-linear motion grows at 0.1173 1/s and 0.7545 Hz, "
        "the linear verdict says growth at 0.1173 1/s and 0.7545 Hz (2 modes agree)."
    ) in flat
    assert "Audit" not in run("analyze", "caravan").stdout
    data = json.loads(run("analyze", "navion", "--audit", "--json").stdout)["audit"]
    assert data == {
        "sentence": "the equations of motion are linear: there is nothing to audit",
        "linear_equations": True,
        "agrees": None,
        "size": 1e-4,
        "within": 1e-3,
        "modes": [],
    }
