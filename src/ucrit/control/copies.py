"""Copies of a model inside a controller: what observers, reference models and model-based laws compute with.

A copy has a state for every state of the model, named after it (``V_hat``, ``theta_dot_hat``), and takes those
parameters that it shall not share under names of its own (``C_f_hat``).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

from ..core.contract.declare import Quantity, Variable
from ..core.contract.model import Model
from ..core.errors import UcritError, near_match
from ..core.numeric.compiled import compiled

KNOWN = "known"
"""Ending of parameters that the law has values of its own for."""

DESIRED = "d"
"""Ending of the reference's states and parameters."""


def plain_name(label: str) -> str:
    """Return a state's name without signs."""
    return label.replace("'", "_dot")


def state_names(model: type[Model]) -> dict[str, str]:
    """Return the model's linear states in order: label (``theta'``) and name without signs (``theta_dot``)."""
    return {label: label.replace("'", "_dot") for label in compiled(model).labels}


def state_unit(model: type[Model], label: str) -> str:
    """Return the unit of a state."""
    return model.declaration.variables[label.rstrip("'")].state_unit(label.count("'"))


def state_meaning(model: type[Model], label: str) -> str:
    """Return a state in words."""
    return "rate of the " * label.count("'") + model.declaration.variables[label.rstrip("'")].meaning


def checked_states(model: type[Model], names: Sequence[str]) -> tuple[str, ...]:
    """Return states as they are labelled; both ``theta'`` and ``theta_dot`` are understood."""
    known = state_names(model)
    back = {name: label for label, name in known.items()} | {label: label for label in known}
    for name in names:
        if name not in back:
            raise UcritError(f"{model.model_id()}: there is no state '{name}'{near_match(name, back)}")
    return tuple(back[name] for name in names)


def symbol_of(model: type[Model], label: str, x: Any, dx: Any) -> Any:
    """Return a state of the model in a law's groups of values."""
    return getattr((x, dx)[label.count("'")], label.rstrip("'"))


def ratio(above: str, below: str) -> str:
    """Return the unit of a quotient.

    >>> ratio("rad", "m/s")
    'm^-1 s'
    """
    from ..core.units import dimension

    return str(dimension(above).times(dimension(below), -1))


def own_parameters(model: type[Model], own: Sequence[str], suffix: str) -> dict[str, Quantity]:
    """Return the parameters that a copy needs: shared ones by their names, its own with the suffix.

    Raises `UcritError` for a name that the model does not have.
    """
    declared = model.declaration.parameters
    for name in own:
        if name not in declared:
            raise UcritError(f"{model.model_id()}: there is no parameter '{name}'{near_match(name, declared)}")
    found: dict[str, Quantity] = {}
    for name, parameter in declared.items():
        if name in own:
            meaning = f"{parameter.meaning} that the controller reckons with"
            found[f"{name}_{suffix}"] = replace(parameter, name="", meaning=meaning, is_speed=False)
        else:
            found[name] = parameter
    return found


def own_states(model: type[Model], suffix: str, words: str) -> dict[str, Quantity]:
    """Return a state for every state of the model."""
    refuse_constrained(model)
    return {
        f"{name}_{suffix}": Variable(
            state_unit(model, label),
            f"{state_meaning(model, label)}, {words}",
            motion=f"{words} {model.declaration.variables[label.rstrip(chr(39))].motion}".strip(),
        )
        for label, name in state_names(model).items()
    }


def refuse_constrained(model: type[Model]) -> None:
    """Refuse a model whose states are fewer than its variables' derivatives: a copy would need to be reduced."""
    variables = model.declaration.variables
    full = [name + "'" * k for name, v in variables.items() for k in range(v.order)]
    if list(state_names(model)) != full or any(not v.order for v in variables.values()):
        raise UcritError(f"{model.model_id()}: a copy of a model with constraints or algebraic unknowns is not made")


@dataclass(frozen=True)
class Copy:
    """A model's equations with other symbols: those of a controller.

    Attributes
    ----------
    residuals
        Each zero.
    outputs
        By name.
    """

    residuals: tuple[Any, ...]
    outputs: Mapping[str, Any]


