"""Branches of a root locus at very many points: interpolated between tracked ones, then corrected to full accuracy."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ...core.numeric.compiled import coefficients, compiled, direction
from ...numerics.assignment import assign
from ..linear.modes import eigenvalues

Array = npt.NDArray[Any]

HIGHEST = 6
"""Order above which roots of the characteristic polynomial may be less accurate than eigenvalues."""

ACCURATE = 1e-9
"""Difference from LAPACK's eigenvalues, as a share of the largest, that is allowed at the tracked points."""

ROUNDS = 4
CLOSE = 0.2
"""Correction, as a share of the distance to the nearest other root, above which a root counts as in doubt."""


def dense_branches(vehicle: Model, name: str, values: Array, nodes: Array, branches: Array) -> Array | None:
    """Return branches at many values, shape (values, n), that continue those tracked at fewer nodes.

    Where a root is in doubt eigenvalues take the place of corrected roots. ``None`` where that is no gain: a high
    order, zero roots, polynomials whose roots are not accurate enough, or doubt nearly everywhere.
    """
    functions = compiled(type(vehicle), direction(vehicle))
    if functions.order > HIGHEST or functions.structural_zeros:
        return None
    checked, sure = _corrected(vehicle, name, nodes, branches)
    size = np.abs(branches).max(axis=1)
    if not sure.any() or (np.abs(checked - branches).max(axis=1) > ACCURATE * size)[sure].any():
        return None
    at = np.clip(np.searchsorted(nodes, values, side="right") - 1, 0, len(nodes) - 2)
    share = ((values - nodes[at]) / (nodes[at + 1] - nodes[at]))[:, None]
    guess = branches[at] * (1 - share) + branches[at + 1] * share
    found, sure = _corrected(vehicle, name, values, guess)
    real = branches.imag == 0
    sure &= (real[at] == real[at + 1]).all(axis=1)
    found = np.where(real[at], found.real, found)
    doubt = np.flatnonzero(~sure)
    if len(doubt) > len(values) // 4:
        return None
    if doubt.size:
        exact = eigenvalues(vehicle.with_(**{name: values[doubt]}))
        links = assign(np.abs(guess[doubt][:, :, None] - exact[:, None, :]) ** 2)
        found[doubt] = np.take_along_axis(exact, links, axis=1)
    return found


def _corrected(vehicle: Model, name: str, values: Array, guess: Array) -> tuple[Array, npt.NDArray[np.bool_]]:
    """Correct all roots of the polynomials at once (K. Weierstrass 1891), and tell where that is sure."""
    a = coefficients(vehicle.with_(**{name: values}))
    lead = np.asarray(a[-1], dtype=float)
    z = np.ascontiguousarray(guess.T)
    start, order = z.copy(), len(z)
    with np.errstate(all="ignore"):
        monic = [np.asarray(c, dtype=float) / lead for c in a[:-1]]
        for _ in range(ROUNDS):
            value = np.ones_like(z)
            for c in monic[::-1]:
                value = value * z + c
            apart = np.ones_like(z)
            for k in range(1, order):
                apart *= z - np.roll(z, k, axis=0)
            step = value / apart
            z = z - step
        gap = np.min([np.abs(z - np.roll(z, k, axis=0)) for k in range(1, order)], axis=0) if order > 1 else np.inf
        sure = (np.abs(z - start) < CLOSE * gap) & (np.abs(step) < 1e-12 * np.abs(z).max(axis=0))
    return np.ascontiguousarray(z.T), np.asarray(sure.all(axis=0))
