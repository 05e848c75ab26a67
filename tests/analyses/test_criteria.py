"""The criteria that the machine derives, against the literature's, and against eigenvalues."""

import re

import numpy as np
import pytest
import sympy as sp
from hypothesis import assume, given
from hypothesis import strategies as st

from ucrit import UcritError, analyze, criteria, critical, find_model, load, verdict
from ucrit.analyses.stability.few import READABLE, ranked
from ucrit.catalogue import model_names, vehicle_names
from ucrit.core.contract.possible import holds
from ucrit.core.numeric.compiled import state_space


def same(expression, literature):
    """Whether two expressions are equal, both read with plain symbols."""
    names = {str(s): s for s in sp.symbols("a b c k m C C_f C_r I_c I_z U V Psi r_0 Omega N S Q")}
    found, wanted = (sp.sympify(e, locals=names) for e in (expression, literature))
    return sp.expand(found - wanted) == 0


def only_condition(name):
    (condition,) = criteria(find_model(name)).conditions
    return condition


@pytest.mark.parametrize(
    ("model", "literature", "failure"),
    [
        ("trailer-undamped-hitch", "(m*a*b - I_c)*(C*(I_c + m*b**2) + k*(a + b)*(m*a*b - I_c))", "flutter"),
        ("trailer-rigid-tire-undamped", "m*a*b - I_c", "flutter"),
        ("trailer-rigid-tire", "c*(a + b) + U*(m*a*b - I_c)", "flutter"),
        ("car", "(a + b)**2*C_f*C_r + m*U**2*(b*C_r - a*C_f)", "divergence"),
        ("wheelset-kinematic", "Psi", "divergence"),
    ],
)
def test_criterion_is_the_literatures(model, literature, failure):
    condition = only_condition(model)
    assert same(condition.expression, literature)
    assert condition.failure == failure


@pytest.mark.parametrize(
    ("model", "parameter", "power", "literature"),
    [
        ("trailer-rigid-tire", "U", 1, "c*(a + b)/(I_c - m*a*b)"),
        ("trailer-rigid-tire-undamped", "I_c", 1, "m*a*b"),
        ("car", "U", 2, "-(a + b)**2*C_f*C_r/(m*(b*C_r - a*C_f))"),
    ],
)
def test_critical_value_in_closed_form_is_the_literatures(model, parameter, power, literature):
    boundary = only_condition(model).boundary(parameter)
    assert boundary.power == power
    assert (
        sp.simplify(
            sp.sympify(
                boundary.expression,
                locals={"I_c": sp.Symbol("I_c"), "C_f": sp.Symbol("C_f"), "C_r": sp.Symbol("C_r")},
            )
            - sp.sympify(literature, locals={"I_c": sp.Symbol("I_c"), "C_f": sp.Symbol("C_f"), "C_r": sp.Symbol("C_r")})
        )
        == 0
    )


@pytest.mark.parametrize("model", ["trailer-rigid-hitch", "trailer-kinematic"])
def test_stable_forward_unstable_backward(model):
    assert criteria(find_model(model)).settled is True
    assert criteria(find_model(model), direction=-1).settled is False


def test_kinematic_wheelset_has_the_literatures_wavelength():
    from ucrit.core.derivation.derive import symbolic

    system = symbolic(find_model("wheelset-kinematic"))
    a0, a1, a2 = system.polynomial.expressions
    Psi, r_0, l, Omega = system.traced.parameters.values()
    assert a1 == 0
    speed, frequency = r_0 * Omega, sp.sqrt(a0 / a2)
    wavelength = sp.simplify((2 * sp.pi * speed / frequency) ** 2)
    assert sp.simplify(wavelength - (2 * sp.pi) ** 2 * r_0 * l / (2 * Psi)) == 0
    assert not wavelength.has(Omega)


TOO_LONG = (
    "airplane",
    "airplane-longitudinal-coefficients",
    "airplane-lateral-coefficients",
    "bicycle",
    "car-four-wheels",
    "car-trailer",
    "rail-truck",
    "car-split-friction",
    load("car-with-stability-control").model_id(),
)


@pytest.mark.parametrize("name", [n for n in vehicle_names() if type(load(n)).model_id() not in TOO_LONG])
def test_criteria_agree_with_eigenvalues(name):
    vehicle = load(name)
    model = type(vehicle)
    random = np.random.default_rng(1)
    factors = 10 ** random.uniform(-0.7, 0.7, (len(vehicle.values), 400))
    changes = {}
    for row, (key, value) in zip(factors, vehicle.values.items(), strict=True):
        values = float(value) * row
        changes[key] = np.where(model.declaration.parameters[key].allows(values), values, value)
    possible = np.all([np.ones(400, dtype=bool), *holds(model, changes).values()], axis=0)
    changes = {key: np.where(possible, values, vehicle.values[key]) for key, values in changes.items()}
    many = vehicle.along("sample", **changes)
    found = criteria(vehicle)
    if found.settled is not None:
        predicted = np.full(400, found.settled)
    else:
        predicted = np.all([np.broadcast_to(c.value(many) > 0, 400) for c in found], axis=0)
    values = np.linalg.eigvals(state_space(many).A)
    if found.zeros == values.shape[-1]:
        assert (found.kind, found.settled) == ("neutral", True)
        return
    size = np.abs(values).max(axis=-1)
    values = np.take_along_axis(values, np.argsort(np.abs(values), axis=-1)[:, found.zeros :], axis=-1)
    growth = values.real.max(axis=-1) / size
    clear = np.abs(growth) > 1e-9
    if found.kind == "neutral":
        assert np.array_equal(growth < 1e-9, predicted)
    else:
        assert clear.mean() > 0.95 or verdict(vehicle).marginal
        assert np.array_equal((growth < 0)[clear], predicted[clear])


