"""The steps of `ucrit.numerics.matrices` as loops that numba compiles: several matrices side by side in each register.

Nothing here runs uncompiled, but for tests. Arrays are of shape (..., lanes), so that the innermost loops run over
neighbours in memory.
"""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np

LANES = 32
"""Matrices handled together: for order 8 their 16 kB stay in the first-level cache."""

EPS = 2.220446049250313e-16
TINY = 1e-300


def balance(H: Any, scale: Any, sweeps: int) -> None:
    """Scale rows and columns by powers of two, then all to the Frobenius norm sqrt(n)."""
    n, lanes = H.shape[0], H.shape[2]
    column, row = np.empty(lanes), np.empty(lanes)
    for _ in range(sweeps):
        for i in range(n):
            column[:] = 0.0
            row[:] = 0.0
            for j in range(n):
                if j != i:
                    for w in range(lanes):
                        column[w] += abs(H[j, i, w])
                        row[w] += abs(H[i, j, w])
            for w in range(lanes):
                ratio = column[w] / row[w]
                scale[w] = np.exp2(np.rint(np.log2(ratio) / 2)) if 0.0 < ratio < np.inf else 1.0
            for j in range(n):
                for w in range(lanes):
                    H[i, j, w] *= scale[w]
                for w in range(lanes):
                    H[j, i, w] /= scale[w]
    scale[:] = 0.0
    for i in range(n):
        for j in range(n):
            for w in range(lanes):
                scale[w] += H[i, j, w] * H[i, j, w]
    for w in range(lanes):
        scale[w] = 1.0 / np.sqrt(scale[w] / n) if scale[w] > 0.0 else 1.0
    for i in range(n):
        for j in range(n):
            for w in range(lanes):
                H[i, j, w] *= scale[w]


def to_hessenberg(H: Any, v: Any, u: Any, t: Any) -> None:
    """Reduce by Householder's reflections."""
    n, lanes = H.shape[0], H.shape[2]
    for k in range(n - 2):
        t[:] = 0.0
        for i in range(k + 1, n):
            for w in range(lanes):
                v[i, w] = H[i, k, w]
        for i in range(k + 2, n):
            for w in range(lanes):
                t[w] += v[i, w] * v[i, w]
        for w in range(lanes):
            first = v[k + 1, w]
            length = np.sqrt(first * first + t[w])
            signed = -length if first < 0.0 else length
            v[k + 1, w] = first + signed
            squared = t[w] + v[k + 1, w] * v[k + 1, w]
            t[w] = 2.0 / squared if squared > 0.0 else 0.0
            H[k + 1, k, w] = -signed
        for i in range(k + 1, n):
            for w in range(lanes):
                u[i, w] = v[i, w] * t[w]
        for j in range(k + 1, n):
            t[:] = 0.0
            for i in range(k + 1, n):
                for w in range(lanes):
                    t[w] += v[i, w] * H[i, j, w]
            for i in range(k + 1, n):
                for w in range(lanes):
                    H[i, j, w] -= u[i, w] * t[w]
        for i in range(n):
            t[:] = 0.0
            for j in range(k + 1, n):
                for w in range(lanes):
                    t[w] += H[i, j, w] * v[j, w]
            for j in range(k + 1, n):
                for w in range(lanes):
                    H[i, j, w] -= t[w] * u[j, w]


def polynomial(H: Any, p: Any, t: Any) -> None:
    """Write ascending coefficients of the leading blocks of size k into p[k], the whole matrix's into p[n]."""
    n, lanes = H.shape[0], H.shape[2]
    for w in range(lanes):
        p[0, 0, w] = 1.0
    for k in range(n):
        for w in range(lanes):
            p[k + 1, 0, w] = 0.0
        for m in range(k + 1):
            for w in range(lanes):
                p[k + 1, m + 1, w] = p[k, m, w]
            for w in range(lanes):
                p[k + 1, m, w] -= H[k, k, w] * p[k, m, w]
        t[:] = 1.0
        for i in range(k - 1, -1, -1):
            for w in range(lanes):
                t[w] *= H[i + 1, i, w]
            for m in range(i + 1):
                for w in range(lanes):
                    p[k + 1, m, w] -= H[i, k, w] * t[w] * p[i, m, w]


