"""``ucrit cycles``: what it prints, draws and writes, and what it refuses."""

import csv

import pytest


def test_prints_within_80_columns_and_writes_a_table(run, tmp_path):
    path = tmp_path / "cycles.csv"
    done = run("cycles", "nose-gear", "--set", "k=-10", "--to", "24", "--at", "82.8 km/h", "--out", str(path))
    assert done.exit_code == 0
    assert max(len(line) for line in done.output.splitlines() if str(path) not in line) <= 80
    assert "20.51 m/s" in done.output
    assert "At 23 m/s (82.8 km/h) straight running is unstable; stable limit cycle" in " ".join(done.output.split())
    assert str(path) in "".join(done.output.split())
    head, *rows = csv.reader(path.read_text().splitlines())
    assert "amplitude of psi [rad]" in head
    assert float(rows[-1][head.index("V [m/s]")]) == 24


@pytest.mark.parametrize(("name", "start"), [("a.png", b"\x89PNG"), ("a.svg", b"<?xml"), ("a.pdf", b"%PDF")])
def test_draws(run, tmp_path, name, start):
    path = tmp_path / name
    assert run("cycles", "nose-gear", "--to", "18", "-o", str(path)).exit_code == 0
    assert path.read_bytes().startswith(start)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--out", "a.gif"), "the output 'a.gif' must end in .csv, .nc, .json, .mat, .png, .svg, .pdf"),
        (("--from", "30", "--to", "20"), "the range from 30 to 20 m/s is empty"),
        (("--along", "kapa"), "there is no parameter 'kapa'; did you mean 'kappa'?"),
        (("--at", "3 kg"), "kg"),
        (("--to", "18", "--basin", "y"), "straight running is unstable"),
    ],
)
def test_refuses_in_a_sentence(run, words, message):
    done = run("cycles", "nose-gear", *words)
    assert done.exit_code == 2
    assert message in " ".join(done.output.split())
    assert "Traceback" not in done.output


def test_a_basin_is_told(run, monkeypatch):
    import importlib

    monkeypatch.setattr(importlib.import_module("ucrit.analyses.nonlinear.basin"), "ROUNDS", 1)
    done = run("cycles", "caravan-with-stabiliser", "--at", "24", "--to", "30", "--basin", "theta'")
    assert "a smaller one dies out" in " ".join(done.output.split())
