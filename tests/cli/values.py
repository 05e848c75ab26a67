"""Values of parameters, good and bad, made from what a model declares."""

from __future__ import annotations

import math
from typing import Any

from ucrit.catalogue import find_model, model_names
from ucrit.core.contract.declare import Parameter
from ucrit.core.contract.model import Model
from ucrit.core.units import dimension

EVERY = [(name, key) for name in model_names() for key in find_model(name).declaration.parameters]


def inside(p: Parameter) -> float:
    """Return a value that the bounds of a parameter allow."""
    if math.isfinite(p.lower) and math.isfinite(p.upper):
        return (p.lower + p.upper) / 2
    if math.isfinite(p.lower):
        return p.lower + 1
    return p.upper - 1 if math.isfinite(p.upper) else 0.1


def sample(model: type[Model]) -> dict[str, float]:
    """Return one allowed value of every parameter."""
    return {name: inside(p) for name, p in model.declaration.parameters.items()}


def bad_values(p: Parameter) -> list[Any]:
    """Return values that no parameter like this may have, with what the sentence must hold."""
    other = "m" if dimension(p.unit) != dimension("m") else "kg"
    bad: list[Any] = [math.nan, math.inf, -math.inf, "much", f"3 {other}", "3 flurbs", "", True, {"a": 1}]
    for bound, outward, open_ in ((p.lower, -1, p.above == p.lower), (p.upper, 1, p.below == p.upper)):
        if math.isfinite(bound):
            bad.append(bound + outward)
            bad += [bound] if open_ else []
    return [*bad, 0.0] if p.is_speed else bad


def toml(value: Any) -> str:
    """Return a value as TOML writes it."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, dict):
        return "{" + ", ".join(f"{k} = {toml(v)}" for k, v in value.items()) + "}"
    return f'"{value}"' if isinstance(value, str) else repr(value)
