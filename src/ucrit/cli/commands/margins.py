"""``ucrit margins``: how far a vehicle under control is from instability."""

from __future__ import annotations

import click

from ..output import json_option, print_json
from ..parameters import Name, assignments, complete_parameters, load_vehicle


@click.command("margins", short_help="Gain, phase, delay and disk margins of a vehicle under control.")
@click.argument("vehicle", type=Name("vehicle", suffix=".toml"))
@click.argument("ranges", nargs=-1, metavar="[NAME=RANGE...]", shell_complete=complete_parameters)
@click.option("--input", "chosen", metavar="NAME", help="Input at which the loop is cut; all driven ones by default.")
@click.option(
    "--set",
    "changes",
    metavar="NAME=VALUE",
    multiple=True,
    shell_complete=complete_parameters,
    help="Change a parameter; may be repeated.",
)
@click.option(
    "-o", "--out", metavar="FILE", help="Draw them over a range (.png, .svg, .pdf) or write a table (.csv, .json, ...)."
)
@json_option
def command(
    vehicle: str, ranges: tuple[str, ...], chosen: str | None, changes: tuple[str, ...], out: str | None, as_json: bool
) -> None:
    """Tell by how much the gain, the phase and the delay of the control loop may change before it is unstable.

    The vehicle's file names its controllers. With ranges the margins are a table, as CSV; a range is LO:HI, LO:HI:COUNT
    or values separated by commas. One range can be drawn.

    \b
    Examples:
      ucrit margins motorcycle-steered-to-lean
      ucrit margins motorcycle-steered-to-lean --set G=0.4
      ucrit margins motorcycle-steered-to-lean U=9:40:32
      ucrit margins motorcycle-steered-at-the-rear U=10:75:200 --out margins.png

    Exit status: 0 done; 2 wrong input.
    """
    from ...analyses.regions.sweep import read_ranges
    from ...analyses.stability.margins import driven_inputs, margins
    from ...core.errors import UcritError
    from ..output import to_stdout, writer, written
    from ..terminal import Page, terminal, vehicle_head

    write = None if out is None else writer(out)
    subject = load_vehicle(vehicle, assignments(changes, "G=0.3"))
    names = [chosen] if chosen else driven_inputs(type(subject))
    read = assignments(ranges, '"U=20:130:12 km/h"')
    spans = read_ranges(subject, read)
    if (write is not None or as_json) and len(names) > 1:
        what = "JSON" if as_json else "a file"
        raise UcritError(f"{what} holds the margins at one input: choose --input {' or --input '.join(names)}")
    page = Page(terminal())
    if write is None and not as_json and not spans:
        vehicle_head(page, subject)
        page.line()
    for name in names:
        found = margins(subject.with_(**spans), name)
        if write is not None and out is not None:
            write(found)
        if as_json:
            print_json(found)
        elif write is not None and out is not None:
            written(out)
        elif spans:
            to_stdout(found)
        else:
            page.paragraph(str(found))
