"""Names of modes."""

from types import MappingProxyType

import numpy as np
import pytest

from ucrit import Model, UcritError, analyze, coordinate, critical, find_model, load, modes, param
from ucrit.analyses.linear.modes import _distinct
from ucrit.catalogue import model_names, vehicle_names
from ucrit.core.contract.mode_names import check_mode_names


@pytest.mark.parametrize(
    ("name", "zeros"),
    [
        ("car-with-stability-control", {"forward speed"}),
        ("satellite-middle-axis", {"spin rate"}),
        ("oversteering-car-on-the-road", {"lateral position", "heading"}),
        ("marble-on-the-flat", {"rolling position"}),
    ],
)
def test_zero_roots_are_named_by_what_nothing_restores(name, zeros):
    vehicle = load(name)
    assert {mode.name for mode in modes(vehicle) if mode.eigenvalue == 0} == zeros
    told = analyze(vehicle).sentence
    assert "zero root" not in told or all(name in told for name in zeros)


@pytest.mark.parametrize("name", vehicle_names())
def test_no_two_modes_of_a_vehicle_share_a_name(name):
    vehicle = load(name)
    speed = type(vehicle).declaration.speed
    there = [vehicle] if speed is None else [vehicle.with_(**{speed: vehicle.values[speed] * k}) for k in (0.2, 1, 3)]
    for at in there:
        names = modes(at).names
        assert len(set(names)) == len(names)
        assert all(names)


@pytest.mark.parametrize("model", [find_model(name) for name in model_names()], ids=model_names())
def test_what_the_field_calls_a_mode_fits_a_mode_of_the_model(model):
    check_mode_names(model.model_id(), model.mode_names, model.declaration.variables.values())


def named(**names):
    class Named(Model):
        """Body on a spring."""

        I: float = param("kg m^2", "moment of inertia", above=0)
        k: float = param("N m/rad", "stiffness", above=0, default=1.0)
        theta = coordinate("rad", "swivel angle", motion="swivel")
        mode_names = MappingProxyType({key.replace("_", " "): value for key, value in names.items()})

        def equations(self, x, dx, ddx):
            return self.I * ddx.theta + self.k * x.theta

    return Named


def test_a_name_that_no_mode_has_is_refused():
    assert [mode.name for mode in modes(named(swivel_oscillation="shimmy")(I=1))] == ["shimmy"]
    with pytest.raises(UcritError, match=r"^Named: mode_names: no mode is called 'swivl oscillation'.*'swivel oscill"):
        named(swivl_oscillation="shimmy")
    with pytest.raises(UcritError, match=r"'swivel divergence' must be called '\.\.\. divergence', got 'flip'"):
        named(swivel_divergence="flip")


def test_the_least_stable_of_several_modes_has_the_name_of_the_field():
    for name, word in (("caravan", "sway"), ("coach-truck", "hunting"), ("shimmying-caster-damped", "shimmy")):
        vehicle = load(name)
        (onset,) = critical(vehicle)
        assert onset.mode == word
        for factor in (0.3, 0.9, 1.1):
            found = modes(vehicle.with_(**{onset.parameter: factor * onset.value})).list()
            of_that_kind = [m for m in found if m.oscillates and f"{m.motion} oscillation" in type(vehicle).mode_names]
            assert [m.name for m in of_that_kind].index(word) == 0
            assert sum(m.name == word for m in found) == 1
    assert len(of_that_kind) == 2  # faster than critical the caster has a second oscillation, which is no shimmy


def test_names_follow_the_mode_and_not_the_model():
    flexible, rigid = (next(iter(modes(load(name)))) for name in ("caravan", "caravan-rigid-tire"))
    assert (flexible.name, rigid.name) == ("sway", "sway")
    assert (flexible.motion, rigid.motion) == ("lateral", "yaw")


@pytest.mark.parametrize(
    ("values", "names"),
    [
        ([-1, -2], ["slow x", "fast x"]),
        ([-1, -1.05], ["x 1", "x 2"]),
        ([-3, -2, -5], ["x 2", "x 1", "x 3"]),
    ],
)
def test_modes_of_one_name_are_told_apart(values, names):
    assert _distinct(["x"] * len(values), np.array(values)) == names


def test_what_becomes_unstable_has_no_number():
    """A real mode is one of several at low speed, but that is not what it is known by."""
    assert [c.motion for c in critical(load("motorcycle-steered-to-lean"))] == ["capsize motion"]
