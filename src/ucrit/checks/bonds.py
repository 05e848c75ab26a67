"""Does a model's bond graph, in momenta and displacements, move as the model does, and does its power balance?"""

from __future__ import annotations

from functools import cache
from typing import Any

import sympy as sp

from ..bondgraph.equations import StateEquations, state_equations
from ..bondgraph.further import graph_states
from ..bondgraph.model import BondGraphModel, graph_of, states_bond_graph
from ..bondgraph.power import power_balance
from ..core.derive import symbolic
from ..core.model import Model, Names
from .precise import DIGITS, same_up_to_factor
from .report import FailedCheckError, NotApplicableError
from .subject import Subject


def bond_graph(subject: Subject) -> str:
    """Power balances, and the state equations have the model's characteristic polynomial.

    A graph may have more states than the model, displacements that nothing depends on: powers of s are left out.
    """
    if not states_bond_graph(subject.model):
        raise NotApplicableError("the model states no bond graph; a method 'bond_graph' would")
    found = _found(subject.model)
    power = power_balance(found)
    if power.unbalanced:
        raise FailedCheckError(f"power is not passed on by {', '.join(power.unbalanced)}")
    if power.conserved is False:
        raise FailedCheckError("the rate of the stores' energy is not the power of sources and resistances")
    energy = "and is the rate of the energy" if power.conserved else "(a store's energy cannot be told)"
    said = f"power balances in every junction {energy}"
    if issubclass(subject.model, BondGraphModel):
        return said
    _compare(subject)
    return f"{said}; {len(found.states)} momenta and displacements have the same characteristic polynomial"


def _found_in(model: type[Model]) -> StateEquations:
    return state_equations(graph_of(model), symbolic(model).traced.u)


def _slopes_of(model: type[Model]) -> Any:
    """Return the matrix of the state equations about the basic motion."""
    found, traced = _found(model), symbolic(model).traced
    names = list(model.declaration.variables)
    x, dx, ddx = (
        Names(group, {name: chain[k] for name, chain in zip(names, traced.q, strict=False) if k < len(chain)})
        for k, group in enumerate(("x", "dx", "ddx"))
    )
    states = graph_states(model.model_id(), found.graph, x, dx, ddx)
    basic = {symbol: sp.sympify(value) for symbol, value in traced.basic.items()}
    basic |= {s: states[s].xreplace(basic) for s in found.symbols}
    return sp.Matrix(found.rates).jacobian(sp.Matrix(found.symbols)).xreplace(basic)


_found: Any = cache(_found_in)
_slopes: Any = cache(_slopes_of)


def _compare(subject: Subject) -> None:
    """Compare characteristic polynomials at random parameters, in exact numbers."""
    system, slopes = subject.system(), _slopes(subject.model)
    symbols = list(system.traced.parameters.values())
    for point in subject.points("bond graph", count=2):
        values = dict(zip(symbols, map(sp.Rational, map(str, point)), strict=True))
        one = [sp.sympify(c).xreplace(values) for c in system.polynomial.expressions]
        other = slopes.xreplace(values).charpoly().all_coeffs()[::-1]
        if not same_up_to_factor(_numbers(one), _numbers(other)):
            raise FailedCheckError("the state equations of the bond graph have another characteristic polynomial")


def _numbers(coefficients: list[Any]) -> list[Any]:
    """Return coefficients as numbers, those of the lowest powers left out while they are zero."""
    import mpmath

    with mpmath.workdps(DIGITS):
        values = [mpmath.mpmathify(sp.sympify(c).evalf(DIGITS)) for c in coefficients]
    first = next(i for i, v in enumerate(values) if v)
    return values[first:]
