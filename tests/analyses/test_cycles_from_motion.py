"""Limit cycles that a simulated motion leads to: closed forms, and a branch that a critical value leads to as well."""

import math

import numpy as np
import pytest
from click.testing import CliRunner

from ucrit import Model, UcritError, limit_cycles, load, param, plot
from ucrit.cli.app import cli
from ucrit.core import coordinate, sign

RATE = {"above": 0, "default": 1}


class VanDerPol(Model):
    """Oscillator that drives itself while it is small, and brakes itself while it is large."""

    epsilon: float = param("1/s", "drive", above=0)
    omega: float = param("1/s", "frequency", **RATE)
    length: float = param("m", "deviation at which it brakes", **RATE)

    x = coordinate("m", "deviation", motion="swing")

    def equations(self, x, dx, ddx):
        return (ddx.x + self.omega**2 * x.x - self.epsilon * (1 - (x.x / self.length) ** 2) * dx.x,)


class Relay(Model):
    """Damped oscillator that a relay pushes the way it goes: driven at any size, by a law that jumps."""

    push: float = param("m/s^2", "push", above=0)
    zeta: float = param("1", "damping ratio", above=0, below=1)
    omega: float = param("1/s", "frequency", **RATE)

    x = coordinate("m", "deviation", motion="swing")

    def equations(self, x, dx, ddx):
        return (ddx.x + 2 * self.zeta * self.omega * dx.x + self.omega**2 * x.x - self.push * sign(dx.x),)


def test_van_der_pols_oscillator_has_the_amplitude_of_the_perturbation_series():
    """Amplitude 2 + e^2/96, period 2 pi (1 + e^2/16), multiplier exp(-2 pi e), each up to e^4 or e^3."""
    found = limit_cycles(VanDerPol(epsilon=0.05), "epsilon", 0.02, 0.2, start={"x": "0.3 m"})
    (branch,) = found.branches
    assert (branch.begin, branch.end, branch.kind, branch.critical, branch.onset) == (
        *("range", "range", "from a motion"),
        *(None, None),
    )
    assert branch.start in branch.cycles
    assert branch.start.value == 0.05
    np.testing.assert_allclose(branch.values[[0, -1]], [0.02, 0.2], rtol=1e-12)
    for cycle in branch.cycles:
        e = cycle.value
        assert cycle.amplitude["x"] == pytest.approx(2 + e**2 / 96, abs=0.01 * e**4 + 2 * cycle.error)
        assert cycle.period == pytest.approx(2 * math.pi * (1 + e**2 / 16), abs=0.05 * e**4 + 1e-7)
        assert cycle.growth == pytest.approx(math.expm1(-2 * math.pi * e), abs=2 * e**3 + 1e-5)
        assert cycle.stable
    assert "Stable limit cycles are found from epsilon = 0.02 1/s to epsilon = 0.2 1/s." in found.sentences
    plot(found)


def test_a_relay_oscillator_that_jumps_at_any_size_is_followed_along_its_closed_form():
    """Amplitude F coth(pi zeta / (2 sqrt(1 - zeta^2))), from the free swing about the relay's two rests."""
    (branch,) = limit_cycles(Relay(push=1, zeta=0.1), "zeta", 0.03, 0.8, start={"x": 9}).branches
    assert (branch.begin, branch.end) == ("range", "range")
    for cycle in branch.cycles:
        root = math.sqrt(1 - cycle.value**2)
        assert cycle.amplitude["x"] == pytest.approx(1 / math.tanh(math.pi * cycle.value / (2 * root)), rel=1e-7)
        assert cycle.period == pytest.approx(2 * math.pi / root, rel=1e-7)
        assert cycle.stable
    assert branch.values[[0, -1]].tolist() == pytest.approx([0.03, 0.8])


def test_a_caravans_branch_is_the_same_from_a_motion_as_from_the_critical_speed():
    caravan = load("caravan-with-stabiliser")
    (hopf,) = limit_cycles(caravan, upper=28).branches
    (branch,) = limit_cycles(caravan, lower=hopf.critical.value / 2, upper=28, start={"theta": "20 deg"}).branches
    assert (branch.begin, branch.end) == ("equilibrium", "range")
    assert branch.start.value == caravan.U
    assert branch.start.stable
    assert branch.cycles[0].value == pytest.approx(hopf.critical.value, rel=2e-3)  # one that small
    assert [c.value for c in branch.folds] == pytest.approx([c.value for c in hopf.folds], rel=1e-6)
    for one, other in zip(hopf.at(24), branch.at(24)[::-1], strict=True):
        smaller = min((one, *branch.at(24)), key=lambda c: abs(c.amplitude["theta"] - one.amplitude["theta"]) or 9)
        assert [*one.amplitude.values()] == pytest.approx([*smaller.amplitude.values()], rel=1e-5)
        assert other.vehicle == one.vehicle


@pytest.mark.parametrize(
    ("name", "start", "told"),
    [
        ("caravan-rigid-tire-undamped", {"theta": "1 kg"}, "measured in rad"),
        ("caravan", {"thet": "1 deg"}, "did you mean 'theta'"),
        ("caravan", {}, "start needs the values of one state or more"),
        ("wheelset", {"y": "2 mm"}, "the motion from y = 2 mm dies out within .* s: it leads to no limit cycle"),
        ("bowling-ball-on-a-stick", {"theta": "1 deg"}, "has no speed"),
    ],
)
def test_a_motion_that_leads_to_no_cycle_is_told_in_one_sentence(name, start, told):
    with pytest.raises(UcritError, match=told) as caught:
        limit_cycles(load(name), start=start)
    assert "\n" not in str(caught.value)


def test_the_motion_is_that_at_the_vehicles_own_value():
    with pytest.raises(UcritError, match=r"the motion is that at epsilon = 0.05 1/s, which must be between 0\.2 and 3"):
        limit_cycles(VanDerPol(epsilon=0.05), "epsilon", 0.2, 3, start={"x": 1})


def test_the_command_starts_from_a_motion_and_tells_growth_and_asks_before_it_prints():
    run = CliRunner().invoke
    gear = ["cycles", "nose-gear", "--set", "k=-10", "--set", "V=25", "--to", "30"]
    result = run(cli, [*gear, "--start", "psi=10 deg"])
    assert result.exit_code == 0, result.output
    told = " ".join(result.output.split())
    assert (
        "At 25 m/s (90 km/h) the simulated motion comes to a limit cycle with an amplitude of psi of 24.33 deg" in told
    )
    assert "growth in a period" in told
    result = run(cli, [*gear, "--at", "1e9"])
    assert result.exit_code == 2
    assert "must be within" in result.output
    assert len(result.output.splitlines()) <= 2
