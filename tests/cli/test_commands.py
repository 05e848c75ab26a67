"""What each command does, through the same door as a user."""

from __future__ import annotations

import json
import re
import socket
from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import Result

import ucrit
from ucrit.analyses.about.show import show
from ucrit.catalogue import TIRES, model_names, vehicle_names
from ucrit.cli.app import COMMANDS

Run = Callable[..., Result]

OWN_MODEL = '''
from ucrit import Model, param, state


class Cart(Model):
    """Cart that slows down (Own, 2024)."""

    m = param("kg", "mass", above=0)
    c = param("N s/m", "damping", default=2)
    v = state("m/s", "velocity")

    def equations(self, x, dx):
        return (self.m * dx.v + self.c * x.v,)
'''


def test_analyze_tells_everything(run: Run) -> None:
    text = run("analyze", "caravan").stdout
    found = ucrit.analyze("caravan")
    flat = " ".join(text.split())
    assert found.vehicle.info.name in flat
    assert found.vehicle.info.source in flat
    assert "UNSTABLE at 27.78 m/s (100 km/h)" in flat
    assert found.sentence[1:] in flat
    for mode in found.modes:
        assert mode.name in flat
    assert "flutter of the sway at 0.7691 Hz" in flat
    compact = "".join(text.split())
    for criterion in found.failing:
        assert "".join(str(criterion).split()) in compact
    for remedy in found.remedies:
        assert re.search(rf"^  {remedy.parameter} +at (least|most) ", text, re.MULTILINE)


def test_words_for_every_verdict(run: Run) -> None:
    for name, word in (
        ("oversteering-car", "STABLE"),
        ("caravan", "UNSTABLE"),
        ("wheelset-1-in-20", "NEUTRAL"),
    ):
        lines = run("analyze", name).stdout.splitlines()
        assert [line for line in lines if line.split(" at ")[0] == word], name
    assert "Remedies: none needed" in run("analyze", "oversteering-car").stdout


def test_closed_form_of_a_critical_speed(run: Run) -> None:
    assert "U**2 = C_f*C_r*(a + b)**2/(m*(C_f*a - C_r*b))" in run("analyze", "oversteering-car").stdout


def test_printed_remedies_really_help(run: Run) -> None:
    rows = re.findall(r"^  (\w+) +at (?:least|most) +(\S+) ", run("analyze", "caravan").stdout, re.MULTILINE)
    assert len(rows) >= 5
    for name, value in rows:
        assert len(value.replace(".", "").replace("-", "").strip("0")) <= 4, value
        result = run("analyze", "caravan", "--set", f"{name}={value}", "--fail-if-unstable")
        assert result.exit_code == 0, (name, value)


def test_exit_status_three_only_when_asked(run: Run) -> None:
    assert run("analyze", "caravan").exit_code == 0
    assert run("analyze", "caravan", "--fail-if-unstable").exit_code == 3
    assert run("analyze", "caravan", "--json", "--fail-if-unstable").exit_code == 3
    assert run("analyze", "caravan", "--upto", "80 km/h", "--fail-if-unstable").exit_code == 0


def test_json_is_the_dictionary_and_nothing_else(run: Run, tmp_path: Path) -> None:
    page = tmp_path / "out.html"
    result = run("analyze", "caravan", "--json", "--report", page)
    assert json.loads(result.stdout) == json.loads(json.dumps(ucrit.analyze("caravan").to_dict()))
    assert page.read_text(encoding="utf-8").lstrip().lower().startswith("<!doctype html")
    assert "caravan" in page.read_text(encoding="utf-8")


