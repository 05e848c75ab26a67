"""Models, listings and check reports as text for a terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..core.contract.tolerances import Tolerances
from .render import in_few
from .terminal import Page, vehicle_head
from .wrap import number, short_numbers, shorten

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rich.console import Console

    from ..analyses.about.cite import Citations
    from ..analyses.about.laws import ControllerDescription
    from ..analyses.about.listing import Entry, Listing
    from ..analyses.about.show import Matrix, ModelDescription
    from ..checks import Report

COLOURS = {True: "green", False: "bold red", None: "dim"}
WORDS = {True: "pass", False: "FAIL", None: "-"}


def show_listing(console: Console, found: Listing) -> None:
    """Print the listing, a line each; vehicles are grouped by their model."""
    page = Page(console)
    if found.models:
        page.line(("Models", "bold"), ("   ucrit show NAME: the equations, ucrit new NAME: a vehicle file", "dim"))
        _entries(page, found.models, _widest(found.models))
    if found.models and found.vehicles:
        page.line()
    if found.vehicles:
        page.line(("Vehicles", "bold"), ("   ucrit analyze NAME: the verdict", "dim"))
        for model in dict.fromkeys(e.model for e in found.vehicles):
            page.line(f"  {model}")
            _entries(page, [e for e in found.vehicles if e.model == model], _widest(found.vehicles), indent=4)
    if found.controllers:
        if found.models or found.vehicles:
            page.line()
        page.line(("Controllers", "bold"), ("   ucrit show NAME: the law", "dim"))
        _entries(page, found.controllers, _widest(found.controllers))


def _widest(entries: Sequence[Entry]) -> int:
    return max(len(e.name) for e in entries)


def _entries(page: Page, entries: Sequence[Entry], width: int, indent: int = 2) -> None:
    for e in entries:
        lead = " " * indent + f"{e.name:<{width}}  "
        page.line((lead, "cyan"), shorten(e.title, page.width - len(lead)))


def show_citations(console: Console, found: Citations) -> None:
    """Print sources under what rests on them, then the works that they name."""
    page = Page(console)
    for of in dict.fromkeys(c.of for c in found):
        page.line((of[:1].upper() + of[1:], "bold"))
        for source in (c.source for c in found if c.of == of):
            page.paragraph(source, indent=2, hanging=2)
    page.line(("Works", "bold"), ("   --bibtex prints them for a bibliography", "dim"))
    for work in found.works:
        page.paragraph(str(work), indent=2, hanging=2)


def show_model(console: Console, found: ModelDescription) -> None:
    """Print everything about a model, and the numbers of a vehicle where one was asked for."""
    page = Page(console)
    if found.vehicle is not None:
        vehicle_head(page, found.vehicle)
        page.line(f"Model: {found.model}")
    else:
        page.paragraph(found.model, "bold")
        page.paragraph(found.title)
    if found.notes:
        page.line()
        page.paragraph(found.notes)
    _parameters(page, found)
    for head, group in (("Variables", found.variables), ("Inputs", found.inputs), ("Outputs", found.outputs)):
        if group:
            page.heading(head)
            page.table([[q.name, _unit(q.unit), q.meaning] for q in group])
    _equations(page, found)
    _polynomial(page, found)
    _criteria(page, found)
    if found.sources:
        page.heading("Compared with")
        for source in found.sources:
            page.paragraph(source, indent=2, hanging=2)


def show_controller(console: Console, found: ControllerDescription) -> None:
    """Print everything about a controller."""
    page = Page(console)
    page.paragraph(found.controller, "bold")
    page.paragraph(found.title)
    if found.notes:
        page.line()
        page.paragraph(found.notes)
    groups = (
        ("Parameters", found.parameters),
        ("States", found.variables),
        ("Inputs", found.inputs),
        ("Outputs", found.outputs),
    )
    for head, group in groups:
        if group:
            page.heading(head)
            page.table([[q.name, _unit(q.unit), q.meaning] for q in group])
    demands = ", which stays an input: what is demanded" if found.through else ""
    page.heading(f"Drives {', '.join(found.drives)}{demands}")
    for name, text in found.law.items():
        page.formula(f"{name} = {text}", indent=2)
    for equation in found.equations:
        page.formula(f"{equation} = 0", indent=2)


def _unit(unit: str) -> str:
    return "-" if unit == "1" else unit


def _parameters(page: Page, found: ModelDescription) -> None:
    page.heading("Parameters")
    values = {} if found.vehicle is None else found.vehicle.values
    tolerances = Tolerances() if found.vehicle is None else found.vehicle.info.tolerances
    rows = []
    for p in found.parameters:
        value = [number(float(values[p.name]), 6)] if values else []
        known = f" ({tolerances.of(p.name)})" if tolerances.of(p.name) else ""
        default = "" if p.default is None or values else f"; {number(p.default, 6)} by default"
        allowed = p.allowed.replace(f" {p.unit}", "").replace(" in", "")
        rows.append([p.name, *value, _unit(p.unit), f"{p.meaning}{known}; {allowed}{default}"])
    page.table(rows, right=(1,) if values else ())
    for one, other, coefficient in tolerances.correlations:
        page.line(f"  {one} and {other} are correlated: {number(coefficient, 6)}")


def _equations(page: Page, found: ModelDescription) -> None:
    page.heading("Equations of motion (x' is the rate of x)")
    for equation in found.equations:
        page.formula(f"{equation} = 0", indent=2)
    if found.definitions:
        page.heading("where")
    for name, formula in found.definitions.items():
        page.formula(f"{name} = {formula}", indent=2)
    page.heading("Linear about the basic motion: " + _linear(found))
    page.line(f"  q = [{', '.join(found.unknowns)}]")
    if found.inputs:
        page.line(f"  u = [{', '.join(u.name for u in found.inputs)}]")
    for order, matrix in enumerate(found.P):
        _matrix(page, f"P_{order}", matrix, found.unknowns)
    if found.inputs:
        _matrix(page, "Q", found.Q, [u.name for u in found.inputs])


def _linear(found: ModelDescription) -> str:
    terms = [f"P_{k} q" + "'" * k for k in range(len(found.P))]
    return " + ".join(terms) + (" = Q u" if found.inputs else " = 0")


def _matrix(page: Page, name: str, matrix: Matrix, columns: Sequence[str]) -> None:
    """Print a matrix in rows where they fit, else its entries other than zero one by one."""
    cells = [[f.text for f in row] for row in matrix]
    widths = [max(len(row[j]) for row in cells) for j in range(len(columns))]
    lead = f"  {name} = "
    if len(lead) + 2 + sum(w + 2 for w in widths) <= page.width:
        for i, row in enumerate(cells):
            text = "  ".join(cell.rjust(w) for cell, w in zip(row, widths, strict=True))
            page.line((lead if i == 0 else " " * len(lead)) + f"[{text}]")
        return
    page.line(f"  {name}, entries other than 0:")
    for i, row in enumerate(cells, 1):
        for j, cell in enumerate(row, 1):
            if cell != "0":
                page.formula(f"{name}[{i},{j}] = {cell}", indent=4)


def _polynomial(page: Page, found: ModelDescription) -> None:
    order = len(found.polynomial) - 1
    page.heading(f"Characteristic polynomial a_0 + a_1 s + ... of degree {order}")
    for k, coefficient in enumerate(found.polynomial):
        page.formula(f"a_{k} = {coefficient}", indent=2)


def _criteria(page: Page, found: ModelDescription) -> None:
    page.heading("Stable if and only if")
    if found.criteria is not None and found.criteria.free is not None:
        page.paragraph(in_few(found.criteria, found.why_no_criteria), indent=2)
    if found.criteria is None:
        page.paragraph(found.why_no_criteria, indent=2)
    elif found.criteria.settled is not None:
        page.paragraph(str(found.criteria), indent=2)
    else:
        for c in found.criteria:
            page.line("  ", (f"{c.name} (else {c.failure})", "dim"))
            page.formula(short_numbers(str(c)), indent=4)


def show_report(console: Console, report: Report) -> None:
    """Print the outcome of checks, a word before each."""
    page = Page(console)
    page.line((str(report).partition("\n")[0], "bold green" if report.ok else "bold red"))
    for check in report.checks:
        word = WORDS[check.passed]
        rows = page.wrapped(f"{check.name}: {check.detail}", 8, 2)
        page.line("  ", (f"{word:<4}", COLOURS[check.passed]), rows[0][6:])
        for row in rows[1:]:
            page.line(row)
