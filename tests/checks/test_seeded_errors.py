"""The benchmark of seeded errors reaches what a model imports, and tells a caught error from one without effect."""

from importlib import import_module
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


@pytest.fixture
def mutants(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT))
    monkeypatch.setenv("UCRIT_CACHE", "off")
    return import_module("benchmarks.mutants")


def test_the_tire_laws_that_a_model_takes_are_seeded_too(mutants):
    seeds = mutants.mutants(["car-handling"])
    assert {m.file for m in seeds} == {"models/car_handling.py", "parts/tires/slip.py", "parts/tires/brush.py"}
    bent = [m for m in seeds if "maximum(slip, held)" in m.diff or "3 - 3 * sliding" in m.diff]
    assert bent
    assert mutants.checked(bent[0]) not in (mutants.SURVIVED, mutants.EQUIVALENT)
    silent = next(m for m in seeds if m.what == "forces: constant doubled")  # the aligning moment, which nothing uses
    assert mutants.checked(silent) == mutants.EQUIVALENT


def test_properties_of_coefficients_are_seeded(mutants):
    seeds = mutants.mutants(["airplane-longitudinal-coefficients"])
    assert any("Z_wdot" in m.diff for m in seeds)
