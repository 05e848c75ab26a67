"""What a bond graph says: causality, findings, state equations and power balance."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ..bondgraph.causality import HEAD, Causality
from ..bondgraph.graph import Graph
from ..bondgraph.model import graph_of, input_symbols, states_bond_graph
from ..catalogue import BONDS, find_model, model_from_file, model_names
from ..core.errors import UcritError, near_match
from ..core.html import Rich
from ..core.model import Model

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
    model
        The model that states the graph, ``None`` for a bare graph.
    """

    name: str
    title: str
    causality: Causality
    rows: tuple[BondRow, ...]
    states: tuple[str, ...]
    equations: tuple[str, ...]
    findings: tuple[str, ...]
    balanced: bool
    model: type[Model] | None = field(default=None, repr=False)

    @property
    def graph(self) -> Graph:
        """The graph."""
        return self.causality.graph

    @property
    def text(self) -> str:
        """The graph as text that is read back to an equal one, with the declarations of its model.

        Raises `ModelError` where a law holds a function that the text form has no name for.
        """
        from ..bondgraph.writing import write_graph, write_sheet

        if self.model is None:
            return write_graph(self.graph) + "\n"
        declared = self.model.declaration
        return write_sheet(self.title, declared.parameters, declared.inputs, self.graph)

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
        model=model,
    )


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
