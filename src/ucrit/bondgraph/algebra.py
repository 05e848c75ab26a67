"""Assignments put into each other: in order where there is one, solved where they form a loop."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import networkx as nx
import sympy as sp
from sympy.solvers.solveset import NonlinearError

from ..core.errors import ModelError
from .assignments import Assignments, number_of
from .graph import Graph
from .laws import solve_linear


@dataclass(frozen=True)
class Loop:
    """An algebraic loop: bonds whose variables depend on each other at every instant, and how it was solved."""

    bonds: tuple[int, ...]
    elements: tuple[str, ...]
    unknowns: tuple[str, ...]
    linear: bool

    def __str__(self) -> str:
        how = "linear, solved" if self.linear else "solved"
        return (
            f"algebraic loop through bonds {', '.join(map(str, self.bonds))} ({', '.join(self.elements)}); "
            f"{how} for {', '.join(self.unknowns)}"
        )


BREAK = "a spring or an inertia between them, however small, breaks it"


def put_together(work: Assignments) -> tuple[dict[Any, Any], list[Loop]]:
    """Return every effort and flow as an expression in states, store outputs, inputs and parameters.

    Variables that depend on each other are solved for together: linear equations always, a single equation that
    is not linear where it has one solution.

    Raises
    ------
    ModelError
        If a loop cannot be solved; its elements and bonds are named.
    """
    reads = nx.DiGraph()
    reads.add_nodes_from(work.of)
    reads.add_edges_from((used, symbol) for symbol, x in work.of.items() for used in x.free_symbols if used in work.of)
    values: dict[Any, Any] = {}
    loops = []
    order = nx.condensation(reads)
    for component in nx.lexicographical_topological_sort(order):
        members = sorted(order.nodes[component]["members"], key=lambda s: (number_of(s), s.name))
        equations = {symbol: work.of[symbol].xreplace(values) for symbol in members}
        if len(members) == 1 and not reads.has_edge(members[0], members[0]):
            values |= equations
        else:
            solved, loop = _solve_loop(work.graph, reads.subgraph(members), equations)
            values |= solved
            loops.append(loop)
    return values, loops


def _solve_loop(graph: Graph, reads: Any, equations: dict[Any, Any]) -> tuple[dict[Any, Any], Loop]:
    cut = _cut(graph, reads)
    chain: dict[Any, Any] = {}
    for symbol in nx.lexicographical_topological_sort(nx.subgraph(reads, set(equations) - set(cut)), key=str):
        chain[symbol] = equations[symbol].xreplace(chain)
    residuals = [equations[y].xreplace(chain) - y for y in cut]
    bonds = tuple(sorted({number_of(s) for s in equations}))
    inside = [e for e in graph.elements if _is_inside(graph, e.name, bonds)]
    names = tuple(str(e) for e in inside if e.kind not in ("0", "1")) or tuple(str(e) for e in inside)
    found, linear = _solution(residuals, cut)
    if found is None:
        why = "its equations contradict each other" if linear else "its laws are not linear; " + BREAK
        raise ModelError(
            f"algebraic loop through bonds {', '.join(map(str, bonds))} ({', '.join(names)}) cannot be solved: {why}"
        )
    solved = dict(zip(cut, found, strict=True))
    values = {symbol: x.xreplace(solved) for symbol, x in chain.items()} | solved
    unknowns = tuple(_told(symbol) for symbol in cut)
    return values, Loop(bonds, names, unknowns, linear)


def _told(symbol: Any) -> str:
    return f"the {'effort' if symbol.name[0] == 'e' else 'flow'} of bond {number_of(symbol)}"


def _is_inside(graph: Graph, name: str, bonds: Iterable[int]) -> bool:
    own = {b.number for b in graph.bonds_at[name]}
    return len(own & set(bonds)) == len(own) if len(own) == 1 else len(own & set(bonds)) > 1


def _cut(graph: Graph, reads: Any) -> list[Any]:
    """Return variables without which the others can be computed one after the other, those of resistances first."""
    resistances = {b.number for e in graph.elements if e.kind == "R" for b in graph.bonds_at[e.name]}
    left = nx.DiGraph(reads)
    cut: list[Any] = []
    while True:
        cyclic = [c for c in nx.strongly_connected_components(left) if len(c) > 1 or left.has_edge(*(2 * list(c)))]
        if not cyclic:
            return cut
        members = [s for c in cyclic for s in c]
        chosen = min(members, key=lambda s: (number_of(s) not in resistances, -left.degree(s), str(s)))
        cut.append(chosen)
        left.remove_node(chosen)


def _solution(residuals: list[Any], unknowns: list[Any]) -> tuple[list[Any] | None, bool]:
    try:
        A, b = sp.linear_eq_to_matrix([sp.expand(r) for r in residuals], unknowns)
    except NonlinearError:
        if len(unknowns) > 1:
            return None, False
        try:
            found = sp.solve(residuals[0], unknowns[0])
        except NotImplementedError:
            return None, False
        return (found if len(found) == 1 else None), False
    return solve_linear(A, b), True
