"""Mistakes of first-time users: each gets one sentence, names what is wrong, and leaves nothing behind."""

import os
import subprocess
import sys
from pathlib import Path

import click
import pytest

from ucrit.cli.app import cli

MODEL = '''"""Axes as usual."""
from ucrit import Model, coordinate, param, speed
from ucrit.core import atan, sin

class Caster(Model):
    """Caster (own derivation, 2026)."""
    m: float = param("kg", "mass", above=0)
    C: float = param("N/rad", "cornering coefficient", above=0)
    U: float = speed()
    theta = coordinate("rad", "swivel angle", motion="swivel")

    def kinetic_energy(self, x, dx):
        return self.m * dx.theta**2 / 2

    def forces(self, x, dx):
        return [(-self.C * atan(x.theta), self.U * sin(x.theta))]
'''
SECOND = MODEL[MODEL.index("class") :].replace("Caster(Model)", "Other(Model)")
THIRD = "class Heavier(Caster):\n    C: float = param('N/rad', 'cornering coefficient', above=0, default=3)\n"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (MODEL + SECOND, "holds 2 models, Caster, Other: pick one, '{path}:Other'"),
        ("import sys\nsys.exit(3)\n", "cannot be run in line 2: SystemExit: 3"),
        ("from ..core import sin\n", "in line 1: ImportError: attempted relative import"),
        ("from .. import x\n", "in a file of one's own write 'from ucrit.core import ...'"),
        ("x = 1\n", "'{path}' defines no model"),
        (MODEL.replace("above=0)\n    C", "abov=0)\n    C"), "in line 7: TypeError: param() has no argument 'abov'"),
        (MODEL.replace("return self.m", "self.m"), "Caster.kinetic_energy must return one expression, got None"),
        (MODEL.replace("[(", "[(1, "), "Caster.forces must return a list of pairs"),
        (MODEL.replace("return [", "["), "Caster.forces must return a list of pairs, each a force"),
        (MODEL.replace("from ucrit.core", "from math").replace("(x.theta)", "(x.theta)"), "take sin, cos, sqrt"),
        (MODEL.replace("from ucrit.core import atan", "from numpy import arctan as atan"), "take sin, cos, sqrt"),
    ],
)
def test_a_model_file_that_is_wrong(run, tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "mine.py"
    path.write_text(text)
    done = run("show", str(path))
    assert done.exit_code == 2
    assert message.format(path=path) in done.stderr
    assert done.stderr.count("\n") == 1


def test_of_a_model_and_what_derives_from_it_the_latter_is_meant(run, tmp_path: Path) -> None:
    path = tmp_path / "mine.py"
    path.write_text(MODEL + THIRD)
    assert run("show", str(path)).stdout.startswith("Heavier\n")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["analyze", "caravan", "--report", "x.txt"], "a report is written to a file ending in .html"),
        (["check", "trailer", "--published", "none.toml"], "there is no file 'none.toml'"),
        (["check", "trailer", "--published", "empty.toml"], "empty.toml: there is nothing to compare with"),
        (["analyze", "latin.toml"], "is not a text file in UTF-8"),
        (["analyze", "digits.toml"], "digits.toml: not valid TOML: a number has too many digits"),
        (["analyze", "caravan", "--set", "m=1e-308"], "trailer: with m = 1e-308 kg the equations leave the range"),
        (["analyze", "caravan", "--set", "U=5e-324"], "the equations leave the range"),
        (["routh", "s^2 + nan"], "must be a finite"),
        (["routh", "s^2 + 1e400"], "holds a number that is not finite"),
        (["show", "nope"], "and 122 more"),
        (["tire", "brush", "--set", "C=1", "--road", "ice"], "a road is given as NAME=VALUE"),
    ],
)
def test_wrong_input(run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, arguments: list[str], message: str):
    monkeypatch.chdir(tmp_path)
    Path("empty.toml").write_text("")
    Path("latin.toml").write_bytes("name = 'Wohnwägen'".encode("latin-1"))
    Path("digits.toml").write_text(f"m = {'9' * 5000}")
    done = run(*arguments)
    assert done.exit_code == 2
    assert message in done.stderr
    assert done.stderr.count("\n") == 1


def test_raised_digits_are_powers(run) -> None:
    assert run("routh", "s² + 2s + 1").stdout == run("routh", "s^2 + 2s + 1").stdout


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="no device that is full")
def test_a_full_disk_and_a_closed_output_are_no_traceback() -> None:
    command = [sys.executable, "-m", "ucrit", "new", "trailer"]
    with open("/dev/full", "w") as full:
        done = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True)
    assert done.returncode == 2
    assert done.stderr == "ucrit: the result cannot be written or read: No space left on device\n"
    done = subprocess.run(["sh", "-c", '"$@" >&-', "sh", *command], stderr=subprocess.PIPE, text=True)
    assert (done.returncode, done.stderr) == (0, "")


def test_lists_name_models_in_one_way(run) -> None:
    assert "_" not in run("list", "vehicles").stdout
    assert "_" not in run("list", "models").stdout


def test_the_same_option_has_the_same_name_everywhere() -> None:
    context = click.Context(cli)
    for name in cli.list_commands(context):
        command = cli.get_command(context, name)
        assert command is not None
        options = {option for p in command.params for option in p.opts if option.startswith("--")}
        assert not options & {"--output", "--file", "--param", "--speed", "--up-to", "--max"}
        assert all(set(p.opts) == {"-o", "--out"} for p in command.params if {"-o", "--out"} & set(p.opts))


@pytest.mark.parametrize(
    "arguments", [["sweep", "caravan", "U=10:20:2"], ["boundary", "caravan", "c=0:8000", "U=20:21"]]
)
def test_what_is_written_is_told(run, tmp_path: Path, arguments: list[str]) -> None:
    path = tmp_path / "ä b.csv"
    assert run(*arguments, "-o", str(path)).stdout == f"Written to {path}\n"
    assert path.exists()
