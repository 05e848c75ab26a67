"""Points of a curve of solutions of n equations in n + 1 unknowns: Newton's method, and the tangent."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[Any]
Function = Callable[[Array], tuple[Array, Array]]

CONVERGED, ROUNDING = 1e-11, 1e-6
"""Scaled correction after which Newton's method has converged, or has if it then gets no smaller."""

NEWTON = 12


class Point(NamedTuple):
    """A point of a curve: unknowns (n + 1,), unit tangent in scaled unknowns (scaled back), Jacobian (n, n + 1)."""

    y: Array
    tangent: Array
    jacobian: Array


class NoConvergenceError(ArithmeticError):
    """Newton's method found no point of the curve near the guess; the text says what happened."""


def solve(function: Function, guess: Array, tangent: Array, scale: Array) -> tuple[Array, Array, float]:
    """Return the solution in the plane through the guess at right angles to the tangent (both scaled).

    Returns
    -------
    tuple
        Unknowns, Jacobian there, and the length of the first correction in scaled unknowns.

    Raises
    ------
    NoConvergenceError
        If there is none nearby.
    """
    y, last, first = guess, math.inf, 0.0
    for iteration in range(NEWTON):
        value, jacobian = function(y)
        if not (np.isfinite(value).all() and np.isfinite(jacobian).all()):
            raise NoConvergenceError("the equations have no value there")
        size = row_sizes(jacobian * scale)
        right = np.append(value / size[:, 0], tangent @ ((y - guess) / scale))
        try:
            step = np.linalg.solve(bordered(jacobian * scale, tangent), -right)
        except np.linalg.LinAlgError:
            raise NoConvergenceError("the equations are singular there: solutions are no single curve") from None
        length = float(np.linalg.norm(step))
        first = first if iteration else length
        if iteration and length > 0.7 * last:
            if last < ROUNDING:
                return y, jacobian, first
            raise NoConvergenceError("Newton's method does not converge")
        y, last = y + scale * step, length
        if length <= CONVERGED * (1 + float(np.abs(y / scale).max())):
            return y, function(y)[1], first
    raise NoConvergenceError("Newton's method does not converge")


def bordered(scaled: Array, row: Array) -> Array:
    """Return a scaled Jacobian with its rows brought to one size, and one row more."""
    return np.vstack([scaled / row_sizes(scaled), row])


def row_sizes(matrix: Array) -> Array:
    """Return the lengths of a matrix's rows as a column, 1 for a row of zeros."""
    size = np.linalg.norm(matrix, axis=1, keepdims=True)
    return np.where(size > 0, size, 1.0)


def tangent_at(jacobian: Array, along: Array, scale: Array) -> Array:
    """Return the scaled unit tangent whose direction is nearest to ``along`` (scaled).

    Raises
    ------
    NoConvergenceError
        If there is none: the Jacobian has no full rank.
    """
    border = bordered(jacobian * scale, along)
    try:
        found = np.linalg.solve(border, np.append(np.zeros(len(jacobian)), 1.0))
    except np.linalg.LinAlgError:
        raise NoConvergenceError("the equations are singular there: solutions are no single curve") from None
    return np.asarray(found / np.linalg.norm(found))