def copied(
    model: type[Model],
    suffix: str,
    parameters: Mapping[str, Any],
    x: Any,
    dx: Any,
    inputs: Mapping[str, Any],
    injected: Mapping[str, Any] | None = None,
) -> Copy:
    """Return a model's equations for states ``<name>_<suffix>``, each rate corrected by ``injected[label]``.

    ``inputs`` gives the inputs' values, zero beyond the basic motion where it gives none.
    """
    traced = traced_once(model, None)
    values = {symbol: parameters[name] for name, symbol in traced.parameters.items()}
    extra = injected or {}
    residuals = []
    for chain in traced.q:
        base = chain[0].name
        for k in range(len(chain) - 1):
            name = f"{base}{'_dot' * k}_{suffix}"
            values[chain[k]] = getattr(x, name)
            rate = getattr(dx, name) - extra.get(base + "'" * k, 0)
            if k + 2 < len(chain):
                residuals.append(rate - getattr(x, f"{base}{'_dot' * (k + 1)}_{suffix}"))
            else:
                values[chain[-1]] = rate
    for symbol in traced.u:
        values[symbol] = inputs.get(symbol.name, traced.basic.get(symbol, 0))
    names = model.declaration.outputs
    return Copy(
        (*residuals, *(r.xreplace(values) for r in traced.residuals)),
        {name: e.xreplace(values) for name, e in zip(names, traced.outputs, strict=True)},
    )


def rates(model: type[Model], suffix: str, parameters: Mapping[str, Any], x: Any, inputs: Mapping[str, Any]) -> Any:
    """Return the rates of a copy's states by label, as formulas of states and inputs (not of other rates)."""
    traced, highest = _solved(model)
    values = {symbol: parameters[name] for name, symbol in traced.parameters.items()}
    found = {}
    for chain in traced.q:
        for k in range(len(chain) - 1):
            values[chain[k]] = getattr(x, f"{chain[0].name}{'_dot' * k}_{suffix}")
    for symbol in traced.u:
        values[symbol] = inputs.get(symbol.name, traced.basic.get(symbol, 0))
    for chain, solved in zip(traced.q, highest, strict=True):
        label = chain[0].name
        for k in range(len(chain) - 1):
            found[label + "'" * k] = solved if k + 2 == len(chain) else chain[k + 1]
    return {label: expression.xreplace(values) for label, expression in found.items()}


def _solve(model: type[Model]) -> Any:
    from ..core.derivation.nonlinear import solve_for_highest

    traced = traced_once(model, None)
    solved = solve_for_highest(traced)
    return traced, list(solved.M.LUsolve(solved.f))


_solved: Any = cache(_solve)


def bound_parameters(instance: Any, model: type[Model], own: Sequence[str], suffix: str) -> dict[str, Any]:
    """Return the values that a copy takes for the model's parameters."""
    return {n: instance.__dict__[f"{n}_{suffix}" if n in own else n] for n in model.declaration.parameters}


def basic_states(model: type[Model], suffix: str, parameters: Mapping[str, Any]) -> dict[str, dict[str, Any]]:
    """Return the basic motion of a copy, in the form of ``basic_motion``."""
    traced = traced_once(model, None)
    values = {symbol: parameters[name] for name, symbol in traced.parameters.items()}
    found: dict[str, dict[str, Any]] = {"x": {}, "dx": {}}
    for chain in traced.q:
        for k in range(len(chain) - 1):
            name = f"{chain[0].name}{'_dot' * k}_{suffix}"
            for group, symbol in (("x", chain[k]), ("dx", chain[k + 1])):
                value = traced.basic.get(symbol, 0)
                if value != 0:
                    found[group][name] = value.xreplace(values)
    return found


def linear_in_symbols(model: type[Model], direction: int = 1) -> tuple[list[str], Any, Any, dict[str, Any]]:
    """Return states, A and B of ``w' = A w + B u`` in symbols, and the parameters' symbols by name."""
    import sympy as sp

    from ..core.derivation.linear import linearize

    refuse_constrained(model)
    system = linearize(traced_once(model, direction))
    e = system.explicit
    solved = e.L.LUsolve(e.R.row_join(e.Q)).applyfunc(sp.cancel)
    n = e.R.cols
    rows = []
    for i, label in enumerate(labels := list(state_names(model))):
        if i + 1 < n and labels[i + 1].rstrip("'") == label.rstrip("'"):
            rows.append([sp.Integer(j == i + 1) for j in range(solved.cols)])
        else:
            variable = list(model.declaration.variables).index(label.rstrip("'"))
            rows.append(list(solved[variable, :]))
    both = sp.Matrix(rows)
    return labels, both[:, :n], both[:, n:], dict(system.traced.parameters)


def _trace(model: type[Model], direction: int | None) -> Any:
    from ..core.derivation.trace import trace

    return trace(model, direction)


traced_once: Any = cache(_trace)


def parameter_values(vehicle: Model, own: Sequence[str], suffix: str) -> dict[str, Any]:
    """Return the values of a copy's own parameters: the vehicle's present ones."""
    return {f"{name}_{suffix}": vehicle.values[name] for name in own}
