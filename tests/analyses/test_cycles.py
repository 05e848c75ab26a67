"""Limit cycles of vehicles: continuation against simulation on both sides, the published shimmy, words and tables."""

import importlib
import json
import math
from functools import cache

import numpy as np
import pytest

from ucrit import (
    UcritError,
    basin,
    check_model,
    critical,
    find_model,
    limit_cycles,
    load,
    modes,
    param,
    plot,
    simulate,
)
from ucrit.analyses.nonlinear.cycle_words import expectation
from ucrit.core import sign, where
from ucrit.plots import plot_cycles

MODELS = ("nose-gear", "trailer-handling", "caster-handling", "wheelset-flange")


@cache
def followed(name, **changes):
    return limit_cycles(load(name, changes))


def late_peak(vehicle, cycle, state, start, periods):
    """Return the greatest value of a state in the last three periods of a simulation."""
    times = (periods - 3 + np.linspace(0, 3, 3 * 200 + 1)) * cycle.period
    found = simulate(vehicle, times[-1], start, times=times, tolerance=1e-8)
    return float(np.abs(found[state]).max())


@pytest.mark.parametrize("name", MODELS)
def test_every_check_passes(name):
    check_model(find_model(name)).raise_if_failed()


@pytest.mark.parametrize(
    ("linear", "saturating", "changes"),
    [
        ("caravan", "caravan-on-brush-tires", {}),
        ("shimmying-caster-damped", "caster-on-brush-tire", {}),
        ("wheelset", "worn-wheelset", {"lambda_": 0.05, "k_1": 2e6, "V": "100 km/h"}),
    ],
)
def test_what_saturates_is_linear_at_first(linear, saturating, changes):
    np.testing.assert_allclose(
        modes(load(saturating, changes)).eigenvalues, modes(load(linear)).eigenvalues, rtol=1e-10
    )


def test_the_nose_gear_has_the_published_critical_speeds():
    """G. Somieski (1997): without damping and with k = -10."""
    gear = load("nose-gear")
    assert critical(gear)[0].value == pytest.approx(15.2593, abs=5e-5)
    assert critical(gear.with_(k=-10))[0].value == pytest.approx(20.51105, abs=5e-6)


def test_the_nose_gear_shimmies_as_published_by_continuation_and_by_simulation():
    """A swivel angle of 24.33 degrees at 25 m/s with k = -10 (G. Somieski 1997)."""
    found = followed("nose-gear", k=-10)
    (cycle,) = found.at(25)
    assert found.branches[0].kind == "supercritical"
    assert cycle.stable
    assert math.degrees(cycle.amplitude["psi"]) == pytest.approx(24.33, abs=0.005)
    peak = late_peak(cycle.vehicle, cycle, "psi", {"psi": 0.35}, 45)
    assert peak == pytest.approx(cycle.amplitude["psi"], rel=2e-4)  # 200 samples a period miss the peak so far


def test_multipliers_are_those_of_the_simulated_flow():
    (cycle,) = followed("nose-gear", k=-10).at(25)
    labels, sizes = ("psi", "psi'", "y"), np.array([*cycle.amplitude.values()])
    first = cycle.states(np.array([0.0]))[:, 0]

    def after(start):
        begun = dict(zip(labels, start, strict=True))
        return simulate(cycle.vehicle, cycle.period, begun, times=[cycle.period], tolerance=1e-12).values[0]

    steps = np.diag(1e-4 * sizes)
    flow = np.array([(after(first + step) - after(first - step)) / 2e-4 for step in steps]).T / sizes[:, None]
    expected = np.linalg.eigvals(flow)
    expected = expected[np.argsort(np.abs(expected - 1))]
    assert expected[0] == pytest.approx(1, abs=1e-6)
    assert cycle.accuracy < 1e-8
    np.testing.assert_allclose(np.sort(cycle.multipliers.real), np.sort(expected[1:].real), rtol=2e-6)


