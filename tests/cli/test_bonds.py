"""`ucrit bonds`: what it prints, what it draws, what it refuses; files of bond graphs as models."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import Result

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
    result = run("bonds", "oscillator", "--draw", str(tmp_path / name))
    assert result.exit_code == 0
    assert (tmp_path / name).read_bytes().startswith(start)
    assert f"The drawing is in {tmp_path / name}".replace("\n", "") in result.stdout.replace("\n", "")


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
        (("traler",), "ucrit: there is no model and no file 'traler'; did you mean 'trailer'?"),
        (("satellite-damped",), "ucrit: satellite-damped states no bond graph"),
        (("caravan",), "ucrit: there is no model and no file 'caravan'"),
        (("none.bonds",), "ucrit: there is no file 'none.bonds'"),
        (("trailer", "--draw", "x.gif"), "ucrit: a drawing is written to a file ending in .png, .svg, .pdf, got"),
        (("trailer", "--draw", "/no/such/x.png"), "ucrit: '/no/such/x.png' cannot be written"),
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
