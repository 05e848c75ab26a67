"""What is derived once per model and kept on disk: sources of numeric functions and the facts beside them."""

from __future__ import annotations

from functools import cache
from typing import Any

import sympy as sp

from ..contract.model import Model
from ..errors import UcritError
from ..formulas.codegen import generate, renaming, write
from ..formulas.corners import corners
from ..formulas.plane import computable
from ..formulas.slopes import staged_slopes
from .linear import LinearSystem, linear_system
from .nonlinear import constraints, solve_for_highest
from .trace import trace

_symbolic: Any = cache(linear_system)


def symbolic(model: type[Model], direction: int = 1) -> LinearSystem:
    """Return the linear system of a model in symbols, derived once per process."""
    if direction not in (1, -1):
        raise UcritError(f"direction must be 1 (ahead) or -1 (backing up), got {direction!r}")
    found: LinearSystem = _symbolic(model, direction)
    return found


def linear_facts(model: type[Model], direction: int) -> dict[str, Any]:
    """Derive the explicit linear form and the characteristic polynomial of a model."""
    system = symbolic(model, direction)
    e, polynomial = system.explicit, system.polynomial
    parameters = list(system.traced.parameters.values())
    blocks = (e.L, e.R, e.Q, e.Cw, e.Cz, e.D)
    names = [chain[0].name for chain in system.traced.q]
    swap, factors = dict(polynomial.functions), polynomial.factors
    return {
        "order": sum(e.orders),
        "zeros": polynomial.zeros,
        "undamped": polynomial.undamped,
        "variables": names,
        "states": [(name, k) for name, order in zip(names, e.orders, strict=True) for k in range(order)],
        "shapes": [block.shape for block in blocks],
        "degrees": {name: polynomial.degrees(symbol) for name, symbol in system.traced.parameters.items()},
        "matrices": generate("matrices", [parameters], [entry for block in blocks for entry in block]),
        "coefficients": generate("coefficients", [parameters], polynomial.expressions),
        "sizes": [len(factor) for factor in factors],
        "factors": generate("factors", [parameters], [a.as_expr().xreplace(swap) for f in factors for a in f]),
    }


def size_facts(model: type[Model], direction: int) -> dict[str, Any]:
    """Derive bounds of the characteristic coefficients: the sums of their terms' sizes, and how often those round."""
    polynomial = symbolic(model, direction).polynomial
    parameters = list(symbolic(model, direction).traced.parameters.values())
    names = list(polynomial.functions)
    magnitudes, units = polynomial.bounds()
    return {
        "functions": generate("functions", [parameters], [polynomial.functions[name] for name in names]),
        "magnitudes": generate("magnitudes", [parameters, names], magnitudes),
        "units": units,
    }


def corner_facts(model: type[Model], direction: int) -> list[tuple[str, str]]:
    """Derive where the equations jump or bend on the basic motion."""
    traced = symbolic(model, direction).traced
    by = [symbol for chain in traced.q for symbol in chain]
    return corners(traced.residuals, by, dict(traced.basic))


def slope_facts(model: type[Model], direction: int) -> dict[str, Any]:
    """Derive how the explicit form changes with every parameter; only slopes other than zero are kept."""
    system = symbolic(model, direction)
    parameters = list(system.traced.parameters.values())
    entries = [e for block in (system.explicit.L, system.explicit.R) for e in block]
    return _sparse("slopes", [parameters], entries, parameters)


def static_slope_facts(model: type[Model], direction: int) -> dict[str, Any]:
    """Derive how the lowest coefficient that is not zero changes with every parameter."""
    system = symbolic(model, direction)
    parameters, static = list(system.traced.parameters.values()), system.polynomial.static_expression
    return {"slopes": generate("static", [parameters], [static.diff(p) for p in parameters])}


def motion_facts(model: type[Model]) -> dict[str, Any]:
    """Derive the non-linear equations solved for the highest derivatives, and the outputs."""
    traced = trace(model, direction=None)
    solved = solve_for_highest(traced, iterated=True)
    parameters, z = list(traced.parameters.values()), list(traced.highest)
    conditions = constraints(traced)
    terms = [sp.Add.make_args(sp.expand(condition)) for condition in conditions]
    rates: list[tuple[str, int]] = []
    for i, order in enumerate(traced.orders):
        rates += [("w", len(rates) + k + 1) for k in range(order - 1)]
        if order:
            rates.append(("z", i))
    return {
        "size": len(traced.q),
        "states": [symbol.name for symbol in traced.states],
        "rates": rates,
        "conditions": [str(condition) for condition in conditions],
        "lengths": [len(summands) for summands in terms],
        "terms": generate("terms", [traced.states, traced.u, parameters], [t for summands in terms for t in summands]),
        "implicit": [z.index(symbol) for symbol in solved.implicit],
        "motion": generate(
            "motion", [traced.states, traced.u, parameters, z if solved.implicit else ()], [*solved.M, *solved.f]
        ),
        "outputs": generate("outputs", [traced.states, traced.highest, traced.u, parameters], traced.outputs),
        "basic": generate("basic", [parameters], [traced.basic.get(s, 0) for s in (*traced.states, *traced.u)]),
    }


def motion_switch_facts(model: type[Model]) -> dict[str, Any]:
    """Derive the values whose sign changes are kinks of the equations of motion."""
    from ..formulas.switches import switches

    traced = trace(model, direction=None)
    solved, moving = solve_for_highest(traced), {*traced.states, *traced.u}
    found = [e for e in switches([*solved.M, *solved.f]) if e.free_symbols & moving]
    return {"values": generate("values", [traced.states, traced.u, list(traced.parameters.values())], found)}


def motion_event_facts(model: type[Model]) -> dict[str, Any]:
    """Derive a model's events."""
    from .event_facts import event_facts

    return event_facts(model)


def motion_slope_facts(model: type[Model]) -> dict[str, Any]:
    """Derive how the residuals ``M z - f`` of the non-linear equations change with states, inputs and parameters."""
    traced = trace(model, direction=None)
    solved, z = solve_for_highest(traced, iterated=True), sp.Matrix(traced.highest)
    parameters = list(traced.parameters.values())
    residuals = solved.M * z - solved.f
    groups = traced.states, traced.highest, traced.u, parameters
    by = {
        "residual": (*traced.states, *traced.u, *parameters),
        "output": (*traced.states, *traced.highest, *traced.u, *parameters),
    }
    return {
        name: _sparse(name, groups, expressions, variables)
        for (name, variables), expressions in zip(by.items(), (residuals, traced.outputs), strict=True)
    }


def _sparse(name: str, groups: Any, expressions: Any, variables: Any) -> dict[str, Any]:
    """Return places and source of the slopes that are not zero."""
    renamed = renaming(groups)
    formulas = [computable(sp.sympify(e)).xreplace(renamed) for e in expressions]
    found = staged_slopes(formulas, [renamed[v] for v in variables])
    source = write(name, [len(group) for group in groups], found.steps, found.slopes.values())
    return {"places": list(found.slopes), "source": source}
