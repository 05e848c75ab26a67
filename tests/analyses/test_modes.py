"""Names of modes."""

import pytest

from ucrit import analyze, load, modes


@pytest.mark.parametrize(
    ("name", "zeros"),
    [
        ("car-with-stability-control", {"forward velocity"}),
        ("satellite-middle-axis", {"roll rate"}),
        ("oversteering-car-on-the-road", {"lateral position", "yaw position"}),
        ("marble-on-the-flat", {"rolling position"}),
    ],
)
def test_zero_roots_are_named_by_what_nothing_restores(name, zeros):
    vehicle = load(name)
    assert {mode.name for mode in modes(vehicle) if mode.eigenvalue == 0} == zeros
    told = analyze(vehicle).sentence
    assert ("places" in told) == any("position" in each for each in zeros) or "zero root" not in told
    assert ("speeds" in told) == (not any("position" in each for each in zeros)) or "zero root" not in told
