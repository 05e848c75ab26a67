"""``ucrit compare``: vehicles side by side."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from ..output import json_option, print_json
from ..parameters import Name, assignments, complete_parameters, load_vehicle

if TYPE_CHECKING:
    from ...analyses.stability.analyze import Analysis
    from ...analyses.stability.compare import Comparison


@click.command("compare", short_help="Put vehicles side by side: verdicts, modes, what differs.")
@click.argument("vehicles", nargs=-1, required=True, metavar="VEHICLE...", type=Name("vehicle", suffix=".toml"))
@click.option(
    "--set",
    "changes",
    metavar="NAME=VALUE",
    multiple=True,
    shell_complete=complete_parameters,
    help="With one vehicle: compare it with itself, changed; may be repeated.",
)
@click.option("--upto", metavar="SPEED", help="Judge all up to this speed; each its own by default.")
@json_option
def command(vehicles: tuple[str, ...], changes: tuple[str, ...], upto: str | None, as_json: bool) -> None:
    """Compare vehicles: verdicts, critical speeds, modes, and the parameters in which they differ.

    VEHICLE is the name of one that is shipped (see 'ucrit list') or a vehicle file. Vehicles of different
    models can be compared; a dash stands for what one of them does not have. Up to three fit on 80 columns.

    \b
    Examples:
      ucrit compare understeering-car oversteering-car
      ucrit compare understeering-car oversteering-car --upto "140 km/h"
      ucrit compare caravan --set c=8000 --set "m=1.1 t"
      ucrit compare caravan mine.toml --json

    Rows of speeds are in m/s, those of parameters in SI units. A mode that does not oscillate is told by its
    eigenvalue: a positive one grows. The static term is the last one of the characteristic polynomial, the
    first being 1; where it turns negative a vehicle diverges, as a car may that goes faster.

    Exit status: 0 compared, stable or not; 2 wrong input.
    """
    from ...analyses.stability.analyze import analyze
    from ...analyses.stability.compare import compare

    subjects = _subjects(vehicles, assignments(changes, 'a=1.9 or "m=2 t"'), upto)
    comparison = compare(*subjects)
    found = [analyze(subject) for subject in subjects]
    if as_json:
        print_json(_data(comparison, found))
    else:
        _show(comparison, found)


def _subjects(names: tuple[str, ...], changes: dict[str, Any], upto: str | None) -> list[Any]:
    """Return the vehicles to compare; one with changes stands for itself and itself changed."""
    from ...core.errors import UcritError

    if changes and len(names) > 1:
        raise UcritError(f"--set compares one vehicle with itself, changed; {len(names)} vehicles are given")
    if not changes and len(names) == 1:
        raise UcritError(
            f"a comparison needs a second vehicle, or a change: 'ucrit compare {names[0]} --set NAME=VALUE'"
        )
    found = [load_vehicle(name, {}, upto) for name in names]
    if changes:
        changed = load_vehicle(names[0], changes, upto)
        what = ", ".join(f"{name} = {value}" for name, value in changes.items())
        found.append(changed.with_info(name=f"with {what}"))
    return found


def _data(comparison: Comparison, found: list[Analysis]) -> dict[str, Any]:
    """Return what ``ucrit analyze --json`` tells of each vehicle, and where their parameters differ."""
    differing = [
        {"parameter": name, "unit": unit, "values": list(values)}
        for name, (unit, values) in comparison.differing.items()
    ]
    terms = [subject.static_term for subject in comparison.subjects]
    vehicles = [one.to_dict() for one in found]
    return {"schema": 1, "vehicles": vehicles, "static_terms": terms, "differing": differing}


def _show(comparison: Comparison, found: list[Analysis]) -> None:
    from ..terminal import Page, terminal

    page = Page(terminal())
    for subject, one in zip(comparison.subjects, found, strict=True):
        page.line((subject.name, "bold"))
        page.paragraph(f"{one.sentence[:1].upper()}{one.sentence[1:]}.", indent=2)
        if one.caveat:
            page.paragraph(f"But {one.caveat}.", "yellow", indent=2)
    page.line()
    for line in str(comparison).splitlines():
        page.line(line)
