"""What a bond graph says: causality, findings, state equations and power; and the powers along a motion."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ..bondgraph.causality import HEAD, Causality
from ..bondgraph.graph import Graph
from ..bondgraph.model import BondGraphModel, graph_of, input_symbols, states_bond_graph
from ..catalogue import BONDS, find_model, model_from_file, model_names
from ..core.errors import UcritError, near_match
from ..core.html import Rich
from ..core.model import Model
from .convert import Series, Table, Tabular
from .simulation import Simulation

Array = npt.NDArray[np.float64]
WHY = {
    "source": "a source",
    "end": "its only bond",
    "store": "a store",
    "resistance": "chosen freely",
    "rest": "chosen freely",
}


@dataclass(frozen=True)
class BondRow:
    """One bond: number, ends, which end its effort acts on, and the element whose causality settled it."""

    number: int
    tail: str
    head: str
    effort_on: str
    settled_by: str
    reason: str


@dataclass(frozen=True)
class Bonds(Rich):
    """What `bonds` finds.

    Attributes
    ----------
    name, title
        Name and first line of the model, empty for a bare graph.
    causality
        The graph with its causal strokes.
    rows
        The bonds, one by one.
    states
        Names of the states.
    equations
        Rates of the states as text, ``p' = ...``.
    findings
        Derivative causality and algebraic loops, a sentence each.
    balanced
        Whether power passes junctions, transformers and gyrators unchanged, and the energy's rate is what goes in.
    text
        The graph as text that is read back to an equal one.
    """

    name: str
    title: str
    causality: Causality
    rows: tuple[BondRow, ...]
    states: tuple[str, ...]
    equations: tuple[str, ...]
    findings: tuple[str, ...]
    balanced: bool
    text: str

    @property
    def graph(self) -> Graph:
        """The graph."""
        return self.causality.graph

    def __str__(self) -> str:
        lines = [f"{r.number}: {r.tail} -> {r.head}, effort on {r.effort_on}" for r in self.rows]
        return "\n".join([*lines, *self.findings, *self.equations])


def bonds(subject: Graph | type[Model] | Model | str | os.PathLike[str]) -> Bonds:
    """Analyse a bond graph: causality, algebraic loops, derivative causality, state equations, power balance.

    Parameters
    ----------
    subject
        A graph, a model that states one, or the name of a model; also a Python file with a model, or a bond graph
        as text (a file ending in ``.bonds``).

    Raises
    ------
    UcritError
        If there is no such thing, the model states no bond graph, or the graph is wrong.

    Examples
    --------
    >>> from ucrit import bonds
    >>> print(bonds("oscillator").equations[1])
    q_spring' = p_mass/m
    """
    from ..bondgraph.equations import state_equations
    from ..bondgraph.power import power_balance
    from ..bondgraph.writing import write_graph
    from ..core.typeset import text as typeset

    graph, model = _graph(subject)
    inputs = () if model is None else tuple(input_symbols(model.declaration.inputs).values())
    found = state_equations(graph, inputs)
    power = power_balance(found)
    return Bonds(
        name="" if model is None else model.model_id(),
        title="" if model is None else model.title(),
        causality=found.causality,
        rows=_rows(found.causality),
        states=found.states,
        equations=tuple(f"{s}' = {typeset(r)}" for s, r in zip(found.states, found.tidied, strict=True)),
        findings=found.findings,
        balanced=not power.unbalanced and power.conserved is not False,
        text=write_graph(graph) + "\n" if model is None else _sheet(model, graph),
    )


def _sheet(model: type[Model], graph: Graph) -> str:
    from ..bondgraph.writing import write_sheet

    return write_sheet(model.title(), model.declaration.parameters, model.declaration.inputs, graph)


def _graph(subject: Any) -> tuple[Graph, type[Model] | None]:
    if isinstance(subject, Graph):
        return subject, None
    if isinstance(subject, Model):
        return graph_of(type(subject)), type(subject)
    if isinstance(subject, type):
        return graph_of(subject), subject
    model = _named(os.fspath(subject))
    return graph_of(model), model


def _named(name: str) -> type[Model]:
    if ".py" in name or name.endswith(BONDS) or name.replace("_", "-") in model_names():
        return find_model(name)
    if Path(name).is_file() and not name.endswith(".toml"):
        return model_from_file(Path(name), name)
    raise UcritError(f"there is no model and no file '{name}'{near_match(name, stating())}")


def stating() -> list[str]:
    """Names of the models in the catalogue that state a bond graph."""
    return [name for name in model_names() if states_bond_graph(find_model(name))]


def _rows(found: Causality) -> tuple[BondRow, ...]:
    rows = []
    for bond, stroke in zip(found.graph.bonds, found.strokes, strict=True):
        step = found.step_of(bond.number)
        on = bond.head if stroke == HEAD else bond.tail
        rows.append(BondRow(bond.number, bond.tail, bond.head, on, step.element, WHY[step.reason]))
    return tuple(rows)


@dataclass(frozen=True)
class PowerFlow(Tabular):
    """Powers along a simulated motion.

    Attributes
    ----------
    vehicle
        The vehicle that was simulated.
    times
        [s], shape (T,).
    powers
        Power along each bond [W], positive from tail to head, shape (T, bonds).
    energy
        Held by all stores [J], shape (T,).
    supplied, dissipated
        Given by all sources, taken by all resistances [W], shape (T,).
    """

    vehicle: Model
    times: Array
    powers: Array
    energy: Array
    supplied: Array
    dissipated: Array

    def table(self) -> Table:
        """Return the powers of the bonds, the energy, and what is supplied and dissipated, over time."""
        coords = (
            Series("time", ("time",), self.times, "s"),
            Series("bond", ("bond",), 1 + np.arange(self.powers.shape[1])),
        )
        data = (
            Series("energy", ("time",), self.energy, "J"),
            Series("supplied", ("time",), self.supplied, "W"),
            Series("dissipated", ("time",), self.dissipated, "W"),
            Series("power", ("time", "bond"), self.powers, "W"),
        )
        return Table("power", self.vehicle, coords, data, ("time",))

    @property
    def imbalance(self) -> float:
        """Largest difference of the energy from what has come in, as a share of the energy that was about.

        The integral over time is Simpson's on the given times, and its error is part of this.
        """
        from scipy.integrate import cumulative_simpson

        net = self.supplied - self.dissipated
        gained = cumulative_simpson(net, x=self.times, initial=0.0)
        about = np.ptp(self.energy) + np.trapezoid(np.abs(self.supplied) + np.abs(self.dissipated), self.times)
        return float(np.max(np.abs(self.energy - self.energy[0] - gained)) / (about or 1.0))


def power_flow(simulation: Simulation) -> PowerFlow:
    """Return the power of every bond, and the energy, along a simulated motion.

    Parameters
    ----------
    simulation
        What `ucrit.simulate` returned for a vehicle whose model is stated by a bond graph.

    Raises
    ------
    UcritError
        If the model is stated otherwise, or its energy is unknown.

    Examples
    --------
    >>> from ucrit import param, power_flow, simulate
    >>> from ucrit.bondgraph import BondGraphModel, C, Graph, I, one
    >>> class Bouncing(BondGraphModel):
    ...     m: float = param("kg", "mass", above=0)
    ...     k: float = param("N/m", "stiffness", above=0)
    ...
    ...     def bond_graph(self):
    ...         return Graph(one("x"), I("mass", self.m), C("spring", 1 / self.k), "x -> mass", "x -> spring")
    >>> flow = power_flow(simulate(Bouncing(m=1, k=4), 3, {"q_spring": 0.1}))
    >>> bool(abs(flow.energy - 0.02).max() < 1e-9)
    True
    """
    from ..bondgraph.equations import state_equations
    from ..bondgraph.power import power_balance
    from ..core.codegen import build, generate
    from ..core.trace import parameter_symbol

    model = type(simulation.vehicle)
    if not issubclass(model, BondGraphModel):
        raise UcritError(f"{model.model_id()} is not stated by a bond graph: derive it from BondGraphModel")
    declared = model.declaration
    inputs = list(input_symbols(declared.inputs).values())
    found = state_equations(graph_of(model, None), tuple(inputs))
    power = power_balance(found)
    if power.energy is None:
        raise UcritError(f"{model.model_id()}: the energy of a store is unknown, its law cannot be integrated")
    parameters = [parameter_symbol(p, None) for p in declared.parameters.values()]
    wanted = [*power.bonds, power.energy, power.supplied, power.dissipated]
    function = build(generate("powers", [list(found.symbols), inputs, parameters], wanted), "powers")
    order = [simulation.states.index(name) for name in found.states]
    values = function(simulation.values.T[order], simulation.input_values.T, simulation.vehicle.arguments())
    table = np.array([np.broadcast_to(v, simulation.times.shape) for v in values], dtype=np.float64)
    return PowerFlow(simulation.vehicle, simulation.times, table[:-3].T, *table[-3:])
