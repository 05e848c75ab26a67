"""Tracing: run a model's own equations once on SymPy symbols and keep the expressions."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any

import sympy as sp

from ..contract.declare import Parameter
from ..contract.methods import STATEMENTS, Names, as_tuple, call
from ..contract.model import Model
from ..errors import ModelError
from ..formulas.settle import settled
from .dimensions import check_dimensions

Expr = Any

OWN = ("hat", "known", "d")
"""Endings of parameters that a controller has values of its own for: of observers, laws and references."""


@dataclass(frozen=True)
class Traced:
    """A model's equations in symbols; every residual is zero.

    ``q[i][k]`` is the symbol of the k-th derivative of variable i, up to the variable's order; ``basic`` maps
    symbols of states, their derivatives and inputs to their values on the basic motion.
    """

    model: type[Model]
    parameters: Mapping[str, sp.Symbol]
    q: tuple[tuple[sp.Symbol, ...], ...]
    u: tuple[sp.Symbol, ...]
    residuals: tuple[Expr, ...]
    outputs: tuple[Expr, ...]
    basic: Mapping[sp.Symbol, Expr]
    multipliers: int = 0

    @property
    def orders(self) -> tuple[int, ...]:
        """Order of each variable."""
        return tuple(len(chain) - 1 for chain in self.q)

    @property
    def states(self) -> tuple[sp.Symbol, ...]:
        """Symbols of the variables and their derivatives below the highest, variable by variable."""
        return tuple(symbol for chain in self.q for symbol in chain[:-1])

    @property
    def highest(self) -> tuple[sp.Symbol, ...]:
        """Symbols of each variable's highest derivative."""
        return tuple(chain[-1] for chain in self.q)

    def time_derivative(self, expression: Expr) -> Expr:
        """Differentiate along the motion by the chain rule; the highest derivatives must not occur."""
        terms = (sp.diff(expression, low) * high for chain in self.q for low, high in pairwise(chain))
        return sp.Add(*terms)


def parameter_symbol(parameter: Parameter, direction: int | None) -> sp.Symbol:
    """Return the symbol of a parameter with its declared sign as an assumption."""
    sign = direction if parameter.is_speed and parameter.sign is None else parameter.sign
    assumption = {
        1: {"positive": True},
        -1: {"negative": True},
        0: {"nonnegative": True},
        None: {"real": True},
    }
    return sp.Symbol(parameter.name, **assumption[sign])


def symbolic_instance(model: type[Model], symbols: Mapping[str, Any]) -> Model:
    """Return an instance whose parameters are symbols, past the validation meant for numbers."""
    instance = object.__new__(model)
    instance.__dict__.update(symbols, _values=dict(symbols), _shared={})
    return instance


def trace(model: type[Model], direction: int | None = 1, method: str = "") -> Traced:
    """Run the equations of ``model`` on symbols.

    Parameters
    ----------
    model
        The class to trace.
    direction
        +1 for forward speed, -1 for backing up, ``None`` for either; a model without speed ignores it.
    method
        Name of a further derivation (``"equations_newton"``); the first one by default.

    Raises
    ------
    ModelError
        If units clash, names are unknown, equations and unknowns differ in number, or the basic motion does not
        satisfy the equations.
    """
    declared = model.declaration
    symbols = {name: parameter_symbol(p, direction) for name, p in declared.parameters.items()}
    instance = symbolic_instance(model, symbols)
    q = [tuple(sp.Symbol(v.label(k), real=True) for k in range(v.order + 1)) for v in declared.variables.values()]
    u = tuple(sp.Symbol(name, real=True) for name in declared.inputs)
    groups = groups_of(model, q, u)
    residuals, multipliers = _residuals(model, instance, groups, q, method)
    q = [*q, *((m,) for m in multipliers)]
    if len(residuals) != len(q):
        raise ModelError(f"{model.model_id()}: {len(residuals)} equations for {len(q)} variables")
    outputs = call(instance.outputs, groups) if hasattr(instance, "outputs") else {}
    _check_output_names(model, outputs)
    traced = Traced(
        model=model,
        parameters=symbols,
        q=tuple(q),
        u=u,
        residuals=tuple(_rational(r) for r in residuals),
        outputs=tuple(_rational(outputs[name]) for name in declared.outputs),
        basic=_basic_motion(model, instance, q, u, declared),
        multipliers=len(multipliers),
    )
    if not method:
        check_dimensions(traced)
    _check_basic_motion(traced)
    return traced


@dataclass(frozen=True)
class Written:
    """Equations as people write them: the forces of parts as functions, a controller's law by the side.

    ``residuals`` use the symbols of ``law``, which are what drives the vehicle, and of ``outputs``, by their names.
    """

    residuals: tuple[Expr, ...]
    outputs: Mapping[sp.Symbol, Expr]
    law: Mapping[sp.Symbol, Expr] = field(default_factory=dict)

    @property
    def definitions(self) -> dict[sp.Symbol, Expr]:
        """What the residuals' further symbols stand for: the law, then the outputs that it or they use."""
        found = dict(self.law)
        waiting = [*self.residuals, *found.values()]
        while waiting:
            for symbol in sorted(waiting.pop(0).free_symbols & self.outputs.keys() - found.keys(), key=str):
                found[symbol] = self.outputs[symbol]
                waiting.append(found[symbol])
        return found


