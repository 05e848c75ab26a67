"""A bond graph: elements, and numbered bonds between them along which power is counted from tail to head."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
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
        for _, fault in self.faults():
            raise ModelError(fault)

    def faults(self) -> Iterator[tuple[Element | Bond, str]]:
        """Find what is wrong with elements and bonds, a sentence each; what comes later may follow from the first."""
        for bond in self.bonds:
            for name in (bond.tail, bond.head):
                if name not in self.by_name:
                    yield bond, f"bond {bond}: there is no element '{name}'{near_match(name, self.by_name)}"
            if bond.tail == bond.head:
                yield bond, f"bond {bond}: it joins an element to itself"
        for element in self.elements:
            for fault in (*_reading_faults(self, element), *_bond_faults(element, self.bonds_at[element.name])):
                yield element, f"{element}{fault}"


def _chain(text: Any) -> list[tuple[str, str]]:
    names = [name.strip() for name in text.split(ARROW)] if isinstance(text, str) else []
    if len(names) < 2 or not all(name.isidentifier() for name in names):
        raise ModelError(f"bond graph: a part is an element, a graph or a bond such as 'a -> b', got {text!r}")
    return [(names[i], names[i + 1]) for i in range(len(names) - 1)]


def _bond_faults(element: Element, bonds: tuple[Bond, ...]) -> Iterator[str]:
    numbers = ", ".join(str(b.number) for b in bonds)
    if not bonds:
        yield ": no bond leads to it"
    elif element.kind in TWO_PORTS:
        heads = sum(b.head == element.name for b in bonds)
        if len(bonds) != 2 or heads != 1:
            yield f": one bond must lead to it and one away from it, it has bonds {numbers}"
        if element.law is not None and element.law.expressions[0].is_zero:
            yield ": its ratio is zero, so that it would pass on nothing; leave it out"
    elif element.kind not in JUNCTIONS:
        ports = element.law.ports if element.law else 1
        if len(bonds) != ports:
            yield f": its law has {ports} port{'s' * (ports > 1)}, it has bonds {numbers}"
        away = [b for b in bonds if b.tail == element.name]
        if away and element.kind not in SOURCES:
            yield f": bond {away[0]} must lead to it, so that power into it counts as positive"


READABLE = {"0": "e and p", "1": "f and q", "I": "e, f and p", "C": "e, f and q", "TF": "nothing", "GY": "nothing"}


def _reading_faults(graph: Graph, element: Element) -> Iterator[str]:
    for symbol in element.law.reads if element.law else ():
        variable, name, port = split(symbol)
        if name not in graph.by_name:
            yield f" reads {symbol}: there is no element '{name}'{near_match(name, graph.by_name)}"
            continue
        source = graph.by_name[name]
        readable = READABLE.get(source.kind, "e and f")
        ports = source.law.ports if source.law and source.kind not in TWO_PORTS else 1
        if variable not in readable.replace("and", "").replace(",", "").split():
            yield f" reads {symbol}: of {source}, {readable} can be read"
        elif (port is None) != (ports == 1) or (port is not None and port > ports) or port == 0:
            wanted = f"{variable}.{name}" + ("" if ports == 1 else f".1 to {variable}.{name}.{ports}")
            yield f" reads {symbol}: {source} has {ports} port{'s' * (ports > 1)}, write {wanted}"