def test_the_kinks_of_a_clipped_law_cost_no_accuracy():
    """The states of a cycle on few intervals, against a simulation that is ten thousand times finer."""
    (cycle,) = followed("nose-gear", k=-10).at(25)
    times = np.linspace(0, cycle.period, 40)
    start = dict(zip(("psi", "psi'", "y"), cycle.states(np.array([0.0]))[:, 0], strict=True))
    found = simulate(cycle.vehicle, cycle.period, start, times=times, tolerance=1e-11)
    sizes = np.array([*cycle.amplitude.values()])
    apart = np.abs(found.values - cycle.states(times).T) / sizes
    assert apart.max() < 4 * cycle.error
    assert cycle.error < 1e-6
    assert len(cycle._orbit.widths) < 40


def test_a_caravan_with_sliding_tires_settles_on_the_supercritical_cycle():
    found = followed("caravan-on-brush-tires")
    (branch,) = found.branches
    assert branch.kind == "supercritical"
    assert not branch.folds
    assert branch.onset is None
    (cycle,) = found.at(30)
    for share in (0.5, 2):
        peak = late_peak(cycle.vehicle, cycle, "theta", {"theta": share * cycle.amplitude["theta"]}, 25)
        assert peak == pytest.approx(cycle.amplitude["theta"], rel=2e-3)
    below = load("caravan-on-brush-tires", {"U": 0.8 * branch.critical.value})
    assert late_peak(below, cycle, "theta", {"theta": 0.1}, 15) < 0.01
    assert found.at(0.95 * branch.critical.value) == ()


def test_a_caravan_with_a_stabiliser_is_subcritical_and_simulation_parts_at_the_unstable_cycle():
    found = followed("caravan-with-stabiliser")
    (branch,) = found.branches
    assert branch.kind == "subcritical"
    (fold,) = branch.folds
    assert branch.onset.value == pytest.approx(fold.value)
    assert 0.8 * branch.critical.value < fold.value < 0.9 * branch.critical.value
    small, large = sorted(found.at(24), key=lambda c: c.amplitude["theta"])
    assert (small.stable, large.stable) == (False, True)
    labels = branch.states
    for factor, settles in ((0.7, 0.0), (1.5, large.amplitude["theta"])):
        start = dict(zip(labels, factor * small.states(np.array([0.0]))[:, 0], strict=True))
        peak = late_peak(small.vehicle, large, "theta", start, 25)
        assert peak == pytest.approx(settles, rel=5e-3, abs=0.3 * small.amplitude["theta"])
    assert found.at(0.99 * fold.value) == ()


def test_just_below_a_fold_oscillations_die_out_and_just_above_they_stay():
    """One simulation of both from the cycle at the fold."""
    found = followed("caravan-with-stabiliser")
    (fold,) = found.branches[0].folds
    start = dict(zip(found.branches[0].states, fold.states(np.array([0.0]))[:, 0], strict=True))
    speeds = fold.value * np.array([0.99, 1.01])
    times = (40 + np.linspace(0, 1, 101)) * fold.period
    late = simulate(fold.vehicle.with_(U=speeds), times[-1], start, times=times, tolerance=1e-7)
    below, above = np.abs(late["theta"]).max(axis=-1)
    stable = max(found.at(speeds[1]), key=lambda c: c.amplitude["theta"])
    assert below < 0.1 * fold.amplitude["theta"]
    assert above == pytest.approx(stable.amplitude["theta"], rel=2e-3)


def test_a_value_outside_the_range_is_refused():
    with pytest.raises(
        UcritError, match=r"nose-gear: V must be within 4\.1.* where limit cycles were followed, got 500"
    ):
        followed("nose-gear", k=-10).at(500)


