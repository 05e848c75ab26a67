"""Parameters of extreme size: an answer that holds, or one sentence; no warning, no contradiction."""

from __future__ import annotations

import warnings
from collections.abc import Iterator

import numpy as np
import pytest

from ucrit import (
    UcritError,
    analyze,
    critical,
    frequency_response,
    impulse_response,
    load,
    modes,
    remedies,
    sensitivity,
    stability_map,
    step_response,
    verdict,
)

EXTREME = [
    ("caravan", {"m": 1e200}),
    ("caravan", {"m": 1e308}),
    ("caravan", {"m": 1e-308}),
    ("caravan", {"k": 1e150, "m": 1e-150}),
    ("caravan", {"k": 1e20, "m": 1e-10}),
    ("caravan", {"k": 1e300}),
    ("caravan", {"C": 1e308, "k": 1e308}),
    ("caravan", {"U": 1e300}),
    ("bmw-320i", {"m": 1e200}),
    ("bmw-320i", {"m": 1e-150, "U": 1e-5}),
    ("understeering-car", {"C_f": 1e308}),
    ("shimmying-caster", {"k": 1e305}),
]


@pytest.fixture(autouse=True)
def _warnings_are_errors() -> Iterator[None]:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        yield


def tried(function, *arguments):
    """Return what a function gives, ``None`` where it refuses in one sentence."""
    try:
        return function(*arguments)
    except UcritError as error:
        told = str(error)
    assert len(told) < 250
    assert "double numbers" in told or "singular" in told or "cannot be solved" in told
    return None


@pytest.mark.parametrize(("name", "changes"), EXTREME)
def test_answers_agree_or_are_refused(name, changes):
    vehicle = load(name, changes)
    judged = tried(verdict, vehicle)
    if judged is None:
        return
    key = next(iter(changes))
    grid = stability_map(vehicle, **{key: [float(changes[key])]})
    assert bool(grid.stable[0]) == judged.stable  # which is exact
    for function in (critical, sensitivity, remedies):
        tried(function, vehicle)
    found = tried(modes, vehicle)
    if found is not None:
        largest = np.abs(found.eigenvalues).max()
        assert np.sum(found.eigenvalues.real > 1e-9 * largest) <= judged.growing
    whole = tried(analyze, vehicle)
    if whole is not None and whole.criteria is not None and whole.criteria.settled is None:
        assert bool(whole.failing) != judged.stable


def test_eigenvalues_that_are_lost_are_refused():
    with pytest.raises(UcritError, match=r"eigenvalues are of sizes from about 1e-98 to 1e\+1 1/s, too far apart"):
        analyze("caravan", changes={"m": 1e200})
    assert [m.name for m in analyze("caravan", changes={"k": 1e12}).modes]  # stiff, but told apart


def test_equations_without_accelerations_are_still_called_singular():
    with pytest.raises(UcritError, match="with m = 1e\\+308 kg the equations leave the range of double numbers"):
        modes(load("caravan", {"m": 1e308}))


@pytest.mark.parametrize("respond", [step_response, impulse_response])
def test_responses_beyond_doubles_are_refused(respond):
    car = load("understeering-car")
    assert np.isfinite(respond(car, "delta_f", size=1e300).values).all()
    with pytest.raises(UcritError, match=r"car: the response at .* s is beyond the range of double numbers"):
        respond(car, "delta_f", size=1e308)
    runaway = load("oversteering-car", {"U": "200 km/h"})
    with pytest.raises(UcritError, match="car: the response at 100000 s is beyond"):
        respond(runaway, "delta_f", times=[0.0, 1.0, 1e5])


def test_frequencies_beyond_doubles_are_refused():
    car = load("understeering-car")
    assert abs(frequency_response(car, "delta_f", "r", [1e300]).values).max() < 1e-290
    with pytest.raises(UcritError, match=r"the response at 1e\+308 Hz is beyond"):
        frequency_response(car, "delta_f", "r", [1.0, 1e308])


@pytest.mark.parametrize(
    ("name", "key"), [("caravan", "U"), ("benchmark-bicycle", "m_R"), ("navion-from-geometry", "I_yy")]
)
def test_everything_tells_the_same_a_rounding_from_the_boundary(name, key):
    """Rounded coefficients differ there: all that give a verdict ask the one judge."""
    from ucrit.analyses.regions.critical_many import _Block
    from ucrit.analyses.stability.judge import judge
    from ucrit.analyses.stability.remedies import _stable_now
    from ucrit.core.numeric.compiled import deciding_coefficients
    from ucrit.numerics.hurwitz import stable

    vehicle = load(name)
    edge = next(iter(critical(vehicle, key))).value
    values = np.array([edge * (1 + 2.3e-16 * k) for k in range(-15, 16)])
    many, speed = vehicle.with_(**{key: values}), type(vehicle).declaration.speed
    grid = stability_map(vehicle, **{key: values}).stable.tolist()
    assert set(grid) == {True, False}
    if name != "caravan":
        assert np.asarray(stable(deciding_coefficients(many))).tolist() != grid
    assert judge(many).tolist() == grid
    assert [_stable_now(vehicle.with_(**{key: x})) for x in values] == grid
    block = _Block(vehicle, {key: values}, 1)
    speeds = (values if key == speed else np.full(values.size, vehicle.values[speed])) / block.unit
    assert block.judged(speeds[:, None])[:, 0].tolist() == grid
