"""``ucrit handling``: words, picture, table, refusals."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from click.testing import Result

Run = Callable[..., Result]


def test_prints_the_limit_and_draws(run: Run, tmp_path: Path) -> None:
    picture = tmp_path / "diagram.svg"
    done = run("handling", "spinning-car", "--at", "90 km/h", "--out", str(picture))
    assert done.exit_code == 0
    assert "spins: the rear axle saturates first" in done.stdout
    assert "at 25 m/s" in done.stdout
    assert picture.read_text().lstrip().startswith("<?xml")


def test_writes_a_table(run: Run, tmp_path: Path) -> None:
    table = tmp_path / "diagram.csv"
    assert run("handling", "ploughing-car", "--slip", "4 deg", "-o", str(table)).exit_code == 0
    head, *rows = table.read_text().splitlines()
    assert head.startswith("point,speed [m/s],a_y [m/s^2],curvature [1/m],delta [rad],front [rad],rear [rad]")
    assert abs(float(rows[-1].split(",")[5]) - 0.0698132) < 1e-6


def test_keeps_the_radius_or_the_steer_angle(run: Run) -> None:
    done = run("handling", "ploughing-car", "--radius", "60 m", "--upto", "72 km/h")
    assert "on a radius of 60 m" in done.stdout
    assert "20 m/s (72 km/h)" in done.stdout
    assert "at a steer angle of 2 deg" in run("handling", "spinning-car", "--steer", "2 deg").stdout


def test_refuses(run: Run) -> None:
    for arguments, message in (
        (("handling", "caravan"), "a handling diagram needs an output a_y"),
        (("handling", "spinning-car", "--out", "x.doc"), "must end in .csv"),
        (("handling", "spinning-car", "--slip", "3 kg"), "slip"),
        (("handling", "spining-car"), "did you mean 'spinning-car'"),
    ):
        done = run(*arguments)
        assert done.exit_code == 2, arguments
        assert message in done.stderr, done.stderr
