"""Causality turned into assignments: the effort of each bond is set at one end, its flow at the other."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import sympy as sp

from .causality import Causality
from .elements import JUNCTIONS, SOURCES, STORES, TWO_PORTS, Element
from .graph import Bond, Graph
from .laws import split


@dataclass(frozen=True)
class Store:
    """One port of a store, and the symbols that belong to it.

    ``state`` is its momentum or displacement. ``output`` is what it gives in integral causality: a flow of an
    inertia, an effort of a spring; it stands for ``law`` of the states. In derivative causality ``output`` is the
    rate of the state, which is ``law`` of what it is given.
    """

    element: Element
    port: int
    bond: Bond
    integral: bool
    state: Any
    output: Any
    law: Any

    @property
    def given(self) -> Any:
        """Symbol of what the bond gives to an integrated state's rate."""
        return effort(self.bond) if self.element.kind == "I" else flow(self.bond)

    @property
    def name(self) -> str:
        """Name of the state: ``p_mass``, ``q_spring``, with the number of the port in fields."""
        return f"{'p' if self.element.kind == 'I' else 'q'}_{self.element.name}" + self.suffix

    @property
    def suffix(self) -> str:
        """Number of the port in fields."""
        return "" if self.element.law is None or self.element.law.ports == 1 else f"_{self.port}"


@dataclass(frozen=True)
class Total:
    """A junction's common variable added up over time, because some law reads it."""

    element: Element
    state: Any
    rate: Any

    @property
    def name(self) -> str:
        """Name of the state."""
        return f"{'q' if self.element.kind == '1' else 'p'}_{self.element.name}"


@dataclass
class Assignments:
    """Assignments of all bonds, in symbols that are not yet replaced by each other."""

    causality: Causality
    stores: list[Store] = field(default_factory=list)
    totals: list[Total] = field(default_factory=list)
    of: dict[Any, Any] = field(default_factory=dict)

    @property
    def graph(self) -> Graph:
        """The graph."""
        return self.causality.graph


def effort(bond: Bond) -> Any:
    """Symbol of a bond's effort."""
    return sp.Symbol(f"e_{bond.number}.", real=True)


def flow(bond: Bond) -> Any:
    """Symbol of a bond's flow."""
    return sp.Symbol(f"f_{bond.number}.", real=True)


def number_of(symbol: Any) -> int:
    """Number of the bond that an effort or a flow belongs to."""
    return int(symbol.name[2:-1])


def assignments(found: Causality) -> Assignments:
    """Return what each end of each bond sets."""
    work = Assignments(found)
    for element in found.graph.elements:
        bonds = found.graph.bonds_at[element.name]
        inward = [found.effort_in(element.name, b) for b in bonds]
        if element.kind in JUNCTIONS:
            _junction(work, element, bonds, inward)
        elif element.kind in TWO_PORTS:
            _two_port(work, element, bonds, inward)
        elif element.kind in SOURCES:
            symbol = effort(bonds[0]) if element.kind == "Se" else flow(bonds[0])
            work.of[symbol] = element.law.expressions[0] if element.law else 0
        elif element.kind in STORES:
            _store(work, element, bonds, inward)
        else:
            _resistance(work, element, bonds, inward)
    _read(work)
    return work


def _junction(work: Assignments, element: Element, bonds: tuple[Bond, ...], inward: list[bool]) -> None:
    common, balanced = (effort, flow) if element.kind == "0" else (flow, effort)
    strong = bonds[inward.index(element.kind == "0")]
    sign = {b: 1 if b.head == element.name else -1 for b in bonds}
    others = [b for b in bonds if b != strong]
    for b in others:
        work.of[common(b)] = common(strong)
    work.of[balanced(strong)] = -sign[strong] * sp.Add(*(sign[b] * balanced(b) for b in others))


