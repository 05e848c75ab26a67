"""Stability of many matrices at once without their eigenvalues: balance, Hessenberg form, polynomial, Routh."""

from __future__ import annotations

from fractions import Fraction
from importlib.util import find_spec
from math import comb, lcm, prod
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .rounded import judged
from .routh import all_decay

Array = NDArray[np.float64]

_BLOCK = 2048  # matrices handled together, so that they and temporaries stay in the second-level cache
_COMPILED_PAYS = 100_000
_EPS = float(np.finfo(float).eps)
_EXACT_OPERATIONS = 4_000_000  # for the matrices of one call that eigenvalues do not settle: some seconds
_SWEEPS = 2  # of balancing; by powers of two, hence exact


def stable_matrices(A: ArrayLike, engine: str = "auto") -> NDArray[np.bool_]:
    """Tell of many real matrices at once whether all their eigenvalues lie in the open left half plane.

    The characteristic polynomial of the balanced matrices is computed from their Hessenberg form (I. C. F. Ipsen,
    R. Rehman, SIAM J. Matrix Anal. Appl. 30 (2008) 762-776, for its errors) and judged by Routh's array with error
    bounds; matrices for which that is not sure are judged by LAPACK's balanced eigenvalues where their error cannot
    matter, and exactly for the numbers given where it can.

    Parameters
    ----------
    A
        Shape (..., n, n), n at least 1.
    engine
        ``"numpy"``, ``"numba"`` (compiled, after some seconds for compiling), or ``"auto"``: numba for a hundred
        thousand matrices or more, where it is installed.

    Returns
    -------
    bool array of shape (...)
        A matrix is not stable if an eigenvalue lies on the imaginary axis, or if it holds a number that is not finite.
        Of very many that only exact numbers can settle (more than a thousand of order 8) the ones nearest to the axis
        are settled, and further ones are called not stable.

    Raises
    ------
    ValueError
        If the matrices are not square, or there is no such engine.
    ImportError
        If numba is asked for and not installed.

    Examples
    --------
    >>> stable_matrices([[[0, 1], [-2, -3]], [[0, 1], [2, -3]], [[0, 1], [-1, 0]]])
    array([ True, False, False])
    """
    matrices = np.asarray(A, dtype=float)
    if matrices.ndim < 2 or matrices.shape[-1] != matrices.shape[-2] or not matrices.shape[-1]:
        raise ValueError(f"matrices of shape {matrices.shape}: the last two dimensions must be equal and not 0")
    n = matrices.shape[-1]
    many: Array = matrices.reshape(-1, n, n)
    stable = np.zeros(prod(matrices.shape[:-2]), dtype=bool)
    by_numba = _by_numba(engine, len(many))
    block = _BLOCK * 64 if by_numba else _BLOCK
    for start in range(0, len(many), block):
        part = many[start : start + block]
        with np.errstate(all="ignore"):
            found, open_ = _compiled(part) if by_numba else _judged(part)
            sure: NDArray[np.bool_] = np.array(found)
        if open_.any():
            sure[open_] = _by_eigenvalues(part[open_])
        stable[start : start + block] = sure
    return stable.reshape(matrices.shape[:-2])


def eigenvalues_with_errors(A: ArrayLike) -> tuple[NDArray[np.complex128], Array]:
    """Return the eigenvalues of matrices, and how far from them those of the matrices before rounding may be.

    By the theorem of Bauer and Fike (G. H. Golub, C. F. Van Loan, Matrix Computations, 4th edition (2013), section
    7.2.3) for the balanced matrix, its eigenvectors' condition, and a hundred times its size's rounding.

    Parameters
    ----------
    A
        Shape (..., n, n), finite.

    Returns
    -------
    array, array
        Eigenvalues of shape (..., n) and one bound for them of shape (...); infinite where eigenvectors coincide.

    Examples
    --------
    >>> values, errors = eigenvalues_with_errors([[[-1, 1, 0], [0, -1, 1], [0, 0, -1]], np.diag([-1, -2, -3])])
    >>> bool(errors[0] > 1e-6), bool(errors[1] < 1e-12)
    (True, True)
    """
    matrices = np.asarray(A, dtype=float)
    n = matrices.shape[-1]
    H = np.ascontiguousarray(matrices.reshape(-1, n, n).transpose(1, 2, 0))
    with np.errstate(all="ignore"):
        _balance(H)
        balanced = np.moveaxis(H, 2, 0)
        values, vectors = np.linalg.eig(balanced)
        sizes = np.linalg.svd(vectors, compute_uv=False)
        errors = 100 * n * _EPS * np.linalg.norm(balanced, axis=(1, 2)) * sizes[:, 0] / sizes[:, -1]
    lead = matrices.shape[:-2]
    return values.astype(complex).reshape(*lead, n), np.asarray(
        np.where(np.isnan(errors), np.inf, errors).reshape(lead)
    )


def _by_numba(engine: str, count: int) -> bool:
    if engine not in ("auto", "numpy", "numba"):
        raise ValueError(f"there is no engine '{engine}'; allowed: auto, numpy, numba")
    return engine == "numba" or (engine == "auto" and count >= _COMPILED_PAYS and find_spec("numba") is not None)


