"""Small HTML tables, as notebooks show vehicles and results; every text is escaped."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from html import escape
from typing import Any


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
    """Return a table whose first column heads its rows.

    >>> table([("m", 1200.0)], ("name", "value"), "a <trailer>")
    '<table><caption>a &lt;trailer&gt;</caption><thead><tr><th scope="col">name</th><th scope="col">value</th></tr>\
</thead><tbody><tr><th scope="row">m</th><td>1200</td></tr></tbody></table>'
    """
    body = "".join(
        f'<tr><th scope="row">{text(first)}</th>' + "".join(f"<td>{text(cell)}</td>" for cell in rest) + "</tr>"
        for first, *rest in rows
    )
    top = "".join(f'<th scope="col">{text(name)}</th>' for name in head)
    title = f"<caption>{text(caption)}</caption>" if caption else ""
    return f"<table>{title}{f'<thead><tr>{top}</tr></thead>' if head else ''}<tbody>{body}</tbody></table>"


class Rich:
    """A result that a notebook shows as it prints: its text, aligned as in a terminal."""

    def _repr_html_(self) -> str:
        lines = str(self)
        return f"<pre>{escape(lines)}</pre>" if "\n" in lines else f"<p>{escape(lines)}</p>"
