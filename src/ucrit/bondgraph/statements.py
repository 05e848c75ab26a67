"""What the elements of a graph state, put beside the state equations that were derived from it.

Every junction, transformer, law and source is read once more, directly and without its causality; the two sides of
each statement are equal along every motion, or the derivation is wrong.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import sympy as sp

from .elements import JUNCTIONS, SOURCES, STORES, TWO_PORTS, Element
from .equations import StateEquations
from .laws import split


def statements(found: StateEquations) -> Iterator[tuple[Element, Any, Any]]:
    """Yield each element with two expressions in states, inputs and parameters that it says are equal.

    Examples
    --------
    >>> from ucrit.bondgraph import C, Graph, I, one
    >>> from ucrit.bondgraph.equations import state_equations
    >>> graph = Graph(one("x"), I("mass", 2), C("spring", 3), "x -> mass", "x -> spring")
    >>> [(str(e), left, right) for e, left, right in statements(state_equations(graph))][2:]
    [("I 'mass'", p_mass, p_mass), ("C 'spring'", q_spring, q_spring)]
    """
    read = _readings(found)
    for element in found.graph.elements:
        bonds = found.graph.bonds_at[element.name]
        e = [found.efforts[b.number - 1] for b in bonds]
        f = [found.flows[b.number - 1] for b in bonds]
        if element.kind in JUNCTIONS:
            common, balanced = (e, f) if element.kind == "0" else (f, e)
            yield from ((element, common[0], other) for other in common[1:])
            yield (
                element,
                sp.Add(*(x for x, b in zip(balanced, bonds, strict=True) if b.head == element.name)),
                sp.Add(*(x for x, b in zip(balanced, bonds, strict=True) if b.tail == element.name)),
            )
            continue
        assert element.law is not None
        says = [x.xreplace(read) for x in element.law.expressions]
        if element.kind in SOURCES:
            yield element, (e if element.kind == "Se" else f)[0], says[0]
        elif element.kind in TWO_PORTS:
            i, o = (0, 1) if bonds[0].head == element.name else (1, 0)
            yield element, *((f[o], says[0] * f[i]) if element.kind == "TF" else (e[i], says[0] * f[o]))
            yield element, *((e[i], says[0] * e[o]) if element.kind == "TF" else (e[o], says[0] * f[i]))
        else:
            state = _states(found, element)
            values = {"effort": e, "flow": f, "momentum": state, "displacement": state}
            taken = dict(zip(element.law.taken, values[element.law.takes], strict=True))
            for given, says_it in zip(values[element.law.gives], says, strict=True):
                yield element, given, says_it.xreplace(taken)


def _states(found: StateEquations, element: Element) -> list[Any]:
    """Return momenta or displacements of a store's ports; of dependent ones, what they follow from."""
    if element.kind not in STORES:
        return []
    dependent = {d.bond.number: d.state for d in found.dependences}
    return [dependent.get(s.bond.number, s.state) for s in found.stores if s.element == element]


def _readings(found: StateEquations) -> dict[Any, Any]:
    read = {}
    totals = {t.element.name: t.state for t in found.totals}
    for element in found.graph.elements:
        for symbol in element.law.reads if element.law else ():
            variable, name, port = split(symbol)
            number = found.graph.bonds_at[name][(port or 1) - 1].number
            if variable in ("e", "f"):
                read[symbol] = (found.efforts if variable == "e" else found.flows)[number - 1]
            elif name in totals:
                read[symbol] = totals[name]
            else:
                read[symbol] = _states(found, found.graph.by_name[name])[(port or 1) - 1]
    return read
