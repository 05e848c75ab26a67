"""The audit agrees with right linear verdicts, and finds wrong ones."""

import dataclasses

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ucrit import UcritError, analyze, audit, load, modes
from ucrit.analyses.motion import audit as module
from ucrit.catalogue import vehicle_names
from ucrit.core.numeric.motion import motion
from ucrit.numerics.prony import fit_exponents


def test_every_vehicle_moves_as_its_linear_equations_say():
    linear, checked = [], 0
    for name in vehicle_names():
        found = audit(load(name))
        assert found.agrees, f"{name}: {found.sentence}"
        if found.linear:
            linear.append(name)
            assert "linear: there is nothing to audit" in found.sentence
        checked += len(found.findings)
    assert checked > 60
    assert {"navion", "boeing-747"} <= set(linear)
    for name in linear:
        made, arguments = motion(type(load(name))), load(name).arguments()
        w, u = made.basic(arguments)
        here, there = made.slopes(w, u, arguments).A, made.slopes(w + np.arange(1, len(w) + 1), u, arguments).A
        assert np.array_equal(here, there), f"{name} is not linear"


def test_a_wrong_linear_verdict_is_found(monkeypatch):
    caravan = load("caravan")
    right = modes(caravan)
    wrong = dataclasses.replace(right, eigenvalues=right.eigenvalues - 0.2 * (np.abs(right.eigenvalues.real) < 1))
    monkeypatch.setattr(module, "modes", lambda vehicle: wrong)
    found = audit(caravan)
    assert not found.agrees
    assert "DISAGREES with the linear verdict in 1 of 2 modes" in found.sentence
    assert "grows at 0.1173 1/s and 0.7545 Hz, the linear verdict says decay at 0.08271 1/s" in found.sentence
    assert [f.agrees for f in found.findings] == [False, True]


def test_an_error_of_a_percent_in_any_parameter_of_the_linear_equations_is_found(monkeypatch):
    """Wherever it moves an eigenvalue by more than the audit allows."""
    found = {}
    for name in ("caravan", "oversteering-car", "nose-gear"):
        vehicle = load(name)
        right = modes(vehicle).eigenvalues
        for parameter, value in vehicle.values.items():
            if not isinstance(value, float) or value == 0:
                continue
            wrong = modes(vehicle.with_(**{parameter: 1.01 * value}))
            apart = max(np.abs(s - right).min() / abs(s) for s in wrong.eigenvalues)
            monkeypatch.setattr(module, "modes", lambda _, wrong=wrong: wrong)
            if abs(apart / module.WITHIN - 1) > 0.05:
                found[name, parameter] = apart > module.WITHIN
                assert audit(vehicle).agrees != found[name, parameter], (name, parameter)
    assert sum(found.values()) > 15


def test_a_larger_perturbation_shows_where_linear_equations_end():
    caravan = load("caravan")
    small, large = audit(caravan, size=1e-4), audit(caravan, size=0.5)
    error = [max(abs(f.fitted - f.linear) / abs(f.linear) for f in found.findings) for found in (small, large)]
    assert error[0] < 1e-6 < 1e-4 < error[1]


def test_analysis_carries_the_audit():
    found = analyze("caravan", audit=True)
    assert found.to_dict()["audit"]["agrees"] is True
    assert found.to_dict()["audit"]["modes"][0]["nonlinear"]["re"] == pytest.approx(found.modes[0].eigenvalue.real)
    assert "audit" not in analyze("caravan").to_dict()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [({"size": 0}, "size must be above 0, got 0"), ({"within": float("nan")}, "within must be a number, got nan")],
)
def test_mistakes_are_told(arguments, words):
    with pytest.raises(UcritError, match=words):
        audit(load("caravan"), **arguments)
    with pytest.raises(UcritError, match="give scalar parameters"):
        audit(load("caravan").with_(m=[1000, 2000]))


@settings(max_examples=60, deadline=None)
@given(st.floats(-3, 3), st.floats(0.5, 20), st.floats(0, 6), st.integers(1, 4))
def test_exponents_of_a_sum_of_two_are_found(growth, omega, phase, quantities):
    step = 0.4 / max(abs(growth), omega)
    t = step * np.arange(40)
    samples = np.stack([np.exp(growth * t) * np.cos(omega * t + phase + k) for k in range(quantities)], axis=1)
    exponents, misfit = fit_exponents(samples, step, 2)
    assert exponents[0] == pytest.approx(complex(growth, omega), rel=1e-5, abs=1e-6)
    assert misfit < 1e-8
