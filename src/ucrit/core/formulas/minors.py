"""Determinants of sparse matrices of polynomials: block by block, and of each block by minors, without divisions."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import prod
from typing import Any

from sympy.polys.matrices import DomainMatrix
from sympy.polys.rings import PolyElement, PolyRing

Rows = Sequence[Sequence[PolyElement]]


def blocks(rows: Rows, ring: PolyRing) -> list[list[int]]:
    """Return the places of the blocks of a square matrix that falls into a triangle of them.

    Variables that act on others without being acted on, such as those of actuators, make blocks of their own.
    """
    found: list[list[int]] = DomainMatrix([list(row) for row in rows], (len(rows), len(rows)), ring.to_domain()).scc()
    return found


def determinant(rows: Rows, ring: PolyRing) -> Any:
    """Return the determinant of a square matrix over a ring of polynomials."""
    return prod(block_determinants(rows, ring), start=ring.one)


def block_determinants(rows: Rows, ring: PolyRing) -> Iterator[Any]:
    """Return the determinants of the blocks, whose product is the whole matrix's."""
    return (_by_minors(part(rows, block), ring) for block in blocks(rows, ring))


def part(rows: Rows, places: Sequence[int]) -> list[list[PolyElement]]:
    """Return the rows and columns at some places."""
    return [[rows[i][j] for j in places] for i in places]


def _by_minors(rows: Rows, ring: PolyRing) -> Any:
    """Return a determinant by Laplace, sparse rows first, each minor of the rows so far once.

    Of sparse matrices of long polynomials only few minors are not zero, and quotients would cost most.
    """
    order = sorted(range(len(rows)), key=lambda i: sum(map(bool, rows[i])))
    minors = {0: ring.one if _even(order) else -ring.one}  # by the set of columns, as bits
    for i in order:
        following: dict[int, PolyElement] = {}
        for columns, minor in minors.items():
            for j, entry in enumerate(rows[i]):
                if entry and not columns >> j & 1:
                    term = -minor * entry if (columns >> j).bit_count() % 2 else minor * entry
                    key = columns | 1 << j
                    following[key] = following[key] + term if key in following else term
        minors = {columns: minor for columns, minor in following.items() if minor}
    return next(iter(minors.values()), ring.zero)


def _even(order: Sequence[int]) -> bool:
    """Tell whether a permutation has an even number of inversions."""
    return sum(a > b for k, b in enumerate(order) for a in order[:k]) % 2 == 0
