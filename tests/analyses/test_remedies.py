"""A remedy helps, and nothing smaller does."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ucrit import UcritError, analyze, critical, load, modes, remedies, verdict
from ucrit.analyses.stability.advice import advice
from ucrit.catalogue import vehicle_names

UNSTABLE = [name for name in vehicle_names() if name not in ("coach-truck",) and not analyze(name).stable]


def is_stable(vehicle):
    """Whether a vehicle is stable from a standstill to its speed, or at its one point if it has none."""
    name = type(vehicle).declaration.speed
    if name is None:
        return not verdict(vehicle).growing
    found = critical(vehicle, name, 0.0, float(vehicle.values[name]))
    return not len(found) and found.stable_at_lower and modes(vehicle).growth < 0


@pytest.mark.parametrize("name", [n for n in UNSTABLE if "backward" not in n])
def test_remedies_help_and_smaller_changes_do_not(name):
    vehicle = load(name)
    found = remedies(vehicle)
    assert {r.parameter for r in found} == set(vehicle.values) - {type(vehicle).declaration.speed}
    for remedy in found:
        if remedy.value is None:
            continue
        assert is_stable(vehicle.with_(**{remedy.parameter: remedy.value}))
        short = remedy.present + (remedy.value - remedy.present) * (1 - 1e-6)
        assert not is_stable(vehicle.with_(**{remedy.parameter: short}))


def test_most_unstable_vehicles_can_be_remedied_and_a_two_wheeler_without_steering_cannot():
    helped = {name for name in UNSTABLE if any(r.value is not None for r in remedies(load(name)))}
    assert {"caravan", "pneumatic-caster", "shimmying-caster", "caravan-rigid-tire"} <= helped
    assert "supermarket-cart-pushed-backward" not in helped


@given(st.floats(24, 60))
def test_remedies_of_the_caravan_are_critical_values_at_the_asked_speed(speed):
    caravan = load("caravan").with_(U=speed)
    for remedy in remedies(caravan):
        if remedy.value is not None:
            edges = [c.value for c in critical(caravan, remedy.parameter)]
            assert any(remedy.value == pytest.approx(edge, rel=1e-7) for edge in edges)


def test_smallest_change_first_and_the_useless_last():
    shares = [
        abs(r.relative) if r.value is not None else float("inf")
        for r in remedies(load("bmw-320i").with_(C_r=5e4, U=40))
    ]
    assert shares == sorted(shares)
    assert shares[-1] == float("inf")


def test_a_stable_vehicle_needs_none():
    assert remedies(load("caravan"), upto=20.0) == ()


def test_a_parameter_that_is_zero_now_gets_a_value():
    (c,) = [r for r in remedies(load("caravan").with_(c=0)) if r.parameter == "c"]
    assert c.present == 0
    assert c.value == pytest.approx(critical(load("caravan"), "c")[0].value, rel=1e-7)
    assert c.relative == float("inf")


def test_backing_up_cannot_be_remedied_by_hitch_or_mass():
    assert all(r.value is None for r in remedies(load("caravan").with_(U=-2)))


def test_a_model_without_speed_is_remedied_at_its_point():
    found = remedies(load("wheelset-1-in-20").with_(Psi=-0.05))
    (Psi,) = [r for r in found if r.value is not None]
    assert Psi.parameter == "Psi"
    assert 0 < Psi.value < 1e-9
    told = advice(Psi, analyze(load("wheelset-1-in-20").with_(Psi=-0.05)))
    assert (told.word, told.text, told.relative) == ("above", "0", 1.0)


def test_an_empty_range_of_speeds_is_refused():
    with pytest.raises(UcritError, match="empty range"):
        remedies(load("caravan"), upto=10.0, since=12.0)


def test_a_remedy_is_told_with_digits_that_help():
    found = remedies(load("caravan"))
    for remedy in found:
        word, text = remedy.told()
        assert float(text) >= remedy.value if word == "at least" else float(text) <= remedy.value
        assert float(text) == pytest.approx(remedy.value, rel=1e-5)
        assert f"{word} {text} " in str(remedy)
    assert {r.parameter: r.told()[1] for r in found}["c"] == "9045.09"
    assert found.vehicle == load("caravan")