def test_the_worn_wheelset_hunts_between_its_flanges():
    found = followed("worn-wheelset")
    (cycle,) = found.at("162 km/h")
    clearance = cycle.vehicle.values["clearance"]
    assert clearance < cycle.amplitude["y"] < 1.5 * clearance
    for start in (0.006, 0.012):
        peak = late_peak(cycle.vehicle, cycle, "y", {"y": start}, 12)
        assert peak == pytest.approx(cycle.amplitude["y"], rel=2e-3)
    (branch,) = found.branches
    assert branch.kind == "subcritical"
    assert branch.onset.amplitude["y"] == pytest.approx(clearance, rel=2e-3)  # the flange makes the fold


def test_the_basin_is_where_simulations_part(monkeypatch):
    monkeypatch.setattr(importlib.import_module("ucrit.analyses.nonlinear.basin"), "ROUNDS", 1)
    vehicle = load("caravan-with-stabiliser", {"U": 24})
    told = []
    found = basin(vehicle, "theta'", followed("caravan-with-stabiliser"), progress=lambda *done: told.append(done))
    assert 0 < found.dies_out < found.persists < 1.2 * found.dies_out
    assert told[-1] == (1, 1)
    period = found.unstable.period
    for size, dies in ((0.9 * found.dies_out, True), (1.1 * found.persists, False)):
        run = simulate(vehicle, 30 * period, {"theta'": size}, tolerance=1e-7, times=np.linspace(28, 30, 60) * period)
        assert (np.abs(run["theta"]).max() < 0.7 * found.unstable.amplitude["theta"]) == dies
    assert "dies out" in str(found)


def test_any_parameter_can_be_varied():
    found = limit_cycles(load("caravan-on-brush-tires", {"U": 25}), "c", 2000, 10000)
    branch = found.branches[-1]
    assert found.parameter == "c"
    speeds = followed("caravan-on-brush-tires").at(25)
    at = [c for c in found.at(4000) if c.stable]
    assert branch.unit == "N m s/rad"
    sure = 5 * (at[0].error + speeds[0].error) / (1 - speeds[0].multipliers[0].real)
    assert sure < 1e-3
    assert at[0].amplitude["theta"] == pytest.approx(speeds[0].amplitude["theta"], rel=sure)


def test_a_branch_reaches_the_ends_of_the_range_that_is_asked_for():
    found = limit_cycles(load("nose-gear", {"k": -10}), upper=24)
    assert found.branches[0].values[-1] == 24
    (end,) = found.at(24)
    (inside,) = followed("nose-gear", k=-10).at(24)
    assert end.amplitude["psi"] == pytest.approx(inside.amplitude["psi"], rel=1e-5)
    assert limit_cycles(load("nose-gear", {"k": -10}), lower=0, upper=24).lower > 0


def test_words():
    text = str(followed("caravan-with-stabiliser"))
    for part in ("26.79 m/s (96.4 km/h)", "Subcritical", "22.62 m/s", "non-linear critical value"):
        assert part in text
    assert "Supercritical" in str(followed("nose-gear", k=-10))
    assert "24.33 deg" in expectation(followed("nose-gear", k=-10), 25)
    nothing = limit_cycles(load("bmw-320i"))
    assert nothing.branches == ()
    assert "no limit cycles" in str(nothing)
    assert "no limit cycle was found" in expectation(followed("nose-gear", k=-10), 10)


def test_tables():
    found = followed("caravan-with-stabiliser")
    content = json.loads(found.to_json())
    assert content["variables"]["amplitude of theta"]["unit"] == "rad"
    assert len(content["variables"]["U"]["values"]) == len(found.branches[0].cycles)
    assert sum(content["variables"]["fold"]["values"]) == 1
    (cycle, *_) = found.at(30)
    over_a_period = cycle.to_xarray()
    assert float(over_a_period["theta"].max()) == pytest.approx(cycle.amplitude["theta"], rel=1e-4)
    assert float(over_a_period["theta"][0]) == pytest.approx(float(over_a_period["theta"][-1]), abs=1e-9)