def _two_port(work: Assignments, element: Element, bonds: tuple[Bond, ...], inward: list[bool]) -> None:
    assert element.law is not None
    n = element.law.expressions[0]
    into = next(b for b in bonds if b.head == element.name)
    out = next(b for b in bonds if b.tail == element.name)
    effort_comes = inward[bonds.index(into)]
    if element.kind == "TF" and effort_comes:
        work.of |= {effort(out): effort(into) / n, flow(into): flow(out) / n}
    elif element.kind == "TF":
        work.of |= {effort(into): n * effort(out), flow(out): n * flow(into)}
    elif effort_comes:
        work.of |= {flow(out): effort(into) / n, flow(into): effort(out) / n}
    else:
        work.of |= {effort(into): n * flow(out), effort(out): n * flow(into)}


def _resistance(work: Assignments, element: Element, bonds: tuple[Bond, ...], inward: list[bool]) -> None:
    law = element.law
    assert law is not None
    variables = {"effort": [effort(b) for b in bonds], "flow": [flow(b) for b in bonds]}
    given = [effort_in == (law.gives == "effort") for effort_in in inward]
    found = law.solved(str(element), given, variables[law.takes], variables[law.gives])
    for known, takes, gives, x in zip(given, variables[law.takes], variables[law.gives], found, strict=True):
        work.of[takes if known else gives] = x


def _store(work: Assignments, element: Element, bonds: tuple[Bond, ...], inward: list[bool]) -> None:
    """Relate the states of an inertia's ports to their flows, of a spring's ports to their efforts."""
    law = element.law
    assert law is not None
    kind, ports = element.kind, len(bonds)
    integral = [effort_in == (kind == "I") for effort_in in inward]
    suffix = [""] if ports == 1 else [f"_{k}" for k in range(1, ports + 1)]
    letter = "p" if kind == "I" else "q"
    states = [sp.Symbol(f"{letter}_{element.name}{s}", real=True) for s in suffix]
    co = [flow(b) if kind == "I" else effort(b) for b in bonds]
    outputs = [
        sp.Symbol(f"{'f' if (kind == 'I') == whole else 'e'}_{element.name}{s}.out", real=True)
        for s, whole in zip(suffix, integral, strict=True)
    ]
    names = {"momentum": states, "displacement": states, "flow": co, "effort": co}
    gives_state = names[law.gives] is states
    given = [whole == gives_state for whole in integral]
    laws = law.solved(str(element), given, names[law.takes], names[law.gives])
    for k, bond in enumerate(bonds):
        store = Store(element, k + 1, bond, integral[k], states[k], outputs[k], laws[k])
        work.stores.append(store)
        # the other variable of the bond is set elsewhere; this end sets flow or effort
        work.of[flow(bond) if (kind == "I") == integral[k] else effort(bond)] = store.output


def _read(work: Assignments) -> None:
    """Replace readings of elements by the symbols of their bonds and states."""
    graph, swap = work.graph, {}
    stores = {(s.element.name, s.port): s for s in work.stores}
    for element in graph.elements:
        for symbol in element.law.reads if element.law else ():
            variable, name, port = split(symbol)
            source = graph.by_name[name]
            bond = graph.bonds_at[name][(port or 1) - 1]
            if variable in ("e", "f"):
                swap[symbol] = effort(bond) if variable == "e" else flow(bond)
            elif source.kind in JUNCTIONS:
                swap[symbol] = _total(work, source, bond).state
            else:
                store = stores[name, port or 1]
                swap[symbol] = store.state if store.integral else store.law
    work.of = {symbol: sp.sympify(x).xreplace(swap) for symbol, x in work.of.items()}
    work.stores = [Store(**{**vars(s), "law": sp.sympify(s.law).xreplace(swap)}) for s in work.stores]


def _total(work: Assignments, source: Element, bond: Bond) -> Total:
    for total in work.totals:
        if total.element == source:
            return total
    rate, letter = (flow(bond), "q") if source.kind == "1" else (effort(bond), "p")
    work.totals.append(Total(source, sp.Symbol(f"{letter}_{source.name}", real=True), rate))
    return work.totals[-1]
