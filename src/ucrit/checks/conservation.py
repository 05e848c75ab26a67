"""Are energy and other declared quantities accounted for along the non-linear motion?"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise
from typing import Any

import numpy as np
import sympy as sp

from ..core.contract.methods import as_tuple, call
from ..core.derivation.trace import Traced, symbolic_instance
from ..core.formulas.codegen import build, generate
from .report import FailedCheckError, NotApplicableError
from .states import random_states, stacked
from .subject import Subject

TOLERANCE = 1e-9


def energy(subject: Subject) -> str:
    """The rate of ``h = sum q' dL/dq' - L`` is the power of the forces and of the constraints.

    Source: H. Goldstein, Classical Mechanics (1980), section 2.7, with the generalised forces kept.
    """
    if not subject.is_current("kinetic_energy"):
        raise NotApplicableError("the model states no energies")
    traced = subject.traced
    instance, groups = symbolic_instance(subject.model, traced.parameters), subject.groups(traced)

    def of(name: str, nothing: Any) -> Any:
        return call(getattr(instance, name), groups) if hasattr(instance, name) else nothing

    lagrangian = sp.sympify(of("kinetic_energy", 0)) - of("potential_energy", 0)
    rates = [chain[1] for chain in traced.q if len(chain) == 3]
    h = sum((dq * sp.diff(lagrangian, dq) for dq in rates), sp.S.Zero) - lagrangian
    multipliers = [chain[0] for chain in traced.q if len(chain) == 1]
    forces = [*of("forces", ()), *zip(multipliers, of("constraints", ()), strict=False)]
    power = [-force * dq * sp.diff(sp.sympify(velocity), dq) for force, velocity in forces for dq in rates]
    if _imbalance(subject, [*_rate(h, traced), *power]):
        raise FailedCheckError("energy is not balanced along the motion: its rate is not the power of the forces")
    return "the rate of energy is the power of the forces along the motion"


def conserved(subject: Subject) -> str:
    """What the method ``conserved(self, x, dx)`` returns does not change along the motion."""
    if not hasattr(subject.model, "conserved"):
        raise NotApplicableError("the model declares no method 'conserved'")
    traced = subject.traced
    instance = symbolic_instance(subject.model, traced.parameters)
    returned = call(instance.conserved, subject.groups(traced))  # type: ignore[attr-defined]
    named = returned if isinstance(returned, Mapping) else dict(enumerate(as_tuple(returned), 1))
    for name, expression in named.items():
        if _imbalance(subject, _rate(sp.sympify(expression), traced)):
            raise FailedCheckError(f"the conserved quantity {name} changes along the motion")
    told = "1 declared quantity stays" if len(named) == 1 else f"{len(named)} declared quantities stay"
    return f"{told} constant along the motion"


def _rate(expression: Any, traced: Traced) -> list[Any]:
    """Return the terms of the time derivative of a function of the states."""
    steps = [(low, high) for chain in traced.q for low, high in pairwise(chain)]
    return [sp.diff(expression, low) * high for low, high in steps]


def _imbalance(subject: Subject, terms: list[Any]) -> bool:
    """Tell whether the terms add up to anything but zero along the motion."""
    traced, states = subject.traced, random_states(subject, "conservation")
    z = subject.motion.highest(states.w, states.u, states.parameters)
    groups = [traced.states, traced.highest, traced.u, list(traced.parameters.values())]
    function = build(generate("terms", groups, terms), "terms")
    values = stacked(function(states.w, z, states.u, states.parameters), states.w)
    return not bool(np.all(np.abs(values.sum(axis=0)) <= TOLERANCE * np.abs(values).sum(axis=0)))
