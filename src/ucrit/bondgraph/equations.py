"""State equations of a bond graph: the rates of momenta and displacements, in symbols.

Stores in derivative causality have no state of their own. Their momentum follows from the states; its rate acts
back on them, which makes the equations implicit, and linear in the rates. They are solved here.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

import sympy as sp

from ..core.errors import ModelError
from .algebra import Loop, put_together
from .assignments import Assignments, Store, Total, assignments, effort, flow
from .causality import Causality, causality
from .elements import Element
from .graph import Bond, Graph
from .laws import solve_linear


@dataclass(frozen=True)
class Dependence:
    """A store in derivative causality, the elements that its state follows from, and the state in symbols."""

    element: Element
    bond: Bond
    on: tuple[str, ...]
    state: Any

    def __str__(self) -> str:
        what = "momentum" if self.element.kind == "I" else "displacement"
        on = f"follows from {' and '.join(self.on)}" if self.on else "does not change"
        return f"{self.element} (bond {self.bond.number}) is in derivative causality: its {what} {on}; solved"


@dataclass(frozen=True, eq=False)
class StateEquations:
    """What follows from a bond graph.

    Attributes
    ----------
    states
        Names of the states: ``p_mass`` of an inertia, ``q_spring`` of a spring, ``q_x`` of a 1-junction that a law
        reads the displacement of; with the number of the port in fields.
    rates
        Their rates, expressions in states, inputs and parameters.
    efforts, flows
        Of each bond, in the order of their numbers, likewise.
    dependences, loops
        Stores without a state of their own, and algebraic loops; both are solved.
    stores, totals
        What the states belong to.
    """

    causality: Causality
    states: tuple[str, ...]
    symbols: tuple[Any, ...]
    rates: tuple[Any, ...]
    efforts: tuple[Any, ...]
    flows: tuple[Any, ...]
    dependences: tuple[Dependence, ...]
    loops: tuple[Loop, ...]
    stores: tuple[Store, ...]
    totals: tuple[Total, ...]

    @property
    def graph(self) -> Graph:
        """The graph."""
        return self.causality.graph

    @cached_property
    def tidied(self) -> tuple[Any, ...]:
        """The rates as they are shown and used in models."""
        return tuple(tidy(rate) for rate in self.rates)

    @property
    def findings(self) -> tuple[str, ...]:
        """Derivative causality and algebraic loops, a sentence each."""
        return tuple(str(x) for x in (*self.dependences, *self.loops))

    def __str__(self) -> str:
        return "\n".join(f"{name}' = {rate}" for name, rate in zip(self.states, self.tidied, strict=True))


@lru_cache(maxsize=64)
def assembled(graph: Graph) -> tuple[Assignments, dict[Any, Any], list[Loop]]:
    """Return what each bond's ends set, every effort and flow in outputs of stores and sources, and the loops."""
    work = assignments(causality(graph))
    return work, *put_together(work)


@lru_cache(maxsize=64)
def state_equations(graph: Graph, inputs: tuple[Any, ...] = ()) -> StateEquations:
    """Derive the state equations of a bond graph.

    Parameters
    ----------
    graph
        The bond graph.
    inputs
        Symbols that change with time from outside; everything else is a parameter.

    Raises
    ------
    ModelError
        If the graph is incomplete, its causality contradictory, an algebraic loop cannot be solved, or a dependent
        store's momentum follows an input, whose rate would be needed.

    Examples
    --------
    >>> from ucrit.bondgraph import C, Graph, I, one
    >>> print(state_equations(Graph(one("x"), I("mass", 2), C("spring", 3), "x -> mass", "x -> spring")))
    p_mass' = -q_spring/3
    q_spring' = p_mass/2
    """
    work, raw, loops = assembled(graph)
    outputs = {s.output: s.law for s in work.stores if s.integral}
    # what a store gives may depend on signals, and with fields of mixed causality on bonds
    outputs = {o: settled(x, raw, outputs) for o, x in outputs.items()}
    values = {symbol: settled(x, raw, outputs) for symbol, x in raw.items()}
    wholes = [s for s in work.stores if s.integral]
    symbols = [s.state for s in wholes] + [t.state for t in work.totals]
    rates = [values[s.given] for s in wholes] + [values[t.rate] for t in work.totals]
    solved, dependences = _dependent(work, values, dict(zip(symbols, rates, strict=True)), inputs)
    final = {symbol: x.xreplace(solved) for symbol, x in values.items()}
    return StateEquations(
        work.causality,
        (*(s.name for s in wholes), *(t.name for t in work.totals)),
        tuple(symbols),
        tuple(rate.xreplace(solved) for rate in rates),
        tuple(final[effort(b)] for b in graph.bonds),
        tuple(final[flow(b)] for b in graph.bonds),
        dependences,
        tuple(loops),
        tuple(work.stores),
        tuple(work.totals),
    )


