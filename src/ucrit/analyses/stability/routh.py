"""Routh's array of a bare polynomial, given as text or by its coefficients: the criterion as a textbook shows it."""

from __future__ import annotations

import ast
import keyword
import re
import unicodedata
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from html import escape
from typing import Any

from ...core.errors import UcritError, near_match
from ...numerics.routh import RouthArray
from ...numerics.routh import routh as array_of

MAX_DEGREE = 99
"""Largest power that a formula may come to."""

WIDE = 30
"""Characters of an array's element above which it is shown below the array."""

_NUMBER = r"(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
_TOKEN = re.compile(rf"\s*(?:(?P<number>{_NUMBER})|(?P<name>[^\W\d]\w*)|(?P<sign>\*\*|[-+*/^(),]))")


@dataclass(frozen=True)
class RouthTest:
    """Routh's criterion for one polynomial; it prints as the table of a textbook and what follows from it.

    Attributes
    ----------
    polynomial
        As it was understood, with descending powers.
    array
        Rows, notes and numbers of roots; see `ucrit.numerics.RouthArray`.
    conditions
        For symbols, what must all be positive for stability; factors that are positive anyway are left out.
    settled
        ``True``: stable, ``False``: not stable, whatever the symbols; ``None``: the conditions decide.
    positive
        Symbols that were taken as positive.
    either_sign
        Whether the conditions may be met by the polynomial with all its signs changed instead.
    """

    polynomial: str
    array: RouthArray
    conditions: tuple[str, ...] = ()
    settled: bool | None = None
    positive: tuple[str, ...] = ()
    either_sign: bool = False

    @property
    def right_half_plane(self) -> int | None:
        """Number of roots with positive real part; ``None`` for symbols."""
        return self.array.right_half_plane

    @property
    def verdict(self) -> str:
        """What follows, in words."""
        if self.settled is not None:
            return f"{'stable: all' if self.settled else 'not stable: not all'} roots are in the left half plane"
        either = ", perhaps after a change of all its signs," if self.either_sign else ""
        return "\n".join([f"stable{either} if and only if", *(f"    {c} > 0" for c in self.conditions)])

    def to_dict(self) -> dict[str, Any]:
        """Return the array and what follows from it as plain data; elements are texts, which are exact."""
        array = self.array
        return {
            "schema": 1,
            "polynomial": self.polynomial,
            "variable": array.variable,
            "positive": list(self.positive),
            "rows": [
                {"power": power, "elements": [str(x) for x in row]}
                for power, row in zip(array.powers, array.rows, strict=True)
            ],
            "notes": list(array.notes),
            "right_half_plane": array.right_half_plane,
            "imaginary_axis": array.imaginary_axis,
            "settled": self.settled,
            "either_sign": self.either_sign,
            "conditions": list(self.conditions),
            "verdict": self.verdict,
        }

    def __str__(self) -> str:
        table, long = _shown(self.array)
        taken = [f"with {', '.join(self.positive)} positive"] if self.positive else []
        return "\n".join([self.polynomial, "", str(table), *long, *taken, self.verdict])

    def _repr_html_(self) -> str:
        table, long = _shown(self.array)
        below = "<br>".join(map(escape, [*long, *self.verdict.splitlines()]))
        return f"<p>{escape(self.polynomial)}</p>{table._repr_html_()}<p>{below}</p>"


