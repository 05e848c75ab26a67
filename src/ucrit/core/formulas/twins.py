"""Copies of a vehicle inside its controller, told apart by their errors before a determinant is taken.

An observer follows the vehicle's own equations. With its errors in place of its states what is left of them is free of
the vehicle's states: the matrix falls into blocks (the separation of D. G. Luenberger, IEEE Transactions on Automatic
Control 11 (1966) 190-197).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

Twins = Sequence[tuple[int, int, int]]
"""Places of a copy's variable and of its original, and how many times the original is differentiated."""

Rows = list[list[list[Any]]]
"""Entry [i][j][k] belongs to ``s**k`` in row i and column j."""


def untwinned(rows: Rows, twins: Twins, zero: Any) -> Rows:
    """Return rows of the same determinant: columns of originals with those of their copies, rows of copies without.

    Row and column operations keep the determinant. A row that equals an earlier one in all columns but the copies'
    loses it.
    """
    if not twins:
        return rows
    found = [[list(chain) for chain in row] for row in rows]
    for copy, original, order in twins:
        for row in found:
            for k, entry in enumerate(row[copy]):
                row[original] += [zero] * (k + order + 1 - len(row[original]))
                row[original][k + order] = row[original][k + order] + entry
    copies = {copy for copy, _, _ in twins}
    outside = [j for j in range(len(rows)) if j not in copies]
    keys = [tuple(_trimmed(row[j]) for j in outside) for row in found]
    for i, key in enumerate(keys):
        if any(key) and key in keys[:i]:
            found[i] = [_less(one, other, zero) for one, other in zip(found[i], found[keys.index(key)], strict=True)]
    return found


def _trimmed(chain: list[Any]) -> tuple[Any, ...]:
    last = max((k for k, c in enumerate(chain) if c), default=-1)
    return tuple(chain[: last + 1])


def _less(one: list[Any], other: list[Any], zero: Any) -> list[Any]:
    size = max(len(one), len(other))
    padded = [[*chain, *[zero] * (size - len(chain))] for chain in (one, other)]
    return [a - b for a, b in zip(*padded, strict=True)]
