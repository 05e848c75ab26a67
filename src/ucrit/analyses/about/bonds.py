"""What a bond graph says: causality, findings, state equations and power balance."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from ...bondgraph.algebra import Loop
from ...bondgraph.causality import HEAD, Causality
from ...bondgraph.equations import Dependence
from ...bondgraph.graph import Graph
from ...bondgraph.model import graph_of, input_symbols, states_bond_graph
from ...bondgraph.text import Sheet, declared_symbols, read_sheet
from ...catalogue import BONDS, find_model, load, model_names, vehicle_names
from ...core.contract.declare import Input, Parameter
from ...core.contract.files import read_text
from ...core.contract.model import Model
from ...core.errors import UcritError, near_match
from ...core.html import Rich

SCHEMA = 1
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
    dependences, loops
        Stores in derivative causality, and algebraic loops; both are solved.
    balanced
        Whether power passes junctions, transformers and gyrators unchanged, and the energy's rate is what goes in.
    parameters, inputs
        What the model or the text declares, by name.
    """

    name: str
    title: str
    causality: Causality
    rows: tuple[BondRow, ...]
    states: tuple[str, ...]
    equations: tuple[str, ...]
    dependences: tuple[Dependence, ...]
    loops: tuple[Loop, ...]
    balanced: bool
    parameters: Mapping[str, Parameter] = field(default_factory=dict, repr=False)
    inputs: Mapping[str, Input] = field(default_factory=dict, repr=False)

    @property
    def graph(self) -> Graph:
        """The graph."""
        return self.causality.graph

    @property
    def findings(self) -> tuple[str, ...]:
        """Derivative causality and algebraic loops, a sentence each."""
        return tuple(map(str, (*self.dependences, *self.loops)))

    def to_dict(self) -> dict[str, Any]:
        """Plain data, as ``ucrit bonds --json`` prints them; see docs/json.md."""
        return {
            "schema": SCHEMA,
            "name": self.name,
            "title": self.title,
            "elements": [{"kind": e.label, "name": e.name, "law": str(e.law or "")} for e in self.graph.elements],
            "bonds": [
                {
                    "number": row.number,
                    "from": row.tail,
                    "to": row.head,
                    "stroke_at": row.effort_on,
                    "settled_by": row.settled_by,
                    "reason": row.reason,
                }
                for row in self.rows
            ],
            "signals": [{"variable": s.variable, "from": s.source, "to": s.target} for s in self.graph.signals],
            "dependent": [
                {"element": d.element.name, "bond": d.bond.number, "on": list(d.on)} for d in self.dependences
            ],
            "loops": [
                {"bonds": list(loop.bonds), "elements": list(loop.elements), "linear": loop.linear}
                for loop in self.loops
            ],
            "findings": list(self.findings),
            "balanced": self.balanced,
            "states": [
                {"name": name, "rate": equation.partition(" = ")[2]}
                for name, equation in zip(self.states, self.equations, strict=True)
            ],
        }

    @property
    def text(self) -> str:
        """The graph as text that is read back to an equal one, with its declarations.

        Raises `ModelError` where a law holds a function that the text form has no name for.
        """
        from ...bondgraph.writing import write_sheet

        return write_sheet(self.title, self.parameters, self.inputs, self.graph)

    def __str__(self) -> str:
        lines = [f"{r.number}: {r.tail} -> {r.head}, effort on {r.effort_on}" for r in self.rows]
        return "\n".join([*lines, *self.findings, *self.equations])


def bonds(subject: Graph | type[Model] | Model | str | os.PathLike[str]) -> Bonds:
    """Analyse a bond graph: causality, algebraic loops, derivative causality, state equations, power balance.

    Parameters
    ----------
    subject
        A graph, a model or vehicle that states one, or the name of either; also a Python file with a model, a vehicle
        file, or a bond graph as text (a file ending in ``.bonds``).

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
    from ...bondgraph.equations import state_equations
    from ...bondgraph.power import power_balance

    graph, sheet = _graph(subject)
    found = state_equations(graph, tuple(input_symbols(sheet.inputs).values()))
    power = power_balance(found)
    return Bonds(
        name=sheet.where,
        title=sheet.title,
        causality=found.causality,
        rows=_rows(found.causality),
        states=found.states,
        equations=tuple(f"{s}' = {_told(r)}" for s, r in zip(found.states, found.tidied, strict=True)),
        dependences=found.dependences,
        loops=found.loops,
        balanced=not power.unbalanced and power.conserved is not False,
        parameters=sheet.parameters,
        inputs=sheet.inputs,
    )


def _told(rate: Any) -> str:
    from ...bondgraph.formulas import formula
    from ...core.formulas.typeset import text

    told = text(rate)
    return formula(rate) if "Piecewise" in told else told


def _graph(subject: Any) -> tuple[Graph, Sheet]:
    """Return a graph, and its name, title and declarations."""
    if isinstance(subject, Graph):
        return subject, Sheet("", "", {}, {}, ())
    if isinstance(subject, str | os.PathLike):
        name = os.fspath(subject)
        if name.endswith(BONDS):  # also one whose numbers carry no units, which is no model yet
            sheet = read_sheet(read_text(Path(name)), name)
            return sheet.graph(declared_symbols(sheet)), replace(sheet, where=Path(name).stem)
        subject = _named(name)
    model = type(subject) if isinstance(subject, Model) else subject
    declared = model.declaration
    return graph_of(model), Sheet(model.model_id(), model.title(), declared.parameters, declared.inputs, ())


def _named(name: str) -> type[Model]:
    if ".py" in name or name.replace("_", "-") in model_names():
        return find_model(name)
    if name.endswith(".toml") or name in vehicle_names():
        return type(load(name))
    raise UcritError(f"there is no model, vehicle or file '{name}'{near_match(name, (*stating(), *vehicle_names()))}")


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
