"""Does a model's bond graph, in momenta and displacements, move as the model does, and does its power balance?"""

from __future__ import annotations

from typing import Any

import sympy as sp

from ..bondgraph.equations import StateEquations, state_equations
from ..bondgraph.further import graph_states
from ..bondgraph.model import BondGraphModel, graph_of, states_bond_graph
from ..bondgraph.power import power_balance
from .precise import same_up_to_factor
from .report import FailedCheckError, NotApplicableError
from .subject import Subject


def bond_graph(subject: Subject) -> str:
    """Power balances, and the state equations have the model's characteristic polynomial.

    A graph may have more states than the model, displacements that nothing depends on: powers of s are left out.
    """
    if not states_bond_graph(subject.model):
        raise NotApplicableError("the model states no bond graph; a method 'bond_graph' would")
    inputs = subject.traced.u
    for direction in subject.directions:
        graph = graph_of(subject.model, direction)
        found = state_equations(graph, inputs)
        power = power_balance(found)
        if power.unbalanced:
            raise FailedCheckError(f"power is not passed on by {', '.join(power.unbalanced)}")
        if power.conserved is False:
            raise FailedCheckError("the rate of the stores' energy is not the power of sources and resistances")
        if not issubclass(subject.model, BondGraphModel):
            _compare(subject, direction, found)
    energy = "and is the rate of the energy" if power.conserved else "(a store's energy cannot be told)"
    return f"power balances in every junction {energy}; {len(found.states)} states give the same polynomial"


def _compare(subject: Subject, direction: int, found: StateEquations) -> None:
    """Compare characteristic polynomials at random parameters, in exact numbers."""
    system = subject.system(direction)
    groups = subject.groups(system.traced)
    states = graph_states(
        subject.model.model_id(), found.graph, groups["x"], groups["dx"], groups["ddx"]
    )
    basic = {symbol: sp.sympify(value) for symbol, value in system.traced.basic.items()}
    basic |= {s: states[s].xreplace(basic) for s in found.symbols}
    slopes = sp.Matrix(found.rates).jacobian(sp.Matrix(found.symbols)).xreplace(basic)
    symbols = list(system.traced.parameters.values())
    for point in subject.points("bond graph", direction):
        values = dict(zip(symbols, map(sp.nsimplify, map(str, point)), strict=True))
        one = [sp.sympify(c).xreplace(values) for c in system.polynomial.expressions]
        other = slopes.xreplace(values).charpoly().all_coeffs()[::-1]
        if not same_up_to_factor(_numbers(one), _numbers(other)):
            raise FailedCheckError("the state equations of the bond graph have another characteristic polynomial")


def _numbers(coefficients: list[Any]) -> list[Any]:
    """Return coefficients as numbers, those of the lowest powers left out while they are zero."""
    import mpmath

    with mpmath.workdps(40):
        values = [mpmath.mpmathify(sp.sympify(c).evalf(40)) for c in coefficients]
    first = next(i for i, v in enumerate(values) if v)
    return values[first:]