def test_the_diagram():
    found = followed("caravan-with-stabiliser")
    (axes,) = plot(found).axes
    styles = [line.get_linestyle() for line in axes.lines]
    assert "--" in styles
    assert "-" in styles
    assert "θ" in axes.get_ylabel()
    assert "deg" in axes.get_ylabel()
    (axes,) = plot_cycles(found, state="x").axes
    assert "[m]" in axes.get_ylabel()
    with pytest.raises(UcritError, match="no state 'thta'; did you mean 'theta'"):
        plot_cycles(found, state="thta")
    with pytest.raises(UcritError, match="no limit cycles to draw"):
        plot(limit_cycles(load("bmw-320i")))


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        (lambda: limit_cycles(load("caravan"), "V"), "there is no parameter 'V'"),
        (lambda: limit_cycles(load("caravan"), lower=30, upper=20), "the range from 30 to 20 m/s is empty"),
        (lambda: limit_cycles(load("caravan"), lower="3 kg"), "kg"),
        (lambda: limit_cycles(load("caravan"), tolerance=0), "tolerance must be above 0"),
        (lambda: limit_cycles(load("marble-on-a-hill")), "has no speed"),
        (lambda: basin(load("caravan-with-stabiliser"), "thetta"), "no state 'thetta'; did you mean 'theta'"),
        (
            lambda: basin(load("caravan-with-stabiliser", {"U": 30}), "theta", followed("caravan-with-stabiliser")),
            "straight running is unstable at 30 m/s",
        ),
        (
            lambda: basin(load("caravan-with-stabiliser", {"U": 20}), "theta", followed("caravan-with-stabiliser")),
            "no unstable limit cycle is found at 20 m/s",
        ),
    ],
)
def test_what_makes_no_sense_is_refused(wrong, message):
    with pytest.raises(UcritError, match=message):
        wrong()


class CasterBetweenPads(type(load("caster-on-brush-tire"))):
    """Caster whose fork rubs on pads, beyond a free angle (own derivation, 2026)."""

    bond_graph = equations_bond_graph = None
    M_0: float = param("N m", "moment of friction", at_least=0)
    free: float = param("rad", "angle at which the pads begin", at_least=0)

    def forces(self, x, dx):
        return (*super().forces(x, dx), (-self.M_0 * where(abs(x.theta) > self.free, sign(dx.theta), 0), dx.theta))


class CasterWithDryFriction(CasterBetweenPads):
    """The same with pads all the way (own derivation, 2026)."""

    free = 0.0

    def forces(self, x, dx):
        return (*super(CasterBetweenPads, self).forces(x, dx), (-self.M_0 * sign(dx.theta), dx.theta))


def test_cycles_go_through_dry_friction():
    """Where the fork begins to touch its pads the branch has a corner; a simulation tells the same amplitude."""
    values = load("caster-on-brush-tire").values
    found = limit_cycles(CasterBetweenPads(**values, M_0=3, free=0.02), upper=20)
    (branch,) = found.branches
    assert branch.end == "range"
    (cycle,) = found.at(18)
    start = dict(zip(branch.states, 1.01 * cycle.states(np.array([0.0]))[:, 0], strict=True))
    assert late_peak(cycle.vehicle, cycle, "theta", start, 20) == pytest.approx(cycle.amplitude["theta"], rel=1e-4)
    (before,), (after,) = found.at(16), found.at(16.2)
    assert before.amplitude["theta"] < 0.02 < after.amplitude["theta"]
    assert after.multipliers[0].real < before.multipliers[0].real - 0.2  # the friction begins at once


def test_friction_on_the_basic_motion_itself_is_refused():
    values = load("caster-on-brush-tire").values
    with pytest.raises(UcritError, match="a law jumps on the basic motion itself"):
        limit_cycles(CasterWithDryFriction(**values, M_0=3))


def test_linear_equations_are_refused_before_anything_is_followed():
    with pytest.raises(UcritError, match="bicycle: the equations are linear, so that there are no limit cycles"):
        limit_cycles(load("benchmark-bicycle"))


def test_equations_without_any_comparison_have_limit_cycles():
    assert limit_cycles(load("coach-truck-rigid"), lower=44).branches[0].kind == "supercritical"
