"""Every command that answers prints the same answer as one object of strict JSON."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from click.testing import Result

from ucrit import certify, load, stability_map, uncertainty
from ucrit.analyses.results.convert import finite
from ucrit.cli.app import COMMANDS, cli

Run = Callable[..., Result]

ANSWERS = {
    "analyze": ["caravan"],
    "compare": ["caravan", "neutral-car"],
    "list": [],
    "show": ["cart"],
    "simulate": ["caravan", "--until", "1", "--initial", "theta=0.01", "--points", "3"],
    "sweep": ["caravan", "U=10,20"],
    "map": ["caravan", "c=0:8000:3", "U=5:50:3", "--margins"],
    "cycles": ["nose-gear", "--set", "k=-10", "--at", "25"],
    "handling": ["spinning-car"],
    "boundary": ["caravan", "c=0:8000", "U=5:50", "--tolerance", "0.1"],
    "margins": ["motorcycle-steered-to-lean"],
    "uncertainty": ["caravan", "--samples", "16"],
    "certify": ["caravan", "U=5:60"],
    "routh": ["s^3 + 4 s^2 + 5 s + K"],
    "bonds": ["caravan"],
    "tire": ["pacejka-205-60r15"],
    "check": ["cart"],
    "cite": ["caravan"],
}
SILENT = {"new", "app", "completion"}
"""Commands that give a file, a page, a script: no answers."""


def object_of(text: str) -> dict[str, Any]:
    """Read strict JSON; whatever else stands on standard output is an error."""

    def refuse(constant: str) -> None:
        raise AssertionError(f"{constant} is no JSON")

    found = json.loads(text, parse_constant=refuse)
    assert isinstance(found, dict)
    return found


def test_every_command_is_either_asked_here_or_gives_no_answer() -> None:
    assert set(ANSWERS) | SILENT == set(COMMANDS)
    assert not set(ANSWERS) & SILENT


@pytest.mark.parametrize("command", ANSWERS)
def test_the_answer_is_one_object_and_nothing_else(run: Run, command: str) -> None:
    result = run(command, *ANSWERS[command], "--json")
    assert result.exit_code == 0
    found = object_of(result.stdout)
    assert found["schema"] == 1
    if "coordinates" in found:  # a table's answers have one shape
        shape = ["schema", "result", "model", "vehicle", "parameters", "findings", "coordinates", "variables"]
        assert list(found) == shape
        assert result.stdout.count("\n") == 1


@pytest.mark.parametrize("command", ["map", "handling", "uncertainty", "simulate", "margins", "boundary", "tire"])
def test_what_is_printed_is_what_is_written(run: Run, command: str, tmp_path: Path) -> None:
    path = tmp_path / "answer.json"
    result = run(command, *ANSWERS[command], "--json", "--out", path)
    assert object_of(result.stdout) == object_of(path.read_text())


def test_findings_are_those_of_the_results() -> None:
    caravan = load("caravan")
    refuted = certify(caravan, U=(5.0, 60.0)).to_dict()["findings"]
    assert refuted["state"] == "refuted"
    assert refuted["counterexample"]["eigenvalues"][0]["re"] > 0
    assert certify(caravan, U=(5.0, 10.0)).to_dict()["findings"]["counterexample"] is None
    found = stability_map(caravan, U=[10.0, 20.0, 30.0, 40.0])
    assert found.to_dict()["findings"] == {"share": 0.5}
    never = uncertainty(caravan, samples=16, upto=5).to_dict()["findings"]
    assert never["as_given"] is None  # infinity: none up to 5 m/s
    assert never["never"] == 1


def test_numbers_that_json_does_not_have_are_null() -> None:
    assert finite({"a": [1.0, float("inf")], "b": float("nan"), "c": "x"}) == {"a": [1.0, None], "b": None, "c": "x"}


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["sweep", "caravan", "U=10,20", "-o", "x.zarr"], "--json prints a result that is held in memory"),
        (["map", "caravan", "c=0:8:3", "U=5:50:3", "-o", "x.zarr"], "--json prints a result that is held in memory"),
        (["analyze", "no-such"], "no-such"),
    ],
)
def test_errors_are_no_json(arguments: list[str], sentence: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as left:
        cli.main([*arguments, "--json"])
    told = capsys.readouterr()
    assert left.value.code == 2
    assert told.out == ""
    assert sentence in told.err
