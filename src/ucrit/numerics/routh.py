"""Routh's array of one polynomial, exact for numbers and for symbols, singular cases included."""

from collections.abc import Sequence
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from html import escape
from itertools import pairwise
from math import gcd as integer_gcd
from numbers import Real
from typing import Any

from .exact import primitive, rational

Row = tuple[Any, ...]


@dataclass(frozen=True)
class RouthArray:
    """Routh's array; it prints as the table of a textbook.

    Attributes
    ----------
    rows : one tuple for each power of s, from s^n down to s^0; Fractions, or SymPy expressions if a
        coefficient was one
    powers : n, n - 1 ... 0
    notes : what was done about vanishing rows and pivots, plain sentences
    right_half_plane : number of roots with positive real part, with multiplicity; None for symbols
    imaginary_axis : number of roots on the imaginary axis, zeros included, with multiplicity; None for
        symbols
    variable : how it prints the variable
    """

    rows: tuple[Row, ...]
    powers: tuple[int, ...]
    notes: tuple[str, ...]
    right_half_plane: int | None
    imaginary_axis: int | None
    variable: str = "s"

    @property
    def first_column(self) -> Row:
        """The first element of every row; for a stable polynomial all have one sign."""
        return tuple(row[0] for row in self.rows)

    @property
    def sign_changes(self) -> int | None:
        """Sign changes in the first column: one for each root in the right half plane; None for symbols."""
        return self.right_half_plane

    def __str__(self) -> str:
        cells = [[_text(x) for x in row] for row in self.rows]
        width = [max(len(row[j]) for row in cells if j < len(row)) for j in range(len(cells[0]))]
        labels = [f"{self.variable}^{power}" for power in self.powers]
        lines = [
            f"{label:<{max(map(len, labels))}} | "
            + "  ".join(f"{text:>{size}}" for text, size in zip(row, width, strict=False))
            for label, row in zip(labels, cells, strict=True)
        ]
        return "\n".join([*lines, *self.notes, *self._verdict()])

    def _repr_html_(self) -> str:
        variable = escape(self.variable)
        rows = "".join(
            f"<tr><th>{variable}<sup>{power}</sup></th>{''.join(f'<td>{escape(_text(x))}</td>' for x in row)}</tr>"
            for power, row in zip(self.powers, self.rows, strict=True)
        )
        notes = "".join(f"<p>{escape(note)}</p>" for note in (*self.notes, *self._verdict()))
        return f"<table>{rows}</table>{notes}"

    def _verdict(self) -> list[str]:
        if self.right_half_plane is None:
            return []
        right, axis = self.right_half_plane, self.imaginary_axis
        return [f"roots in the right half plane: {right}, on the imaginary axis: {axis}"]


def routh(coefficients: Sequence[Any], variable: str = "s") -> RouthArray:
    """Routh's array of ``a[0] + a[1] s + ... + a[n] s^n``.

    * A row that vanishes is replaced by the derivative of the auxiliary polynomial, the row above it (Routh
      1877).
    * A row that only begins with k zeros is multiplied by ``1 + (-1)^k s^(2k)``. That factor is positive on
      the whole imaginary axis, so the count of roots is unchanged, whatever other roots there are (Benidir
      and Picinbono, IEEE Trans. Automatic Control 35, 1990, pp. 218-222). The customary small epsilon has no
      such guarantee: it moves roots off the axis.

    Parameters
    ----------
    coefficients : ascending powers; int, float, Fraction or SymPy expressions. Floats are taken as the exact
        numbers they store, so the counts are exact. A symbolic element counts as zero if SymPy's `cancel` or
        `is_zero` says so.
    variable : how the array and its notes print the variable

    Raises
    ------
    ValueError
        If there is no non-zero coefficient, one is not finite, or one is neither a real number nor an
        expression.

    Examples
    --------
    >>> print(routh([10, 11, 4, 2, 2, 1]))
    s^5 |  1   2  11
    s^4 |  2   4  10
    s^3 | -6   6
    s^2 |  6  10
    s^1 | 16
    s^0 | 10
    row s^3 began with 0; multiplied by 1 - s^2, which is positive on the imaginary axis
    roots in the right half plane: 2, on the imaginary axis: 0
    >>> routh([4, 4, 5, 1, 1]).notes
    ('row s^1 vanished; replaced by the derivative of the auxiliary polynomial s^2 + 4',)
    """
    a = [_element(x) for x in coefficients]
    notes: list[str] = []
    while a and _is_zero(a[-1]):
        notes.append(f"the coefficient of {variable}^{len(a) - 1} is zero and was left out")
        a.pop()
    if not a:
        raise ValueError("the polynomial is 0: it needs at least one non-zero coefficient")
    degree = len(a) - 1
    rows: list[Row] = [tuple(a[::-2])]
    auxiliary: int | None = None  # index of the row that is the first auxiliary polynomial
    for power in reversed(range(degree)):
        row = _next_row(rows[-2], rows[-1]) if len(rows) > 1 else tuple(a[-2::-2])
        if all(map(_is_zero, row)) and auxiliary is None:
            auxiliary = len(rows) - 1
        row, note = _regular(row, rows[-1], power, variable)
        rows.append(row)
        notes += note
    right, axis = _count([row[0] for row in rows], auxiliary)
    return RouthArray(tuple(rows), tuple(range(degree, -1, -1)), tuple(notes), right, axis, variable)


