"""The one place that prints: lines with styles, aligned columns, indented paragraphs."""

from __future__ import annotations

import sys
import textwrap
from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.console import Console

    from ..core.contract.model import Model

WIDEST = 110
"""Lines are not made longer than this on a wide terminal."""

Span = str | tuple[str, str]


def terminal(stderr: bool = False) -> Console:
    """Return the console: colours where the terminal has them, else 80 columns of plain text."""
    from rich.console import Console

    console = Console(file=sys.stderr if stderr else sys.stdout, highlight=False, markup=False, emoji=False)
    console.width = min(console.width, WIDEST)
    return console


def printable(text: str) -> str:
    """Replace characters that would steer the terminal."""
    return "".join(c if c.isprintable() else " " for c in text)


class Page:
    """Prints to a console, line by line, never wider than it where a text can be wrapped."""

    def __init__(self, console: Console) -> None:
        self.console = console
        self.width = max(console.width, 40)

    @property
    def plus_minus(self) -> str:
        """A plus-minus sign that the terminal's encoding has."""
        try:
            "\u00b1".encode(self.console.encoding)
        except (UnicodeEncodeError, LookupError):
            return "+-"
        return "\u00b1"

    def line(self, *spans: Span) -> None:
        """Print one line of texts, each plain or with a style."""
        from rich.text import Text

        parts = [(s, "") if isinstance(s, str) else s for s in spans]
        text = Text.assemble(*((printable(t), style) for t, style in parts))
        text.rstrip()
        self.console.print(text, soft_wrap=True)

    def heading(self, text: str) -> None:
        """Print a heading after a blank line."""
        self.line()
        self.line((text, "bold"))

    def wrapped(self, text: str, indent: int = 0, hanging: int = 0) -> list[str]:
        """Return the rows of a text that is wrapped at spaces."""
        lead = " " * indent
        return textwrap.wrap(
            printable(" ".join(text.split())),
            self.width,
            initial_indent=lead,
            subsequent_indent=lead + " " * hanging,
            break_on_hyphens=False,
        )

    def paragraph(self, text: str, style: str = "", indent: int = 0, hanging: int = 0) -> None:
        """Print a wrapped text, each of its paragraphs on new lines."""
        for block in text.split("\n\n"):
            for row in self.wrapped(block, indent, hanging):
                self.line((row, style))

    def formula(self, text: str, indent: int = 4, most: int = 0) -> None:
        """Print a wrapped formula; ``most`` lines of it where that is given."""
        from .wrap import wrap_formula

        rows = wrap_formula(printable(text), self.width - indent)
        cut = len(rows) - most if most and len(rows) > most + 1 else 0
        for row in rows[: len(rows) - cut]:
            self.line(" " * indent + row)
        if cut:
            self.line(" " * indent, (f"... {cut} more lines", "dim"))

    def table(self, rows: Sequence[Sequence[str]], head: Sequence[str] = (), right: Sequence[int] = ()) -> None:
        """Print columns, those in ``right`` aligned right; the last column takes what is left and wraps."""
        everything = [head, *rows] if head else list(rows)
        if not everything:
            return
        count = len(everything[0])
        widths = [max(len(row[i]) for row in everything) for i in range(count)]
        last = max(self.width - 2 - sum(w + 2 for w in widths[:-1]), 20)
        for number, row in enumerate(everything):
            cells = [c.rjust(w) if i in right else c.ljust(w) for i, (c, w) in enumerate(zip(row, widths, strict=True))]
            lead = "  " + "".join(cell + "  " for cell in cells[:-1])
            wrapped = textwrap.wrap(printable(row[-1]), last, break_on_hyphens=False) or [""]
            if count - 1 in right:
                wrapped[0] = wrapped[0].rjust(widths[-1])
            style = "dim" if head and number == 0 else ""
            self.line((lead + wrapped[0], style))
            for more in wrapped[1:]:
                self.line(" " * len(lead) + more)


def vehicle_head(page: Page, vehicle: Model) -> None:
    """Print who a vehicle is: name, model, source, remark."""
    info, model = vehicle.info, type(vehicle)
    page.paragraph(info.name or model.__name__, "bold")
    page.paragraph(model.title())
    for word, text in (("Source", info.source), ("Note", info.note)):
        if text:
            page.paragraph(f"{word}: {text}", "dim")
