"""Does every further derivation, in the model or published, give the same motion?"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import sympy as sp

from ..core.derivation.linear import linear_system
from ..core.derivation.nonlinear import solve_for_highest
from ..core.derivation.trace import Traced, trace
from ..core.formulas.codegen import build, generate
from .matching import same_equations
from .precise import numeric, same_up_to_factor
from .published import agree
from .report import FailedCheckError, NotApplicableError
from .sample import Array
from .states import States, differs, random_states, stacked
from .subject import Subject


def derivations(subject: Subject) -> str:
    """Each method ``equations_<how>`` gives the first derivation's linear equations and accelerations."""
    if not subject.derivations:
        raise NotApplicableError("the model has one derivation only; a method 'equations_newton' would add another")
    for method in subject.derivations:
        for direction in subject.directions:
            _compare_linear(subject, method, direction)
        _compare_motion(subject, trace(subject.model, None, method), method)
    return f"{', '.join(subject.derivations)} give the same linear equations and the same accelerations"


def _compare_linear(subject: Subject, method: str, direction: int) -> None:
    first, second = subject.system(direction), linear_system(subject.model, direction, method)
    points = subject.points(method, direction)
    if first.P[0].shape == second.P[0].shape:
        if not same_equations(first, second.P, second.Q, points):
            raise FailedCheckError(f"{method} has other linear equations")
        return
    symbols = list(first.traced.parameters.values())
    one, other = (numeric(s.polynomial.expressions, symbols) for s in (first, second))
    if not all(same_up_to_factor(one(point), other(point)) for point in points):
        raise FailedCheckError(f"{method} has another characteristic polynomial")


def published_motion(subject: Subject) -> str:
    """Published non-linear equations of motion and outputs agree with the derived ones."""
    entries = subject.published("motion")
    traced, declared = subject.traced, subject.model.declaration
    names = subject.motion_names(traced)
    q = traced.q[: len(declared.variables)]
    for entry in entries:
        residuals = tuple(entry.formulas(entry.content["equations"], names))
        if len(residuals) != len(q):
            raise FailedCheckError(f"{entry.where}: {len(residuals)} equations for {len(q)} variables")
        _compare_motion(subject, replace(traced, q=q, residuals=residuals, multipliers=0), entry.where)
        for name, formula in entry.content.get("outputs", {}).items():
            if name not in declared.outputs:
                raise FailedCheckError(f"{entry.where}: the model has no output '{name}'")
            _compare_output(subject, name, entry.formulas(formula, names), entry.where)
    return agree(entries, "non-linear motion")


def _compare_motion(subject: Subject, other: Traced, where: str) -> None:
    states = random_states(subject, "derivations")
    count = len(subject.model.declaration.variables)
    expected = subject.motion.highest(states.w, states.u, states.parameters)[:count]
    for chain, one, two in zip(other.q, expected, accelerations(other, states)[:count], strict=True):
        if differs(one[None], two[None]):
            raise FailedCheckError(f"{where} gives another {chain[-1]} in the non-linear motion")


def accelerations(traced: Traced, states: States) -> Array:
    """Return the highest derivatives that traced equations give, one a row."""
    solved = solve_for_highest(traced)
    n = len(traced.q)
    entries = stacked(_function(traced, [*solved.M, *solved.f])(states.w, states.u, states.parameters), states.w)
    M = np.moveaxis(entries[: n * n].reshape(n, n, -1), -1, 0)
    z = np.linalg.solve(M, entries[n * n :].T[..., None])
    return np.asarray(z[..., 0].T, dtype=np.float64)


def _compare_output(subject: Subject, name: str, formula: Any, where: str) -> None:
    """Compare an output, the highest derivatives in the published formula taken from the derived motion."""
    traced, states = subject.traced, random_states(subject, "derivations")
    z = subject.motion.highest(states.w, states.u, states.parameters)
    groups = [(*traced.states, *traced.highest), traced.u, list(traced.parameters.values())]
    function = build(generate("output", groups, [sp.sympify(formula)]), "output")
    expected = stacked(function(np.concatenate([states.w, z]), states.u, states.parameters), states.w)
    row = list(subject.model.declaration.outputs).index(name)
    if differs(subject.motion.outputs(states.w, states.u, states.parameters)[row][None], expected):
        raise FailedCheckError(f"{where} gives another {name}")


def _function(traced: Traced, expressions: Sequence[Any]) -> Any:
    groups = [traced.states, traced.u, list(traced.parameters.values())]
    return build(generate("values", groups, expressions), "values")
