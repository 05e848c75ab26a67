"""The forms of linear equations: every way from each to each, and the same eigenvalues at its end."""

import numpy as np
import pytest
import scipy.linalg
import sympy as sp
from scipy.optimize import linear_sum_assignment

from ucrit import Descriptor, NthOrder, SecondOrder, StateSpace, UcritError, find_model, forms, load, modes

WAYS = ("to_nth_order", "to_state_space", "to_second_order", "to_descriptor")
VEHICLES = (
    "bmw-320i",
    "oversteering-car-on-the-road",
    "caravan",
    "caravan-rigid-tire",
    "caravan-kinematic",
    "wheelset",
    "wheelset-1-in-20",
    "supermarket-cart",
    "supermarket-cart-pushed-backward",
    "marble-on-the-flat",
    "pneumatic-caster",
    "satellite-middle-axis",
    "explorer-1",
    "large-airplane-body",
)


def apart(one, other):
    """Return the largest distance between two sets of eigenvalues, each with its own, over the largest of them."""
    assert len(one) == len(other)
    distance = np.abs(np.asarray(one)[:, None] - np.asarray(other)[None])
    return distance[linear_sum_assignment(distance)].max() / max(np.abs(other).max(), 1e-300)


@pytest.mark.parametrize("name", VEHICLES)
def test_every_form_has_the_eigenvalues_of_the_vehicle(name):
    vehicle = load(name)
    expected = modes(vehicle).eigenvalues
    for form in forms(vehicle):
        for there in WAYS:
            for back in WAYS:
                found = getattr(getattr(form, there)(), back)()
                assert apart(found.eigenvalues, expected) < 1e-9, (type(form).__name__, there, back)
                assert found.rigid_positions == np.count_nonzero(expected == 0)
                assert np.count_nonzero(found.eigenvalues == 0) == found.rigid_positions


@pytest.mark.parametrize("name", ["bmw-320i", "caravan", "wheelset", "pneumatic-caster"])
def test_descriptor_pencil_by_another_algorithm(name):
    descriptor = forms(load(name)).descriptor
    E, A = (np.array(M.tolist(), dtype=float) for M in (descriptor.E, descriptor.A))
    values = scipy.linalg.eigvals(A, E)
    finite = values[np.argsort(np.abs(np.where(np.isfinite(values), values, np.inf)))][: descriptor.order]
    assert apart(finite, descriptor.eigenvalues) < 1e-9


def test_second_order_set_by_another_algorithm():
    rng = np.random.default_rng(1)
    M, B, K = np.round(rng.normal(size=(3, 3, 3)), 3)
    form = SecondOrder(M, B, K)
    solved = -np.linalg.solve(M, np.hstack([K, B]))
    expected = np.linalg.eigvals(np.vstack([np.hstack([np.zeros((3, 3)), np.eye(3)]), solved]))
    for way in WAYS:
        assert apart(getattr(form, way)().eigenvalues, expected) < 1e-10


def test_symbols_go_through_every_form():
    form = forms(find_model("trailer"))
    polynomial = form.nth_order.a
    for there in (form.state_space, form.second_order, form.descriptor):
        for way in WAYS:
            found = getattr(there, way)().coefficients
            ratio = [sp.cancel(a / b) for a, b in zip(found, polynomial, strict=True)]
            assert len(set(ratio)) == 1


def test_odd_order_becomes_pairs_and_one_equation_of_first_order():
    form = NthOrder([6, 11, 6, 1]).to_second_order()
    assert form.M.rows == 2
    assert form.M.rank() == 1
    assert sorted(form.eigenvalues.real) == pytest.approx([-3, -2, -1], rel=1e-12)


def test_constraint_and_part_without_mass_lower_the_order():
    hitch = SecondOrder([[2, 0], [0, 0]], [[0, 0], [0, 3]], [[5, -5], [-5, 5]])
    assert hitch.order == 3
    assert hitch.rigid_positions == 1
    assert hitch.to_state_space().states == ("x1", "x1'", "x2")
    assert hitch.to_descriptor().E.rank() == 3


def test_double_zero_is_exact():
    free = SecondOrder([[0.1, 0], [0, 0.3]], [[0, 0], [0, 0]], [[0.7, -0.7], [-0.7, 0.7]])
    assert free.rigid_positions == 2
    assert list(free.eigenvalues).count(0) == 2


def test_printing():
    assert str(forms(find_model("oscillator")).second_order) == (
        "second-order set, M q'' + B q' + K q = 0\nM = [[m]]\nB = [[b]]\nK = [[k]]"
    )
    assert "rigid positions: 1" in str(forms(load("marble-on-the-flat")))
    assert "9.81" in str(NthOrder([9.81, 1]))


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: StateSpace([[1, 2]]), "A must be a square matrix, got 1 rows of 2 entries"),
        (lambda: StateSpace([1, 2]), "A must be a square matrix, given row by row"),
        (lambda: StateSpace([["k"]]), "A: entries must be finite real numbers or SymPy expressions, got 'k'"),
        (lambda: SecondOrder([[1]], [[float("nan")]], [[1]]), "B: entries must be finite"),
        (lambda: SecondOrder([[1]], [[1]], [[1, 0], [0, 1]]), "M: 1, B: 1, K: 2 rows"),
        (lambda: NthOrder([1]), "two coefficients or more"),
        (lambda: NthOrder([1, 2, 0]), "the last of them not zero"),
        (lambda: Descriptor([[0]], [[1]]).to_state_space(), "hold no rates"),
        (lambda: Descriptor([[1, 1], [1, 1]], [[1, 1], [1, 1]]).eigenvalues, "not independent"),
        (lambda: StateSpace([[sp.Symbol("k")]]).eigenvalues, "give values for k"),
        (lambda: StateSpace([[sp.I]]), "finite real numbers"),
        (lambda: forms(load("caravan").with_(m=[1, 2])), "give scalar parameters"),
    ],
)
def test_mistakes_are_refused_in_a_sentence(make, words):
    with pytest.raises(UcritError) as error:
        make()
    assert words in str(error.value)


def test_states_of_a_vehicle_are_named():
    vehicle = load("caravan")
    assert forms(vehicle).state_space.states == modes(vehicle).labels


def test_backing_up():
    trailer = load("caravan").with_(U=-3)
    assert apart(forms(trailer).nth_order.eigenvalues, modes(trailer).eigenvalues) < 1e-9
