"""`ucrit bonds`: what it prints, what it draws, what it refuses; files of bond graphs as models."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import Result

from ucrit import UcritError, load
from ucrit.catalogue import read_vehicle
from ucrit.core.contract.files import write_vehicle
from ucrit.web.serve import _fragment

Run = Callable[..., Result]
SHEET = """title Mass on a spring (Karnopp 2004, section 3.II)
param m [kg] above 0: mass
param k [N/m] above 0: stiffness
param c [N s/m] at_least 0: damping
1 x
I mass = m
C spring = 1/k
R damper = c
x -> mass
x -> spring
x -> damper
"""


def test_a_graph_is_printed_in_80_columns(run: Run) -> None:
    result = run("bonds", "trailer")
    assert result.exit_code == 0
    assert all(len(line) <= 80 for line in result.stdout.splitlines())
    assert "MTF  left_theta   a*cos(q.theta)" in result.stdout
    assert "I 'mass_ahead' (bond 11) is in derivative causality" in result.stdout
    assert "q_hitch' = " in result.stdout
    assert "power balances" in result.stdout


@pytest.mark.parametrize(("name", "start"), [("g.svg", b"<?xml"), ("g.png", b"\x89PNG"), ("G.PDF", b"%PDF")])
def test_a_graph_is_drawn(run: Run, tmp_path: Path, name: str, start: bytes) -> None:
    result = run("bonds", "oscillator", "-o", str(tmp_path / name))
    assert result.exit_code == 0
    assert (tmp_path / name).read_bytes().startswith(start)
    assert f"Written to {tmp_path / name}".replace("\n", "") in result.stdout.replace("\n", "")


def test_a_file_is_a_model(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "my-spring.bonds"
    path.write_text(SHEET)
    (tmp_path / "one.toml").write_text('model = "my-spring.bonds"\n[parameters]\nm = 2\nk = 8\nc = 1\n')
    assert "p_mass' = " in run("bonds", str(path)).stdout
    assert "a_2 = m" in run("show", str(path)).stdout
    assert run("check", str(path)).exit_code == 0
    assert "STABLE" in run("analyze", str(tmp_path / "one.toml")).stdout
    assert "k =" in run("new", str(path)).stdout


def test_a_model_written_as_text_is_read_back(run: Run, tmp_path: Path) -> None:
    text = run("bonds", "trailer", "--text").stdout
    path = tmp_path / "again.bonds"
    path.write_text(text)
    assert run("bonds", str(path), "--text").stdout == text


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (("traler",), "ucrit: there is no model, vehicle or file 'traler'; did you mean 'trailer'?"),
        (("satellite-damped",), "ucrit: satellite-damped states no bond graph"),
        (("navion",), "ucrit: airplane-longitudinal-coefficients states no bond graph"),
        (("caravan", "--json", "--text"), "ucrit: --text and --json both print the graph: give one of them"),
        (("none.bonds",), "ucrit: there is no file 'none.bonds'"),
        (("trailer", "-o", "x.gif"), "ucrit: a drawing is written to a file ending in .png, .svg, .pdf, got"),
        (("trailer", "-o", "/no/such/x.png"), "ucrit: '/no/such/x.png' cannot be written"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_one_sentence(run: Run, arguments: tuple[str, ...], sentence: str) -> None:
    result = run("bonds", *arguments)
    assert result.exit_code == 2
    assert result.stdout == ""
    assert result.stderr.startswith(sentence)
    assert len(result.stderr.splitlines()) == 1


def test_a_wrong_line_of_a_file_is_named(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "wrong.bonds"
    path.write_text(SHEET.replace("I mass = m", "I mass = mm"))
    result = run("bonds", str(path))
    assert result.exit_code == 2
    assert "wrong.bonds, line 6: I 'mass': the formula 'mm' uses 'mm'; did you mean 'm'?" in result.stderr


def test_a_vehicle_shows_the_graph_of_its_model(run: Run) -> None:
    assert run("bonds", "caravan").stdout == run("bonds", "trailer").stdout
    assert "where(" in run("bonds", "caster-on-brush-tire").stdout


def test_numbers_without_units_are_a_graph_but_no_model(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "plain.bonds"
    path.write_text("1 x\nI mass = 2\nC spring = 1/8\nx -> mass\nx -> spring\n")
    assert "p_mass' = -8*q_spring" in run("bonds", str(path)).stdout
    result = run("show", str(path))
    assert result.exit_code == 2
    assert "the law of C 'spring' is a number without a unit, make it a parameter" in result.stderr


def test_a_file_with_defaults_is_a_vehicle(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "my-spring.bonds"
    path.write_text(SHEET.replace("above 0:", "above 0 default 2:"))
    assert "STABLE" in run("analyze", str(path), "--set", "c=0.1").stdout
    assert "damping c is missing" in run("analyze", str(path)).stderr
    assert f'model = "{path}"' in run("new", str(path)).stdout


def test_a_graph_stands_in_a_vehicle_file(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "one.toml"
    graph = SHEET.replace("I mass = m", "I mass = mm")
    path.write_text(f'model = "mine"\ngraph = """\n{SHEET}"""\n[parameters]\nm = 2\nk = 8\nc = 1\n')
    assert "STABLE" in run("analyze", str(path)).stdout
    assert "I mass = m" in run("new", str(path)).stdout
    vehicle = load(path)
    again = read_vehicle(write_vehicle(vehicle), "pasted")
    assert type(again) is type(vehicle)
    assert again.values == vehicle.values
    assert pickle.loads(pickle.dumps(vehicle)) == vehicle
    assert _fragment(vehicle).startswith("#toml=")
    path.write_text(f'model = "mine"\ngraph = """\n{graph}"""\n[parameters]\n')
    assert "one.toml: graph, line 6: I 'mass': the formula 'mm' uses 'mm'" in run("analyze", str(path)).stderr


def test_pasted_text_cannot_name_a_file(tmp_path: Path) -> None:
    (tmp_path / "secret.bonds").write_text(SHEET)
    with pytest.raises(UcritError, match=r"secret.bonds' is a file; name a model of the catalogue here"):
        read_vehicle(f'model = "{tmp_path / "secret.bonds"}"\n[parameters]', "pasted")
