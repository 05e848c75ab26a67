"""``ucrit tire``."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import Result

Run = Callable[..., Result]


def test_a_file_tells_version_units_axes_and_forces(run: Run) -> None:
    text = run("tire", "pac2002-235-60r16", "--load", "4 kN").stdout
    for words in ("PAC2002 (MF 5.2)", "length in meter", "ISO 8855", "shifts   left out", "74905", "0.523"):
        assert words in text
    assert "as measured" in run("tire", "pac2002-235-60r16:measured").stdout
    assert max(map(len, text.splitlines())) <= 80


def test_laws_take_numbers_and_roads(run: Run) -> None:
    text = run("tire", "brush", "--set", "C=1 kN/deg", "--load", "4000", "--road", "ice=0.1", "--road", "dry=1").stdout
    assert "57296" in text
    assert "Forces on road 'ice', friction times 0.1" in text
    assert "Property file" not in text


@pytest.mark.parametrize("ending", ["png", "svg", "csv", "json", "mat", "nc"])
def test_curves_are_written(run: Run, tmp_path: Path, ending: str) -> None:
    path = tmp_path / f"out.{ending}"
    assert run("tire", "brush", "--set", "C=80000", "-o", path).exit_code == 0
    assert path.stat().st_size > 1000


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["pacejca-205"], "did you mean 'pacejka-205-60r15'?"),
        (["none.tir"], "there is no file 'none.tir'"),
        (["brush"], "a law, which needs a tire's numbers"),
        (["brush", "--set", "C=3", "--load", "-1"], "load must be above 0 N, got -1 N"),
        (["brush", "--set", "C=3", "--road", "ice"], "NAME=VALUE"),
        (["brush", "--set", "C=3", "--road", "ice=0"], "friction mu must be above 0"),
        (["brush", "--set", "C=3", "-o", "x.xls"], "must end in .csv"),
    ],
)
def test_what_is_wrong_is_one_sentence(run: Run, arguments: list[str], words: str) -> None:
    result = run("tire", *arguments)
    assert (result.exit_code, result.stdout) == (2, "")
    assert words in result.stderr
    assert len(result.stderr.splitlines()) == 1
