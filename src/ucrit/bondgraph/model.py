"""Models whose motion a bond graph states, and bond graphs as a further derivation of other models."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from ..core.contract.collect import declared
from ..core.contract.declare import Variable
from ..core.contract.methods import Names, call, check_methods, is_current
from ..core.contract.model import Model
from ..core.errors import ModelError
from ..core.made import made
from .graph import Graph


class BondGraphModel(Model):
    """Base of models stated by a bond graph: a method ``bond_graph(self, u)`` returns it, ``u`` only if wanted.

    The states need no declaration: they are the momenta ``p_...`` of inertias and the displacements ``q_...`` of
    springs in integral causality, and their units follow. One that is declared all the same, by `ucrit.state`,
    keeps its meaning and unit.

    Examples
    --------
    >>> from ucrit import param
    >>> from ucrit.bondgraph import C, Graph, I, one
    >>> class Bouncing(BondGraphModel):
    ...     '''Mass on a spring.'''
    ...
    ...     m: float = param("kg", "mass", above=0)
    ...     k: float = param("N/m", "stiffness", above=0)
    ...
    ...     def bond_graph(self):
    ...         return Graph(one("x"), I("mass", self.m), C("spring", 1 / self.k), "x -> mass", "x -> spring")
    >>> [(v.name, v.unit) for v in Bouncing.declaration.variables.values()]
    [('p_mass', 'N s'), ('q_spring', 'm')]
    """

    def __init_subclass__(cls, **options: Any) -> None:
        for base in cls.__mro__[1:]:
            for name, value in vars(base).items():
                if isinstance(value, Variable) and value.meaning.startswith(DERIVED) and name not in vars(cls):
                    setattr(cls, name, None)
        check_methods(cls)
        if hasattr(cls, "bond_graph") and cls.__name__ != "_FromText":
            _declare_states(cls)
        super().__init_subclass__(**options)

    def equations(self, x: Any, dx: Any, u: Any) -> Any:
        """Return the rates of the states less what the graph says they are."""
        from .equations import state_equations

        found = state_equations(_graph(self, {"u": u}), _inputs(u))
        if not found.states:
            raise ModelError(f"{type(self).model_id()}: no store of its bond graph has a state, so that nothing moves")
        swap = {s: getattr(x, name) for s, name in zip(found.symbols, found.states, strict=True)}
        of = dict(zip(found.states, found.tidied, strict=True))
        return [getattr(dx, name) - of[name].xreplace(swap) for name in type(self).declaration.variables]


def equations_bond_graph(self: Any, x: Any, dx: Any, ddx: Any, u: Any) -> list[Any]:
    """Return the equations of motion that follow from ``bond_graph(self, u)``, in a model's own variables.

    To be put into a model's class: ``equations_bond_graph = equations_bond_graph``, a further derivation beside the
    first. The graph names what it shares with the model. A 1-junction named like a coordinate has its rate as flow;
    named like a state, the state. A 0-junction named like a state has it as effort; a spring or an inertia named
    like one as displacement or momentum.

    Raises
    ------
    ModelError
        If the graph is wrong, or its states cannot be put as functions of the model's variables.
    """
    from .further import further_equations

    return further_equations(type(self).model_id(), _graph(self, {"u": u}), x, dx, ddx)


def model_from_text(text: str, name: str = "BondGraph", where: str = "bond graph") -> type[BondGraphModel]:
    """Return the model that a bond graph's text describes; see `ucrit.bondgraph.text`.

    Parameters
    ----------
    text
        Declarations, elements and bonds, one a line.
    name
        Name for the class.
    where
        What to call the text in messages.

    Raises
    ------
    ModelError
        Naming the line or the elements that are wrong.

    Examples
    --------
    >>> text = "param m [kg] above 0: mass\\nparam c [N s/m]: drag\\n1 x\\nI m = m\\nR c = c\\nx -> m\\nx -> c"
    >>> model = model_from_text(text)
    >>> list(model.declaration.variables)
    ['p_m']
    """
    from .text import declared_symbols, read_sheet

    sheet = read_sheet(text, where)
    sheet.graph(declared_symbols(sheet))
    return made(_stated_by, text.strip("\n") + "\n", name)  # type: ignore[no-any-return]


def _stated_by(text: str, name: str) -> type[BondGraphModel]:
    """Return the model of a text that has been found right."""
    from .text import read_sheet

    sheet = read_sheet(text, name)
    stem = re.sub(r"\W", "_", name)
    about = {"__doc__": sheet.title or name, "text": text, "called": name, "__module__": __name__}
    cls = stem if stem.isidentifier() else f"_{stem}"
    return type(cls, (_FromText,), {**about, **sheet.parameters, **sheet.inputs})


class _FromText(BondGraphModel):
    """Model of a text: what it declares, and the graph read again whenever it is traced."""

    text = ""
    called = ""

    @classmethod
    def model_id(cls) -> str:
        """Name of the model: the file's."""
        return cls.called or cls.__name__

    @classmethod
    def ingredients(cls) -> dict[str, Any]:
        """Return the name and the text, which a vehicle file can hold."""
        return {**super().ingredients(), "graph": cls.text}

    def bond_graph(self, u: Any) -> Graph:
        """Return the graph of the text."""
        from .text import read_sheet

        sheet = read_sheet(self.text, self.called)
        names = {name: getattr(self, name) for name in sheet.parameters}
        return sheet.graph(names | {name: getattr(u, name) for name in sheet.inputs})