def _errors(n: int) -> list[float]:
    """Errors of the coefficients: with a Frobenius norm of sqrt(n), that of s^(n-k) is at most comb(n, k)."""
    return [8 * n * k * _EPS * comb(n, k) + 1e-300 for k in range(n, -1, -1)]


def _compiled(matrices: Array) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    from .lanes import compiled

    codes = np.empty(len(matrices), dtype=np.uint8)
    compiled()(np.ascontiguousarray(matrices), np.array(_errors(matrices.shape[-1])), _SWEEPS, codes)
    return codes == 1, codes == 2


def _judged(matrices: Array) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    n = matrices.shape[-1]
    H = np.ascontiguousarray(matrices.transpose(1, 2, 0))
    _balance(H)
    size = np.sqrt((H * H).sum(axis=(0, 1)) / n)
    H /= np.where(size > 0, size, 1)
    _to_hessenberg(H)
    a = _polynomial(H)
    bounds = [float(comb(n, k)) for k in range(n, -1, -1)]
    return judged(a, bounds, _errors(n))


def _balance(H: Array) -> None:
    """Scale rows and columns by powers of two until they are about as large as each other."""
    n = len(H)
    inside = ~np.eye(n, dtype=bool)[:, :, None]
    for _ in range(_SWEEPS):
        size = np.abs(H) * inside
        ratio = size.sum(axis=0) / size.sum(axis=1)
        scale = np.exp2(np.rint(np.log2(np.where((ratio > 0) & np.isfinite(ratio), ratio, 1.0)) / 2))
        H *= scale[:, None]
        H /= scale[None]


def _to_hessenberg(H: Array) -> None:
    """Reduce matrices of shape (n, n, N) by Householder's reflections; what is eliminated is left behind."""
    n = len(H)
    for k in range(n - 2):
        v = H[k + 1 :, k].copy()
        rest = (v[1:] * v[1:]).sum(axis=0)
        first = v[0].copy()
        length = np.sqrt(first * first + rest)
        v[0] += np.where(first < 0, -length, length)
        squared = rest + v[0] * v[0]
        factor = np.where(squared > 0, 2 / np.where(squared > 0, squared, 1), 0.0)
        H[k + 1, k] = np.where(first < 0, length, -length)
        u = v * factor
        right = H[k + 1 :, k + 1 :]
        right -= u[:, None] * _sum(v[:, None] * right, 0)[None]
        below = H[:, k + 1 :]
        below -= _sum(below * v[None], 1)[:, None] * u[None]


def _sum(x: Array, axis: int) -> Array:
    return np.asarray(x.sum(axis=axis))


def _polynomial(H: Array) -> list[Any]:
    """Return ascending coefficients of det(s - H) by the recursion over leading blocks (Hyman's method)."""
    n, count = len(H), H.shape[-1]
    blocks = [np.ones((1, count))]
    for k in range(n):
        p = np.zeros((k + 2, count))
        p[1:] = blocks[k]
        p[:-1] -= H[k, k] * blocks[k]
        chain = np.ones(count)
        for i in range(k - 1, -1, -1):
            chain = chain * H[i + 1, i]
            p[: i + 1] -= (H[i, k] * chain) * blocks[i]
        blocks.append(p)
    return list(blocks[n])


def _by_eigenvalues(matrices: Array) -> NDArray[np.bool_]:
    """Judge matrices by eigenvalues whose error cannot matter, and those nearest to the axis by exact numbers."""
    n = matrices.shape[-1]
    finite = np.flatnonzero(np.isfinite(matrices).all(axis=(1, 2)))
    stable = np.zeros(len(matrices), dtype=bool)
    rates, errors = np.zeros(finite.size), np.zeros(finite.size)
    for start in range(0, finite.size, _BLOCK):
        block = slice(start, start + _BLOCK)
        values, errors[block] = eigenvalues_with_errors(matrices[finite[block]])
        rates[block] = values.real.max(axis=-1)
    stable[finite] = rates < -errors
    near = np.flatnonzero(~(np.abs(rates) > errors))
    for k in near[np.argsort(np.abs(rates[near]), kind="stable")][: _EXACT_OPERATIONS // n**4]:
        stable[finite[k]] = all_decay(_exact_polynomial(matrices[finite[k]]))
    return stable


def _exact_polynomial(matrix: Array) -> list[int]:
    """Return ascending coefficients of det(s - c A) in integers, with c > 0 (U. Le Verrier, D. K. Faddeev)."""
    numbers = [[Fraction(x) for x in row] for row in matrix.tolist()]
    common = lcm(*(x.denominator for row in numbers for x in row))
    A = np.array([[int(x * common) for x in row] for row in numbers], dtype=object)
    one = np.array([[int(i == j) for j in range(len(A))] for i in range(len(A))], dtype=object)
    product, found = one, [1]
    for k in range(1, len(A) + 1):
        product = A @ product
        found.append(-sum(product.diagonal().tolist()) // k)
        product = product + found[-1] * one
    return found[::-1]
