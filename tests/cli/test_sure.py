"""Uncertainty and certificates on the command line."""

from __future__ import annotations

import json

import pytest


def test_uncertainty_is_told_and_written(run, tmp_path):
    done = run("uncertainty", "caravan", "--samples", 256, "-o", tmp_path / "x.csv")
    assert done.exit_code == 0
    assert "Stability is first lost below (256 vehicles drawn)" in done.output
    assert "as given  23.24 m/s" in done.output
    lines = (tmp_path / "x.csv").read_text().splitlines()
    assert lines[0].startswith("sample,m [kg],")
    assert len(lines) == 257
    assert run("uncertainty", "caravan", "--samples", 64, "-o", tmp_path / "x.svg").exit_code == 0
    assert "<svg" in (tmp_path / "x.svg").read_text()[:1000]
    assert run("uncertainty", "caravan", "--samples", 64, "-o", tmp_path / "x.json").exit_code == 0
    assert json.loads((tmp_path / "x.json").read_text())["result"] == "uncertainty"


def test_what_does_not_vary_is_told_before_a_picture_is_refused(run, tmp_path):
    done = run("uncertainty", "caravan", "--samples", 64, "--upto", "20 km/h", "-o", tmp_path / "x.svg")
    assert done.exit_code == 2
    assert "Stability is never lost up to 5.556 m/s (20 km/h) in all 64 cases." in done.stdout
    assert "Stability is first lost below" not in done.stdout
    assert "there is nothing to draw" in done.stderr


def test_indices_are_told(run):
    pytest.importorskip("SALib", reason="needs the extra 'scale'")
    done = run("uncertainty", "caravan", "--samples", 128, "--indices", "--upto", "150 km/h")
    assert "alone" in done.output
    assert "m, I_c" in done.output
    assert "Higher critical speeds count as 41.67 m/s (150 km/h)." in done.output


@pytest.mark.parametrize(
    ("region", "status", "word"),
    [
        (("m=1100:1250", "U=36:60 km/h"), 0, "PROVED"),
        (("U=1:30",), 3, "NOT STABLE"),
        (("c=3000:4000", "k=4900:5000", "U=1:17", "--boxes", 2), 1, "UNDECIDED"),
    ],
)
def test_certificates_and_their_status(run, region, status, word):
    done = run("certify", "caravan", *region)
    assert done.exit_code == 0
    assert f"\n{word}\n" in done.output
    assert run("certify", "caravan", *region, "--fail-if-unstable").exit_code == status
    assert ("Eigenvalues there" in done.output) == (status == 3)
    assert ("Left open" in done.output) == (status == 1)


def test_streamed_sweeps(run, tmp_path):
    zarr = pytest.importorskip("zarr", reason="needs the extra 'scale'")
    store = tmp_path / "x.zarr"
    assert run("sweep", "caravan", "U=5:40:30", "c=0,4000", "-o", store).exit_code == 0
    assert zarr.open_group(str(store), mode="r")["stable"].shape == (30, 2)
    done = run("sweep", "caravan", "U=5:40:31", "c=0,4000", "-o", store)
    assert done.exit_code == 2
    assert "holds another job" in done.stderr


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("uncertainty", "bmw-320i"), "ucrit: car: no parameter has a tolerance"),
        (("uncertainty", "caravan", "--samples", "1000"), "samples must be a power of two"),
        (("uncertainty", "caravan", "-o", "x.xls"), "must end in"),
        (("certify", "caravan", "m=3"), "is no range"),
        (("certify", "caravan", "m=1:2", "--set", "m=3"), "parameter m is given twice"),
        (("certify", "caravan", "m=1:2", "m=1:3"), "parameter m is given twice"),
        (("certify", "caravan"), "missing argument"),
        (("sweep", "caravan", "U=1:2", "--scheduler", "tcp://x"), "--scheduler needs a store"),
    ],
)
def test_wrong_input_is_one_sentence(run, words, message):
    done = run(*words)
    assert done.exit_code == 2
    assert message in done.stderr
    assert done.stderr.count("\n") == 1


def test_both_ends_of_a_region_have_as_many_digits(run):
    told = " ".join(run("certify", "caravan", "U=20:50 km/h").stdout.split())
    assert "Stable for every U from 5.55556 to 13.8889 m/s (20 to 50 km/h): proved" in told
    refuted = run("certify", "caravan", "U=20:190 km/h").stdout
    assert "+-" not in refuted
    assert "eigenvalue 0.4821 ± 4.53j 1/s" in refuted


def test_decimals_of_criteria_are_short_on_the_screen_and_whole_in_the_data(run):
    import json
    import re

    long = re.compile(r"\d\.\d{9,}")
    told = run("analyze", "benchmark-bicycle").stdout
    assert not long.search(told)
    criteria = json.loads(run("analyze", "benchmark-bicycle", "--json").stdout)["criteria"]
    assert any(long.search(c["condition"]) for c in criteria)
