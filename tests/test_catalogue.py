"""The whole catalogue: every model is checked, has a vehicle and agrees with something independent."""

import pytest

from ucrit.catalogue import PUBLISHED, find_model, load, model_names, vehicle_names
from ucrit.checks import check_model
from ucrit.checks.sample import vehicles_of

INDEPENDENT = (
    "published polynomial",
    "published equations",
    "published state matrix",
    "published motion",
    "further derivations",
)


@pytest.mark.parametrize("name", model_names())
def test_model_passes_every_check(name):
    report = check_model(find_model(name))
    assert report.ok, str(report)
    passed = {check.name for check in report.checks if check.passed}
    assert passed.intersection(INDEPENDENT), f"{name} is compared with nothing"
    criteria = next(check for check in report.checks if check.name == "published criteria")
    assert criteria.passed or "nothing is published" in criteria.detail, f"{name}: {criteria.detail}"


@pytest.mark.parametrize("name", vehicle_names())
def test_vehicle_passes_every_check(name):
    vehicle = load(name)
    assert vehicle.info.source.strip(), f"{name} does not say where its numbers come from"
    report = check_model(vehicle, seed=1)
    assert report.ok, str(report)


@pytest.mark.parametrize("name", model_names())
def test_model_has_a_vehicle(name):
    assert vehicles_of(name), f"there is no vehicle file for {name}"


@pytest.mark.parametrize("path", sorted(PUBLISHED.glob("*.toml")), ids=lambda path: path.stem)
def test_published_file_belongs_to_a_model(path):
    assert path.stem.replace("_", "-") in model_names()
