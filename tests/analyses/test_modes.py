"""Names of modes."""

import pytest

from ucrit import analyze, load, modes


@pytest.mark.parametrize(
    ("name", "zeros"),
    [
        ("car-with-stability-control", {"forward speed"}),
        ("satellite-middle-axis", {"spin rate"}),
        ("oversteering-car-on-the-road", {"lateral position", "yaw position"}),
        ("marble-on-the-flat", {"rolling position"}),
    ],
)
def test_zero_roots_are_named_by_what_nothing_restores(name, zeros):
    vehicle = load(name)
    assert {mode.name for mode in modes(vehicle) if mode.eigenvalue == 0} == zeros
    told = analyze(vehicle).sentence
    assert "zero root" not in told or all(name in told for name in zeros)
