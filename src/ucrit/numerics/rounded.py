"""Stability of polynomials whose coefficients were rounded: what is sure, and what is open."""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .hurwitz import sign_changes

Array = NDArray[np.float64]

EPS = float(np.finfo(float).eps)

UNDERFLOW = 1e-300
"""Added to error bounds: what products below the smallest double may lose."""


def judged(
    a: Sequence[Array], size: Sequence[Any], error: Sequence[Any]
) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Whether polynomials are stable for sure, and where that is not sure, from coefficients that were rounded.

    Parameters
    ----------
    a
        n + 1 coefficients, n > 0, that broadcast together.
    size, error
        Bounds of their absolute values and of their errors.

    Returns
    -------
    bool array, bool array
        Stable for sure; neither that nor unstable for sure (also where numbers overflow or are not finite). Both of
        the broadcast shape of ``a``.

    Examples
    --------
    >>> stable, open_ = judged([np.array([1.0, 1e-20, -1.0]), np.array(1.0)], [1, 1], [1e-15, 1e-15])
    >>> stable, open_
    (array([ True, False, False]), array([False,  True, False]))
    """
    shape = np.broadcast_shapes(*(np.shape(x) for x in a))
    with np.errstate(all="ignore"):
        if not (a[-1] > 0).all():
            sign = np.where(a[-1] < 0, -1.0, 1.0)
            a = [x * sign for x in a]
        error = [x + UNDERFLOW for x in error]
        signed = np.asarray(a[-1] > error[-1])  # else conditions may have been turned round wrongly
        if len(a) > 5:
            sure, possible = _judged_by_routh(a, error)
        else:
            tests = sorted(zip(conditions(a), slacks(size, error), strict=True), key=lambda pair: np.size(pair[0]))
            sure = reduce(np.logical_and, [x > slack for x, slack in tests])
            possible = reduce(np.logical_and, [~(x < -slack) for x, slack in tests])
    sure = sure & signed if not signed.all() else sure
    possible = possible | ~signed if not signed.all() else possible
    return np.broadcast_to(sure, shape), np.broadcast_to(possible & ~sure, shape)


def conditions(a: Sequence[Any]) -> list[Any]:
    """What must be positive for stability if the leading coefficient is: any numbers with ``+ - * /``.

    Up to degree 4 the conditions of Lienard and Chipart, above the first column of Routh's array.
    """
    if len(a) > 5:
        return _first_column(a)
    if len(a) == 4:
        return [a[3], a[0], a[2], a[1] * a[2] - a[0] * a[3]]
    if len(a) == 5:
        return [a[4], a[0], a[1], a[3], a[1] * (a[2] * a[3] - a[4] * a[1]) - a[0] * (a[3] * a[3])]
    return list(reversed(a))


def _first_column(a: Sequence[Any]) -> list[Any]:
    upper, lower = list(a[::-2]), list(a[-2::-2])
    column = [upper[0]]
    while lower:
        column.append(lower[0])
        ratio, row = upper[0] / lower[0], upper[1:]
        for j, x in enumerate(lower[1:]):
            row[j] = row[j] - ratio * x
        upper, lower = lower, row
    return column


def slacks(size: Sequence[Any], error: Sequence[Any]) -> list[Any]:
    """Errors of what must be positive for degree 1 to 4, from bounds of the coefficients' sizes and errors."""
    M, E = size, error
    if len(M) == 4:
        product = M[1] * E[2] + M[2] * E[1] + M[0] * E[3] + M[3] * E[0] + 4 * EPS * (M[1] * M[2] + M[0] * M[3])
        return [E[3], E[0], E[2], 1.1 * product + UNDERFLOW]
    if len(M) == 5:
        product = (
            E[1] * (M[2] * M[3] + 2 * M[4] * M[1])
            + E[2] * M[1] * M[3]
            + E[3] * (M[1] * M[2] + 2 * M[0] * M[3])
            + E[4] * M[1] * M[1]
            + E[0] * M[3] * M[3]
            + 6 * EPS * (M[1] * M[2] * M[3] + M[4] * M[1] * M[1] + M[0] * M[3] * M[3])
        )
        return [E[4], E[0], E[1], E[3], 1.1 * product + UNDERFLOW]
    return list(reversed(E))


def _judged_by_routh(a: Sequence[Array], error: Sequence[Any]) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    changes, certain = sign_changes(a, error)
    positive = [~(x < -e) for x, e in sorted(zip(a, error, strict=True), key=lambda pair: np.size(pair[0]))]
    sure = certain & (changes == 0) & (a[-1] > error[-1])
    return np.asarray(sure), np.asarray(reduce(np.logical_and, positive) & ~(certain & (changes != 0)))
