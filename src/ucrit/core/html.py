"""Small HTML tables, as notebooks show vehicles and results; every text is escaped."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from html import escape
from typing import Any

from .record import Record

LEFT = ' style="text-align:left"'


class Raw(str):
    """HTML that is put into a table as it is: a formula, a picture."""

    __slots__ = ()


def text(value: Any) -> str:
    """Return a value as the text of a cell: six digits of a number, nothing for ``None``.

    >>> text(-1.23456789), text(2.5 - 1j), text(None), text(True)
    ('-1.23457', '2.5-1j', '', 'yes')
    """
    if isinstance(value, Raw):
        return value
    if value is None:
        return ""
    value = value.item() if hasattr(value, "item") else value
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, complex):
        return f"{value.real:.6g}{value.imag:+.6g}j" if value.imag else f"{value.real:.6g}"
    return f"{value:.6g}" if isinstance(value, int | float) else escape(str(value))


def lines(told: str) -> str:
    """Return text of several lines as it stands in a terminal."""
    return f'<pre style="font-family:monospace">{escape(told)}</pre>'


def math_of(mathml: str, tail: str = "") -> Raw:
    """Return presentation MathML as an inline formula, with an operator and a number such as ``> 0`` behind it."""
    pieces = "".join(f"<mn>{piece}</mn>" if piece.isdigit() else f"<mo>{escape(piece)}</mo>" for piece in tail.split())
    return Raw(f"<math><mrow>{mathml}{pieces}</mrow></math>")


def with_unit(name: str, unit: str) -> str:
    """Return the head of a column: ``U [m/s]``; no brackets where there is no unit."""
    return f"{name} [{unit}]" if unit and unit != "1" else name


def quantity(value: float | None, unit: str) -> str:
    """Return a number with its unit; an en dash where there is none."""
    if value is None or math.isnan(value):
        return "\N{EN DASH}"
    return f"{value:.6g}" + ("" if unit in ("", "1") else f" {unit}")


def table(rows: Iterable[Sequence[Any]], head: Sequence[str] = (), caption: Any = "") -> str:
    """Return a table whose first column heads its rows; columns of words stand at the left, as notebooks would not.

    >>> table([(1, 1200.0)], ("number", "value"), "a <trailer>")
    '<table><caption>a &lt;trailer&gt;</caption><thead><tr><th scope="col">number</th><th scope="col">value</th></tr>\
</thead><tbody><tr><th scope="row">1</th><td>1200</td></tr></tbody></table>'
    """
    rows = list(rows)
    sides = [LEFT if all(isinstance(x, str | None) for x in column) else "" for column in zip(*rows, strict=True)]
    sides += [""] * (len(head) - len(sides))

    def cells(row: Sequence[Any]) -> str:
        first, *rest = (f"{side}>{text(value)}" for side, value in zip(sides, row, strict=False))
        return f'<th scope="row"{first}</th>' + "".join(f"<td{cell}</td>" for cell in rest)

    body = "".join(f"<tr>{cells(row)}</tr>" for row in rows)
    top = "".join(f'<th scope="col"{side}>{text(name)}</th>' for side, name in zip(sides, head, strict=False))
    title = f"<caption>{text(caption)}</caption>" if caption else ""
    return f"<table>{title}{f'<thead><tr>{top}</tr></thead>' if head else ''}<tbody>{body}</tbody></table>"


class Rich(Record):
    """A result that a notebook shows as it prints: its text, aligned as in a terminal."""

    def _repr_html_(self) -> str:
        told = str(self)
        return lines(told) if "\n" in told else f"<p>{escape(told)}</p>"
