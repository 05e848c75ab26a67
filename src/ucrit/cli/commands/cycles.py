"""``ucrit cycles``: limit cycles beyond and below the critical speed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from ..output import json_option, print_json, writer
from ..parameters import Name, assignments, complete_parameters, load_vehicle
from ..progress import progress

if TYPE_CHECKING:
    from ...analyses.nonlinear.basin import Basin
    from ...analyses.nonlinear.cycles import LimitCycles

ROWS = 12
"""Cycles of a branch that are printed; all of them are written."""


@click.command("cycles", short_help="Follow limit cycles: what happens beyond the critical speed.")
@click.argument("vehicle", type=Name("vehicle", suffix=".toml"))
@click.option(
    "--set",
    "changes",
    metavar="NAME=VALUE",
    multiple=True,
    shell_complete=complete_parameters,
    help="Change a parameter; may be repeated.",
)
@click.option("--along", metavar="NAME", help="Parameter that is varied; the speed by default.")
@click.option("--from", "lower", metavar="VALUE", help="Least value; a fifth of the critical one by default.")
@click.option("--to", "upper", metavar="VALUE", help="Greatest value; three times the critical one by default.")
@click.option(
    "--start",
    "starts",
    metavar="STATE=VALUE",
    multiple=True,
    help="Follow the cycle that the motion from theta=10deg comes to; may be repeated.",
)
@click.option("--at", metavar="VALUE", help="Tell the cycles at this value; the vehicle's own by default.")
@click.option("--basin", "disturbed", metavar="STATE", help="Simulate how large a disturbance of STATE persists.")
@click.option("-o", "--out", metavar="FILE", help="Draw (.png, .svg, .pdf) or write (.csv, .json, .mat, .nc).")
@json_option
def command(
    vehicle: str,
    changes: tuple[str, ...],
    along: str | None,
    lower: str | None,
    upper: str | None,
    starts: tuple[str, ...],
    at: str | None,
    disturbed: str | None,
    out: str | None,
    as_json: bool,
) -> None:
    """Follow the limit cycles that begin where VEHICLE starts to oscillate.

    They tell whether the vehicle beyond its critical speed swings a little more (supercritical) or is left for a
    wide oscillation at once (subcritical), and from which speed on a disturbed vehicle may keep oscillating.
    Cycles that begin nowhere in the range are found with --start: the motion is simulated until it repeats.

    \b
    Examples:
      ucrit cycles nose-gear --set k=-10 --at 25
      ucrit cycles caravan-with-stabiliser --out cycles.png
      ucrit cycles caravan-with-stabiliser --set "U=90 km/h" --basin theta
      ucrit cycles caravan-with-stabiliser --start "theta=20 deg"
      ucrit cycles worn-wheelset --from "100 km/h" --to "200 km/h" -o cycles.csv

    Exit status: 0 followed; 2 wrong input, nothing is written then.
    """
    from ...analyses.nonlinear.basin import basin
    from ...analyses.nonlinear.cycles import limit_cycles

    write = None if out is None else writer(out)
    subject = load_vehicle(vehicle, assignments(changes, 'a=1.9 or "m=2 t"'))
    start = assignments(starts, '"theta=10 deg"', "state") or None
    with progress("cycles") as advance:
        found = limit_cycles(subject, along, lower, upper, start=start, progress=advance)
    value = _value(found, at)
    told = _told(found, value, at is not None)
    border: Basin | None = None
    if disturbed is not None:
        with progress("simulations") as advance:
            border = basin(subject.with_(**{found.parameter: value}), disturbed, found, progress=advance)
    if write is not None:
        write(found)
    if as_json:
        answer = found.to_dict()
        if border is not None:
            answer["findings"]["basin"] = border.to_dict()
        print_json(answer)
        return
    _show(found, [*told, *([] if border is None else [str(border)])], out)


def _value(found: LimitCycles, at: str | None) -> float:
    from ...core.units import to_si

    value = found.vehicle.values[found.parameter] if at is None else to_si(at, found.unit, found.parameter)
    return float(value)


def _told(found: LimitCycles, value: float, asked: bool) -> list[str]:
    """Return what to expect at a value; `UcritError` where it was asked for outside the range."""
    from ...analyses.nonlinear.cycle_words import expectation

    within = found.lower <= value <= found.upper
    return [expectation(found, value)] if asked or (found.branches and within) else []


def _show(found: LimitCycles, told: list[str], out: str | None) -> None:
    from ..terminal import Page, terminal, vehicle_head

    page = Page(terminal())
    vehicle_head(page, found.vehicle)
    page.line()
    for sentence in found.sentences:
        page.paragraph(sentence)
    if told:
        page.line()
    for sentence in told:
        page.paragraph(sentence)
    for branch in found.branches:
        _table(page, branch)
    if out is not None:
        page.line()
        page.line(f"Written to {out}")


def _table(page: Any, branch: Any) -> None:
    from ...analyses.nonlinear.cycle_words import amplitude_text, leading_state, value_text
    from ..wrap import number

    name, unit = leading_state(branch)
    begun = branch.critical or branch.start
    page.heading(f"Limit cycles {'from' if branch.critical else 'by'} {value_text(branch, begun.value)}")
    head = [f"{branch.parameter} [{branch.unit}]", "Hz", f"amplitude of {name}", "growth in a period", ""]
    step = -(-len(branch.cycles) // ROWS)
    last = len(branch.cycles) - 1
    shown = [c for i, c in enumerate(branch.cycles) if i % step == 0 or c.fold or i == last]
    rows = [
        [
            number(cycle.value),
            number(cycle.frequency_hz),
            amplitude_text(cycle.amplitude[name], unit),
            "" if cycle.fold else f"{number(100 * cycle.growth, 3)} %",
            "fold" if cycle.fold else "stable" if cycle.stable else "unstable" if cycle.growth else "not told",
        ]
        for cycle in shown
    ]
    page.table(rows, head, right=(0, 1, 2, 3))
