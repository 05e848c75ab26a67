"""Many polynomials at once: rows of coefficients in ascending powers, shape (N, degree + 1)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from .determinants import hurwitz_matrix

Array = NDArray[np.float64]

_NOISE = 1e-14
"""Leading coefficients below this share of the largest are what rounding left of zeros."""


def product(p: Array, q: Array) -> Array:
    """Return the products of polynomials, row by row.

    >>> product(np.array([[1.0, 1.0]]), np.array([[-1.0, 1.0]]))
    array([[-1.,  0.,  1.]])
    """
    found = np.zeros((len(p), p.shape[1] + q.shape[1] - 1))
    for k in range(q.shape[1]):
        found[:, k : k + p.shape[1]] += p * q[:, k : k + 1]
    return found


def total(p: Array, q: Array) -> Array:
    """Return the sums of polynomials, row by row."""
    found = np.zeros((len(p), max(p.shape[1], q.shape[1])))
    found[:, : p.shape[1]] += p
    found[:, : q.shape[1]] += q
    return found


def hurwitz_bundle(a: Sequence[Array]) -> Array:
    """Return H_(n-1) of polynomials in s whose n + 1 coefficients are polynomials in a parameter.

    Expanded by rows with shared minors: no division, and no loop over the N polynomials.

    >>> one, two = np.array([[1.0]]), np.array([[2.0, 1.0]])
    >>> hurwitz_bundle([one, two, np.array([[0.0, 3.0]]), one])
    array([[-1.,  6.,  3.]])
    """
    size, count = len(a) - 2, len(a[0])
    zero = np.zeros((count, 0))
    padded = [*a, zero]
    places = [row[:size] for row in hurwitz_matrix(range(len(a)))[:size]]
    used_zero = [row[:size] for row in hurwitz_matrix([1] * len(a))[:size]]
    minors: dict[int, Array] = {0: np.ones((count, 1))}
    for row, there in zip(places, used_zero, strict=True):
        following: dict[int, Array] = {}
        for used, minor in minors.items():
            for j, (k, present) in enumerate(zip(row, there, strict=True)):
                if present and padded[k].shape[1] and not used >> j & 1:
                    term = product(minor, padded[k])
                    term = -term if (used >> j).bit_count() % 2 else term
                    key = used | 1 << j
                    following[key] = total(following[key], term) if key in following else term
        minors = following
    return minors.get(2**size - 1, np.zeros((count, 1)))


def real_parts(p: Array) -> Array:
    """Return the positive real parts of the roots of each polynomial, infinity in place of the others.

    Shape (N, K). Eigenvalues of companion matrices: accurate where roots are simple. A polynomial that vanishes has
    no roots here.
    """
    size = np.abs(p)
    kept = np.flatnonzero((size > _NOISE * size.max(axis=1, keepdims=True)).any(axis=0))
    if len(kept) == 0 or kept[0] == kept[-1]:
        return np.zeros((len(p), 0))
    p = p[:, kept[0] : kept[-1] + 1]
    largest = np.abs(p).max(axis=1)
    degree = p.shape[1] - 1
    lead = np.where(np.abs(p[:, -1]) > 1e-16 * largest, p[:, -1], 1e-16 * largest)
    companion = np.zeros((len(p), degree, degree))
    companion[:, np.arange(1, degree), np.arange(degree - 1)] = 1.0
    with np.errstate(all="ignore"):
        companion[:, :, -1] = -p[:, :-1] / lead[:, None]
    good: NDArray[np.bool_] = np.asarray(np.isfinite(companion).all(axis=(1, 2)))
    roots = np.linalg.eigvals(np.where(good[:, None, None], companion, 0.0)).real
    return np.asarray(np.where(good[:, None] & (roots > 0), roots, np.inf))
