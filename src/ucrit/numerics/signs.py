"""On which side of the imaginary axis eigenvalues lie, where a matrix is known but for its rounding."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[Any]

SWEEPS = 6


def real_parts(A: Array, errors: Array) -> tuple[Array, Array]:
    """Return the real parts of eigenvalues, the largest first, and by how much each may be wrong.

    To first order an eigenvalue changes by ``y^H dA x``, its eigenvectors scaled to ``y^H x = 1``; where eigenvectors
    nearly coincide, no more than L. Elsner's bound allows (Linear Algebra and its Applications 71 (1985) 77-80).

    Parameters
    ----------
    A, errors
        Matrices of shape (..., n, n), and what each entry may be wrong by.

    Returns
    -------
    array, array
        Each of shape (..., n).

    Examples
    --------
    >>> A = np.array([[0.0, 1.0], [1e-14, 0.0]])
    >>> values, wrong = real_parts(A, 1e-12 * np.ones((2, 2)))
    >>> bool(values[0] > 0), bool(wrong[0] > values[0])
    (True, True)
    """
    n = A.shape[-1]
    with np.errstate(all="ignore"):
        values, right = np.linalg.eig(A)
        left = _inverse(right)
        first = np.einsum("...ki,...ij,...jk->...k", np.abs(left), errors, np.abs(right))
        scaled, wrong = _balanced(A, errors)
        size, off = np.linalg.norm(scaled, axis=(-2, -1)), np.linalg.norm(wrong, axis=(-2, -1))
        most = (2 * size + off) ** (1 - 1 / n) * off ** (1 / n)
    found = np.fmin(first, most[..., None])
    order = np.argsort(-values.real, axis=-1, kind="stable")
    return np.take_along_axis(values.real, order, -1), np.take_along_axis(found, order, -1)


def _inverse(matrices: Array) -> Array:
    """Return inverses, infinite for the singular ones."""
    try:
        return np.linalg.inv(matrices)
    except np.linalg.LinAlgError:
        n = matrices.shape[-1]
        flat = matrices.reshape(-1, n, n)
        full = np.abs(np.linalg.det(flat)) > 0
        found = np.full(flat.shape, np.inf, dtype=matrices.dtype)
        found[full] = np.linalg.inv(flat[full])
        return found.reshape(matrices.shape)


def _balanced(A: Array, errors: Array) -> tuple[Array, Array]:
    """Return matrices and their errors in units of the states in which rows and columns are about as large."""
    inside = ~np.eye(A.shape[-1], dtype=bool)
    size = np.abs(A) + errors
    for _ in range(SWEEPS):
        ratio = np.sum(size, axis=-2, where=inside) / np.sum(size, axis=-1, where=inside)
        scale = np.sqrt(np.where((ratio > 0) & np.isfinite(ratio), ratio, 1.0))
        by = scale[..., :, None] / scale[..., None, :]
        size, A, errors = size * by, A * by, errors * by
    return A, errors
