"""A bond graph: elements, and numbered bonds between them along which power is counted from tail to head."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from ..core.errors import ModelError, near_match
from .elements import JUNCTIONS, SOURCES, TWO_PORTS, Element, renamed
from .laws import split

ARROW = "->"


@dataclass(frozen=True)
class Bond:
    """A bond; power is positive when it goes from ``tail`` to ``head``."""

    number: int
    tail: str
    head: str

    def __str__(self) -> str:
        return f"{self.number}: {self.tail} {ARROW} {self.head}"


@dataclass(frozen=True)
class Signal:
    """An activated bond: ``target`` reads a variable of ``source`` and takes no power for it."""

    source: str
    target: str
    variable: str


@dataclass(frozen=True, init=False)
class Graph:
    """Elements and bonds in declared order.

    Parameters
    ----------
    parts
        Elements, other graphs, and bonds as text: ``"a -> b"``, or several as a chain ``"a -> b -> c"``. Bonds are
        numbered in the order in which they are met. A graph may be a fragment: bonds may lead to elements that
        come with other parts.

    Raises
    ------
    ModelError
        If two elements have one name, or a text is no bond.

    Examples
    --------
    >>> from ucrit.bondgraph import C, Graph, I, one
    >>> graph = Graph(one("x"), I("mass", 2), C("spring", 3), "x -> mass", "x -> spring")
    >>> print(graph.bonds[1])
    2: x -> spring
    """

    elements: tuple[Element, ...]
    bonds: tuple[Bond, ...]

    def __init__(self, *parts: Element | Graph | str) -> None:
        elements: list[Element] = []
        pairs: list[tuple[str, str]] = []
        for part in parts:
            if isinstance(part, Element):
                elements.append(part)
            elif isinstance(part, Graph):
                elements += part.elements
                pairs += [(bond.tail, bond.head) for bond in part.bonds]
            else:
                pairs += _chain(part)
        names = [element.name for element in elements]
        for element in elements:
            if names.count(element.name) > 1:
                raise ModelError(f"bond graph: two elements are called '{element.name}'")
        object.__setattr__(self, "elements", tuple(elements))
        object.__setattr__(self, "bonds", tuple(Bond(k, *pair) for k, pair in enumerate(pairs, 1)))

    @cached_property
    def by_name(self) -> Mapping[str, Element]:
        """Elements by their names."""
        return {element.name: element for element in self.elements}

    @cached_property
    def bonds_at(self) -> Mapping[str, tuple[Bond, ...]]:
        """Bonds of each element, in order: those of a field are its ports."""
        return {n: tuple(b for b in self.bonds if n in (b.tail, b.head)) for n in self.by_name}

    @cached_property
    def signals(self) -> tuple[Signal, ...]:
        """Activated bonds: what the laws of elements read."""
        found = []
        for element in self.elements:
            for symbol in element.law.reads if element.law else ():
                variable, source, _ = split(symbol)
                if source != element.name:
                    found.append(Signal(source, element.name, variable))
        return tuple(dict.fromkeys(found))

    def prefixed(self, prefix: str, keep: Iterable[str] = ()) -> Graph:
        """Return the graph with a prefix before the names of its elements, to use it once more.

        ``keep`` names elements of other parts, or of this one, that keep their names.
        """
        kept = set(keep)
        own = {name: prefix + name for name in self.by_name if name not in kept}
        elements = [renamed(element, own) for element in self.elements]
        bonds = [f"{own.get(b.tail, b.tail)} {ARROW} {own.get(b.head, b.head)}" for b in self.bonds]
        return Graph(*elements, *bonds)

    def check(self) -> None:
        """Raise `ModelError` for bonds that lead nowhere, wrong numbers of bonds and wrong directions."""
        if not self.elements:
            raise ModelError("bond graph: there is no element")
        for bond in self.bonds:
            for name in (bond.tail, bond.head):
                if name not in self.by_name:
                    raise ModelError(f"bond {bond}: there is no element '{name}'{near_match(name, self.by_name)}")
            if bond.tail == bond.head:
                raise ModelError(f"bond {bond}: it joins an element to itself")
        for element in self.elements:
            _check_bonds(element, self.bonds_at[element.name])
            _check_readings(self, element)


def _chain(text: Any) -> list[tuple[str, str]]:
    names = [name.strip() for name in text.split(ARROW)] if isinstance(text, str) else []
    if len(names) < 2 or not all(name.isidentifier() for name in names):
        raise ModelError(f"bond graph: a part is an element, a graph or a bond such as 'a -> b', got {text!r}")
    return [(names[i], names[i + 1]) for i in range(len(names) - 1)]


def _check_bonds(element: Element, bonds: tuple[Bond, ...]) -> None:
    numbers = ", ".join(str(b.number) for b in bonds)
    if not bonds:
        raise ModelError(f"{element}: no bond leads to it")
    if element.kind in TWO_PORTS:
        heads = sum(b.head == element.name for b in bonds)
        if len(bonds) != 2 or heads != 1:
            raise ModelError(f"{element}: one bond must lead to it and one away from it, it has the bonds {numbers}")
    elif element.kind not in JUNCTIONS:
        ports = element.law.ports if element.law else 1
        if len(bonds) != ports:
            raise ModelError(f"{element}: its law has {ports} ports, it has the bonds {numbers}")
        away = [b for b in bonds if b.tail == element.name]
        if away and element.kind not in SOURCES:
            raise ModelError(f"{element}: bond {away[0]} must lead to it, so that power into it counts as positive")


def _check_readings(graph: Graph, element: Element) -> None:
    for symbol in element.law.reads if element.law else ():
        variable, name, port = split(symbol)
        if name not in graph.by_name:
            raise ModelError(f"{element} reads {symbol}: there is no element '{name}'{near_match(name, graph.by_name)}")
        source = graph.by_name[name]
        kind, ports = source.kind, source.law.ports if source.law and source.kind not in TWO_PORTS else 1
        junction = {"e": "0", "p": "0", "f": "1", "q": "1"}[variable]
        store = {"p": "I", "q": "C"}.get(variable)
        one_port = kind not in (*JUNCTIONS, *TWO_PORTS) and store in (None, kind)
        if not (one_port or kind == junction):
            has = {"0": "e and p", "1": "f and q", "I": "e, f and p", "C": "e, f and q"}.get(kind, "e and f")
            has = "nothing" if kind in TWO_PORTS else has
            raise ModelError(f"{element} reads {symbol}: of {source}, {has} can be read")
        if (port is None) != (ports == 1) or (port is not None and not 1 <= port <= ports):
            wanted = f"{variable}.{name}" if ports == 1 else f"one of {variable}.{name}.1 to {variable}.{name}.{ports}"
            raise ModelError(f"{element} reads {symbol}: {source} has {ports} ports, write {wanted}")
