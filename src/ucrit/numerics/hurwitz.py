"""Stability and right-half-plane roots of many real polynomials at once, from their coefficients.

Coefficients are in ascending powers, ``a[0] + a[1] s + ... + a[n] s^n``.
"""

from collections.abc import Iterator, Sequence
from functools import reduce
from math import prod
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

_BLOCK = 32768  # points handled together, so that temporaries stay in the cache
_EPS = float(np.finfo(float).eps)


def stable(a: Sequence[ArrayLike]) -> NDArray[np.bool_]:
    """Whether every root of ``a[0] + a[1] s + ... + a[n] s^n`` lies strictly in the left half plane.

    Up to n = 4 the conditions of Lienard and Chipart are written out (Gantmacher, The Theory of Matrices 2,
    ch. XV sec. 13); above, Routh's recursion runs on whole arrays. No loop over points.

    Parameters
    ----------
    a : n + 1 scalars or arrays that broadcast together; the overall sign of the polynomial does not matter.
        Keep a coefficient that varies along one axis only as a thin array: less work.

    Returns
    -------
    bool array of the broadcast shape : marginal is not stable; ``a[n] = 0`` (a root at infinity) and NaN are
        not stable. Up to n = 4 the answer is right unless the products compared agree to 8 units of rounding
        (2e-15); above, unless a pivot is as small as its own rounding error. Non-zero coefficients must lie
        between 1e-100 and 1e100.

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
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        for block in _blocks(shape):
            result[block] = criterion([x[block] if _spans(x, shape) else x for x in arrays])
    return result


def right_half_plane(a: ArrayLike) -> NDArray[np.int64]:
    """The number of roots in the open right half plane, with multiplicity, for many polynomials at once.

    Routh's recursion with a running error bound counts where every sign is certain; only the points near a
    boundary are counted by balanced companion eigenvalues, polished by Newton steps on the polynomial.

    Parameters
    ----------
    a : shape (..., n + 1), coefficients along the last axis, ``a[..., n]`` not zero

    Returns
    -------
    int array of shape (...) : exact for the given coefficients unless a root is so close to the imaginary
    axis that
        a relative change of the coefficients of 2n units of rounding could move it there (for a simple
        well-separated root 1e-15 of its magnitude, for a double one 1e-7); such a root counts as on the axis,
        not right of it. Scaling of s and of the polynomial does not matter. Non-zero coefficients must lie
        between 1e-100 and 1e100.

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
    with np.errstate(all="ignore"):
        for start in range(0, len(points), _BLOCK):
            block = _scaled(points[start : start + _BLOCK])
            count[start : start + _BLOCK], certain = _count_by_routh(block)
            if not certain.all():
                unsure = start + np.flatnonzero(~certain)
                count[unsure] = _count_by_eigenvalues(block[~certain])
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
    """Lienard-Chipart for degree 1 to 4; the leading coefficient is known to be positive or the point unstable."""
    signs = [a[-1] > 0, *(x > 0 for x in a[:-1])]
    if len(a) == 4:
        signs[2] = a[1] * a[2] > a[0] * a[3]
    elif len(a) == 5:
        signs[3] = a[1] * (a[2] * a[3] - a[4] * a[1]) > a[0] * (a[3] * a[3])
    # The thin conditions are combined first, among themselves.
    return reduce(np.logical_and, sorted(signs, key=np.size))


def _stable_by_routh(a: Sequence[Array]) -> Any:
    """Routh's recursion; every new row of a stable point is positive and below the row before last: no overflow."""
    upper, lower = list(a[::-2]), list(a[-2::-2])
    good = upper[0] > 0
    while lower:
        positive = lower[0] > 0
        good = good & positive
        ratio = upper[0] / np.where(positive, lower[0], 1.0)
        row = [x - ratio * y for x, y in zip(upper[1:], lower[1:], strict=False)] + upper[len(lower) :][:1]
        upper, lower = lower, row
    return good


