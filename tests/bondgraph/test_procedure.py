"""Causality and state equations of graphs drawn at random, against rules and matrices written down independently."""

from __future__ import annotations

from itertools import product

import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from ucrit import ModelError
from ucrit.bondgraph import GY, TF, C, Graph, I, R, Se, Sf, causality, one, zero
from ucrit.bondgraph.causality import HEAD, TAIL, Causality
from ucrit.bondgraph.equations import state_equations
from ucrit.bondgraph.power import power_balance
from ucrit.bondgraph.text import read_graph
from ucrit.bondgraph.writing import write_graph

NUMBERS = st.fractions(min_value="1/4", max_value=4, max_denominator=7).map(
    lambda x: sp.Rational(x.numerator, x.denominator)
)
QUICK = settings(max_examples=25, deadline=None)


@st.composite
def chains(draw):
    """Masses joined to each other and to the ground by springs and dampers, some through a lever."""
    n = draw(st.integers(1, 4))
    masses = draw(st.lists(NUMBERS, min_size=n, max_size=n))
    ends = st.tuples(st.integers(0, n - 1), st.integers(-1, n - 1)).filter(lambda e: e[0] != e[1])
    links = draw(st.lists(st.tuples(ends, NUMBERS, NUMBERS, NUMBERS), min_size=1, max_size=5))
    return masses, links


def assembled(masses, links):
    """Return the graph of the masses, and M, B and K from the energies."""
    n = len(masses)
    parts = [p for k, m in enumerate(masses) for p in (one(f"x{k}"), I(f"m{k}", m), f"x{k} -> m{k}")]
    M, B, K = sp.diag(*masses), sp.zeros(n, n), sp.zeros(n, n)
    for number, ((i, j), lever, k, b) in enumerate(links):
        name, row = f"d{number}", sp.zeros(1, n)
        row[i] = lever
        parts += [zero(name), TF(f"t{number}", lever), f"x{i} -> t{number} -> {name}"]
        if j >= 0:
            row[j] -= 1
            parts.append(f"{name} -> x{j}")
        parts += [one(f"s{number}"), C(f"c{number}", 1 / k), R(f"r{number}", b)]
        parts += [f"{name} -> s{number} -> c{number}", f"s{number} -> r{number}"]
        K += row.T * row * k
        B += row.T * row * b
    return Graph(*parts), M, B, K


def reduced(polynomial, s):
    """Return monic coefficients of a polynomial without its roots at zero."""
    coefficients = sp.Poly(polynomial, s).monic().all_coeffs()
    while len(coefficients) > 1 and coefficients[-1] == 0:
        coefficients.pop()
    return coefficients


@QUICK
@given(chains())
def test_eigenvalues_are_those_of_the_assembled_matrices(chain):
    graph, M, B, K = assembled(*chain)
    found = state_equations(graph)
    s = sp.Symbol("s")
    A = sp.Matrix(found.rates).jacobian(sp.Matrix(found.symbols))
    assert reduced(A.charpoly(s).as_expr(), s) == reduced((M * s**2 + B * s + K).det(), s)
    assert not found.dependences
    assert not found.loops
    balance = power_balance(found)
    assert balance.conserved
    assert balance.unbalanced == ()


@st.composite
def trees(draw):
    """Trees of junctions with anything at their ends, transformers and gyrators on some bonds."""
    n = draw(st.integers(1, 6))
    parts = [(zero if draw(st.booleans()) else one)(f"j{k}") for k in range(n)]
    for k in range(1, n):
        start = f"j{draw(st.integers(0, k - 1))}"
        between = draw(st.sampled_from([None, TF, GY]))
        if between is None:
            parts.append(f"{start} -> j{k}")
        else:
            parts += [between(f"b{k}", draw(NUMBERS)), f"{start} -> b{k} -> j{k}"]
    for k in range(draw(st.integers(1, 7))):
        kind = draw(st.sampled_from([I, I, C, C, R, R, Se, Sf]))
        at, name = f"j{draw(st.integers(0, n - 1))}", f"e{k}"
        parts += [kind(name, draw(NUMBERS)), f"{name} -> {at}" if kind in (Se, Sf) else f"{at} -> {name}"]
    ends = {end for p in parts if isinstance(p, str) for end in p.split(" -> ")}
    bare = [p.name for p in parts if not isinstance(p, str) and p.name not in ends]
    return Graph(*parts, *(x for name in bare for x in (R(f"r_{name}", 1), f"{name} -> r_{name}")))


def rules_hold(found):
    """Tell whether every element has the causality that it must have, from the strokes alone."""
    for element in found.graph.elements:
        at_it = [
            (found.strokes[b.number - 1] == HEAD) == (b.head == element.name)
            for b in found.graph.bonds_at[element.name]
        ]
        wanted = {
            "Se": lambda a: not any(a),
            "Sf": all,
            "0": lambda a: sum(a) == 1,
            "1": lambda a: sum(a) == len(a) - 1,
            "TF": lambda a: sum(a) == 1,
            "GY": lambda a: sum(a) in (0, 2),
        }
        if element.kind in wanted and not wanted[element.kind](at_it):
            return False
    return True


def tried(work, graph):
    """Return a result and no message, or none and the message of its error."""
    try:
        return work(graph), ""
    except ModelError as error:
        return None, str(error)


@settings(max_examples=120, deadline=None)
@given(trees())
def test_causality_is_complete_or_the_conflict_is_named(graph):
    found, message = tried(causality, graph)
    if found is None:
        assert message.startswith("causal conflict")
        assert any(f"'{e.name}'" in message for e in graph.elements)
        return
    assert len(found.strokes) == len(graph.bonds)
    assert rules_hold(found)
    assert sorted(n for step in found.steps for n in step.bonds) == [b.number for b in graph.bonds]


@settings(max_examples=40, deadline=None)
@given(trees())
def test_power_balances_whatever_the_graph(graph):
    found, message = tried(state_equations, graph)
    if found is None:
        assert any(
            words in message for words in ("causal conflict", "contradict", "cannot be solved", "depends on its")
        )
        return
    balance = power_balance(found)
    assert balance.unbalanced == ()
    assert balance.conserved


@settings(max_examples=40, deadline=None)
@given(trees())
def test_text_is_read_back(graph):
    assert read_graph(write_graph(graph), {}) == graph


def any_causality(graph):
    """Tell whether any causality keeps all rules, by trying all strokes."""
    return any(rules_hold(Causality(graph, s, ())) for s in product((HEAD, TAIL), repeat=len(graph.bonds)))


@settings(max_examples=40, deadline=None)
@given(trees().filter(lambda g: len(g.bonds) <= 9))
def test_a_causality_is_found_where_there_is_one(graph):
    found, _ = tried(causality, graph)
    assert (found is not None) == any_causality(graph)
