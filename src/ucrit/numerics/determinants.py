"""Hurwitz determinants, exactly: of numbers, of symbolic polynomials, and of polynomials in one parameter."""

from collections.abc import Callable, Sequence
from fractions import Fraction
from math import lcm
from typing import Any

from .exact import interpolate, rational

Division = Callable[[Any, Any], Any]


def determinant(matrix: Sequence[Sequence[Any]], divide: Division | None = None) -> Any:
    """The determinant of a square matrix over any integral domain, without fractions.

    Fraction-free elimination (Bareiss, Mathematics of Computation 22, 1968, pp. 565-578): every division is
    exact.

    Parameters
    ----------
    matrix : n rows of n elements that can be added, multiplied and compared with 0
    divide : exact division of two elements; not needed for numbers nor for elements of a SymPy polynomial
        ring

    Raises
    ------
    ValueError
        If the matrix is not square.

    Examples
    --------
    >>> determinant([[2, 1], [7, 4]])
    1
    """
    rows = [list(row) for row in matrix]
    n = len(rows)
    if any(len(row) != n for row in rows):
        raise ValueError(f"matrix with {n} rows of lengths {[len(row) for row in rows]}: it must be square")
    previous: Any = None
    sign = 1
    for k in range(n):
        pivot = next((i for i in range(k, n) if rows[i][k] != 0), None)
        if pivot is None:
            return rows[k][k]
        if pivot != k:
            rows[k], rows[pivot], sign = rows[pivot], rows[k], -sign
        _eliminate(rows, k, previous, divide)
        previous = rows[k][k]
    return sign * previous if n else 1


def hurwitz_matrix(a: Sequence[Any]) -> list[list[Any]]:
    """The n x n Hurwitz matrix of ``a[0] + a[1] s + ... + a[n] s^n``; its first element is ``a[n - 1]``.

    Examples
    --------
    >>> hurwitz_matrix([4, 3, 2, 1])
    [[2, 4, 0], [1, 3, 0], [0, 2, 4]]
    """
    n = len(a) - 1
    # 1-based, row i and column j hold the coefficient of s^(n - 2j + i).
    powers = [[n - 2 * j + i for j in range(1, n + 1)] for i in range(1, n + 1)]
    return [[a[k] if 0 <= k <= n else 0 for k in row] for row in powers]


def hurwitz_determinants(a: Sequence[Any], divide: Division | None = None) -> list[Any]:
    """The n leading principal minors H_1 ... H_n of the Hurwitz matrix.

    With ``a[n] > 0`` every root of the polynomial has a negative real part exactly if all of them are
    positive (Hurwitz 1895; Gantmacher, The Theory of Matrices 2, ch. XV sec. 6).

    Parameters
    ----------
    a : n + 1 coefficients in ascending powers, elements of any integral domain (exact numbers, SymPy ring
        elements)
    divide : exact division of two elements; not needed for numbers nor for elements of a SymPy polynomial
        ring

    Raises
    ------
    ValueError
        If there are fewer than two coefficients.

    Examples
    --------
    >>> hurwitz_determinants([1, 4, 6, 4, 1])
    [4, 20, 64, 64]
    """
    if len(a) < 2:
        raise ValueError(f"{len(a)} coefficients given: Hurwitz determinants need at least two")
    matrix = hurwitz_matrix(a)
    rows = [list(row) for row in matrix]
    minors: list[Any] = []
    for k in range(len(rows)):
        if minors and minors[-1] == 0:  # elimination without row swaps ends here
            minors += [determinant([row[:m] for row in matrix[:m]], divide) for m in range(k + 1, len(rows) + 1)]
            break
        minors.append(rows[k][k])
        _eliminate(rows, k, minors[-2] if k else None, divide)
    return minors


def hurwitz_polynomial(coefficients: Sequence[Sequence[Any]]) -> list[Fraction]:
    """The Hurwitz determinant H_(n-1) of a polynomial in s, its coefficients polynomials in a parameter p.

    With all coefficients positive, H_(n-1) vanishes first where a pair of roots reaches the imaginary axis;
    it is the product of the sums of every two roots, up to sign and powers of ``a_n`` (Orlando 1911).

    Parameters
    ----------
    coefficients : n + 1 polynomials a_0(p) ... a_n(p), each in ascending powers of p; int, float or Fraction

    Returns
    -------
    list of Fraction : the exact polynomial H_(n-1)(p) in ascending powers, [] if it vanishes for every p

    Raises
    ------
    ValueError
        If there are fewer than two coefficients or one is not finite.

    Examples
    --------
    >>> [int(x) for x in hurwitz_polynomial([[1], [2, 1], [0, 3], [1]])]
    [-1, 6, 3]
    """
    if len(coefficients) < 2:
        raise ValueError(f"{len(coefficients)} coefficients given: Hurwitz determinants need at least two")
    exact = [[rational(x) for x in polynomial] for polynomial in coefficients]
    scale = lcm(*(x.denominator for polynomial in exact for x in polynomial))
    integers = [[x.numerator * (scale // x.denominator) for x in polynomial] for polynomial in exact]
    size = len(integers) - 2

    def corner(a: Sequence[int]) -> list[list[int]]:
        return [row[:size] for row in hurwitz_matrix(a)[:size]]

    degrees = corner([max(len(polynomial) - 1, 0) for polynomial in integers])
    degree = min(sum(map(max, degrees)), sum(map(max, zip(*degrees, strict=True))))
    nodes = [(k + 1) // 2 * (-1) ** k for k in range(degree + 1)]  # 0, -1, 1, -2, 2 ... keep the numbers short
    minors = [determinant(corner([_at_integer(polynomial, x) for polynomial in integers])) for x in nodes]
    return [x / scale**size for x in interpolate(nodes, minors)]


def _at_integer(p: Sequence[int], x: int) -> int:
    total = 0
    for c in reversed(p):
        total = total * x + c
    return total


def _eliminate(rows: list[list[Any]], k: int, previous: Any, divide: Division | None) -> None:
    """One step of Bareiss' elimination in place; `previous` is the pivot before, None in the first step."""
    pivot = rows[k]
    for row in rows[k + 1 :]:
        for j in range(k + 1, len(row)):
            value = row[j] * pivot[k] - row[k] * pivot[j]
            row[j] = value if previous is None else (divide or _divide)(value, previous)


def _divide(x: Any, y: Any) -> Any:
    """Exact division of integers, of other numbers, and of SymPy ring elements."""
    if isinstance(x, int) and isinstance(y, int):
        return x // y
    return x.exquo(y) if hasattr(x, "exquo") else x / y
