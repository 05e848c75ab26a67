"""docs/json.md describes the JSON that the commands print, key by key."""

from __future__ import annotations

import json
import re
import shlex
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from click.testing import Result

Run = Callable[..., Result]
DOCUMENT = (Path(__file__).parents[2] / "docs" / "json.md").read_text(encoding="utf-8")
OPEN = ("vehicle.parameters", "modes[].participation")
VEHICLES = ["caravan", "oversteering-car", "wheelset-1-in-20", "shimmying-caster"]


def same(found: Any, printed: Any) -> None:
    """Assert equality, numbers to 9 digits: eigenvalue solvers differ in the last ones."""
    if isinstance(printed, dict):
        assert list(found) == list(printed)
        for key in printed:
            same(found[key], printed[key])
    elif isinstance(printed, list):
        assert len(found) == len(printed)
        for a, b in zip(found, printed, strict=True):
            same(a, b)
    elif isinstance(printed, float):
        assert found == pytest.approx(printed, rel=1e-9, abs=1e-12)
    else:
        assert found == printed


def test_the_example_is_what_the_command_prints(run: Run) -> None:
    command = re.search(r"^\$ ucrit (.*)$", DOCUMENT, re.MULTILINE)
    printed = re.search(r"```json\n(.*?)```", DOCUMENT, re.DOTALL)
    assert command
    assert printed
    same(json.loads(run(*shlex.split(command[1])).stdout), json.loads(printed[1]))


def paths(value: Any, at: str = "") -> Iterator[str]:
    """Yield the paths of all entries, lists and objects of more than one level included where they are."""
    if at in OPEN:
        yield from (f"{at}.*" for _ in value)
    elif isinstance(value, dict):
        if at == "speed":
            yield at
        for key, inner in value.items():
            yield from paths(inner, f"{at}.{key}" if at else key)
    elif isinstance(value, list):
        yield at
        for inner in value:
            yield from paths(inner, at + "[]")
    else:
        yield at


def test_every_entry_is_documented_and_no_other(run: Run) -> None:
    section = DOCUMENT.split("\n## ")[1]
    documented = re.findall(r"^\| `([^`]+)` \|", section, re.MULTILINE)
    found = {path for name in VEHICLES for path in paths(json.loads(run("analyze", name, "--json").stdout))}
    assert found == set(documented)
    assert len(documented) == len(set(documented))


def test_show_and_list_have_the_documented_entries(run: Run) -> None:
    section = DOCUMENT.split("\n## ")[2]
    documented = {
        n.partition(".")[0]
        for row in re.findall(r"^\| (`.*?) \|", section, re.MULTILINE)
        for n in re.findall(r"`([^`]+)`", row)
    }
    assert set(json.loads(run("show", "caravan", "--json").stdout)) == documented
    listed = json.loads(run("list", "--json").stdout)
    assert set(listed) == {"schema", "models", "vehicles", "controllers"}
    assert set(listed["models"][0]) == {"name", "title", "model"}


def test_compare_has_the_documented_entries(run: Run) -> None:
    section = DOCUMENT.split("\n## ")[4]
    documented = re.findall(r"^\| `([^`]+)` \|", section, re.MULTILINE)
    printed = json.loads(run("compare", "understeering-car", "navion-plane", "--json").stdout)
    own = {key: value for key, value in printed.items() if key != "vehicles"}
    assert {path.removesuffix("[]") for path in paths(own)} | {"vehicles"} == set(documented)
    for name, vehicle in zip(("understeering-car", "navion-plane"), printed["vehicles"], strict=True):
        same(vehicle, json.loads(run("analyze", name, "--json").stdout))
    assert {"parameter": "I_z", "unit": "kg m^2", "values": [2500, None]} in printed["differing"]


def test_the_audits_entries_are_documented(run: Run) -> None:
    section = next(part for part in DOCUMENT.split("\n## ") if part.startswith("`ucrit analyze --audit"))
    rows = re.findall(r"^\| (`audit.*?) \|", section, re.MULTILINE)
    documented = {name for row in rows for name in re.findall(r"`audit\.([^`]+)`", row)}
    assert set(paths(json.loads(run("analyze", "caravan", "--audit", "--json").stdout)["audit"])) == documented


def test_a_graphs_entries_are_documented(run: Run, tmp_path: Path) -> None:
    section = next(part for part in DOCUMENT.split("\n## ") if part.startswith("`ucrit bonds --json"))
    rows = re.findall(r"^\| (`.*?) \| .*? \| (.*) \|$", section, re.MULTILINE)
    documented = {
        name: set(re.findall(r"`(\w+)`", meaning)) for names, meaning in rows for name in re.findall(r"`(\w+)`", names)
    }
    loops = "1 x\nSe push = 1\nR a = 2\n0 z\nR b = 3\npush -> x -> a\nx -> z -> b"
    loop = tmp_path / "loop.bonds"
    loop.write_text(loops)
    for name in ("caravan-rigid-tire", str(loop)):
        found = json.loads(run("bonds", name, "--json").stdout)
        assert set(found) == set(documented)
        for key in ("elements", "bonds", "signals", "dependent", "loops", "states"):
            for entry in found[key]:
                assert set(entry) <= documented[key]
    assert [(loop["bonds"], loop["linear"]) for loop in found["loops"]] == [([2, 3, 4], True)]