def test_set_and_upto_reach_the_analysis(run: Run) -> None:
    found = json.loads(
        run("analyze", "caravan", "--set", "m=2 t", "--set", "a=1.9", "--upto=-10 km/h", "--json").stdout
    )
    values = found["vehicle"]["parameters"]
    assert (values["m"], values["a"]) == (2000, 1.9)
    assert found["speed"]["value"] == pytest.approx(-10 / 3.6)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["analyse", "caravan"], "did you mean 'analyze'?"),
        (["analyze", "carvan"], "did you mean 'caravan'?"),
        (["analyze", "trailer"], "'trailer' is a model, not a vehicle; 'ucrit new trailer > mine.toml'"),
        (["analyze", "caravan", "--jsn"], "did you mean '--json'?"),
        (["analyze"], "missing argument 'VEHICLE'"),
        (["analyze", "caravan", "--set", "m"], "NAME=VALUE"),
        (["analyze", "caravan", "--set", "m=1", "--set", "m=2"], "given twice, as '1' and as '2'"),
        (["analyze", "caravan", "--set", "U=1", "--upto", "2"], "the speed is given twice"),
        (["analyze", "wheelset-1-in-20", "--upto", "3"], "has no speed"),
        (
            ["analyze", "caravan", "--report", "/nowhere/at/all.html"],
            "'/nowhere/at/all.html' cannot be written",
        ),
        (["list", "vehicle"], "'vehicle'"),
        (["show", "carr"], "did you mean 'car'?"),
        (["new", "traler"], "did you mean 'trailer'?"),
        (["new", "car", "--like", "caravan"], "does not give I_z, C_f, C_r of the model car"),
        (["new", "car", "--like", "trailer"], "'trailer' is a model"),
        (["check", "carr"], "did you mean 'car'?"),
        (["check", "car", "--published", "nowhere.toml"], "there is no file 'nowhere.toml'"),
        (["sweep", "caravan"], "missing argument"),
        (["sweep", "caravan", "mm=1:2"], "there is no parameter 'mm'; did you mean 'm'?"),
        (["sweep", "caravan", "m=1:2", "--set", "m=3"], "given twice"),
        (["sweep", "caravan", "m=1:2", "-o", "x.xls"], "must end in .csv"),
        (["map", "caravan", "mm=1:2", "U=3:4"], "there is no parameter 'mm'; did you mean 'm'?"),
        (["map", "caravan", "c=0:1", "U=3:3"], "the range '3:3' is empty"),
        (["map", "caravan", "c=0:1", "U=3:4", "--set", "c=1"], "given twice"),
        (["map", "caravan", "c=0:1:99999", "U=3:4:99999"], "9,999,800,001 points is too large"),
        (["map", "caravan", "c=0:1:99999", "U=3:4:9999", "--margins"], "margins of 999,890,001 points are too many"),
        (["map", "caravan", "c=0:1", "U=3:4", "--engine", "nunba"], "did you mean 'numba'?"),
        (["map", "caravan", "c=0:1", "U=3:4", "m=5:6", "-o", "x.svg"], "drawn over two parameters, got c, U, m"),
        (["map", "caravan", "c=0:1", "U=3:4", "-o", "x.xls"], "must end in .csv"),
        (["map", "caravan", "c=0:1:2400", "U=3:4:2400", "-o", "x.csv"], "a map of 5,760,000 points is too large for"),
        (["map", "caravan", "c=0:1", "U=3:4", "--margins", "-o", "x.zarr"], "has verdicts only"),
        (["boundary", "caravan"], "missing argument"),
        (["boundary", "caravan", "mm=1:2", "U=3:4"], "there is no parameter 'mm'; did you mean 'm'?"),
        (["boundary", "caravan", "m=1:2"], "two or three parameters"),
        (["boundary", "caravan", "m=1:2:3", "U=3:4"], "write LO:HI"),
        (["boundary", "caravan", "m=1:2", "U=3:4", "--tolerance", "2"], "the tolerance"),
        (["boundary", "caravan", "m=1:2", "U=3:4", "-o", "x.xls"], "must end in .csv"),
        (["completion", "tcsh"], "'tcsh'"),
        (["--frob"], "there is no option '--frob'"),
    ],
)
def test_wrong_command_lines(arguments: list[str], words: str, run: Run) -> None:
    result = run(*arguments)
    assert result.exit_code == 2
    assert result.stdout == ""
    assert len(result.stderr.splitlines()) == 1
    assert result.stderr.startswith("ucrit: ")
    assert words in result.stderr


