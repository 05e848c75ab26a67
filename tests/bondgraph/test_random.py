"""Graphs drawn at random: energy, order of declaration, and a formulation that assigns no causality."""

from __future__ import annotations

import numpy as np
import sympy as sp
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.linalg import eigvals

from ucrit import ModelError
from ucrit.bondgraph import Graph
from ucrit.bondgraph.equations import state_equations
from ucrit.bondgraph.power import power_balance

from .test_procedure import trees

QUICK = settings(max_examples=30, deadline=None, derandomize=True)


def derived(graph):
    """Return the state equations; graphs that contradict themselves are passed over."""
    try:
        return state_equations(graph)
    except ModelError:
        assume(False)


def matrix(found):
    return sp.Matrix(found.rates).jacobian(sp.Matrix(found.symbols))


def number_of(element):
    """Return the one number of an element's law; junctions have none."""
    if element.law is None:
        return None
    return float(element.law.coefficients[0, 0] if element.law.takes else element.law.expressions[0])


def tableau(graph):
    """Return E and A of ``E z' = A z`` for all efforts, flows and stored quantities, element by element.

    Every law is written down as it is stated: no bond is told what is cause and what is effect. Sources are held.
    """
    n, stores = len(graph.bonds), [e for e in graph.elements if e.kind in ("I", "C")]
    size = 2 * n + len(stores)
    E, A = [], []

    def row():
        E.append(np.zeros(size))
        A.append(np.zeros(size))
        return E[-1], A[-1]

    for element in graph.elements:
        bonds = graph.bonds_at[element.name]
        number = number_of(element)
        effort, flow = [b.number - 1 for b in bonds], [n + b.number - 1 for b in bonds]
        if element.kind in ("0", "1"):
            common, balanced = (effort, flow) if element.kind == "0" else (flow, effort)
            for other in common[1:]:
                _, a = row()
                a[common[0]], a[other] = 1, -1
            _, a = row()
            for b, place in zip(bonds, balanced, strict=True):
                a[place] = 1 if b.head == element.name else -1
        elif element.kind in ("TF", "GY"):
            i, o = (0, 1) if bonds[0].head == element.name else (1, 0)
            pairs = (flow[o], flow[i]), (effort[i], effort[o])
            if element.kind == "GY":
                pairs = (effort[i], flow[o]), (effort[o], flow[i])
            for left, right in pairs:
                _, a = row()
                a[left], a[right] = 1, -number
        elif element.kind in ("Se", "Sf"):
            _, a = row()
            a[effort[0] if element.kind == "Se" else flow[0]] = 1
        elif element.kind == "R":
            _, a = row()
            a[effort[0]], a[flow[0]] = 1, -number
        else:
            state = 2 * n + stores.index(element)
            rate, law = (effort, flow) if element.kind == "I" else (flow, effort)
            e, a = row()
            e[state], a[rate[0]] = 1, 1
            _, a = row()
            a[state], a[law[0]] = 1, -number
    return np.array(E), np.array(A)


@QUICK
@given(trees())
def test_eigenvalues_are_those_of_a_formulation_without_causality(graph):
    found = derived(graph)
    assume(found.states)
    E, A = tableau(graph)
    assume(A.shape[0] == A.shape[1])
    expected = np.array(matrix(found).tolist(), dtype=float)
    s = np.array([0.3 + 1.1j, -0.7 + 0.4j, 1.9 - 0.8j, 2.3 + 0.1j, -1.7 - 2.9j])
    ratios = [
        np.linalg.det(z * E - A) / np.linalg.det(z * np.eye(len(expected)) - expected) for z in s
    ]  # one polynomial and a constant times the other
    assert np.allclose(ratios, ratios[0], rtol=1e-7)


@QUICK
@given(trees(), st.randoms(use_true_random=False))
def test_the_order_of_declaration_does_not_matter(graph, chance):
    found = derived(graph)
    assume(found.states)
    elements, bonds = list(graph.elements), [f"{b.tail} -> {b.head}" for b in graph.bonds]
    chance.shuffle(elements)
    chance.shuffle(bonds)
    other = state_equations(Graph(*bonds, *elements))
    s = sp.Symbol("s")
    assert matrix(found).charpoly(s) == matrix(other).charpoly(s)
    assert len(found.states) == len(other.states)


@QUICK
@given(trees())
def test_without_resistances_and_sources_energy_is_kept(graph):
    lossless = [e for e in graph.elements if e.kind not in ("R", "Se", "Sf")]
    kept = {e.name for e in lossless}
    bonds = [f"{b.tail} -> {b.head}" for b in graph.bonds if {b.tail, b.head} <= kept]
    bare = kept - {end for b in bonds for end in b.split(" -> ")}
    assume(not bare)
    found = derived(Graph(*lossless, *bonds))
    assume(found.states)
    balance = power_balance(found)
    rate = sum(sp.diff(balance.energy, x) * r for x, r in zip(found.symbols, found.rates, strict=True))
    assert sp.expand(rate) == 0
    assert abs(eigvals(np.array(matrix(found).tolist(), dtype=float)).real).max() < 1e-6
