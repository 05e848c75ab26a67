"""Causality: which end of each bond sets its effort, found by the sequential causality assignment procedure.

Sources come first, then stores in integral causality, then resistances, then what is left; after each choice,
everything that it settles is settled. A causal stroke stands at the end that the effort acts on.

Source: D. Karnopp, D. Margolis and R. Rosenberg, System Dynamics (2000), section 5.2.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property, lru_cache

from ..core.errors import ModelError
from .elements import STORES, Element
from .graph import Bond, Graph

HEAD, TAIL = "head", "tail"


@dataclass(frozen=True)
class Step:
    """One choice: the element that made it, why, and the bonds that it settled, the first one by choice."""

    element: str
    reason: str
    bonds: tuple[int, ...]


@dataclass(frozen=True)
class Causality:
    """A graph with the causal stroke of every bond, and the choices that led to them."""

    graph: Graph
    strokes: tuple[str, ...]
    steps: tuple[Step, ...]

    def effort_in(self, element: str, bond: Bond) -> bool:
        """Tell whether the bond's effort acts on this element: its stroke is at this end."""
        return (self.strokes[bond.number - 1] == HEAD) == (bond.head == element)

    @cached_property
    def ports(self) -> tuple[tuple[Element, int, Bond, bool], ...]:
        """Ports of stores: element, number of the port, bond, and whether its causality is integral."""
        return tuple(
            (x, k, bond, self.effort_in(x.name, bond) == (x.kind == "I"))
            for x in self.graph.elements
            if x.kind in STORES
            for k, bond in enumerate(self.graph.bonds_at[x.name], 1)
        )

    @property
    def derivative(self) -> tuple[tuple[Element, Bond], ...]:
        """Stores in derivative causality, with their bonds."""
        return tuple((element, bond) for element, _, bond, integral in self.ports if not integral)

    @property
    def free(self) -> tuple[Step, ...]:
        """Choices that nothing demanded: each is a sign of an algebraic loop."""
        return tuple(step for step in self.steps if step.reason in (RESISTANCE, REST))

    def step_of(self, number: int) -> Step:
        """Return the choice that settled a bond."""
        return next(step for step in self.steps if number in step.bonds)


SOURCE, END, STORE, RESISTANCE, REST = "source", "end", "store", "resistance", "rest"


class _ConflictError(ModelError):
    pass


@dataclass
class _Work:
    graph: Graph
    strokes: dict[int, str] = field(default_factory=dict)
    roots: dict[int, str] = field(default_factory=dict)
    steps: list[Step] = field(default_factory=list)

    def choose(self, element: Element, bond: Bond, effort_in: bool, reason: str) -> None:
        """Settle a bond and all that follows; where that fails nothing is changed and `_ConflictError` raised."""
        kept = dict(self.strokes), dict(self.roots)
        before = list(self.strokes)
        try:
            self._set(bond, element.name, effort_in, element.name)
        except _ConflictError:
            self.strokes, self.roots = kept
            raise
        settled = tuple(n for n in self.strokes if n not in before)
        if settled:
            self.steps.append(Step(element.name, reason, settled))

    def _set(self, bond: Bond, name: str, effort_in: bool, root: str) -> None:
        queue = [(bond, name, effort_in)]
        while queue:
            bond, name, effort_in = queue.pop(0)
            stroke = HEAD if (bond.head == name) == effort_in else TAIL
            old = self.strokes.get(bond.number)
            if old is None:
                self.strokes[bond.number], self.roots[bond.number] = stroke, root
                queue += [(b, n, inward) for n in (bond.tail, bond.head) for b, inward in self._follows(n)]
            elif old != stroke:
                raise _ConflictError(self._clash(bond, {root, self.roots[bond.number], name}))

    def _follows(self, name: str) -> list[tuple[Bond, bool]]:
        """Return what an element's rule settles of its bonds, now that some are settled."""
        element, bonds = self.graph.by_name[name], self.graph.bonds_at[name]
        known = {b: (self.strokes[b.number] == HEAD) == (b.head == name) for b in bonds if b.number in self.strokes}
        open_ = [b for b in bonds if b not in known]
        if element.kind == "GY":
            return [(b, value) for b in open_ for value in known.values()] + _twice(bonds, known, same=True)
        if element.kind not in ("0", "1", "TF"):
            return []
        special = element.kind != "1"  # exactly one bond brings an effort in (0, TF), or a flow (1)
        marked = [b for b, value in known.items() if value == special]
        if len(marked) > 1 or (not open_ and not marked):
            raise _ConflictError(self._conflict(element, marked or list(bonds)))
        if marked:
            return [(b, not special) for b in open_]
        return [(open_[0], special)] if len(open_) == 1 else []

    def _conflict(self, element: Element, bonds: list[Bond]) -> str:
        takes = {"0": "one effort", "1": "one flow", "TF": "an effort at one end and a flow at the other"}[element.kind]
        roots = {self.roots[b.number] for b in bonds}
        return (
            f"causal conflict: {element} takes {takes}, and {self._told(roots)} deny it that at bonds {_numbers(bonds)}"
        )

    def _clash(self, bond: Bond, names: set[str]) -> str:
        return f"causal conflict: {self._told(names)} ask for opposite causalities of bond {bond}"

    def _told(self, names: set[str]) -> str:
        return " and ".join(str(e) for e in self.graph.elements if e.name in names)


