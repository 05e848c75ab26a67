"""Stability and right-half-plane roots of many real polynomials at once, from their coefficients.

Coefficients are in ascending powers, ``a[0] + a[1] s + ... + a[n] s^n``.
"""

from collections.abc import Iterator, Sequence
from functools import reduce
from math import prod
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .routh import routh

Array = NDArray[np.float64]

_BLOCK = 32768  # points handled together, so that temporaries stay in the cache
_EPS = float(np.finfo(float).eps)
_UNDERFLOW = 1e-300  # added to error bounds: what products below the smallest double may lose


def stable(a: Sequence[ArrayLike]) -> NDArray[np.bool_]:
    """Whether every root of ``a[0] + a[1] s + ... + a[n] s^n`` lies strictly in the left half plane.

    Up to n = 4 the conditions of Lienard and Chipart are written out (Gantmacher, The Theory of Matrices 2,
    ch. XV sec. 13); above, Routh's recursion runs on whole arrays.

    Parameters
    ----------
    a : n + 1 scalars or arrays that broadcast together; the overall sign of the polynomial does not matter.
        Keep a coefficient that varies along one axis only as a thin array: less work.

    Returns
    -------
    bool array of the broadcast shape : marginal is not stable; ``a[n] = 0`` (a root at infinity) and NaN are
        not stable. For n = 3 and 4 right unless the two products compared agree to 2e-15 of their value, and
        for coefficients between 1e-100 and 1e100 or zero; for other n exact for the numbers given, points
        within rounding of the boundary going through `routh` one by one.

    Raises
    ------
    ValueError
        If there are fewer than two coefficients or they do not broadcast.

    Examples
    --------
    >>> stable([1, [2, 0, -1], 1])
    array([ True, False, False])
    """
    if len(a) < 2:
        raise ValueError(f"{len(a)} coefficients given: stability needs a polynomial of degree one or more")
    arrays = [np.asarray(x, dtype=float) for x in a]
    shape = np.broadcast_shapes(*(x.shape for x in arrays))
    if not (arrays[-1] > 0).all():
        sign = np.sign(arrays[-1])
        arrays = [x * sign for x in arrays]
    criterion = _stable_up_to_4 if len(a) <= 5 else _stable_by_routh
    result = np.empty(shape, dtype=bool)
    with np.errstate(all="ignore"):
        for block in _blocks(shape):
            result[block] = criterion([x[block] if _spans(x, shape) else x for x in arrays])
    return result


def right_half_plane(a: ArrayLike) -> NDArray[np.int64]:
    """The number of roots in the open right half plane, with multiplicity, for many polynomials at once.

    Routh's recursion with a running error bound counts where every sign is certain. Points near a boundary
    are counted by balanced companion eigenvalues and discs that must contain the roots. What is still open, a
    root within rounding of the imaginary axis, is settled by the exact array of `routh`, one point at a time
    (about 50 microseconds each).

    Parameters
    ----------
    a : shape (..., n + 1), coefficients along the last axis, ``a[..., n]`` not zero

    Returns
    -------
    int array of shape (...) : exact for the numbers given, however they are scaled; a root on the axis does
    not count

    Raises
    ------
    ValueError
        If a coefficient is not finite or a leading coefficient is zero.

    Examples
    --------
    >>> right_half_plane([[2, 3, 1], [2, -3, 1], [1, 0, 1]])
    array([0, 2, 0])
    """
    coefficients = np.asarray(a, dtype=float)
    if coefficients.ndim == 0 or coefficients.shape[-1] == 0:
        raise ValueError(f"coefficients of shape {coefficients.shape}: the last axis must hold at least one")
    if not np.isfinite(coefficients).all():
        raise ValueError(f"{np.sum(~np.isfinite(coefficients))} coefficients are not finite: all must be")
    if not coefficients[..., -1].all():
        raise ValueError(f"{np.sum(coefficients[..., -1] == 0)} leading coefficients are 0: none may be")
    points = coefficients.reshape(-1, coefficients.shape[-1])
    count = np.zeros(len(points), dtype=np.int64)
    if points.shape[1] == 1:
        return count.reshape(coefficients.shape[:-1])
    with np.errstate(all="ignore"):
        for start in range(0, len(points), _BLOCK):
            block = _scaled(points[start : start + _BLOCK])
            count[start : start + _BLOCK], certain = sign_changes(list(np.ascontiguousarray(block.T)))
            unsure = np.flatnonzero(~certain)
            if len(unsure):
                count[start + unsure], certain = _count_by_eigenvalues(block[unsure])
                for k in start + unsure[~certain]:
                    count[k] = routh(points[k]).right_half_plane or 0
    return count.reshape(coefficients.shape[:-1])


def _spans(x: Array, shape: tuple[int, ...]) -> bool:
    """True if `x` varies along the first axis of `shape`."""
    return x.ndim == len(shape) > 0 and x.shape[0] == shape[0]


