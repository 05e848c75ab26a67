"""A bond graph as text for a terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .terminal import Page

if TYPE_CHECKING:
    from rich.console import Console

    from ..analyses.about.bonds import Bonds


def show_bonds(console: Console, found: Bonds, drawing: str | None = None) -> None:
    """Print elements, bonds, findings and equations; ``drawing`` is the file that it has been drawn into."""
    page = Page(console)
    if found.name:
        page.paragraph(found.name, "bold")
        page.paragraph(found.title)
    page.heading("Elements")
    page.table([[e.label, e.name, str(e.law or "")] for e in found.graph.elements])
    page.heading("Bonds, power counted along the arrow; the causal stroke is where the effort acts")
    rows = [[str(r.number), r.tail, r.head, r.effort_on, f"{r.settled_by}, {r.reason}"] for r in found.rows]
    page.table(rows, head=("no", "from", "to", "stroke at", "settled by"), right=(0,))
    if found.graph.signals:
        page.heading("Signals")
        page.table([[f"{s.variable}.{s.source}", f"read by {s.target}"] for s in found.graph.signals])
    page.heading("Findings")
    for sentence in found.findings or ("integral causality everywhere, no algebraic loop",):
        page.paragraph(sentence, indent=2, hanging=2)
    page.paragraph(_power(found), indent=2, hanging=2)
    page.heading("State equations (x' is the rate of x)" if found.equations else "State equations: none")
    for equation in found.equations:
        page.formula(equation, indent=2)
    if drawing is not None:
        page.line()
        page.line(f"Written to {drawing}")


def _power(found: Bonds) -> str:
    if found.balanced:
        return "power balances in every junction, transformer and gyrator"
    return "POWER DOES NOT BALANCE: this is a fault of the program, please report it"
