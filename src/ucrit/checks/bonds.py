"""Does a model's bond graph, in momenta and displacements, move as the model does, and does its power balance?"""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import sympy as sp

from ..analyses.modes import modes
from ..analyses.power_flow import PowerFlow, power_flow
from ..analyses.simulate import simulate
from ..analyses.simulation import Simulation
from ..bondgraph.equations import StateEquations, state_equations
from ..bondgraph.further import graph_states
from ..bondgraph.model import BondGraphModel, graph_of, states_bond_graph
from ..bondgraph.power import power_balance
from ..core.derive import symbolic
from ..core.errors import UcritError
from ..core.model import Model, Names
from .precise import DIGITS, same_up_to_factor
from .report import FailedCheckError, NotApplicableError
from .subject import Subject

MOTIONS, POINTS = 2, 301
FAULT, IMBALANCE = 1e-6, 1e-5

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

    The motions are the model's own, from its forces or energies if it has any.
    """
    if not states_bond_graph(subject.model):
        raise NotApplicableError("the model states no bond graph; a method 'bond_graph' would")
    followed, told = 0, True
    for vehicle in _vehicles(subject):
        motion = _moved(subject, vehicle)
        if motion is None:
            continue
        flow, followed = power_flow(motion), followed + 1
        name, fault = max(flow.faults.items(), key=lambda item: item[1])
        if not fault <= FAULT:
            raise FailedCheckError(f"along a simulated motion {name} does not do what it states, by {_percent(fault)}")
        told = not np.isnan(flow.energy).any()
        if told and not _balanced(flow):
            raise FailedCheckError(
                "along a simulated motion the energy of the graph's stores is not what its sources give and its "
                f"resistances take: {_percent(flow.imbalance)} are missing"
            )
    if not followed:
        raise NotApplicableError("no random vehicle could be simulated")
    energy = "and the energy changes by what comes in" if told else "(a store's energy cannot be told)"
    return f"along {followed} simulated motions each of {len(flow.faults)} elements does what it states {energy}"


def _percent(share: float) -> str:
    return f"{100 * share:.2g} %"


def _balanced(flow: PowerFlow) -> bool:
    """Tell whether what is missing is nothing, or an error of the integral that half as many times make far larger."""
    if flow.imbalance <= IMBALANCE:
        return True
    rows = (flow.times, flow.powers, flow.energy, flow.supplied, flow.dissipated)
    coarse = PowerFlow(*(row[::2] for row in rows))
    return flow.imbalance <= 100 * IMBALANCE and coarse.imbalance > 8 * flow.imbalance


def _vehicles(subject: Subject) -> list[Model]:
    names = list(subject.model.declaration.parameters)
    points = subject.points("bond graph in motion", subject.either, count=MOTIONS)
    return [subject.model(**dict(zip(names, point, strict=True))) for point in points]


def _moved(subject: Subject, vehicle: Model) -> Simulation | None:
    """Return a motion of random start and inputs as long as the fastest mode takes; ``None`` where it goes wild."""
    rng = subject.rng(f"motion of {subject.model.model_id()}")
    fastest = float(np.abs(modes(vehicle).eigenvalues).max(initial=0.0)) or 1.0
    labels = subject.motion.labels
    basic = dict(zip(labels, subject.motion.basic(vehicle.arguments())[0], strict=True))
    start = {name: float(basic[name]) + float(rng.uniform(0.02, 0.1)) * rng.choice((-1, 1)) for name in labels}
    inputs = {name: float(rng.uniform(0.02, 0.1)) for name in subject.model.declaration.inputs}
    times = np.linspace(0, 3 / fastest, POINTS)
    try:
        found = simulate(vehicle, float(times[-1]), start, inputs, times=times)
    except UcritError:
        return None
    return found if len(found.times) == POINTS else None


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
