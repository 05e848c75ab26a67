"""Margins of many loops at once, from the roots of the polynomials that say where something happens.

A loop is ``L = n/d``; stacks of polynomials have ascending coefficients along the last axis.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[Any]

REAL = 1e-6
"""Share of a root that its imaginary part may be for the root to count as real."""

NONE = 1e-13
"""Leading coefficients below this share of the largest make roots at infinity."""


class LoopMargins(NamedTuple):
    """Margins of loops, each of the stack's shape.

    ``gain_up`` and ``gain_down`` are the factors at which stability ends, ``phase`` [rad] and ``delay`` what may be
    added before it does, ``disk`` the size alpha of the disk of gain and phase changes together.
    """

    gain_up: Array
    gain_down: Array
    phase: Array
    delay: Array
    disk: Array


def from_roots(roots: Array) -> Array:
    """Return monic polynomials with the given roots, shape (..., n) to (..., n + 1); the coefficients are real."""
    found = np.ones((*roots.shape[:-1], 1), dtype=complex)
    for k in range(roots.shape[-1]):
        longer = np.zeros((*found.shape[:-1], found.shape[-1] + 1), dtype=complex)
        longer[..., 1:] = found
        longer[..., :-1] -= roots[..., k, None] * found
        found = longer
    return np.asarray(found.real)


def times(one: Array, other: Array) -> Array:
    """Return products of polynomials."""
    lead = np.broadcast_shapes(one.shape[:-1], other.shape[:-1])
    found = np.zeros((*lead, one.shape[-1] + other.shape[-1] - 1))
    for k in range(one.shape[-1]):
        found[..., k : k + other.shape[-1]] += one[..., k, None] * other
    return found


def positive_roots(p: Array) -> Array:
    """Return the real roots above zero of polynomials (..., n + 1), others as nan, shape (..., n)."""
    size = np.abs(p).max(axis=-1, keepdims=True)
    p = np.where(np.abs(p) > NONE * size, p, 0.0) / np.where(size > 0, size, 1.0)
    while p.shape[-1] > 1 and not np.any(p[..., -1]):
        p = p[..., :-1]
    n = p.shape[-1] - 1
    if not n:
        return np.full((*p.shape[:-1], 0), np.nan)
    leading = np.where(p[..., -1:] == 0, 1e-200, p[..., -1:])
    with np.errstate(all="ignore"):
        ratios = np.clip(-p[..., :-1] / leading, -1e150, 1e150)
    companion = np.zeros((*p.shape[:-1], n, n))
    companion[..., np.arange(1, n), np.arange(n - 1)] = 1
    companion[..., :, -1] = ratios
    roots = np.linalg.eigvals(companion).astype(complex)
    real = (np.abs(roots.imag) <= REAL * np.abs(roots)) & (roots.real > 0) & (roots.real < 1e16)
    return np.where(real, roots.real, np.nan)


def _split(p: Array) -> tuple[Array, Array]:
    """Return E and O, polynomials in ``w = omega**2``, of ``p(j omega) = E + j omega O``."""
    even, odd = p[..., 0::2].copy(), p[..., 1::2].copy()
    even *= (-1.0) ** np.arange(even.shape[-1])
    odd *= (-1.0) ** np.arange(odd.shape[-1])
    return even, odd if odd.shape[-1] else np.zeros((*p.shape[:-1], 1))


def _added(one: Array, other: Array) -> Array:
    n = max(one.shape[-1], other.shape[-1])
    found = np.zeros((*np.broadcast_shapes(one.shape[:-1], other.shape[:-1]), n))
    found[..., : one.shape[-1]] += one
    found[..., : other.shape[-1]] += other
    return found


def _squared(p: Array) -> Array:
    """Return ``|p(j omega)|^2`` as a polynomial in w."""
    even, odd = _split(p)
    shifted = times(odd, odd)
    return _added(times(even, even), np.concatenate([np.zeros_like(shifted[..., :1]), shifted], axis=-1))


def _at(p: Array, s: Array) -> Array:
    total = np.zeros(np.broadcast_shapes((*p.shape[:-1], 1), s.shape), dtype=complex)
    for k in reversed(range(p.shape[-1])):
        total = total * s + p[..., k, None]
    return total


def loop_margins(n: Array, d: Array) -> LoopMargins:
    """Return the margins of loops ``n/d`` that are stable when closed by negative feedback.

    Parameters
    ----------
    n, d
        Polynomials (..., k), ascending; the degree of ``n`` is at most that of ``d``.
    """
    n = _added(n, np.zeros(d.shape[-1]))
    with np.errstate(all="ignore"):
        down, up = _gains(n, d)
        phase, delay = _phases(n, d)
        return LoopMargins(up, down, phase, delay, _disk(n, d))


def _gains(n: Array, d: Array) -> tuple[Array, Array]:
    (even_n, odd_n), (even_d, odd_d) = _split(n), _split(d)
    w = positive_roots(_added(times(odd_n, even_d), -times(even_n, odd_d)))
    s = 1j * np.sqrt(w)
    L = (_at(n, s) / _at(d, s)).real
    ends = [n[..., :1] / d[..., :1], n[..., -1:] / d[..., -1:]]
    L = np.concatenate([L, *ends], axis=-1)
    k = np.where(L < 0, -1 / L, np.nan)
    up = np.where(k > 1, k, np.inf).min(axis=-1)
    down = np.where(k < 1, k, 0.0).max(axis=-1)
    return down, up


def _phases(n: Array, d: Array) -> tuple[Array, Array]:
    w = positive_roots(_added(_squared(n), -_squared(d)))
    omega = np.sqrt(w)
    L = _at(n, 1j * omega) / _at(d, 1j * omega)
    to_go = np.mod(np.angle(L) + np.pi, 2 * np.pi)
    phase = np.where(np.isnan(w), np.inf, np.minimum(to_go, 2 * np.pi - to_go))
    delay = np.where(np.isnan(w), np.inf, to_go / omega)
    return phase.min(axis=-1, initial=np.inf), delay.min(axis=-1, initial=np.inf)


def _disk(n: Array, d: Array) -> Array:
    """Return ``1/max|(1 - L)/(2(1 + L))|`` over all frequencies."""
    above, below = _squared(_added(d, -n)), _squared(_added(d, n))

    def slope(p: Array) -> Array:
        return p[..., 1:] * np.arange(1, p.shape[-1])

    w = positive_roots(_added(times(slope(above), below), -times(above, slope(below))))
    values = (_at(above, w) / _at(below, w)).real
    ends = [above[..., :1] / below[..., :1], above[..., -1:] / below[..., -1:]]
    most = np.nanmax(np.concatenate([values, *ends], axis=-1), axis=-1)
    return np.asarray(2 / np.sqrt(most))
