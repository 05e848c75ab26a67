"""``ucrit sweep``: stability over ranges of parameters."""

from __future__ import annotations

from typing import Any

import click

from ..output import json_option, print_json, to_stdout, writer, written
from ..parameters import Name, assignments, complete_parameters, load_vehicle
from ..progress import progress

ZARR = ".zarr"
EXAMPLE = '"U=20:130:12 km/h"'


@click.command("sweep", short_help="Stability over ranges of parameters, as a table.")
@click.argument("vehicle", type=Name("vehicle", suffix=".toml"))
@click.argument("ranges", nargs=-1, required=True, metavar="NAME=RANGE...", shell_complete=complete_parameters)
@click.option(
    "--set",
    "changes",
    metavar="NAME=VALUE",
    multiple=True,
    shell_complete=complete_parameters,
    help="Change a parameter that is not swept; may be repeated.",
)
@click.option("-o", "--out", metavar="FILE", help="Write .csv, .nc (netCDF), .json, .mat or .zarr; else CSV on stdout.")
@click.option("--scheduler", metavar="ADDRESS", help="Let the workers of this Dask scheduler compute (only to .zarr).")
@json_option
def command(
    vehicle: str,
    ranges: tuple[str, ...],
    changes: tuple[str, ...],
    out: str | None,
    scheduler: str | None,
    as_json: bool,
) -> None:
    """Tabulate stability, growth, damping and eigenvalues for every combination of parameters.

    \b
    A range is LO:HI, LO:HI:COUNT, LO:HI:COUNT:log or values separated by commas:
      m=1000:1500:50        50 masses from 1000 to 1500 kg
      "U=20:130:12 km/h"    12 speeds
      k=1e3:1e6:50:log      50 stiffnesses, one ratio between neighbours
      c=0,2000,4000         three dampings

    \b
    Examples:
      ucrit sweep caravan "U=20:130:12 km/h"
      ucrit sweep caravan m=1000:1500:50 "U=10:130:60 km/h" -o caravan.nc
      ucrit sweep caravan a=1.5:4:26 --set "m=1.4 t" -o caravan.csv
      ucrit sweep caravan m=800:2000:40 U=5:45:50 -o large.zarr

    A Zarr store is written piece by piece, may be larger than memory, and is gone on with after an interruption.

    Exit status: 0 done; 2 wrong input, nothing is written then.
    """
    from ...analyses.regions.sweep import sweep

    read, changed = assignments(ranges, EXAMPLE), assignments(changes, "a=1.9")
    refuse_both(read, changed)
    if out is not None and out.endswith(ZARR):
        refuse_json(as_json)
        stream_to(vehicle, read, changed, out, "sweep", scheduler)
        return
    if scheduler is not None:
        raise click.UsageError("--scheduler needs a store that workers can write to: give -o FILE.zarr too")
    write = (print_json if as_json else to_stdout) if out is None else writer(out, pictures=(), more={ZARR: to_stdout})
    subject = load_vehicle(vehicle, changed)
    with progress("sweep") as advance:
        result = sweep(subject, progress=advance, **read)
    write(result)
    if out is not None and as_json:
        print_json(result)
    elif out is not None:
        written(out)


def stream_to(
    vehicle: str, ranges: dict[str, Any], changes: dict[str, Any], store: str, kind: str, scheduler: str | None
) -> None:
    """Write a sweep or a map to a Zarr store, piece by piece."""
    from ...analyses.regions.stream import stream

    subject = load_vehicle(vehicle, changes)
    with progress(kind) as advance:
        stream(subject, store, kind=kind, client=scheduler, progress=advance, **ranges)
    written(store)


def refuse_json(as_json: bool) -> None:
    """Refuse to print what may be larger than memory."""
    from ...core.errors import UcritError

    if as_json:
        raise UcritError("--json prints a result that is held in memory, a .zarr store may be larger: give one of them")


def refuse_both(ranges: dict[str, Any], changes: dict[str, Any]) -> None:
    """Refuse a parameter that has both a range and a value."""
    from ...core.errors import UcritError

    for name in ranges.keys() & changes.keys():
        given = f"as the range {ranges[name]!r} and as {changes[name]!r}"
        raise UcritError(f"parameter {name} is given twice, {given}")