def test_every_command_teaches_by_examples(run: Run) -> None:
    text = run("--help").stdout
    assert run().stdout == text
    for name in COMMANDS:
        assert f"\n  {name} " in text
        own = run(name, "--help").stdout
        assert f"\n    ucrit {name}" in own or f"$(ucrit {name}" in own
        assert "Exit status: 0" in own
        assert max(map(len, own.splitlines())) <= 80, name


def test_examples_in_the_help_run(run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "my_model.py").write_text(OWN_MODEL)
    Path("mine.toml").write_text(run("new", "caravan").stdout)
    monkeypatch.setattr("uvicorn.Server.run", lambda *_, **__: None)  # the explorer would wait for visitors
    monkeypatch.setattr("webbrowser.open", lambda _: True)
    monkeypatch.setattr("ucrit.web.serve.listen", lambda *_: socket.create_server(("127.0.0.1", 0)))

    Path("mine.bonds").write_text(run("bonds", "oscillator", "--text").stdout)
    Path("mine.tir").write_text((TIRES / "pacejka-205-60r15.tir").read_text())
    tried = 0
    for name in COMMANDS:
        for line in re.findall(rf"^    (ucrit {name} .*)$", run(name, "--help").stdout, re.MULTILINE):
            words = re.sub(r" (\||\|\||>) .*$", "", line).removeprefix("ucrit ")
            if "Caster" in words:
                continue
            import shlex

            assert run(*shlex.split(words)).exit_code in (0, 3), line
            tried += 1
    assert tried > 15


def test_list(run: Run) -> None:
    text = run("list").stdout
    for name in (*model_names(), *vehicle_names()):
        assert re.search(rf"^ +{re.escape(name)}  ", text, re.MULTILINE), name
    assert "caravan" not in run("list", "models").stdout
    assert len(ucrit.list("vehicles")) == len(vehicle_names())
    assert {e["name"] for e in json.loads(run("list", "--json").stdout)["models"]} == set(model_names())


def test_show_prints_what_the_description_holds(run: Run) -> None:
    text, found = run("show", "caravan").stdout, show("trailer")
    flat, compact = " ".join(text.split()), "".join(text.split())
    for p in found.parameters:
        assert p.meaning in flat
    for formula in (*found.equations, *found.polynomial):
        assert "".join(formula.text.split()) in compact
    assert "hitch moves along X" in flat
    assert "Karnopp 2004, eq. (5.33)" in flat
    assert json.loads(run("show", "caravan", "--json").stdout)["vehicle"]["parameters"]["m"] == 1200