DERIVED = ("momentum of ", "displacement of ")


def graph_of(model: type[Model], direction: int | None = 1) -> Graph:
    """Return the bond graph of a model class, its parameters as symbols.

    Raises
    ------
    ModelError
        If the model has no method ``bond_graph``, or only one of a base class that states another motion.
    """
    from ..core.derivation.trace import parameter_symbol, symbolic_instance

    if not states_bond_graph(model):
        raise ModelError(f"{model.model_id()} states no bond graph: a method 'bond_graph(self, u)' would")
    parts = declared(model, Model)
    symbols = {name: parameter_symbol(p, direction) for name, p in parts.parameters.items()}
    return _graph(symbolic_instance(model, symbols), {"u": Names("u", input_symbols(parts.inputs))})


def states_bond_graph(model: type[Model]) -> bool:
    """Tell whether a model states a bond graph of its own motion, not only a base class one of another motion."""
    return getattr(model, "bond_graph", None) is not None and (
        issubclass(model, BondGraphModel)
        or any(is_current(model, method) for method in ("bond_graph", "equations_bond_graph"))
    )


def input_symbols(inputs: Mapping[str, Any]) -> dict[str, Any]:
    """Return the symbols of inputs by their names."""
    import sympy as sp

    return {name: sp.Symbol(name, real=True) for name in inputs}


def _graph(instance: Any, groups: Mapping[str, Any]) -> Graph:
    graph = call(instance.bond_graph, groups)
    if not isinstance(graph, Graph):
        raise ModelError(f"{type(instance).model_id()}: bond_graph must return a Graph, got {type(graph).__name__}")
    return graph


def _inputs(u: Names) -> tuple[Any, ...]:
    return tuple(symbol for name, symbol in vars(u).items() if name != "_group")


def _declare_states(cls: type[Model]) -> None:
    """Give the class the states of its graph as variables, with the units that the parameters settle."""
    from ..core.derivation.trace import parameter_symbol
    from .equations import state_equations
    from .units import state_units

    parts = declared(cls, Model)
    graph = graph_of(cls, None)
    inputs = input_symbols(parts.inputs)
    found = state_equations(graph, tuple(inputs.values()))
    known = {parameter_symbol(p, None): p.dimension for p in parts.parameters.values()}
    known |= {symbol: parts.inputs[name].dimension for name, symbol in inputs.items()}
    units = state_units(graph, known)
    owners = [s.element for s in found.stores if s.integral] + [t.element for t in found.totals]
    for name, element in zip(found.states, owners, strict=True):
        if isinstance(getattr(cls, name, None), Variable):
            continue
        if name in parts.parameters or name in parts.inputs or hasattr(Model, name):
            raise ModelError(f"{cls.model_id()}: the graph has a state '{name}', and that name is taken")
        if name not in units:
            how = (
                "declare its numbers, 'param m [kg] default 2: mass'"
                if issubclass(cls, _FromText)
                else "declare it by state()"
            )
            raise ModelError(f"{cls.model_id()}: the unit of {name} does not follow from the graph; {how}")
        what = "momentum" if name.startswith("p") else "displacement"
        setattr(cls, name, Variable(units[name], f"{what} of {element.name}", motion=element.name))
