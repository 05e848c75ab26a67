"""Power and energy in a bond graph: what junctions pass on, what stores keep, what sources give."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import sympy as sp

from .elements import JUNCTIONS, SOURCES, STORES, TWO_PORTS
from .equations import StateEquations
from .laws import is_zero


@dataclass(frozen=True)
class PowerBalance:
    """Power in a graph, as expressions in its states, inputs and parameters.

    Attributes
    ----------
    bonds
        Power along each bond, positive from tail to head.
    supplied, dissipated
        What all sources give, and what all resistances take.
    energy
        What all stores hold; ``None`` where a law cannot be integrated or reads other elements.
    unbalanced
        Names of junctions, transformers and gyrators that power does not merely pass through.
    conserved
        Whether the energy's rate is what is supplied less what is dissipated; ``None`` without an energy.
    """

    bonds: tuple[Any, ...]
    supplied: Any
    dissipated: Any
    energy: Any
    unbalanced: tuple[str, ...]
    conserved: bool | None


@lru_cache(maxsize=64)
def power_balance(found: StateEquations) -> PowerBalance:
    """Return the powers and the energy of a graph, and tell whether they balance.

    The energy is integrated from the laws of the stores, those in derivative causality included, and its rate is
    taken along the state equations: nothing of this was used to derive them.

    Examples
    --------
    >>> from ucrit.bondgraph import C, Graph, I, one
    >>> from ucrit.bondgraph.equations import state_equations
    >>> graph = Graph(one("x"), I("mass", 2), C("spring", 3), "x -> mass", "x -> spring")
    >>> found = power_balance(state_equations(graph))
    >>> found.energy, found.conserved
    (p_mass**2/4 + q_spring**2/6, True)
    """
    graph = found.graph
    bonds = tuple(e * f for e, f in zip(found.efforts, found.flows, strict=True))

    def into(name: str) -> Any:
        return sp.Add(*(bonds[b.number - 1] * (1 if b.head == name else -1) for b in graph.bonds_at[name]))

    passing = [e.name for e in graph.elements if e.kind in (*JUNCTIONS, *TWO_PORTS)]
    supplied = sp.Add(*(-into(e.name) for e in graph.elements if e.kind in SOURCES))
    dissipated = sp.Add(*(into(e.name) for e in graph.elements if e.kind == "R"))
    energy = _energy(found)
    conserved = None
    if energy is not None:
        rate = sp.Add(*(sp.diff(energy, s) * r for s, r in zip(found.symbols, found.rates, strict=True)))
        conserved = is_zero(rate - supplied + dissipated)
    unbalanced = tuple(name for name in passing if not is_zero(into(name)))
    return PowerBalance(bonds, supplied, dissipated, energy, unbalanced, conserved)


def _energy(found: StateEquations) -> Any:
    total = sp.S.Zero
    for element in found.graph.elements:
        if element.kind not in STORES:
            continue
        part = _stored(found, element)
        if part is None:
            return None
        total += part
    return total


def _stored(found: StateEquations, element: Any) -> Any:
    """Return the energy of one store: half of state times output of a linear law, the integral of any other."""
    law, bonds = element.law, found.graph.bonds_at[element.name]
    if law.reads:
        return None
    co = [(found.flows if element.kind == "I" else found.efforts)[b.number - 1] for b in bonds]
    matrix = law.coefficients
    gives_state = law.gives in ("momentum", "displacement")
    if matrix is not None:
        if not gives_state:
            matrix = matrix.inv()
        if matrix != matrix.T:
            return None
        vector = sp.Matrix(co)
        return sp.expand((vector.T * matrix * vector)[0] / 2) if len(co) == 1 else (vector.T * matrix * vector)[0] / 2
    if law.ports > 1:
        return None
    own = [s for s in found.stores if s.element == element]
    taken = law.taken[0]
    area = sp.integrate(law.expressions[0], (taken, 0, taken))
    if area.has(sp.Integral):
        return None
    if gives_state:  # momentum given by flow: the area is the co-energy
        state = law.expressions[0].xreplace({taken: co[0]})
        return co[0] * state - area.xreplace({taken: co[0]})
    if not own[0].integral:
        return None
    return area.xreplace({taken: own[0].state})