def test_new_names_the_first_missing_parameter(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(run("new", "trailer").stdout)
    assert "mass m is missing" in run("analyze", path).stderr
    path.write_text(path.read_text().replace("# m = ", "m = 3"))
    assert "I_c is missing" in run("analyze", path).stderr


def test_new_like_a_vehicle(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(run("new", "trailer-rigid-hitch", "--like", "caravan").stdout)
    assert ucrit.load(path).values["a"] == ucrit.load("caravan").values["a"]
    path.write_text(run("new", "caravan").stdout)
    assert dict(ucrit.load(path).values) == dict(ucrit.load("caravan").values)


def test_own_model_in_a_file(run: Run, tmp_path: Path) -> None:
    model = tmp_path / "cart.py"
    model.write_text(OWN_MODEL)
    vehicle = tmp_path / "mine.toml"
    vehicle.write_text(run("new", model).stdout.replace("# m = ", "m = 3 "))
    assert "STABLE" in run("analyze", vehicle).stdout
    assert "c*v + m*v' = 0" in run("show", model).stdout
    assert run("check", model).exit_code == 0
    model.write_text(OWN_MODEL.replace("self.c * x.v,", "nonsense,"))
    result = run("analyze", vehicle)
    assert result.exit_code == 2
    assert "line 13: NameError: name 'nonsense' is not defined" in result.stderr
    assert run("check", model).exit_code == 1


def test_check(run: Run) -> None:
    result = run("check", "trailer-kinematic")
    assert result.exit_code == 0
    assert "pass  equations" in result.stdout


def test_boundary_writes_every_format(run: Run, tmp_path: Path) -> None:
    ask = ("boundary", "caravan", "c=0:8000", "U=20:180 km/h", "--tolerance", "0.05")
    for ending in ("csv", "nc", "json", "mat", "png", "svg"):
        path = tmp_path / f"out.{ending}"
        assert run(*ask, "-o", path).exit_code == 0
        assert path.stat().st_size > 500
    rows = run(*ask).stdout.splitlines()
    assert rows[0] == "point,c [N m s/rad],U [m/s],kind,line"
    assert rows == (tmp_path / "out.csv").read_text().splitlines()
    assert {row.split(",")[3] for row in rows[1:]} == {"flutter"}


def test_sweep_writes_every_format(run: Run, tmp_path: Path) -> None:
    for ending in ("csv", "json", "mat", "nc"):
        path = tmp_path / f"out.{ending}"
        assert run("sweep", "caravan", "m=1000:1500:3", "U=20,30", "-o", path).exit_code == 0
        assert path.stat().st_size > 100
    rows = run("sweep", "caravan", "m=1000:1500:3", "U=20,30").stdout
    assert rows == (tmp_path / "out.csv").read_text()
    assert len(rows.splitlines()) == 7


def test_map_tells_a_share_and_writes_every_format(run: Run, tmp_path: Path) -> None:
    ask = ("map", "caravan", "c=0:8000:7", "U=5:50:9")
    for ending in ("csv", "json", "mat", "nc", "png", "svg"):
        path = tmp_path / f"out.{ending}"
        told = run(*ask, "--margins", "-o", path)
        assert told.exit_code == 0
        assert path.stat().st_size > 500
    rows = (tmp_path / "out.csv").read_text().splitlines()
    stable = sum("True" in row for row in rows[1:])
    assert len(rows) == 1 + 63
    assert 0 < stable < 63
    assert f"{100 * stable / 63:.1f} % of 63 points are stable." in told.stdout
    assert told.stdout.splitlines()[-2].split()[:3] == ["least", "0", "50"]
    svg = (tmp_path / "out.svg").read_text()
    assert 'id="design"' in svg
    assert run(*ask, "-o", tmp_path / "map.zarr").exit_code == 0
    assert "Unstable at all 4 points." in run("map", "caravan", "c=0,1", "U=20,50").stdout
    assert "Stable at all 2 points." in run("map", "caravan", "U=5,6").stdout


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_completion_scripts(shell: str, run: Run) -> None:
    assert "_UCRIT_COMPLETE" in run("completion", shell).stdout


def test_version(run: Run) -> None:
    assert run("--version").stdout == f"ucrit {ucrit.__version__}\n"


def test_the_map_of_the_report_is_chosen(run: Run, tmp_path: Path) -> None:
    page = tmp_path / "r.html"
    assert run("analyze", "caravan", "--report", str(page), "--map", "a", "m").exit_code == 0
    assert "Stability over" in page.read_text(encoding="utf-8")
    refused = run("analyze", "caravan", "--report", str(tmp_path / "s.html"), "--map", "a", "mm")
    assert refused.exit_code == 2
    assert "did you mean 'm'?" in refused.stderr
    assert not (tmp_path / "s.html").exists()
    assert run("analyze", "caravan", "--map", "a", "m").exit_code == 2


def test_margins_are_printed_tabled_and_drawn(run, tmp_path):
    rear = "motorcycle-steered-at-the-rear"
    assert "at delta_r: gain times 0.4941 to 3.488" in run("margins", rear).output
    assert run("margins", rear, "U=20:30:3").output.count("True") == 3
    for name in ("m.png", "m.csv"):
        assert run("margins", rear, "U=10:75:14", "--out", tmp_path / name).exit_code == 0
        assert (tmp_path / name).stat().st_size > 500
    refused = run("margins", "motorcycle-steered-at-both-ends", "--out", tmp_path / "n.png")
    assert refused.exit_code == 2
    assert "choose --input delta_f or --input delta_r" in refused.output