def written(traced: Traced) -> Written:
    """Return a model's equations as they are written: with the forces of its parts as functions, not spelt out."""
    model, names = traced.model, traced.model.declaration.outputs
    symbols = [sp.Symbol(name, real=True) for name in names]
    if hasattr(model, "written_loop"):
        loop: Any = symbolic_instance(model, traced.parameters)
        return loop.written_loop(traced)  # type: ignore[no-any-return]
    laws = {name: slot.law.unwritten(name) for name, slot in model.declaration.slots.items()}
    if not laws:
        return Written(traced.residuals, dict(zip(symbols, traced.outputs, strict=True)))
    instance = symbolic_instance(model.fitted(**laws), traced.parameters)
    q = list(traced.q[: len(traced.q) - traced.multipliers])
    groups = groups_of(model, q, traced.u)
    residuals, _ = _residuals(type(instance), instance, groups, q, "")
    outputs = call(instance.outputs, groups) if hasattr(instance, "outputs") else {}
    return Written(tuple(map(_rational, residuals)), {s: _rational(outputs[s.name]) for s in symbols})


def groups_of(model: type[Model], q: list[tuple[sp.Symbol, ...]], u: tuple[sp.Symbol, ...]) -> dict[str, Names]:
    """Return the symbols of a model's variables, rates and inputs, as its methods take them."""
    names = list(model.declaration.variables)
    by_order = [{name: chain[k] for name, chain in zip(names, q, strict=True) if k < len(chain)} for k in range(3)]
    groups = {group: Names(group, values) for group, values in zip(("x", "dx", "ddx"), by_order, strict=True)}
    return {**groups, "u": Names("u", dict(zip(model.declaration.inputs, u, strict=True)))}


def _residuals(
    model: type[Model], instance: Model, groups: dict[str, Names], q: list[tuple[sp.Symbol, ...]], method: str
) -> tuple[list[Expr], list[sp.Symbol]]:
    statement = method or next(name for base in model.__mro__ for name in STATEMENTS if name in vars(base))
    if statement == "kinetic_energy":
        from .lagrange import lagrange

        return lagrange(instance, groups, q)
    if statement == "matrices":
        matrices = [sp.Matrix(P) for P in instance.matrices()]  # type: ignore[attr-defined]
        rows = [sp.Matrix([chain[k] if k < len(chain) else 0 for chain in q]) for k in range(len(matrices))]
        return list(sum((P * row for P, row in zip(matrices, rows, strict=True)), sp.zeros(len(q), 1))), []
    if statement == "closed_loop":
        return instance.closed_loop(q, groups)  # type: ignore[attr-defined,no-any-return]
    return [sp.sympify(r) for r in as_tuple(call(getattr(instance, statement), groups))], []


def _rational(expression: Expr) -> Expr:
    expression = sp.sympify(expression)
    floats = {f: sp.Rational(str(f)) for f in expression.atoms(sp.Float)}
    return expression.xreplace(floats) if floats else expression


def _check_output_names(model: type[Model], outputs: Mapping[str, Any]) -> None:
    declared = set(model.declaration.outputs)
    if declared != set(outputs):
        odd = sorted(declared.symmetric_difference(outputs))
        raise ModelError(f"{model.model_id()}: outputs declared and returned differ in {', '.join(odd)}")


def _basic_motion(
    model: type[Model],
    instance: Model,
    q: list[tuple[sp.Symbol, ...]],
    u: tuple[sp.Symbol, ...],
    declared: Any,
) -> dict[sp.Symbol, Expr]:
    basic: dict[sp.Symbol, Expr] = {symbol: sp.S.Zero for chain in q for symbol in chain} | dict.fromkeys(u, sp.S.Zero)
    given = instance.basic_motion() if hasattr(instance, "basic_motion") else {}
    names = list(declared.variables)
    for group, values in given.items():
        for name, value in values.items():
            if group == "u":
                symbol = u[list(declared.inputs).index(name)]
            else:
                symbol = q[names.index(name)][("x", "dx", "ddx").index(group)]
            basic[symbol] = _rational(value)
    return basic


def _check_basic_motion(traced: Traced) -> None:
    for number, residual in enumerate(settled(traced.residuals, traced.basic), 1):
        left = residual.xreplace(dict(traced.basic))
        if left.has(sp.zoo, sp.nan, sp.oo) or (left != 0 and sp.simplify(left) != 0):
            own = _own_values(traced, left)
            if own:
                raise ModelError(
                    f"{traced.model.model_id()}: with {', '.join(own)} of its own a controller has another basic "
                    f"motion than the vehicle; let it share {', '.join(own.values())}"
                )
            raise ModelError(
                f"{traced.model.model_id()}: equation {number} does not hold on the basic motion, {left} is left"
            )


def _own_values(traced: Traced, left: Expr) -> dict[str, str]:
    """Return parameters such as ``m_hat`` that differ from ``m``, if that is all that is wrong with an equation."""
    found = [(s, s.name.rpartition("_")) for s in traced.parameters.values() if s in left.free_symbols]
    shared = {s: name for s, (name, _, ending) in found if ending in OWN and name in traced.parameters}
    own = {s: traced.parameters[name] for s, name in shared.items()}
    holds = bool(own) and sp.simplify(left.xreplace(own)) == 0
    return {s.name: other.name for s, other in own.items()} if holds else {}
