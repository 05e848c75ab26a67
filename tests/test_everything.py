"""Every vehicle answers every analysis that fits it; one that does not fit is refused in a sentence."""

import math
from itertools import cycle, islice

import numpy as np
import pytest

import ucrit
from ucrit import UcritError, load
from ucrit.catalogue import vehicle_names
from ucrit.core.contract.possible import allowed
from ucrit.core.numeric.compiled import coefficients, state_space
from ucrit.core.numeric.motion import motion

ONE_EACH = list({type(load(name)): name for name in vehicle_names()}.values())
"""One vehicle of every model."""


def inputs(vehicle):
    return type(vehicle).declaration.inputs


def pairs(vehicle):
    """Up to four inputs and outputs of a model, each with another: all of them would take minutes."""
    declared = type(vehicle).declaration
    outputs = [*declared.variables, *declared.outputs]
    return islice(zip(cycle(declared.inputs), outputs, strict=False), 4)


def first_parameters(vehicle):
    """Two parameters to map over, each between half and twice its value."""
    values = {k: float(v) for k, v in vehicle.values.items() if float(v) > 0}
    declared = type(vehicle).declaration.parameters
    names = [k for k, v in values.items() if declared[k].allows([v / 2, 2 * v]).all()]
    alone = [k for k in names if allowed(vehicle, k).allows([values[k] / 2, 2 * values[k]]).all()][:2]
    return {k: np.linspace(values[k] / 2, 2 * values[k], 5) for k in alone}


ALWAYS = {
    "modes": ucrit.modes,
    "verdict": ucrit.verdict,
    "analyze": ucrit.analyze,
    "show": ucrit.show,
    "new": lambda v: ucrit.new(type(v)),
    "routh": lambda v: ucrit.routh(coefficients(v)),
    "forms": ucrit.forms,
    "remedies": ucrit.remedies,
    "sensitivity": ucrit.sensitivity,
    "to_scipy": ucrit.to_scipy,
    "sweep": lambda v: ucrit.sweep(v, **first_parameters(v)),
    "stability_map": lambda v: ucrit.stability_map(v, **first_parameters(v)),
    "compare": lambda v: ucrit.compare(v, load("caravan")),
    "frequency_response": lambda v: [ucrit.frequency_response(v, i) for i in inputs(v)],
    "step_response": lambda v: [ucrit.step_response(v, i) for i in inputs(v)],
    "impulse_response": lambda v: [ucrit.impulse_response(v, i) for i in inputs(v)],
}
WHERE_IT_FITS = {
    "transfer": lambda v: [ucrit.transfer(v, i, o) for i, o in pairs(v)],
    "to_control": ucrit.to_control,
    "simulate": lambda v: ucrit.simulate(v, 0.01),
    "approximation": lambda v: ucrit.approximation(v, v),
    "limit": lambda v: ucrit.limit(v, **{next(iter(v.values)): math.inf}),
    "criteria": ucrit.criteria,
    "critical speed": ucrit.critical,
    "critical value": lambda v: ucrit.critical(v, next(iter(v.values))),
    "locus": lambda v: ucrit.locus(v, next(iter(first_parameters(v))), points=20),
    "steady_turn": ucrit.steady_turn,
    "static_stability": ucrit.static_stability,
    "axle_loads": ucrit.axle_loads,
    "static_margin": ucrit.static_margin,
    "moment_line": ucrit.moment_line,
    "trim": ucrit.trim,
}
REFUSED = {
    "to_control": {"caravan-kinematic"},
    "simulate": set(),
    "approximation": set(),
    "limit": set(),
    "transfer": set(),
    "criteria": {
        "benchmark-bicycle",
        "four-wheel-car",
        "car-and-caravan",
        "car-on-worn-rear-tires",
        "car-with-stability-control",
        "coach-truck",
        "high-van",
        "navion",
        "navion-from-geometry",
    },
    "critical value": set(),
    "locus": set(),
}
"""Vehicles that alone are refused what fits nearly all: criteria too long to be read, one state without an input."""


@pytest.mark.parametrize("name", ONE_EACH)
def test_every_vehicle_answers(name):
    vehicle = load(name)
    for what, analysis in ALWAYS.items():
        assert analysis(vehicle) is not None, what


@pytest.mark.parametrize("name", ONE_EACH)
def test_slopes_of_the_motion_are_the_linear_equations(name):
    vehicle = load(name)
    made, expected = motion(type(vehicle)), state_space(vehicle).A
    w, u = made.basic(vehicle.arguments())
    A = made.slopes(np.reshape(w, (-1, 1)), np.reshape(u, (-1, 1)), vehicle.arguments()).A[0]
    if A.shape == expected.shape:
        np.testing.assert_allclose(A, expected, rtol=1e-9, atol=1e-9 * np.abs(expected).max())
    else:  # constraints leave fewer states
        assert np.isfinite(A).all()


@pytest.mark.parametrize("what", WHERE_IT_FITS)
def test_what_does_not_fit_is_refused_in_a_sentence(what):
    refused = {}
    for name in ONE_EACH:
        try:
            assert WHERE_IT_FITS[what](load(name)) is not None
        except UcritError as error:
            refused[name] = str(error)
    assert len(refused) < len(ONE_EACH)
    assert set(refused) == REFUSED.get(what, set(refused))
    assert not any("\n" in sentence for sentence in refused.values())
