"""Bond graphs: a third way to state a vehicle, by the elements that store, spend and pass on power.

A graph is data: elements and numbered bonds. Its causality is assigned by the sequential procedure, its state
equations in momenta and displacements follow, and with them a `Model` like any other.
"""

from __future__ import annotations

from . import bodies, running_gear
from .causality import Causality, causality
from .elements import GY, MGY, MTF, TF, C, Element, I, MSe, MSf, R, Se, Sf, e, f, one, p, q, zero
from .graph import Bond, Graph
from .model import BondGraphModel, equations_bond_graph, graph_of

__all__ = [
    "GY",
    "MGY",
    "MTF",
    "TF",
    "Bond",
    "BondGraphModel",
    "C",
    "Causality",
    "Element",
    "Graph",
    "I",
    "MSe",
    "MSf",
    "R",
    "Se",
    "Sf",
    "bodies",
    "causality",
    "e",
    "equations_bond_graph",
    "f",
    "graph_of",
    "one",
    "p",
    "q",
    "running_gear",
    "zero",
]
