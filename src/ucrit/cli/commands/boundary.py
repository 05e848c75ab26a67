"""``ucrit boundary``: where stability changes over two or three parameters."""

from __future__ import annotations

import click

from ..output import json_option, print_json, to_stdout, writer, written
from ..parameters import Name, assignments, complete_parameters, load_vehicle
from .sweep import refuse_both


@click.command("boundary", short_help="Where stability changes over two or three parameters.")
@click.argument("vehicle", type=Name("vehicle", suffix=".toml"))
@click.argument("ranges", nargs=-1, required=True, metavar="NAME=RANGE...", shell_complete=complete_parameters)
@click.option(
    "--set",
    "changes",
    metavar="NAME=VALUE",
    multiple=True,
    shell_complete=complete_parameters,
    help="Change a parameter that is not in the ranges; may be repeated.",
)
@click.option(
    "--tolerance",
    type=float,
    metavar="SHARE",
    help="Share of each range down to which boundaries are looked for; 1/512 for two parameters, 1/64 for three.",
)
@click.option(
    "-o",
    "--out",
    metavar="FILE",
    help="Write .csv, .nc (netCDF), .json, .mat or a .png, .svg, .pdf; else CSV on stdout.",
)
@json_option
def command(
    vehicle: str,
    ranges: tuple[str, ...],
    changes: tuple[str, ...],
    tolerance: float | None,
    out: str | None,
    as_json: bool,
) -> None:
    """Find the curves over two, or the surface over three, parameters on which stability changes.

    \b
    A range is LO:HI or LO:HI:log, with a unit or in SI:
      "U=20:130 km/h"       speeds
      k=1e3:1e6:log         stiffnesses, looked at on a logarithmic scale

    \b
    Examples:
      ucrit boundary caravan c=0:8000 "U=20:180 km/h" -o boundary.svg
      ucrit boundary caravan c=0:8000 U=5:50 m=500:2500 -o boundary.csv

    Exit status: 0 done; 2 wrong input, nothing is written then.
    """
    from ...analyses.regions.boundary import boundary

    write = (print_json if as_json else to_stdout) if out is None else writer(out)
    subject = load_vehicle(vehicle, assignments(changes, "a=1.9"))
    read = assignments(ranges, '"U=20:130 km/h"')
    refuse_both(read, assignments(changes, "a=1.9"))
    found = boundary(subject, tolerance=tolerance, **read)
    write(found)
    if out is not None and as_json:
        print_json(found)
    elif out is not None:
        written(out)
