"""Do the derived linear equations agree with those printed in the literature?"""

from __future__ import annotations

from typing import Any

import mpmath
import sympy as sp

from ..core.errors import near_match
from ..core.numeric.compiled import compiled
from .matching import response, same_equations
from .precise import DIGITS, close, frequencies, numeric, same_up_to_factor
from .precise import polynomial as value_at
from .published import Entry, agree
from .report import FailedCheckError
from .subject import Subject


def polynomial(subject: Subject) -> str:
    """The characteristic polynomial is the published one up to a factor free of s."""
    entries = subject.published("polynomial")
    for entry in entries:
        system = subject.system(entry.direction)
        symbols = list(system.traced.parameters.values())
        given = entry.formulas(entry.content["coefficients"], system.traced.parameters)
        derived, printed = numeric(system.polynomial.expressions, symbols), numeric(given, symbols)
        for point in subject.points(entry.where, entry.direction):
            if not same_up_to_factor(derived(point), printed(point)):
                raise FailedCheckError(f"{entry.where}: the characteristic polynomial is another one")
    return agree(entries, "polynomial")


def matrices(subject: Subject) -> str:
    """The linear equations are the published ones up to combinations of rows."""
    entries = subject.published("matrices")
    for entry in entries:
        system = subject.system(entry.direction)
        given = {
            key: _matrix(entry, key, system.traced.parameters)
            for key in ("P_0", "P_1", "P_2", "Q")
            if key in entry.content
        }
        if given["P_0"].shape != system.P[0].shape:
            raise FailedCheckError(f"{entry.where}: P_0 is of shape {given['P_0'].shape}, derived {system.P[0].shape}")
        P = [given.get(key, sp.zeros(*system.P[0].shape)) for key in ("P_0", "P_1", "P_2")]
        if not same_equations(system, P, given.get("Q"), subject.points(entry.where, entry.direction)):
            raise FailedCheckError(f"{entry.where}: the linear equations are others")
    return agree(entries, "set of equations", "sets of equations")


def state_matrix(subject: Subject) -> str:
    """The state matrices are the published ones."""
    entries = subject.published("state_matrix")
    for entry in entries:
        made, parameters = (
            compiled(subject.model, entry.direction),
            subject.system(entry.direction).traced.parameters,
        )
        given = {key: _matrix(entry, key, parameters) for key in ("A", "B") if key in entry.content}
        for key, M in given.items():
            function = numeric(list(M), list(parameters.values()))
            for point in subject.points(entry.where, entry.direction):
                found = getattr(made.state_space(point), key)
                if found.shape != M.shape:
                    raise FailedCheckError(f"{entry.where}: {key} is of shape {M.shape}, derived {found.shape}")
                size = 1e-12 * abs(found).max(axis=1).repeat(M.cols)
                for got, expected, least in zip(found.ravel(), function(point), size, strict=True):
                    if abs(got - float(expected)) > 1e-10 * abs(got) + least:
                        raise FailedCheckError(f"{entry.where}: {key} is another one")
    return f"{agree(entries, 'state matrix', 'state matrices')} with the states {', '.join(made.labels)}"


def _matrix(entry: Entry, key: str, names: Any) -> sp.Matrix:
    return sp.Matrix(entry.formulas(entry.content[key], names))


def transfer(subject: Subject) -> str:
    """Transfer functions are the published ones, as rational functions of s."""
    entries = subject.published("transfer")
    for entry in entries:
        system, declared = subject.system(entry.direction), subject.model.declaration
        name_in, name_out = entry.content["input"], entry.content["output"]
        for name, allowed in (
            (name_in, declared.inputs),
            (name_out, {**declared.variables, **declared.outputs}),
        ):
            if name not in allowed:
                raise FailedCheckError(f"{entry.where}: the model has no '{name}'{near_match(name, allowed)}")
        symbols = list(system.traced.parameters.values())
        above, below = (
            numeric(entry.formulas(entry.content[key], system.traced.parameters), symbols)
            for key in ("numerator", "denominator")
        )
        derived = response(system, name_in, name_out)
        for point in subject.points(entry.where, entry.direction):
            with mpmath.workdps(DIGITS):
                top, bottom = above(point), below(point)
                nodes = frequencies(bottom, len(top) + len(bottom))
                for s, value in zip(nodes, derived(point, nodes), strict=True):
                    if not close(value * value_at(bottom, s), value_at(top, s)):
                        raise FailedCheckError(f"{entry.where}: {name_out}/{name_in} is another transfer function")
    return agree(entries, "transfer function")
