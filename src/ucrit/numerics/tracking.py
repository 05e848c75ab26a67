"""Eigenvalues as continuous branches along a sweep, whatever order they were computed in."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .links import Links

Index = NDArray[np.intp]
Family = Callable[[NDArray[np.float64]], tuple[ArrayLike, ArrayLike | None]]

_MARGIN = 4  # rows on either side of a step in doubt that take part in settling it
_GROWTH = 10  # a sweep that is in doubt everywhere gets at most this multiple of its points, plus 1000


@dataclass(frozen=True, eq=False)
class Tracked:
    """Eigenvalues along a sweep and the order that makes them continuous.

    Attributes
    ----------
    values : (S, n) eigenvalues as they were given
    vectors : (S, n, n) right eigenvectors in columns as they were given, or None
    permutation : (S, n) every row a permutation of 0 ... n - 1; branch j is ``values[k, permutation[k, j]]``
    """

    values: NDArray[np.complex128]
    vectors: NDArray[Any] | None
    permutation: Index

    @property
    def branches(self) -> NDArray[np.complex128]:
        """(S, n) eigenvalues, every column one continuous branch."""
        return np.take_along_axis(self.values, self.permutation, axis=1)

    @property
    def shapes(self) -> NDArray[Any] | None:
        """(S, n, n) eigenvectors in the order of the branches, or None."""
        if self.vectors is None:
            return None
        return np.take_along_axis(self.vectors, self.permutation[:, None, :], axis=2)


def track(values: ArrayLike, vectors: ArrayLike | None = None, parameter: ArrayLike | None = None) -> Tracked:
    """Order the eigenvalues of a sweep into continuous branches.

    Every row of the result is a permutation: nothing is lost or doubled, also through crossings, double roots
    and exact zeros. Where both rows of a step are closed under conjugation, no branch jumps from the upper to
    the lower half plane: the two of a complex pair keep their sides. A common factor of all eigenvalues
    changes nothing.

    Parameters
    ----------
    values : (S, n) real or complex, the eigenvalues of each point in any order
    vectors : (S, n, n), optional, right eigenvectors in columns in the same order; they help where branches
        cross
    parameter : (S,), optional, where the points lie; equally spaced by default

    Raises
    ------
    ValueError
        If the shapes do not fit, a value is not finite, or `parameter` turns back.

    Examples
    --------
    >>> track([[1, 5, 9], [6, 1.5, 9], [2, 9, 7]]).branches.real
    array([[1. , 5. , 9. ],
           [1.5, 6. , 9. ],
           [2. , 7. , 9. ]])
    """
    sweep = Links.unlinked(values, vectors, parameter)
    sweep.link_all(np.arange(len(sweep.links)))
    given = None if vectors is None else np.asarray(vectors)
    return Tracked(np.asarray(values, dtype=complex), given, sweep.permutation())


def refine_where(
    values: ArrayLike, perm: ArrayLike, vectors: ArrayLike | None = None, parameter: ArrayLike | None = None
) -> NDArray[np.bool_]:
    """The steps of a tracked sweep where exchanging two branches would fit nearly as well.

    Points inserted there help to tell them apart.

    Parameters
    ----------
    values, vectors, parameter : as for `track`
    perm : (S, n) permutation as returned by `track`

    Returns
    -------
    (S - 1,) bool

    Examples
    --------
    >>> values = [[-2, 2], [-1, 1], [1j, -1j], [2j, -2j]]
    >>> refine_where(values, track(values).permutation)
    array([False,  True, False])
    """
    sweep = Links.unlinked(values, vectors, parameter)
    order = np.asarray(perm)
    if order.shape != sweep.values.shape or (np.sort(order, axis=1) != np.arange(order.shape[1])).any():
        raise ValueError(f"permutation of shape {order.shape}: it must be a permutation of each row of the eigenvalues")
    sweep.links = np.take_along_axis(order[1:], np.argsort(order[:-1], axis=1), axis=1)
    return sweep.doubtful(np.arange(len(sweep.links)))


def track_adaptive(function: Family, parameter_values: ArrayLike, max_depth: int = 8) -> Tracked:
    """Track the eigenvalues of a family, halving the steps in doubt, and return the points asked for.

    Parameters
    ----------
    function : called with an array of m parameter values; returns the eigenvalues (m, n) and the right
        eigenvectors (m, n, n) in columns, or None instead of them. It is called once for all points and once
        more in every round.
    parameter_values : (S,) rising or falling throughout
    max_depth : rounds of halving; where real roots meet and turn complex the last step stays in doubt at any
        depth

    Returns
    -------
    Tracked : at `parameter_values` only; the branches were followed through the points in between

    Raises
    ------
    ValueError
        If what `function` returns has the wrong shape or is not finite, or `parameter_values` turn back.

    Examples
    --------
    >>> import numpy as np
    >>> def crossing(p):
    ...     return np.sort(np.stack([p, 3 * p**2 - 1], axis=1)), None
    >>> track_adaptive(crossing, [-1, 0, 1, 2, 3]).branches.real
    array([[-1.,  2.],
           [ 0., -1.],
           [ 1.,  2.],
           [ 2., 11.],
           [ 3., 26.]])
    """
    where = np.asarray(parameter_values, dtype=float)
    values, vectors = function(where)
    sweep = Links.unlinked(values, vectors, where)
    steps = np.arange(len(sweep.links))
    sweep.link_all(steps)
    steps = steps[sweep.doubtful(steps)]
    if len(steps):
        # Only the surroundings of the steps in doubt are worked on: the rest may be long.
        rows = np.unique(np.clip(steps[:, None] + np.arange(-_MARGIN, _MARGIN + 2), 0, len(where) - 1))
        local = sweep.restricted(rows)
        order = _refined(local, np.searchsorted(rows, steps), function, max_depth, len(where))
        whole = np.flatnonzero(np.diff(rows) == 1)
        sweep.links[rows[whole]] = np.take_along_axis(order[whole + 1], np.argsort(order[whole], axis=1), axis=1)
    given = None if vectors is None else np.asarray(vectors)
    return Tracked(np.asarray(values, dtype=complex), given, sweep.permutation())


def _refined(sweep: Links, steps: Index, function: Family, max_depth: int, count: int) -> Index:
    """The permutation at the rows of `sweep` after points were inserted into the steps in doubt."""
    asked = np.arange(len(sweep.values))
    inserted = 0
    for _ in range(max_depth):
        middle = (sweep.parameter[steps] + sweep.parameter[steps + 1]) / 2
        inside = (middle != sweep.parameter[steps]) & (middle != sweep.parameter[steps + 1])
        steps, middle = steps[inside], middle[inside]
        inserted += len(steps)
        if not len(steps) or inserted > _GROWTH * count + 1000:
            break
        asked = asked + np.searchsorted(steps, asked)
        steps = sweep.insert(steps, *function(middle), middle)
        steps = steps[sweep.doubtful(steps)]
    return sweep.permutation()[asked]
