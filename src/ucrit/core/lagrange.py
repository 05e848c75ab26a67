"""Lagrange's equations from energies, forces with the velocities of their points, and velocity constraints."""

from __future__ import annotations

from typing import Any

import sympy as sp

from .errors import ModelError
from .model import Model, Names, call


def lagrange(
    instance: Model, groups: dict[str, Names], q: list[tuple[sp.Symbol, ...]]
) -> tuple[list[Any], list[sp.Symbol]]:
    """Return the residuals ``d/dt dL/dq' - dL/dq - Q`` (one per coordinate) and then the constraints.

    A force F on a point that moves with velocity v(q, q') along it does virtual work ``F dv/dq'_j`` on coordinate j.
    Each constraint, a velocity that is zero, acts through a multiplier: a force along that velocity, returned as
    a further unknown (the workless force that keeps it zero).

    Source: L. Meirovitch, Methods of Analytical Dynamics (1970), sections 2.11 and 2.13.
    """
    kinetic = sp.sympify(call(instance.kinetic_energy, groups))  # type: ignore[attr-defined]
    potential = sp.sympify(_optional(instance, "potential_energy", groups, 0))
    forces = list(_optional(instance, "forces", groups, ()))
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


def _optional(instance: Model, name: str, groups: dict[str, Names], default: Any) -> Any:
    method = getattr(instance, name, None)
    return default if method is None else call(method, groups)