def routh(polynomial: str | Sequence[Any], variable: str = "s", positive: Iterable[str] = ()) -> RouthTest:
    """Return Routh's array of a polynomial, with numbers or symbols, and the conditions for stability.

    Parameters
    ----------
    polynomial
        A formula, ``"s^4 + 2 s^3 + (a + b) s^2 + 3s + 1"``, in which ``^`` or ``**`` is a power and a missing sign
        between two factors a product; or coefficients in ascending powers, numbers or SymPy expressions.
    variable
        Name of the variable.
    positive
        Names of symbols that can only be positive; others may have any sign.

    Raises
    ------
    UcritError
        If it is no formula or list, cannot be read or is no polynomial in the variable, or ``positive`` names no
        symbol of it.

    Examples
    --------
    >>> print(routh("s^4 + 2 s^3 + 3 s^2 + 4 s + 5"))
    s^4 + 2 s^3 + 3 s^2 + 4 s + 5
    <BLANKLINE>
    s^4 |  1  3  5
    s^3 |  2  4
    s^2 |  1  5
    s^1 | -6
    s^0 |  5
    roots in the right half plane: 2, on the imaginary axis: 0
    not stable: not all roots are in the left half plane
    >>> print(routh("m s^2 + c s + k", positive=["m"]).verdict)
    stable if and only if
        k > 0
        c > 0
    """
    taken = tuple(dict.fromkeys(positive))
    a = _read(polynomial, variable, taken) if isinstance(polynomial, str) else _exact(polynomial)
    while a and a[-1] == 0:
        a.pop()
    if len(a) < 2:
        shown = repr(polynomial) if isinstance(polynomial, str) else str(list(polynomial))
        raise UcritError(f"{shown} holds no {variable}, so it has no roots; another variable must be named")
    names = {symbol.name for c in a for symbol in c.free_symbols}
    for name in taken:
        if name not in names:
            raise UcritError(f"there is no symbol '{name}' to be positive{near_match(name, names)}")
    try:
        array, text = array_of(a, variable), _written(a, variable)
    except ValueError as error:  # numerics has no error of its own
        raise UcritError(str(error)) from None
    if names:
        conditions, settled, either_sign = _conditions(a)
        return RouthTest(text, array, conditions, settled, taken, either_sign)
    return RouthTest(text, array, (), array.right_half_plane == 0 and array.imaginary_axis == 0)


def _exact(coefficients: Iterable[Any]) -> list[Any]:
    from ..linear.forms_convert import exact

    try:
        return [exact(c) for c in coefficients]
    except TypeError:
        raise UcritError(f"a polynomial is a formula or a list of its coefficients, got {coefficients!r}") from None


def _read(text: str, variable: str, positive: Sequence[str]) -> list[Any]:
    """Return the ascending coefficients of a polynomial in words."""
    import sympy as sp

    from ...core.formulas.expressions import FUNCTIONS, parse

    text = re.sub("[⁰¹²³⁴⁵⁶⁷⁸⁹]+", lambda raised: "^" + unicodedata.normalize("NFKC", raised[0]), text)
    tokens = list(_tokens(text))
    names = {token for kind, token in tokens if kind == "name"} - {variable, "pi", *FUNCTIONS}
    symbols = {_safe(name): sp.Symbol(name, real=True, positive=name in positive or None) for name in names}
    s = symbols[_safe(variable)] = sp.Dummy(variable)
    formula, no_polynomial = _with_products(tokens), UcritError(f"'{text}' is no polynomial in {variable}")
    try:
        expression = parse(formula, symbols if _degree(formula, text) else {}, "polynomial")
        coefficients = sp.Poly(sp.cancel(sp.sympify(expression)), s).all_coeffs()[::-1]
    except (sp.PolynomialError, RecursionError, MemoryError):
        raise no_polynomial from None
    except (TypeError, ValueError, OverflowError) as error:
        if isinstance(error, UcritError):
            raise
        raise UcritError(f"'{text}' holds a number that is not finite") from None
    if any(c.has(s) for c in coefficients):
        raise no_polynomial
    return _exact(coefficients)


def _tokens(text: str) -> Iterator[tuple[str, str]]:
    """Yield kind (``number``, ``name``, ``sign``) and text of each piece of a formula; ``)`` counts as a value."""
    position, end = 0, len(text.rstrip())
    while position < end:
        match = _TOKEN.match(text, position)
        if match is None or match.lastgroup is None:
            raise UcritError(f"the formula '{text}' cannot be read at '{text[position:].strip()[:10]}'")
        token, position = match[match.lastgroup], match.end()
        yield ("name", token) if match.lastgroup == "name" else (match.lastgroup, "**" if token == "^" else token)


