"""Every vehicle answers every analysis that fits it; one that does not fit is refused in a sentence."""

import warnings
from itertools import product

import numpy as np
import pytest

import ucrit
from ucrit import UcritError, load
from ucrit.catalogue import vehicle_names


def pairs(vehicle):
    """Every input with every output of a model."""
    declared = type(vehicle).declaration
    return product(declared.inputs, [*declared.variables, *declared.outputs])


def first_parameters(vehicle):
    """Two parameters to map over, each between half and twice its value."""
    values = {k: float(v) for k, v in vehicle.values.items() if float(v) > 0}
    allowed = type(vehicle).declaration.parameters
    names = [k for k, v in values.items() if allowed[k].allows([v / 2, 2 * v]).all()][:2]
    return {k: np.linspace(values[k] / 2, 2 * values[k], 5) for k in names}


ALWAYS = {
    "modes": ucrit.modes,
    "verdict": ucrit.verdict,
    "analyze": ucrit.analyze,
    "show": ucrit.show,
    "remedies": ucrit.remedies,
    "sensitivity": ucrit.sensitivity,
    "to_control": ucrit.to_control,
    "to_scipy": ucrit.to_scipy,
    "sweep": lambda v: ucrit.sweep(v, **first_parameters(v)),
    "stability_map": lambda v: ucrit.stability_map(v, **first_parameters(v)),
    "compare": lambda v: ucrit.compare(v, load("caravan")),
    "transfer": lambda v: [ucrit.transfer(v, i, o) for i, o in pairs(v)],
    "step": lambda v: [ucrit.step_response(v, i) for i in type(v).declaration.inputs],
}
WHERE_IT_FITS = {
    "criteria": ucrit.criteria,
    "critical speed": ucrit.critical,
    "critical value": lambda v: ucrit.critical(v, next(iter(v.values))),
    "locus": lambda v: ucrit.locus(v, next(iter(first_parameters(v))), points=20),
    "steady_turn": ucrit.steady_turn,
    "static_stability": ucrit.static_stability,
    "axle_loads": ucrit.axle_loads,
    "static_margin": ucrit.static_margin,
    "trim": ucrit.trim,
}


@pytest.mark.parametrize("name", vehicle_names())
def test_every_vehicle_answers(name):
    vehicle = load(name)
    for what, analysis in ALWAYS.items():
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            assert analysis(vehicle) is not None, what


@pytest.mark.parametrize("what", WHERE_IT_FITS)
def test_what_does_not_fit_is_refused_in_a_sentence(what):
    answered, refused = [], []
    for name in vehicle_names():
        try:
            assert WHERE_IT_FITS[what](load(name)) is not None
            answered.append(name)
        except UcritError as error:
            assert "\n" not in str(error)
            refused.append(name)
    assert answered
    assert refused or what == "trim"
