"""Units of efforts, flows and states, found from those of the parameters.

Effort times flow is power, so that the unit of one law's coefficient settles both: ``momentum = m*flow`` makes the
flow's square a power times a time over a mass. Junctions, transformers and gyrators pass units on.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..core.derivation.dimensions import NUMBER, dimension_of
from ..core.errors import ModelError
from ..core.units import Dimension
from .elements import JUNCTIONS, Element
from .graph import Bond, Graph
from .laws import split

POWER = Dimension(1, 2, -3)
TIME = Dimension(0, 0, 1)
NAMES = {
    Dimension(1, 1, -1): "N s",
    Dimension(1, 2, -1): "N m s",
    Dimension(0, 1, 0): "m",
    Dimension(0, 0, 0): "rad",
}


def state_units(graph: Graph, parameters: Mapping[Any, Dimension]) -> dict[str, str]:
    """Return the unit of what each element or junction adds up over time, by its name and port.

    Keys are ``p_mass`` for momenta and ``q_spring`` for displacements. States that no unit settles are left out.
    """
    work = _Units(graph, dict(parameters))
    while work.step():
        pass
    found: dict[str, str] = {}
    for element in graph.elements:
        for port, bond in enumerate(graph.bonds_at[element.name], 1):
            if bond.number not in work.flows:
                continue
            suffix = f"_{port}" if element.law and element.law.ports > 1 else ""
            flow = work.flows[bond.number]
            if any(exponent != round(exponent) for exponent in flow):
                continue
            found.setdefault(f"q_{element.name}{suffix}", _name(flow.times(TIME)))
            found.setdefault(f"p_{element.name}{suffix}", _name(POWER.times(flow, -1).times(TIME)))
    return found


def _name(dimension: Dimension) -> str:
    return NAMES.get(dimension, str(dimension))


class _Units:
    """Dimensions of the flows of bonds found so far; efforts follow from them."""

    def __init__(self, graph: Graph, known: dict[Any, Dimension]) -> None:
        self.graph = graph
        self.known = known
        self.flows: dict[int, Dimension] = {}
        self.by: dict[int, Element] = {}

    def step(self) -> bool:
        """Go through all elements once; tell whether anything was found."""
        before = len(self.flows)
        for element in self.graph.elements:
            bonds = self.graph.bonds_at[element.name]
            self._read(element)
            if element.kind in JUNCTIONS:
                settled = [self.flows[b.number] for b in bonds if b.number in self.flows]
                for b in bonds if settled else ():
                    self._put(b, settled[0], element)
            elif element.law is not None:
                self._element(element, bonds)
        return len(self.flows) > before

    def _put(self, bond: Bond, flow: Dimension, element: Element) -> None:
        known = self.flows.setdefault(bond.number, flow)
        first = self.by.setdefault(bond.number, element)
        if any(abs(a - b) > 1e-9 for a, b in zip(known, flow, strict=True)):
            raise ModelError(
                f"{element} and {first} give unlike units to the flow of bond {bond}: {flow} and {known}"
                + "".join(
                    f"; the law of {e} is a number without a unit, make it a parameter"
                    for e in (element, first)
                    if _is_bare(e)
                )
            )

    def _dimension(self, expression: Any, where: str) -> Dimension | None:
        """Return the dimension of an expression; ``None`` where it is zero or reads what is not known yet."""
        if any(symbol not in self.known for symbol in expression.free_symbols):
            return None
        return dimension_of(expression, self.known, where)

    def _read(self, element: Element) -> None:
        for symbol in element.law.reads if element.law else ():
            variable, name, port = split(symbol)
            bond = self.graph.bonds_at[name][(port or 1) - 1]
            if symbol not in self.known and bond.number in self.flows:
                self.known[symbol] = self._variable(variable, self.flows[bond.number])

    @staticmethod
    def _variable(variable: str, flow: Dimension) -> Dimension:
        effort = POWER.times(flow, -1)
        return {"f": flow, "e": effort, "q": flow.times(TIME), "p": effort.times(TIME)}[variable]

    def _element(self, element: Element, bonds: tuple[Bond, ...]) -> None:
        law, where = element.law, str(element)
        assert law is not None
        if element.kind in ("TF", "GY"):
            ratio = self._dimension(law.expressions[0], where)
            if ratio is not None:
                self._two_port(element, bonds, ratio)
        elif element.kind in ("Se", "Sf"):
            given = self._dimension(law.expressions[0], where)
            if given is not None:
                self._put(bonds[0], given if element.kind == "Sf" else POWER.times(given, -1), element)
        elif (matrix := law.coefficients) is not None:
            for k, bond in enumerate(bonds):
                coefficient = self._dimension(matrix[k, k], where)
                if coefficient is not None:
                    self._put(bond, _flow_of(element.kind, law.gives, coefficient), element)
        elif law.ports == 1 and bonds[0].number not in self.flows:
            self._other_law(element, bonds[0])

    def _two_port(self, element: Element, bonds: tuple[Bond, ...], ratio: Dimension) -> None:
        into = next(b for b in bonds if b.head == element.name)
        out = next(b for b in bonds if b.tail == element.name)
        for here, there, sign in ((into, out, 1), (out, into, -1)):
            if here.number in self.flows:
                flow = self.flows[here.number]
                # a gyrator's e_in = r f_out; either way round the efforts and flows of the ends are exchanged
                passed = flow.times(ratio, sign) if element.kind == "TF" else POWER.times(flow, -1).times(ratio, -1)
                self._put(there, passed, element)

    def _other_law(self, element: Element, bond: Bond) -> None:
        """Try the units of what the law takes until what it gives fits: lengths or angles."""
        law = element.law
        assert law is not None
        if any(s not in self.known for s in law.expressions[0].free_symbols if s not in law.taken):
            return
        fitting = []
        for flow in (Dimension(0, 1, -1), Dimension(0, 0, -1)):
            variables = {name: self._variable(name[0], flow) for name in ("effort", "flow")}
            variables |= {"momentum": self._variable("p", flow), "displacement": self._variable("q", flow)}
            known = {**self.known, law.taken[0]: variables[law.takes]}
            try:
                if dimension_of(law.expressions[0], known, "") == variables[law.gives]:
                    fitting.append(flow)
            except ModelError:
                continue
        if len(fitting) == 1:
            self._put(bond, fitting[0], element)


def _is_bare(element: Element) -> bool:
    law = element.law
    return (
        law is not None
        and element.kind in ("I", "C", "R")
        and not any(x.free_symbols - set(law.taken) for x in law.expressions)
    )


def _flow_of(kind: str, gives: str, coefficient: Dimension) -> Dimension:
    """Return the flow's unit that the coefficient of a linear law settles."""
    # I: f^2 = P t/m; C: e^2 = P t/c; R: f^2 = P/r; the inverse laws have the inverse coefficient
    natural = {"I": "momentum", "C": "displacement", "R": "effort"}[kind]
    number = coefficient if gives == natural else NUMBER.times(coefficient, -1)
    square = POWER.times(number, -1) if kind == "R" else POWER.times(TIME).times(number, -1)
    root = NUMBER.times(square, 0.5)
    return POWER.times(root, -1) if kind == "C" else root
