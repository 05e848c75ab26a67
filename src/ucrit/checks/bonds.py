"""Does a model's bond graph, in momenta and displacements, move as the model does, and does its power balance?"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from typing import Any

import numpy as np
import sympy as sp

from ..analyses.linear.modes import modes
from ..analyses.motion.power_flow import PowerFlow, power_flow
from ..analyses.motion.simulate import simulate
from ..analyses.motion.simulation import Simulation
from ..bondgraph.equations import StateEquations, state_equations
from ..bondgraph.further import graph_states
from ..bondgraph.model import BondGraphModel, graph_of, states_bond_graph
from ..bondgraph.power import power_balance
from ..core.contract.methods import Names
from ..core.contract.model import Model
from ..core.derivation.derive import symbolic
from ..core.errors import UcritError
from .precise import DIGITS, same_up_to_factor
from .report import FailedCheckError, NotApplicableError
from .states import random_states
from .subject import Subject

MOTIONS, POINTS, SPAN = 2, 401, 2.0
REACHES = (0.4, 0.02)
FAULT, IMBALANCE = 1e-6, 1e-6


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


def bond_graph_in_motion(subject: Subject) -> str:
    """Along simulated motions of the model every element does what it states, and the energy is accounted for.

    The motions are the model's own, from its forces or energies if it has any. Laws that are turned round may have
    an end, a tire's a largest force: what fails at large motions only is tried at smaller ones.
    """
    if not states_bond_graph(subject.model):
        raise NotApplicableError("the model states no bond graph; a method 'bond_graph' would")
    for reach in REACHES:
        flows = [power_flow(motion) for motion in _motions(subject, reach)]
        faults = [fault for flow in flows if (fault := _fault(flow))]
        if flows and not faults:
            told = not any(np.isnan(flow.energy).any() for flow in flows)
            energy = "and the energy changes by what comes in" if told else "(a store's energy cannot be told)"
            said = f"along {len(flows)} simulated motions each of {len(flows[0].faults)} elements does what it states"
            return f"{said} {energy}"
    if not flows:
        raise NotApplicableError("no random vehicle could be simulated")
    raise FailedCheckError(f"along a simulated motion {faults[0]}")


def _fault(flow: PowerFlow) -> str:
    name, fault = max(flow.faults.items(), key=lambda item: item[1])
    if not fault <= FAULT:
        return f"{name} does not do what it states, by {100 * fault:.2g} %"
    if flow.imbalance > IMBALANCE:
        missing = f"{100 * flow.imbalance:.2g} % are missing"
        return f"the energy of the stores is not what sources give and resistances take: {missing}"
    return ""


def _motions(subject: Subject, reach: float) -> Iterator[Simulation]:
    """Yield motions of random vehicles, starts and inputs, as long as the fastest mode takes, if they stay finite."""
    states, model = random_states(subject, "bond graph in motion", MOTIONS, reach), subject.model
    for k in range(MOTIONS):
        values = (float(np.broadcast_to(p, (MOTIONS,))[k]) for p in states.parameters)
        vehicle = model(**dict(zip(model.declaration.parameters, values, strict=True)))
        fastest = float(np.abs(modes(vehicle).eigenvalues).max(initial=0.0)) or 1.0
        start = dict(zip(subject.motion.labels, map(float, states.w[:, k]), strict=True))
        inputs = dict(zip(model.declaration.inputs, map(float, states.u[:, k]), strict=True))
        times = np.linspace(0, SPAN / fastest, POINTS)
        try:
            found = simulate(vehicle, float(times[-1]), start, inputs, times=times)
        except UcritError:
            continue
        if len(found.times) == POINTS:
            yield found


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
