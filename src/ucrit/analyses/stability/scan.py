"""Stability changes along a parameter found by eigenvalues: for models that are no polynomials in it."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ...core.contract.possible import allowed
from ..linear.modes import eigenvalues, growth, rigid_positions

POINTS = 2001
"""Points at which stability is sampled; two changes closer together than a step of these can be missed."""

AXIS = 1e-9
"""Real parts below this share of the largest eigenvalue count as zero."""

Array = npt.NDArray[Any]


def scan(vehicle: Model, name: str, lo: float, hi: float) -> Any:
    """Return boundary values with their kinds, and the stability of the intervals between them.

    A vehicle whose motion never decays counts as stable while it does not grow. Values are refined by bisection to
    the last digit; their accuracy is that of the eigenvalues, about 1e-12 relative where the crossing is transverse.
    """
    grid = _grid(vehicle, name, lo, hi)
    rates = _growth(vehicle, name, grid)
    unstable = rates > AXIS
    changes = np.flatnonzero(unstable[1:] != unstable[:-1])
    left, right, was = grid[changes], grid[changes + 1], unstable[changes]
    stable_side = np.where(was, rates[changes + 1], rates[changes])
    threshold = np.where(stable_side < -AXIS, 0.0, AXIS)  # a motion that decays crosses at exactly zero
    for _ in range(60):
        middle = (left + right) / 2
        same = (_growth(vehicle, name, middle) > threshold) == was
        left, right = np.where(same, middle, left), np.where(same, right, middle)
    edges = [(float(value), _kind(vehicle, name, float(value))) for value in (left + right) / 2]
    return edges, [not unstable[0], *(bool(state) for state in was)]


def _grid(vehicle: Model, name: str, lo: float, hi: float) -> Array:
    """Even steps in a finite range; in an open one even steps of the logarithm, around the present value."""
    now = abs(float(vehicle.values[name])) or 1.0
    if math.isfinite(lo) and math.isfinite(hi):
        return np.asarray(np.linspace(lo, hi, POINTS + 2)[1:-1])
    magnitudes = now * np.logspace(-4, 4, POINTS)
    if math.isfinite(lo):
        return np.asarray(lo + magnitudes)
    if math.isfinite(hi):
        return np.asarray(hi - magnitudes[::-1])
    return np.concatenate([-magnitudes[::-1], magnitudes])


def _growth(vehicle: Model, name: str, values: Array) -> Array:
    """Largest real part relative to the largest modulus; impossible values take the present one."""
    if not values.size:
        return np.zeros(0)
    possible = allowed(vehicle, name).allows(values)
    found = eigenvalues(vehicle.with_(**{name: np.where(possible, values, vehicle.values[name])}))
    return np.asarray(growth(vehicle, found) / np.abs(found).max(axis=-1))


def _kind(vehicle: Model, name: str, value: float) -> set[str]:
    found = eigenvalues(vehicle.with_(**{name: value}))
    nearest = found[np.argmin(np.where(rigid_positions(vehicle, found), np.inf, np.abs(found.real)))]
    return {"flutter" if abs(nearest.imag) > AXIS * np.abs(found).max() else "divergence"}
