"""How a motion goes on, in a few words: the last part of it, whatever its frequency and shape."""

import pytest

from ucrit import load, simulate
from ucrit.analyses.motion.motion_summary import tendency, tendency_text


def goes_on(name, changes, until, initial, **inputs):
    found = simulate(load(name, changes), until, initial, inputs, tolerance=1e-8)
    return tendency_text(tendency(found))


@pytest.mark.parametrize(
    ("name", "changes", "until", "initial", "words"),
    [
        ("nose-gear", {"k": -10}, 1.5, {"psi": "20 deg"}, "neither grows nor decays, at 50.76 Hz"),
        ("worn-wheelset", {"V": 45}, 3, {"y": "7.9 mm"}, "neither grows nor decays, at 5.434 Hz"),
        ("caravan", {}, 20, {"theta": 1e-3}, "grows at 0.1173 1/s and 0.7545 Hz"),
    ],
)
def test_oscillations(name, changes, until, initial, words):
    assert goes_on(name, changes, until, initial) == words


def test_rounding_and_a_steady_change_are_no_growth():
    brakes = {"brake_fl": 1000, "brake_fr": 1000}
    assert goes_on("four-wheel-car", {}, 1.5, {}, **brakes) == "follows no single growth or decay"