def all_decay(coefficients: Sequence[Any]) -> bool:
    """Whether all roots of an exact polynomial have negative real parts: Routh's test in integers.

    It stops at the first element that is not positive, hence is faster than `routh`, which counts the roots.

    Parameters
    ----------
    coefficients : ascending powers; int, float or Fraction, taken as the exact numbers they store

    Examples
    --------
    >>> all_decay([1, 2, 1]), all_decay([1, 0, 1]), all_decay([0, 1, 1]), all_decay([2, 1, 1, 1])
    (True, False, False, False)
    """
    a = primitive(coefficients)
    sign = -1 if a and a[-1] < 0 else 1
    a = [sign * x for x in a]
    if not a or min(a) <= 0:
        return False
    upper, lower = a[::-2], a[-2::-2]
    while lower:
        if lower[0] <= 0:
            return False
        following = [*lower[1:], 0]
        row = [lower[0] * x - upper[0] * y for x, y in zip(upper[1:], following, strict=False)]
        common = integer_gcd(*row) or 1
        upper, lower = lower, [x // common for x in row]
    return True


def _next_row(upper: Row, lower: Row) -> Row:
    """The row after `lower`; it has as many elements as `upper` less one."""
    padded = (*lower, Fraction(0))
    return tuple(_cancel(upper[j] - upper[0] * padded[j] / lower[0]) for j in range(1, len(upper)))


def _regular(row: Row, above: Row, power: int, s: str) -> tuple[Row, list[str]]:
    """The row of one power of s with a first element that is not zero, and what was done to it."""
    zeros = next((j for j, x in enumerate(row) if not _is_zero(x)), len(row))
    if zeros == 0:
        return row, []
    if zeros == len(row):
        slope = tuple((power + 1 - 2 * j) * x for j, x in enumerate(above[: power // 2 + 1]))
        polynomial = _polynomial_text(above, power + 1, s)
        action = f"vanished; replaced by the derivative of the auxiliary polynomial {polynomial}"
        return slope, [f"row {s}^{power} {action}"]
    shifted = (*row[zeros:], *[Fraction(0)] * zeros)
    factor = f"1 {'-' if zeros % 2 else '+'} {s}^{2 * zeros}"
    action = f"multiplied by {factor}, which is positive on the imaginary axis"
    row = tuple(x + (-1) ** zeros * y for x, y in zip(row, shifted, strict=True))
    return row, [f"row {s}^{power} began with {', '.join('0' * zeros)}; {action}"]


def _count(column: list[Any], auxiliary: int | None) -> tuple[int | None, int | None]:
    """Roots to the right of the imaginary axis and on it, from the signs of the first column."""
    if not all(isinstance(x, Fraction) for x in column):
        return None, None
    changes = [(x > 0) != (y > 0) for x, y in pairwise(column)]
    if auxiliary is None:
        return sum(changes), 0
    # The auxiliary polynomial is even or odd: as many of its roots lie to the left as to the right.
    return sum(changes), len(column) - 1 - auxiliary - 2 * sum(changes[auxiliary:])


def _element(x: Any) -> Any:
    """An exact number, or the expression with its common factors cancelled."""
    if isinstance(x, Real):
        return rational(x)
    if not hasattr(x, "free_symbols") or x.is_real is False or str(x) == "nan":
        raise ValueError(f"coefficient {x!r}: it must be a finite real number or a SymPy expression")
    return _cancel(x)


def _cancel(x: Any) -> Any:
    return x.cancel() if hasattr(x, "cancel") else x


def _is_zero(x: Any) -> bool:
    return x == 0 or getattr(x, "is_zero", None) is True


def _text(x: Any) -> str:
    """A short fraction as it is, other numbers to six digits."""
    if not isinstance(x, Fraction) or (x.denominator < 1000 and abs(x.numerator) < 10**9):
        return str(x)
    value = Decimal(x.numerator) / Decimal(x.denominator)
    return f"{float(value):.6g}" if -300 < value.adjusted() < 300 else f"{value:.5e}"


def _polynomial_text(row: Row, power: int, s: str) -> str:
    """The even or odd polynomial that a row stands for, such as ``2 s^2 + 8``."""
    text = ""
    for j, x in enumerate(row):
        if _is_zero(x):
            continue
        exponent = power - 2 * j
        variable = "" if exponent == 0 else s if exponent == 1 else f"{s}^{exponent}"
        number = _text(x)
        negative = number.startswith("-") and " " not in number
        number = f"({number})" if " " in number else number.removeprefix("-")
        term = variable if number == "1" and variable else f"{number} {variable}".rstrip()
        text += f" {'-' if negative else '+'} {term}" if text else f"-{term}" if negative else term
    return text
