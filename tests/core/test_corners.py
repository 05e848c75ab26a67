"""Laws that jump or bend on the basic motion: found, told with the verdict, and no false alarm."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import sympy as sp
from click.testing import CliRunner

import ucrit
from ucrit.cli.app import cli
from ucrit.core.formulas.corners import corners

x, v = sp.symbols("x v", real=True)
F, c = sp.symbols("F c", positive=True)

LAWS = [
    (F * sp.sign(v), [("jump", "v")]),
    (sp.Piecewise((F, v > 0), (-F, v < 0), (0, True)), [("jump", "v")]),
    (sp.Max(c * v, 2 * c * v), [("kink", "v")]),
    (sp.Piecewise((c * v, v > 0), (2 * c * v, True)), [("kink", "v")]),
    (F * sp.Abs(x), [("kink", "x")]),
    (x * sp.sign(v), [("kink", "v")]),
    (v * sp.Abs(v), []),
    (F * sp.sign(v - 1), []),
    (sp.Piecewise((x, sp.Abs(x) < 1), (sp.sign(x), True)), []),
    (sp.Piecewise((c * v, v > 0), (c * v + v**2, True)), []),
    (sp.Piecewise((sp.sin(x) / x, sp.Ne(x, 0)), (1, True)), []),
    (sp.sign(v) * (x + v), [("kink", "v")]),
    (sp.tanh(v / c), []),
]


@pytest.mark.parametrize(("law", "expected"), LAWS, ids=str)
def test_corners_are_found_and_no_other(law, expected):
    assert corners([c * v + x + law], [x, v], {x: 0, v: 0}) == expected


MODEL = '''"""Axis: x along the spring. SI units."""
from ucrit import Model, param, state
from ucrit.core import sign


class Block(Model):
    """Block on a spring, with dry friction and a little push."""

    m: float = param("kg", "mass", above=0)
    k: float = param("N/m", "stiffness", above=0)
    c: float = param("N s/m", "damping")
    F: float = param("N", "friction", at_least=0)

    x = state("m", "position")
    v = state("m/s", "velocity")

    def equations(self, x, dx, u):
        return dx.x - x.v, self.m * dx.v + self.k * x.x + self.c * x.v + self.F * sign(x.v)
'''


@pytest.fixture
def block(tmp_path: Path) -> Path:
    (tmp_path / "block.py").write_text(MODEL)
    path = tmp_path / "mine.toml"
    path.write_text('model = "block.py"\n[parameters]\nm = 1\nk = 4\nc = -0.1\nF = 2\n')
    return path


def test_a_verdict_without_the_friction_says_so_everywhere(block, tmp_path):
    found = ucrit.analyze(block)
    assert not found.stable
    assert found.caveat.startswith("a law jumps on the basic motion, at v = 0, where it has no slope")
    assert found.caveat in str(found)
    assert "a law jumps" in found._repr_html_()
    assert found.caveat in str(ucrit.critical(found.vehicle, "c"))
    page = tmp_path / "page.html"
    told = CliRunner().invoke(cli, ["analyze", str(block), "--report", str(page)], catch_exceptions=False)
    assert "But a law jumps on the basic motion, at v = 0" in " ".join(told.stdout.split())
    assert "But a law jumps on the basic motion, at v = 0" in page.read_text()
    data = CliRunner().invoke(cli, ["analyze", str(block), "--json"], catch_exceptions=False).stdout
    assert json.loads(data)["verdict"]["caveat"] == found.caveat


def test_smooth_vehicles_have_no_caveat():
    for name in ("caravan", "understeering-car", "spinning-car", "caravan-with-stabiliser", "worn-wheelset"):
        assert ucrit.analyze(name, advise=False).caveat == ""
