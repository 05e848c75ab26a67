"""Random non-linear states, inputs and parameters at which motions are compared."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import sympy as sp

from ..core.derivation.nonlinear import constraints
from ..core.derivation.trace import Traced
from ..core.formulas.codegen import build, generate
from .sample import Array
from .subject import Subject

COUNT = 64
REACH = 0.4


@dataclass(frozen=True)
class States:
    """States and inputs (first axis: which; second: sample) with a parameter set for each sample."""

    w: Array
    u: Array
    parameters: list[Array]


def random_states(subject: Subject, purpose: str, count: int = COUNT, reach: float = REACH) -> States:
    """Return random states about the basic motion that satisfy the model's constraints."""
    rng, traced = subject.rng(f"states for {purpose}"), subject.traced
    parameters = subject.parameter_sets(purpose, count, subject.either)
    w, u = (np.broadcast_to(v.T, (count, v.shape[0])).T for v in subject.motion.basic(parameters))
    w = w + rng.uniform(-reach, reach, (len(traced.states), count))
    u = u + rng.uniform(-reach, reach, (len(traced.u), count))
    return States(_onto(constraints(traced), traced, w, u, parameters), u, parameters)


def _onto(conditions: list[Any], traced: Traced, w: Array, u: Array, parameters: list[Array]) -> Array:
    """Move states by Gauss-Newton steps, the shortest there are, until the conditions hold."""
    if not conditions:
        return w
    rows, columns = len(conditions), len(traced.states)
    slopes = list(sp.Matrix(conditions).jacobian(sp.Matrix(traced.states)))
    groups = [traced.states, traced.u, list(traced.parameters.values())]
    function = build(generate("conditions", groups, [*conditions, *slopes]), "conditions")
    for _ in range(50):
        values = stacked(function(w, u, parameters), w)
        slope = np.moveaxis(values[rows:].reshape(rows, columns, -1), -1, 0)
        step = np.linalg.pinv(slope) @ np.moveaxis(values[:rows], -1, 0)[..., None]
        w = w - step[..., 0].T
        if np.abs(step).max() < 1e-13:
            break
    return w


def stacked(values: tuple[Any, ...], like: Array) -> Array:
    """Return the values of a generated function as one array, samples along the last axis."""
    return np.array([np.broadcast_to(value, like.shape[1:]) for value in values], dtype=float).reshape(
        len(values), *like.shape[1:]
    )


def differs(left: Array, right: Array, tolerance: float = 1e-8, floor: Array | float = 0.0) -> bool:
    """Tell whether rows of samples differ, relative to each value, to the row's median and to ``floor``."""
    if not left.size:
        return False
    magnitude = np.maximum(np.abs(left), np.abs(right))
    size = np.maximum(magnitude, np.maximum(np.median(magnitude, axis=-1, keepdims=True), floor))
    return not bool(np.all(np.abs(left - right) <= tolerance * size))