def settled(x: Any, raw: Mapping[Any, Any], outputs: Mapping[Any, Any]) -> Any:
    """Replace variables of bonds and outputs of stores until none is left."""
    swap = {**raw, **outputs}
    for _ in range(len(swap) + 1):
        used = x.free_symbols & swap.keys()
        if not used:
            return x
        x = x.xreplace({s: swap[s] for s in used})
    raise ModelError(f"bond graph: what a store gives depends on itself: {x}")


def _dependent(
    work: Assignments, values: Mapping[Any, Any], rates: Mapping[Any, Any], inputs: tuple[Any, ...]
) -> tuple[dict[Any, Any], tuple[Dependence, ...]]:
    """Solve for the rates of dependent stores, ``y' = sum (dy/ds) s'``, in which the rates s' hold y'."""
    stores = [s for s in work.stores if not s.integral]
    if not stores:
        return {}, ()
    unknowns = [s.output for s in stores]
    of_state = {s.state: s for s in work.stores}
    residuals, dependences = [], []
    for store in stores:
        y = store.law.xreplace({k: v for k, v in values.items() if k in store.law.free_symbols})
        told = f"{store.element} (bond {store.bond.number})"
        moved = [str(u) for u in inputs if y.has(u)]
        if moved:
            raise ModelError(
                f"{told} is in derivative causality and follows the input {moved[0]}, whose rate is not known; "
                "put a spring or a resistance between them"
            )
        if y.free_symbols & set(unknowns):
            raise ModelError(f"{told} is in derivative causality and depends on its own rate; its state is not settled")
        residuals.append(sp.Add(*(sp.diff(y, s) * rate for s, rate in rates.items())) - store.output)
        sources = [of_state[s].element for s in rates if y.has(s) and s in of_state]
        dependences.append(Dependence(store.element, store.bond, tuple(dict.fromkeys(map(str, sources))), y))
    A = sp.Matrix(len(unknowns), len(unknowns), lambda i, j: sp.diff(residuals[i], unknowns[j]))
    b = sp.Matrix([-r.xreplace(dict.fromkeys(unknowns, sp.S.Zero)) for r in residuals])
    found = None if A.free_symbols & set(unknowns) else solve_linear(A, b)
    if found is None:
        names = ", ".join(str(s.element) for s in stores)
        raise ModelError(f"{names}: in derivative causality, and the equations cannot be solved for their rates")
    return dict(zip(unknowns, found, strict=True)), tuple(dependences)


def tidy(x: Any) -> Any:
    """Return an expression with common factors of numerators and denominators cancelled where that is quick.

    Functions of more than a symbol are left as they are.
    """
    inner = [g for g in x.atoms(sp.Function) if not g.args[0].is_Symbol]
    names = {g: sp.Dummy(real=True) for g in sorted(inner, key=sp.count_ops, reverse=True)}
    short = x.xreplace(names)
    if short.is_Atom or short.count_ops() > 400:
        return x
    try:
        cancelled = sp.cancel(short)
    except (sp.PolynomialError, NotImplementedError):
        return x
    found = [short, cancelled, sp.factor_terms(cancelled)]
    if short.has(sp.sin) and short.has(sp.cos) and short.count_ops() < 150:
        found.append(sp.factor_terms(sp.trigsimp(cancelled)))
    back = {name: g for g, name in names.items()}
    return min((_restored(x, back) for x in found), key=lambda x: (x.count_ops(), len(str(x))))


def _restored(x: Any, back: Mapping[Any, Any]) -> Any:
    while x.free_symbols & back.keys():
        x = x.xreplace(dict(back))
    return x
