"""Many small assignment problems at once."""

import numpy as np
from numpy.typing import NDArray

Float = NDArray[np.float64]
Index = NDArray[np.intp]


def assign(cost: Float) -> Index:
    """For every n x n cost matrix the permutation of least total cost.

    Where every row has its least cost in another column, those are the answer; a greedy choice that attains
    the same lower bound is another; only the remaining matrices go through the Hungarian algorithm one by
    one.

    Parameters
    ----------
    cost : (m, n, n), non-negative; infinite where a pair is forbidden

    Returns
    -------
    (m, n) : row i of matrix k is assigned to column ``result[k, i]``; every row is a permutation

    Raises
    ------
    ValueError
        If the forbidden pairs leave a matrix without any permutation.

    Examples
    --------
    >>> import numpy as np
    >>> assign(np.array([[[1.0, 2.0], [1.0, 5.0]], [[0.0, 9.0], [9.0, 0.0]]]))
    array([[1, 0],
           [0, 1]])
    """
    n = cost.shape[1]
    links = cost.argmin(axis=2)
    taken = np.bitwise_or.reduce(np.left_shift(1, links), axis=1) if n < 63 else np.zeros(len(cost), dtype=int)
    hard = np.flatnonzero(taken != (1 << min(n, 63)) - 1)
    if len(hard):
        links[hard], optimal = _greedy(cost[hard])
        _hungarian(cost, links, hard[~optimal])
    return np.asarray(links, dtype=np.intp)


def _greedy(cost: Float) -> tuple[Index, NDArray[np.bool_]]:
    """Take the cheapest free pair n times; say where that is certainly the optimum."""
    m, n, _ = cost.shape
    free = cost.copy()
    matrix = np.arange(m)
    links = np.zeros((m, n), dtype=np.intp)
    total = np.zeros(m)
    for _ in range(n):
        row, column = divmod(free.reshape(m, -1).argmin(axis=1), n)
        total += free[matrix, row, column]
        links[matrix, row] = column
        free[matrix, row, :] = np.inf
        free[matrix, :, column] = np.inf
    bound = np.maximum(cost.min(axis=2).sum(axis=1), cost.min(axis=1).sum(axis=1))
    return links, np.isfinite(total) & (total <= bound + 1e-12 * np.abs(bound))


def _hungarian(cost: Float, links: Index, matrices: Index) -> None:
    """Solve the listed matrices one by one, in place."""
    if len(matrices):
        from scipy.optimize import (
            linear_sum_assignment,
        )  # late: few sweeps need it, and it takes long to import

        for k in matrices:
            links[k] = linear_sum_assignment(cost[k])[1]