def _scaled(a: Array) -> Array:
    """The same polynomials with s and the whole scaled by powers of two: the last and the first term are of order 1."""
    degree = a.shape[1] - 1
    exponent = np.where(a == 0, 0, np.frexp(a)[1])
    lowest = np.argmax(a != 0, axis=1)
    lead = exponent[:, -1]
    gap = np.take_along_axis(exponent, lowest[:, None], axis=1)[:, 0] - lead
    step = np.rint(gap / np.maximum(degree - lowest, 1)).astype(int)
    scaled: Array = np.ldexp(a, step[:, None] * (np.arange(degree + 1) - degree) - lead[:, None])
    return scaled


def _count_by_routh(a: Array) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
    """Sign changes of Routh's first column, and where all its signs hold for any rounding of `a` and on the way."""
    columns = list(np.ascontiguousarray(a.T))
    upper, lower = columns[::-2], columns[-2::-2]
    upper_error, lower_error = ([_EPS * np.abs(x) for x in row] for row in (upper, lower))
    changes = np.zeros(len(a), dtype=np.int64)
    certain = np.ones(len(a), dtype=bool)
    while lower:
        pivot, error = np.abs(lower[0]), lower_error[0]
        certain &= pivot > 2 * error
        changes += (upper[0] < 0) != (lower[0] < 0)
        ratio = upper[0] / lower[0]
        slack = (upper_error[0] + np.abs(ratio) * error) / (pivot - error) + _EPS * np.abs(ratio)
        row, row_error = list(upper[1:]), list(upper_error[1:])
        for j in range(len(lower) - 1):
            product = ratio * lower[j + 1]
            row[j] = upper[j + 1] - product
            grown = (np.abs(ratio) + slack) * lower_error[j + 1] + slack * np.abs(lower[j + 1])
            row_error[j] = upper_error[j + 1] + grown + _EPS * (np.abs(product) + np.abs(row[j]))
        upper, lower, upper_error, lower_error = lower, row, lower_error, row_error
    return changes, certain


def _count_by_eigenvalues(a: Array) -> NDArray[np.int64]:
    """Roots whose real part exceeds the radius in which the nearest exact root must lie."""
    count, degree = a.shape[0], a.shape[1] - 1
    companion = np.zeros((count, degree, degree))
    companion[:, 0] = -a[:, -2::-1] / a[:, -1:]
    companion[:, np.arange(1, degree), np.arange(degree - 1)] = 1.0
    roots = np.linalg.eigvals(companion).astype(complex)
    for _ in range(2):
        value, slope = _taylor(a, roots, 1)
        better = roots - value / slope
        roots = np.where(np.abs(_taylor(a, better, 0)[0]) < np.abs(value), better, roots)
    terms = _taylor(a, roots, degree)
    noise = 2 * degree * _EPS * np.abs(_taylor(np.abs(a), np.abs(roots), 0)[0])
    # A root of p lies within (binomial(n, m) |p| / |t_m|)^(1/m) of any point with Taylor coefficients t_m.
    bound = np.abs(terms[0]) + noise
    radius = np.full(roots.shape, np.inf)
    binomial = 1.0
    for m in range(1, degree + 1):
        binomial *= (degree - m + 1) / m
        radius = np.fmin(radius, (binomial * bound / np.abs(terms[m])) ** (1 / m))
    return np.asarray(np.sum(roots.real > radius, axis=1), dtype=np.int64)


def _taylor(a: Array, x: NDArray[Any], order: int) -> list[NDArray[Any]]:
    """The first Taylor coefficients of every polynomial at its points `x`: value, slope, half the curvature ..."""
    row = [np.broadcast_to(c[:, None], x.shape) for c in a.T]
    terms = []
    for _ in range(order + 1):
        total: NDArray[Any] = np.zeros_like(x)
        quotient = []
        for c in reversed(row):
            total = total * x + c
            quotient.append(total)
        terms.append(quotient.pop())
        row = quotient[::-1]
    return terms
