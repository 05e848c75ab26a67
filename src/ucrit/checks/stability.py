"""Do published criteria and critical values agree with the eigenvalues derived?"""

from __future__ import annotations

from typing import Any

import mpmath
import numpy as np
import numpy.typing as npt

from ..analyses.stability.criteria import criteria
from ..core.errors import UcritError, near_match
from ..core.formulas.codegen import build, generate
from ..core.numeric.compiled import compiled
from .precise import DIGITS, EQUAL, numeric
from .published import Entry, agree
from .report import FailedCheckError, NotApplicableError
from .sample import SPREAD, Array
from .states import stacked
from .subject import Subject

Flags = npt.NDArray[np.bool_]

COUNT = 500
SPREADS = (SPREAD, 30.0, 300.0)
"""A vehicle far from the boundary needs a wide spread for both verdicts to occur."""
MAX_ORDER = 4
NEAR = 1e-7


def criterion(subject: Subject) -> str:
    """Published expressions are all positive exactly where the eigenvalues say stable."""
    entries, untested = subject.published("criterion"), []
    for entry in entries:
        traced = subject.traced
        wanted = entry.content["expression"]
        given = entry.formulas(wanted if isinstance(wanted, list) else [wanted], traced.parameters)
        function = build(generate("criterion", [list(traced.parameters.values())], given), "criterion")
        verdicts: set[bool] = set()
        for spread in SPREADS:
            verdicts |= _agreeing(subject, entry, function, spread)
            if len(verdicts) == 2:
                break
        if len(verdicts) < 2:
            untested.append(f"{entry.where}: all of {COUNT} random vehicles are {'un' * (True not in verdicts)}stable")
    if untested:
        raise NotApplicableError("; ".join(untested))
    return f"{agree(entries, 'criterion', 'criteria')} with the eigenvalues of {COUNT} random vehicles"


def _agreeing(subject: Subject, entry: Entry, function: Any, spread: float) -> set[bool]:
    """Return the verdicts met among random vehicles; raise where criterion and eigenvalues disagree."""
    verdicts: set[bool] = set()
    for direction in (1, -1) if entry.direction == 0 else (entry.direction,):
        sets = subject.parameter_sets(entry.where, COUNT, direction, spread)
        positive = np.all(stacked(function(sets), sets[0][None]) > 0, axis=0)
        stable, clear = _stable(subject, sets, direction)
        if np.any(positive[clear] != stable[clear]):
            raise FailedCheckError(f"{entry.where}: eigenvalues and criterion disagree")
        verdicts |= set(positive[clear].tolist())
    return verdicts


def _stable(subject: Subject, sets: list[Array], direction: int) -> tuple[Flags, Flags]:
    """Return where the eigenvalues, without structural zeros, say stable, and where they say so clearly.

    Where no motion ever decays (no odd powers of s), stable means all eigenvalues on the imaginary axis.
    """
    made, polynomial = compiled(subject.model, direction), subject.system(direction).polynomial
    roots = np.linalg.eigvals(made.state_space(sets).A)
    order = np.argsort(np.abs(roots), axis=-1)[:, made.structural_zeros :]
    largest = np.take_along_axis(roots.real, order, axis=-1).max(axis=-1)
    near = np.abs(largest) <= NEAR * np.abs(roots).max(axis=-1)
    if polynomial.undamped:
        return near, np.ones_like(near)
    return largest < 0, ~near


def derived_criterion(subject: Subject) -> str:
    """The symbolic criterion derived from the model is met exactly where the eigenvalues say stable."""
    for direction in subject.directions:
        polynomial = subject.system(direction).polynomial
        order = polynomial.order
        if order == polynomial.zeros:
            raise NotApplicableError("every eigenvalue is zero, whatever the parameters")
        if order > MAX_ORDER:
            raise NotApplicableError(f"criteria in all parameters are for order {MAX_ORDER} at most, not {order}")
        try:
            found = criteria(subject.model, direction=direction)
        except UcritError as refusal:
            raise NotApplicableError(str(refusal)) from None
        sets = subject.parameter_sets("derived criterion", COUNT, direction)
        values = dict(zip(subject.model.declaration.parameters, sets, strict=True))
        vehicle = subject.model(**{name: float(array[0]) for name, array in values.items()})
        met = np.full(COUNT, found.settled is not False)
        for condition in found:
            met &= np.asarray(condition.value(vehicle.along("sample", **values))) > 0
        stable, clear = _stable(subject, sets, direction)
        if np.any(met[clear] != stable[clear]):
            raise FailedCheckError("the derived criterion and the eigenvalues disagree")
    return f"the derived criterion agrees with the eigenvalues of {COUNT} random vehicles"


def critical(subject: Subject) -> str:
    """At a published critical value an eigenvalue lies on the imaginary axis."""
    entries = subject.published("critical")
    for entry in entries:
        traced = subject.system(entry.direction).traced
        name = entry.content["parameter"]
        if name not in traced.parameters:
            raise FailedCheckError(
                f"{entry.where}: there is no parameter '{name}'{near_match(name, traced.parameters)}"
            )
        if not _meets_axis(subject, entry, name):
            raise FailedCheckError(f"{entry.where}: no eigenvalue is on the imaginary axis at this {name}")
    told = "1 published critical value puts" if len(entries) == 1 else f"{len(entries)} published critical values put"
    return f"{told} an eigenvalue on the imaginary axis"


def _meets_axis(subject: Subject, entry: Entry, name: str) -> bool:
    """Tell whether a root is on the imaginary axis wherever the critical value is possible."""
    system, parameters = subject.system(entry.direction), subject.model.declaration.parameters
    symbols = system.traced.parameters
    index, power = list(symbols).index(name), int(entry.content.get("power", 1))
    value = numeric([entry.formulas(entry.content["expression"], symbols)], list(symbols.values()))
    coefficients = numeric(system.polynomial.expressions[system.polynomial.zeros :], list(symbols.values()))
    tried = 0
    with mpmath.workdps(DIGITS):
        for point in subject.points(entry.where, entry.direction, 200):
            found = mpmath.re(value(point)[0])
            if (power % 2 == 0 and found < 0) or tried == 3:
                continue
            root = mpmath.sign(found) * abs(found) ** (mpmath.mpf(1) / power)
            if parameters[name].allows(float(root)):
                tried += 1
                a = coefficients([*point[:index], root, *point[index + 1 :]])
                if not _on_axis(a):
                    return False
    if not tried:
        raise FailedCheckError(f"{entry.where}: the critical {name} is nowhere {parameters[name].allowed}")
    return True


def _on_axis(ascending: list[Any]) -> bool:
    roots = mpmath.polyroots(ascending[::-1], maxsteps=200, extraprec=200)
    size = max(abs(root) for root in roots)
    return any(abs(mpmath.re(root)) < mpmath.sqrt(EQUAL) * size for root in roots)