def _twice(bonds: tuple[Bond, ...], known: dict[Bond, bool], same: bool) -> list[tuple[Bond, bool]]:
    """Return a gyrator's settled bonds as demands on each other, so that a contradiction is met."""
    values = [known.get(b) for b in bonds]
    if None in values or (values[0] == values[1]) == same:
        return []
    return [(bonds[1], bool(values[0]))]


def _numbers(bonds: list[Bond]) -> str:
    return ", ".join(str(b.number) for b in sorted(bonds, key=lambda b: b.number))


@lru_cache(maxsize=64)
def causality(graph: Graph) -> Causality:
    """Assign the causality of every bond.

    Parameters
    ----------
    graph
        The bond graph.

    Raises
    ------
    ModelError
        If the graph is incomplete, or sources contradict each other; the elements are named.

    Examples
    --------
    >>> from ucrit.bondgraph import C, Graph, I, one
    >>> found = causality(Graph(one("x"), I("mass", 2), C("spring", 3), "x -> mass", "x -> spring"))
    >>> found.strokes, found.derivative
    (('head', 'tail'), ())
    """
    graph.check()
    work = _Work(graph)
    for element in graph.elements:
        if element.kind in ("0", "1") and len(graph.bonds_at[element.name]) == 1:
            work.choose(element, graph.bonds_at[element.name][0], element.kind == "0", END)
    for element in graph.elements:
        if element.kind in ("Se", "Sf"):
            _demand(work, element)
    for kinds, reason in ((STORES, STORE), (("R",), RESISTANCE)):
        for element in sorted((x for x in graph.elements if x.kind in kinds), key=_patience):
            for bond in graph.bonds_at[element.name]:
                _prefer(work, element, bond, _wish(element), reason)
    for bond in graph.bonds:
        _prefer(work, graph.by_name[bond.tail], bond, False, REST)
    return Causality(graph, tuple(work.strokes[b.number] for b in graph.bonds), tuple(work.steps))


def _demand(work: _Work, element: Element) -> None:
    bond = work.graph.bonds_at[element.name][0]
    work.choose(element, bond, element.kind == "Sf", SOURCE)


def _prefer(work: _Work, element: Element, bond: Bond, effort_in: bool, reason: str) -> None:
    if bond.number in work.strokes:
        return
    try:
        work.choose(element, bond, effort_in, reason)
    except _ConflictError:
        work.choose(element, bond, not effort_in, reason)


def _patience(element: Element) -> int:
    """Tell whose turn it is: laws that are not linear can perhaps not be turned round, so that they have their way.

    A store's that gives momentum or displacement has it in derivative causality, hence comes last.
    """
    law = element.law
    if law is None or law.coefficients is not None:
        return 1
    return 2 if law.gives in ("momentum", "displacement") else 0


def _wish(element: Element) -> bool:
    """Tell whether the element would rather be given the effort: to integrate it, or because its law takes it."""
    if element.kind in STORES:
        return element.kind == "I"
    return element.law is not None and element.law.takes == "effort"