def _blocks(shape: tuple[int, ...]) -> Iterator[Any]:
    """Slices of the first axis that keep a block of the array small."""
    if len(shape) == 0 or prod(shape) <= 2 * _BLOCK:
        yield ...
        return
    step = max(1, _BLOCK // prod(shape[1:]))
    for start in range(0, shape[0], step):
        yield slice(start, start + step)


def _stable_up_to_4(a: Sequence[Array]) -> Any:
    """Lienard-Chipart for degree 1 to 4 and a positive leading coefficient."""
    signs = [a[-1] > 0, *(x > 0 for x in a[:-1])]
    if len(a) == 4:
        signs[2] = a[1] * a[2] > a[0] * a[3]
    elif len(a) == 5:
        signs[3] = a[1] * (a[2] * a[3] - a[4] * a[1]) > a[0] * (a[3] * a[3])
    # The thin conditions are combined first, among themselves.
    return reduce(np.logical_and, sorted(signs, key=np.size))


def _stable_by_routh(a: Sequence[Array]) -> Any:
    """Routh's recursion, and the exact array at the points where a pivot is lost in rounding."""
    changes, certain = sign_changes(a)
    result = np.asarray(certain & (changes == 0) & (a[-1] > 0))
    possible = reduce(np.logical_and, ((x > 0) & np.isfinite(x) for x in sorted(a, key=np.size)))
    for k in np.argwhere(possible & ~certain):
        array = routh([np.broadcast_to(x, result.shape)[tuple(k)] for x in a])
        result[tuple(k)] = array.right_half_plane == 0 == array.imaginary_axis
    return result


def _scaled(a: Array) -> Array:
    """The polynomials with s and the whole scaled by powers of two: first and last term are of order 1."""
    degree = a.shape[1] - 1
    exponent = np.where(a == 0, 0, np.frexp(a)[1])
    lowest = np.argmax(a != 0, axis=1)
    lead = exponent[:, -1]
    gap = np.take_along_axis(exponent, lowest[:, None], axis=1)[:, 0] - lead
    step = np.rint(gap / np.maximum(degree - lowest, 1)).astype(int)
    scaled: Array = np.ldexp(a, step[:, None] * (np.arange(degree + 1) - degree) - lead[:, None])
    exact = np.isfinite(scaled) & ((np.abs(scaled) >= np.finfo(float).tiny) | (a == 0))
    scaled[~exact.all(axis=1)] = np.nan  # leaves these points to exact arithmetic
    return scaled


def sign_changes(a: Sequence[Array], error: Sequence[Any] | None = None) -> tuple[NDArray[Any], NDArray[np.bool_]]:
    """Sign changes of Routh's first column, and where its signs hold whatever was rounded."""
    upper, lower = list(a[::-2]), list(a[-2::-2])
    errors: list[Any] = [np.zeros(())] * len(a) if error is None else list(error)
    upper_error: list[Any] = errors[::-2]
    lower_error: list[Any] = errors[-2::-2]
    changes: NDArray[Any] = np.zeros((), dtype=np.int64)
    certain: NDArray[np.bool_] = np.ones((), dtype=bool)
    while lower:
        pivot, doubt = np.abs(lower[0]), lower_error[0]
        certain = certain & (pivot > 2 * doubt)
        changes = changes + ((upper[0] < 0) != (lower[0] < 0))
        ratio = upper[0] / lower[0]
        size = np.abs(ratio)
        slack = (upper_error[0] + size * doubt) / (pivot - doubt) + _EPS * size
        row, row_error = upper[1:], upper_error[1:]
        for j in range(len(lower) - 1):
            product = ratio * lower[j + 1]
            row[j] = row[j] - product
            grown = (size + slack) * lower_error[j + 1] + slack * np.abs(lower[j + 1])
            rounding = _EPS * (np.abs(product) + np.abs(row[j])) + _UNDERFLOW
            row_error[j] = row_error[j] + grown + rounding
        upper, lower, upper_error, lower_error = lower, row, lower_error, row_error
    return changes, certain


def _count_by_eigenvalues(a: Array) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
    """Eigenvalues to the right, and where discs that must contain the roots all keep clear of the axis.

    Discs of radius ``n |p(z_i)| / |a_n prod (z_i - z_j)|`` contain all roots, and a connected union of m of
    them contains m (Smith 1970).
    """
    degree = a.shape[1] - 1
    companion = np.zeros((len(a), degree, degree))
    companion[:, 0] = -a[:, -2::-1] / a[:, -1:]
    companion[:, np.arange(1, degree), np.arange(degree - 1)] = 1.0
    usable: NDArray[np.bool_] = np.asarray(np.isfinite(companion).all(axis=(1, 2)))
    roots = np.linalg.eigvals(np.where(usable[:, None, None], companion, 0.0)).astype(complex)
    others = ~np.eye(degree, dtype=bool)
    for last in (False, False, True):
        value = np.zeros_like(roots)
        noise = np.zeros(roots.shape)
        for c in a.T[::-1, :, None]:
            value = value * roots + c
            noise = noise * np.abs(roots) + np.abs(c)
        apart = a[:, -1:] * np.prod(roots[:, :, None] - roots[:, None, :], axis=2, where=others)
        if not last:
            roots = roots - value / apart  # Weierstrass' correction: eigenvalues are accurate for large roots only
    radius = 2 * degree * (np.abs(value) + 4 * degree * _EPS * noise) / np.abs(apart)
    clear = (np.abs(roots.real) > radius) & np.isfinite(apart)
    return np.sum(roots.real > 0, axis=1), usable & clear.all(axis=1)
