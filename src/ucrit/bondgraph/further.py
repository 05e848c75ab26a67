"""A bond graph as a further derivation of a model that is stated in velocities and positions.

Momenta and displacements are put as functions of the model's own variables, ``p = m*V``; what the graph says about
their rates is then an equation of motion in these variables.
"""

from __future__ import annotations

from typing import Any

import sympy as sp

from ..core.contract.methods import Names
from ..core.errors import ModelError
from .algebra import put_together
from .assignments import Store, assignments, effort, flow
from .causality import causality
from .equations import settled
from .graph import Graph
from .laws import is_zero


def further_equations(where: str, graph: Graph, x: Names, dx: Names, ddx: Names) -> list[Any]:
    """Return the equations of motion of a graph in a model's variables; see `equations_bond_graph`."""
    return _Bridge(where, graph, x, dx, ddx).residuals()


def graph_states(where: str, graph: Graph, x: Names, dx: Names, ddx: Names) -> dict[Any, Any]:
    """Return the momenta and displacements of a graph as functions of a model's variables, by their symbols."""
    return _Bridge(where, graph, x, dx, ddx).states()


class _Bridge:
    """Relates the states of a graph to the variables of a model."""

    def __init__(self, where: str, graph: Graph, x: Names, dx: Names, ddx: Names) -> None:
        self.where, self.graph = where, graph
        self.found = assignments(causality(graph))
        self.x, self.dx, self.ddx = (_values(group) for group in (x, dx, ddx))
        self.known: dict[Any, Any] = {}
        self.constraints: list[Any] = []
        self.shared = self._share()
        self.raw, _ = put_together(self.found)
        self.wholes = [s for s in self.found.stores if s.integral]

    def _share(self) -> list[Any]:
        """Put the model's variables for what the junctions named like them have in common.

        Returns what is zero because the graph says otherwise what it is.
        """
        equations = []
        for element in self.graph.elements:
            if element.kind in ("0", "1") and element.name in self.x:
                common = flow if element.kind == "1" else effort
                value = (self.dx if element.name in self.ddx else self.x)[element.name]
                for bond in self.graph.bonds_at[element.name]:
                    if self.found.causality.effort_in(element.name, bond) == (element.kind == "0"):
                        equations.append(self.found.of[common(bond)] - value)
                        self.found.of[common(bond)] = sp.sympify(value)
        return equations

    def residuals(self) -> list[Any]:
        """Return the equations that are left when those that only say what is known are dropped."""
        self.states()
        given = [self._put(s.given) for s in self.wholes]
        equations = [self._rate(self._state(s)) - g for s, g in zip(self.wholes, given, strict=True)]
        dependent = {s.output: self._rate(self._put(s.law)) for s in self.found.stores if not s.integral}
        equations = [eq.xreplace(dependent) for eq in equations]
        equations += [eq.xreplace(dependent) for eq in self.constraints]
        left = [eq for eq in equations if not is_zero(eq)]
        if len(left) != len(self.x):
            raise ModelError(
                f"{self.where}: the bond graph gives {len(left)} equations for {len(self.x)} variables; junctions and "
                "stores must be named like the model's variables"
            )
        return left

    def states(self) -> dict[Any, Any]:
        """Return the graph's momenta and displacements as functions of the model's variables."""
        self._match_states()
        self._match_flows()
        self._displacements()
        self.known |= {s.state: self._state(s) for s in self.wholes}
        return {state: self.known[state] for state in (*(s.state for s in self.wholes), *self._totals())}

    def _totals(self) -> list[Any]:
        return [total.state for total in self.found.totals]

    def _match_states(self) -> None:
        """Stores and junctions named like the model's variables: what is known of totals, springs and inertias."""
        for total in self.found.totals:
            name = total.element.name
            if name not in self.dx or name not in self.ddx:
                raise ModelError(f"{self.where}: the bond graph reads {total.name}, and '{name}' is no coordinate")
            self.known[total.state] = self.x[name]
        for s in self.wholes:
            name = s.element.name + s.suffix
            if name in self.x and name not in self.ddx:
                self.known[s.state] = self.x[name]
                self.known[s.output] = s.law.xreplace(self.known)

    def _match_flows(self) -> None:
        """Solve for the outputs of stores: junctions named like the model's variables have these as flow or effort."""
        unknown = [s.output for s in self.wholes if s.output not in self.known]
        for equation in self.shared:
            rest = sp.expand(self._put(equation))
            pivot = next((o for o in unknown if o not in self.known and rest.has(o)), None)
            if pivot is not None:
                slope = sp.diff(rest, pivot)
                if slope.has(pivot):
                    raise ModelError(f"{self.where}: {self._owners([pivot])[0]} is not a linear part of the flows")
                solved = {pivot: sp.factor_terms(-rest.xreplace({pivot: sp.S.Zero}) / slope)}
                self.known = {k: sp.sympify(x).xreplace(solved) for k, x in self.known.items()} | solved
            elif not is_zero(rest):
                self.constraints.append(rest)
        open_ = [o for o in unknown if o not in self.known and self._is_inertia(o)]
        if open_:
            raise ModelError(
                f"{self.where}: no junction of the bond graph that is named like a variable of the model settles "
                f"the flow of {', '.join(self._owners(open_))}"
            )

    def _is_inertia(self, output: Any) -> bool:
        return any(s.output == output and s.element.kind == "I" for s in self.wholes)

    def _owners(self, outputs: list[Any]) -> list[str]:
        return [str(s.element) for s in self.wholes if s.output in outputs]

    def _displacements(self) -> None:
        """Displacements of springs between the model's coordinates, their flows added up over time."""
        for s in self.wholes:
            if s.state in self.known or s.output in self.known:
                continue
            shared = [n for n in (s.bond.tail, s.bond.head) if n in self.ddx and self.graph.by_name[n].kind == "1"]
            rate = self.dx[shared[0]] if shared and s.element.kind == "C" else sp.expand(self._put(s.given))
            parts = {name: sp.diff(rate, self.dx[name]) for name in self.ddx}
            rest = rate - sp.Add(*(c * self.dx[name] for name, c in parts.items()))
            moving = {*self.x.values(), *self.dx.values()}
            if sp.expand(rest) != 0 or any(c.free_symbols & moving for c in parts.values()):
                raise ModelError(
                    f"{self.where}: the displacement of {s.element} is no sum of the model's coordinates; "
                    "name it like a state of the model"
                )
            self.known[s.state] = sp.Add(*(c * self.x[name] for name, c in parts.items()))
            self.known[s.output] = s.law.xreplace(self.known)

    def _put(self, symbol: Any) -> Any:
        """Return a variable of the graph in variables of the model, as far as they are known."""
        return settled(settled(symbol, self.raw, {}), {}, self.known)

    def _state(self, store: Store) -> Any:
        """Return momentum or displacement of a store as a function of the model's variables."""
        if store.state in self.known:
            return self.known[store.state]
        law = store.element.law
        assert law is not None
        bonds = self.graph.bonds_at[store.element.name]
        taken = [self._put(flow(b) if store.element.kind == "I" else effort(b)) for b in bonds]
        states = [s.state for s in self.found.stores if s.element == store.element]
        if law.gives in ("momentum", "displacement"):
            return law.solved(str(store.element), [False] * law.ports, taken, states)[store.port - 1]
        outputs = [sp.Dummy() for _ in bonds]
        found = law.solved(str(store.element), [True] * law.ports, states, outputs)
        return found[store.port - 1].xreplace(dict(zip(outputs, taken, strict=True)))

    def _rate(self, expression: Any) -> Any:
        """Differentiate along the motion."""
        steps = [(self.x[n], self.dx[n]) for n in self.x if n in self.dx]
        steps += [(self.dx[n], self.ddx[n]) for n in self.ddx]
        return sp.Add(*(sp.diff(expression, low) * high for low, high in steps))


def _values(group: Names) -> dict[str, Any]:
    return {name: value for name, value in vars(group).items() if name != "_group"}
