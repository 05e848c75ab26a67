"""Lagrange's equations from energies, forces with the velocities of their points, and velocity constraints."""

from __future__ import annotations

from typing import Any

import sympy as sp

from ..contract.methods import Names, call
from ..contract.model import Model
from ..errors import ModelError


def lagrange(
    instance: Model, groups: dict[str, Names], q: list[tuple[sp.Symbol, ...]]
) -> tuple[list[Any], list[sp.Symbol]]:
    """Return the residuals ``d/dt dL/dq' - dL/dq - Q`` (one per coordinate) and then the constraints.

    A force F on a point that moves with velocity v(q, q') along it does virtual work ``F dv/dq'_j`` on coordinate j.
    Each constraint, a velocity that is zero, acts through a multiplier: a force along that velocity, returned as
    a further unknown (the workless force that keeps it zero).

    Source: L. Meirovitch, Methods of Analytical Dynamics (1970), sections 2.11 and 2.13.
    """
    name = type(instance).model_id()
    kinetic = _expression(call(instance.kinetic_energy, groups), f"{name}.kinetic_energy")  # type: ignore[attr-defined]
    potential = _expression(_optional(instance, "potential_energy", groups, 0), f"{name}.potential_energy")
    forces = _pairs(_optional(instance, "forces", groups, ()), f"{name}.forces")
    constraints = [sp.sympify(c) for c in _optional(instance, "constraints", groups, ())]
    multipliers = [sp.Symbol(f"lambda_{i}", real=True) for i in range(1, len(constraints) + 1)]
    forces += list(zip(multipliers, constraints, strict=True))
    if any(len(chain) != 3 for chain in q):
        raise ModelError(f"{type(instance).model_id()}: energies need coordinates only, declared by coordinate()")
    residuals = []
    for position, dq, _ in q:
        momentum = sp.diff(kinetic, dq)
        rate = sum((sp.diff(momentum, x) * dx + sp.diff(momentum, dx) * ddx for x, dx, ddx in q), start=sp.S.Zero)
        work = sum((force * sp.diff(sp.sympify(velocity), dq) for force, velocity in forces), start=sp.S.Zero)
        residuals.append(rate - sp.diff(kinetic - potential, position) - work)
    return residuals + constraints, multipliers


def _expression(value: Any, where: str) -> Any:
    if value is None or isinstance(value, str | tuple | list):
        raise ModelError(f"{where} must return one expression, got {value!r}")
    return sp.sympify(value)


def _pairs(value: Any, where: str) -> list[tuple[Any, Any]]:
    pairs: list[Any] = list(value) if isinstance(value, list | tuple) else [None]
    if not all(isinstance(pair, list | tuple) and len(pair) == 2 for pair in pairs):
        raise ModelError(f"{where} must return a list of pairs, each a force and the velocity along it, got {value!r}")
    return [(force, velocity) for force, velocity in pairs]


def _optional(instance: Model, name: str, groups: dict[str, Names], default: Any) -> Any:
    method = getattr(instance, name, None)
    return default if method is None else call(method, groups)