def _with_products(tokens: Sequence[tuple[str, str]]) -> str:
    """Return a formula as Python reads it, with ``*`` between factors that only stand side by side.

    >>> _with_products(list(_tokens("2 s^3 + (a b + 1)s")))
    '2*s**3+(a*b+1)*s'
    """
    from ...core.formulas.expressions import FUNCTIONS

    pieces: list[str] = []
    last = ("sign", "")
    for kind, token in tokens:
        function_call = token == "(" and last[0] == "name" and last[1] in FUNCTIONS
        if (last[0] != "sign" or last[1] == ")") and (kind != "sign" or token == "(") and not function_call:
            pieces.append("*")
        pieces.append(_safe(token) if kind == "name" else token)
        last = (kind, token)
    return "".join(pieces)


def _safe(name: str) -> str:
    """Return a name that Python can read: ``lambda`` is a symbol like others here."""
    return f"{name}_" if keyword.iskeyword(name) else name


def _degree(formula: str, text: str) -> int:
    """Return the power that a formula comes to at most; powers that are no small whole numbers are refused."""

    def of(node: ast.AST) -> int:
        match node:
            case ast.BinOp(op=ast.Pow(), left=left, right=ast.Constant(value=int(power))):
                return of(left) * power
            case ast.BinOp(op=ast.Pow(), right=right):
                raise UcritError(f"'{text}': a power must be a whole number, got '{ast.unparse(right)}'")
            case ast.BinOp(op=ast.Mult() | ast.Div(), left=left, right=right):
                return of(left) + of(right)
        return max((of(child) for child in ast.iter_child_nodes(node)), default=1)

    try:
        degree = of(ast.parse(formula, mode="eval").body)
    except SyntaxError:
        raise UcritError(f"the formula '{text}' cannot be read") from None
    if degree > MAX_DEGREE:
        raise UcritError(f"'{text}': powers may come to {MAX_DEGREE} at most, got {degree}")
    return degree


def _conditions(a: Sequence[Any]) -> tuple[tuple[str, ...], bool | None, bool]:
    """Return what must be positive, whether signs settle that, and whether the polynomial may change its sign."""
    import sympy as sp

    from ...core.derivation.characteristic import characteristic_polynomial
    from ...core.formulas.factor import definite_sign
    from .conditions import conditions

    polynomial = characteristic_polynomial([sp.Matrix([[c]]) for c in a], "polynomial")
    symbols = sorted({symbol for c in a for symbol in c.free_symbols}, key=lambda symbol: str(symbol.name))
    facts = conditions(polynomial, symbols, "polynomial")
    if polynomial.zeros or facts["kind"] == "neutral":
        return (), False, False
    either_sign = facts["settled"] is None and definite_sign(polynomial.leading) is None
    return tuple(c["expression"] for c in facts["conditions"]), facts["settled"], either_sign


def _text(value: Any) -> str:
    """Return a number to six digits, an expression as short as may be."""
    import sympy as sp

    from ..linear.forms_convert import text

    return min(text(sp.factor(value)), text(sp.sympify(value)), key=len)


def _written(a: Sequence[Any], variable: str) -> str:
    """Return a polynomial with descending powers."""
    written = ""
    for power, c in reversed(list(enumerate(a))):
        if c == 0:
            continue
        letter = "" if power == 0 else variable if power == 1 else f"{variable}^{power}"
        number = _text(c)
        minus, number = number.startswith("-"), number.removeprefix("-")
        number = f"({number})" if _is_sum(number) else number
        term = letter if number == "1" and letter else f"{number} {letter}".rstrip()
        sign = (" - " if minus else " + ") if written else "-" if minus else ""
        written += sign + term
    return written


def _is_sum(text: str) -> bool:
    """Tell whether a formula is a sum once what is in brackets is left out."""
    while text != (text := re.sub(r"\([^()]*\)", "", text)):
        pass
    return " " in text


def _shown(array: RouthArray) -> tuple[RouthArray, list[str]]:
    """Return an array to be printed, in which a number stands for each long element, and these elements."""
    if array.right_half_plane is not None:
        return array, []
    rows: list[tuple[str, ...]] = []
    long: list[str] = []
    for row in array.rows:
        texts = [_text(x) for x in row]
        for j, text in enumerate(texts):
            if len(text) > WIDE:
                long.append(f"#{len(long) + 1} = {text}")
                texts[j] = f"#{len(long)}"
        rows.append(tuple(texts))
    return replace(array, rows=tuple(rows)), long