@given(st.floats(0.1, 10), st.floats(0.1, 10), st.floats(0.1, 10))
def test_free_parameters_keep_their_symbols(m, c, C):
    caravan = load("caravan").with_(m=1200 * m, c=4000 * c, C=9e4 * C)
    found = criteria(caravan, free=["U"])
    (full,) = criteria(caravan).conditions
    assume(full.value(caravan) != 0)
    assert all(condition.parameters == ("U",) for condition in found)
    holds = all(condition.value(caravan) > 0 for condition in found) if found.settled is None else found.settled
    assert holds == (full.value(caravan) > 0)


def test_too_long_conditions_are_refused_with_a_way_out():
    with pytest.raises(UcritError, match="too long to be read") as caught:
        criteria(find_model("rail-truck"))
    assert "free=" in str(caught.value)
    found = criteria(load("car-and-caravan"), free=["U"])
    assert all(condition.parameters == ("U",) for condition in found)


LARGE = ("rail-truck", "car-four-wheels", "bicycle")


@pytest.mark.parametrize("name", [n for n in vehicle_names() if type(load(n)).model_id() not in LARGE])
def test_each_parameter_alone_can_stay_free(name):
    vehicle = load(name)
    for parameter in vehicle.values:
        found = criteria(vehicle, free=[parameter])
        holds = not found.failing(vehicle) if found.settled is None else found.settled
        wanted = "neutral" if found.kind == "neutral" else "asymptotically stable"
        assert holds == (verdict(vehicle).state == wanted)
        assert all(len(condition.expression) < 10_000 for condition in found)


def test_free_parameters_of_a_large_model_are_refused_with_another_way_out():
    with pytest.raises(UcritError, match="the conditions in V are too long to be read; critical gives"):
        criteria(load("coach-truck"), free=["V"])


def test_free_needs_a_vehicle_and_known_names():
    with pytest.raises(UcritError, match="need a vehicle"):
        criteria(find_model("car"), free=["U"])
    with pytest.raises(UcritError, match="need scalar values, got arrays for U"):
        criteria(load("caravan").with_(U=[10.0, 20.0]), free=["m"])
    with pytest.raises(UcritError, match="did you mean 'C_f'"):
        criteria(load("bmw-320i"), free=["C_F"])


@pytest.mark.parametrize("name", [n for n in model_names() if n not in TOO_LONG])
def test_what_is_shown_is_typeset_three_ways(name):
    from xml.etree import ElementTree

    for condition in criteria(find_model(name)):
        assert condition.latex
        ElementTree.fromstring(condition.mathml.replace("&InvisibleTimes;", "").replace("&#8290;", ""))
        assert sp.sympify(condition.expression, locals={p: sp.Symbol(p) for p in condition.parameters}).free_symbols


def test_doubles_of_a_criterion_read_back_and_a_one_is_not_written():
    found = criteria(load("oversteering-car-steered-by-yaw-rate"), free=["G"])
    for condition in found.conditions:
        number = float(re.fullmatch(r"G \+ (0\.\d+)", condition.expression)[1])
        assert repr(number) in condition.expression


def test_few_parameters_are_those_that_matter_and_their_criterion_is_right():
    vehicle = load("car-with-stability-control")
    with pytest.raises(UcritError, match='free="few"'):
        criteria(type(vehicle))
    found = criteria(vehicle, free="few")
    assert found.free
    assert 0 < sum(len(c.expression) for c in found) <= READABLE
    assert analyze(vehicle, free="few").criteria == found
    assert analyze(vehicle).criteria is None
    (name,) = found.free
    edges = list(critical(vehicle, name, 0.3 * vehicle.values[name], 3 * vehicle.values[name]))
    assert edges
    for value in [edge.value * factor for edge in edges for factor in (0.999, 1.001)]:
        changed = vehicle.with_(**{name: value})
        assert verdict(changed).stable is not bool(found.failing(changed))


def test_few_are_all_parameters_where_these_can_be_read():
    vehicle = load("caravan")
    assert analyze(vehicle, free="few").criteria == criteria(vehicle)
    assert criteria(vehicle).free is None
    assert analyze(vehicle, free="U, a").criteria.free == ("U", "a")
    assert analyze(vehicle, free="U, a").to_dict()["criteria_in"] == ["U", "a"]
    assert {"a", "I_c", "m"} <= set(ranked(vehicle)[:4])
    with pytest.raises(UcritError, match="a vehicle's; give one"):
        criteria(type(vehicle), free="few")