def judge(a: Any, e: Any, row: Any, error: Any, sure: Any, wrong: Any) -> None:
    """Run Routh's recursion with error bounds: where stability is sure, and where instability is.

    ``row`` and ``error`` of shape (2, m, lanes) hold two rows of the array; ``a`` is ascending, with errors ``e``.
    """
    n, lanes = a.shape[0] - 1, a.shape[1]
    row[:] = 0.0
    error[:] = 0.0
    for w in range(lanes):
        sure[w] = True
        wrong[w] = False
    for k in range(n + 1):
        place, side = (n - k) // 2, (n - k) % 2
        for w in range(lanes):
            row[side, place, w] = a[k, w]
            error[side, place, w] = e[k]
            wrong[w] |= a[k, w] < -e[k]
    for step in range(n):
        up, low = step % 2, (step + 1) % 2
        for w in range(lanes):
            wrong[w] |= sure[w] & (row[low, 0, w] < -2.0 * error[low, 0, w])
            sure[w] &= row[low, 0, w] > 2.0 * error[low, 0, w]
        for j in range((n - step - 1) // 2):
            for w in range(lanes):
                ratio = row[up, 0, w] / row[low, 0, w]
                size = abs(ratio)
                slack = (error[up, 0, w] + size * error[low, 0, w]) / (row[low, 0, w] - error[low, 0, w]) + EPS * size
                product = ratio * row[low, j + 1, w]
                new = row[up, j + 1, w] - product
                grown = (size + slack) * error[low, j + 1, w] + slack * abs(row[low, j + 1, w])
                grown += EPS * (abs(product) + abs(new)) + TINY
                row[1 - low, j + 1, w], error[1 - low, j + 1, w] = new, error[up, j + 1, w] + grown
        for j in range((n - step) // 2):
            for w in range(lanes):
                row[up, j, w], error[up, j, w] = row[up, j + 1, w], error[up, j + 1, w]
        for j in range((n - step) // 2, row.shape[1]):
            for w in range(lanes):
                row[up, j, w], error[up, j, w] = 0.0, 0.0


@cache
def compiled() -> Any:
    """Return the compiled function ``f(matrices, errors, sweeps, codes)``: 1 for stable, 0 unstable, 2 open."""
    import numba

    fast = numba.njit(nogil=True, error_model="numpy")
    steps = [fast(step) for step in (balance, to_hessenberg, polynomial, judge)]
    balanced, reduced, expanded, judged = steps

    def run(matrices: Any, errors: Any, sweeps: int, codes: Any) -> None:
        count, n = matrices.shape[0], matrices.shape[1]
        H, v, u = np.empty((n, n, LANES)), np.empty((n, LANES)), np.empty((n, LANES))
        p, t = np.zeros((n + 1, n + 1, LANES)), np.empty(LANES)
        row, error = np.empty((2, n // 2 + 1, LANES)), np.empty((2, n // 2 + 1, LANES))
        sure, wrong = np.empty(LANES, dtype=np.bool_), np.empty(LANES, dtype=np.bool_)
        for start in range(0, count, LANES):
            for w in range(LANES):
                source = min(start + w, count - 1)
                for i in range(n):
                    for j in range(n):
                        H[i, j, w] = matrices[source, i, j]
            balanced(H, t, sweeps)
            reduced(H, v, u, t)
            expanded(H, p, t)
            judged(p[n], errors, row, error, sure, wrong)
            for w in range(min(LANES, count - start)):
                codes[start + w] = 1 if sure[w] else 0 if wrong[w] else 2

    return fast(run)
