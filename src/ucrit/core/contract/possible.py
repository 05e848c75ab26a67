"""What values of several parameters may be together, beyond the bounds of each.

A model states it in a method ``possible(self)`` that returns a dictionary: what cannot be otherwise, in words with
the names of the parameters, and whether it is so. The values that are possible must form a convex set.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from ..errors import UcritError
from .declare import Parameter

STEPS = 80
WITHIN = 1e-7
"""Bounds keep this share away from where statements end, which hold up to rounding."""


def holds(model: type[Any], values: Mapping[str, Any]) -> Mapping[str, Any]:
    """Return which statements of a model hold for values of its parameters, numbers or arrays that broadcast."""
    if not hasattr(model, "possible"):
        return {}
    instance = object.__new__(model)
    instance.__dict__.update(values)
    found: Mapping[str, Any] = instance.possible()
    return found


def check_together(vehicle: Any) -> None:
    """Raise `UcritError` where the values of a vehicle are impossible together."""
    model = type(vehicle)
    if not hasattr(model, "possible"):
        return
    values = _corners(vehicle)
    for statement, true in holds(model, values).items():
        if not np.all(true):
            names = [name for name in re.findall(r"\w+", statement) if name in values]
            shape = np.broadcast_shapes(*(np.shape(values[name]) for name in names))
            first = np.unravel_index(np.argmin(np.broadcast_to(true, shape)), shape)
            got = (f"{name} = {np.broadcast_to(values[name], shape)[first]:g}" for name in names)
            raise UcritError(f"{model.model_id()}: {statement}, got {', '.join(got)}")


def _corners(vehicle: Any) -> dict[str, Any]:
    """Return the values by name; an array with a dimension of its own by its ends, which in a convex set will do."""
    dims, shared = list(vehicle.dims), vehicle._shared
    values: dict[str, Any] = {}
    for name, value in vehicle.values.items():
        if isinstance(value, np.ndarray):
            kept = value if name in shared else np.array([value.min(), value.max()])
            axis = dims.index(shared.get(name, name))
            value = kept.reshape([-1 if i == axis else 1 for i in range(len(dims))])
        values[name] = value
    return values


def allowed(vehicle: Any, name: str) -> Parameter:
    """Return the declaration of a parameter with its bounds narrowed to what the vehicle's other values leave."""
    declared: Parameter = type(vehicle).declaration.parameters[name]
    if not hasattr(type(vehicle), "possible"):
        return declared
    values, now = _corners(vehicle), np.asarray(vehicle.values[name])

    def fits(value: float) -> bool:
        return all(np.all(true) for true in holds(type(vehicle), {**values, name: value}).values())

    least = _end(fits, float(now.min()), declared.lower, -1)
    most = _end(fits, float(now.max()), declared.upper, 1)
    if least > declared.lower:
        declared = replace(declared, above=-math.inf, at_least=least)
    return replace(declared, below=math.inf, at_most=most) if most < declared.upper else declared


def _end(fits: Any, now: float, bound: float, sense: int) -> float:
    """Return the last value that fits between the present one and a bound, infinite where nothing limits it."""
    inside, outside = now, bound
    if math.isinf(bound):
        step = abs(now) or 1.0
        outside = next((x for x in (now + sense * step * 8.0**k for k in range(20)) if not fits(x)), bound)
    if math.isinf(outside) or fits(outside):
        return sense * math.inf
    for _ in range(STEPS):
        middle = (inside + outside) / 2
        inside, outside = (middle, outside) if fits(middle) else (inside, middle)
    within = inside - sense * WITHIN * max(abs(inside), abs(now))
    return within if (within - now) * sense > 0 else now
