"""Exponentials of stacks of small matrices, in NumPy alone.

`scipy.linalg.expm` goes through a stack matrix by matrix in threaded LAPACK: on a busy machine a few hundred 5 x 5
matrices have taken seconds. This one treats the stack as a whole.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[Any]

PADE = (
    *(64764752532480000.0, 32382376266240000.0, 7771770303897600.0, 1187353796428800.0, 129060195264000.0),
    *(10559470521600.0, 670442572800.0, 33522128640.0, 1323241920.0, 40840800.0, 960960.0, 16380.0, 182.0, 1.0),
)
"""Coefficients of the numerator of degree 13, ascending; the denominator's alternate in sign."""
REACH = 5.371920351148152
"""Norm up to which that approximant is exact to double precision."""
SWEEPS = 4
"""Rounds of balancing; the equations of vehicles need two or three."""


def expm(matrices: Any) -> Array:
    """Return the exponential of each matrix of a stack of shape (..., n, n).

    Scaling and squaring with one Pade approximant (N. J. Higham, SIAM J. Matrix Anal. Appl. 26 (2005) 1179-1193),
    after balancing by powers of two. What is too large for a double becomes infinite or not a number.

    Examples
    --------
    >>> expm([[0.0, 1.0], [0.0, 0.0]])
    array([[1., 1.],
           [0., 1.]])
    """
    A = np.asarray(matrices, dtype=float)
    with np.errstate(all="ignore"):
        scale = _balance(A)
        balanced = A * scale[..., None, :] / scale[..., :, None]
        norm = np.abs(balanced).sum(axis=-2).max(axis=-1, initial=0.0)
        halvings = np.ceil(np.log2(np.maximum(norm / REACH, 1.0))).astype(int)
        F = _pade(balanced * 0.5 ** halvings[..., None, None])
        for k in range(halvings.max(initial=0)):
            F = np.where((k < halvings)[..., None, None], F @ F, F)
        return np.asarray(F * scale[..., :, None] / scale[..., None, :])


def _pade(A: Array) -> Array:
    b, identity = PADE, np.eye(A.shape[-1])
    A2 = A @ A
    A4 = A2 @ A2
    A6 = A4 @ A2
    odd = A6 @ (b[13] * A6 + b[11] * A4 + b[9] * A2) + b[7] * A6 + b[5] * A4 + b[3] * A2 + b[1] * identity
    even = A6 @ (b[12] * A6 + b[10] * A4 + b[8] * A2) + b[6] * A6 + b[4] * A4 + b[2] * A2 + b[0] * identity
    U = A @ odd
    return np.linalg.solve(even - U, even + U)


def _balance(A: Array) -> Array:
    """Powers of two that bring rows and columns to like sizes (E. E. Osborne, J. ACM 7 (1960) 338-345).

    Sizes count from 1, below which nothing needs halving: so the ones of integrators shrink, whose column is zero.
    """
    size = np.abs(A) * (1 - np.eye(A.shape[-1]))
    total = np.ones(A.shape[:-1])
    for _ in range(SWEEPS):
        for i in range(A.shape[-1]):
            column, row = (np.maximum(part.sum(axis=-1), 1.0) for part in (size[..., :, i], size[..., i, :]))
            f = 2.0 ** np.round(np.log2(row / column) / 2)
            size[..., :, i] *= f[..., None]
            size[..., i, :] /= f[..., None]
            total[..., i] *= f
    return total
