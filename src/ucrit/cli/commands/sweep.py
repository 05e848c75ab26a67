"""``ucrit sweep``: stability over ranges of parameters."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

import click

from ..parameters import Name, assignments, complete_parameters, load_vehicle
from ..progress import progress_bar

if TYPE_CHECKING:
    from collections.abc import Callable

ZARR = ".zarr"
FORMATS = {".csv": "to_csv", ".nc": "to_netcdf", ".json": "to_json", ".mat": "to_mat"}


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
@click.option(
    "-o", "--output", metavar="FILE", help="Write .csv, .nc (netCDF), .json, .mat or .zarr; else CSV on stdout."
)
@click.option("--scheduler", metavar="ADDRESS", help="Let the workers of this Dask scheduler compute (only to .zarr).")
def command(
    vehicle: str, ranges: tuple[str, ...], changes: tuple[str, ...], output: str | None, scheduler: str | None
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
    from ...analyses.sweep import sweep

    if output is not None and output.endswith(ZARR):
        _stream(vehicle, ranges, changes, output, scheduler)
        return
    if scheduler is not None:
        raise click.UsageError("--scheduler needs a store that workers can write to: give -o FILE.zarr too")
    write = writer(output, (ZARR,))
    subject = load_vehicle(vehicle, assignments(changes, "a=1.9"))
    read = assignments(ranges, '"U=20:130:12 km/h"')
    refuse_both(read, assignments(changes, "a=1.9"))
    with progress_bar("sweep") as progress:
        result = sweep(subject, progress=progress, **read)
    write(result)


def _stream(
    vehicle: str, ranges: tuple[str, ...], changes: tuple[str, ...], output: str, scheduler: str | None
) -> None:
    """Write a sweep to a Zarr store, piece by piece."""
    from ...analyses.stream import stream

    read = assignments(ranges, '"U=20:130:12 km/h"')
    refuse_both(read, assignments(changes, "a=1.9"))
    subject = load_vehicle(vehicle, assignments(changes, "a=1.9"))
    with progress_bar("sweep") as progress:
        stream(subject, output, kind="sweep", client=scheduler, progress=progress, **read)


def refuse_both(ranges: dict[str, Any], changes: dict[str, Any]) -> None:
    """Refuse a parameter that has both a range and a value."""
    from ...core.errors import UcritError

    for name in ranges.keys() & changes.keys():
        given = f"as the range {ranges[name]!r} and as {changes[name]!r}"
        raise UcritError(f"parameter {name} is given twice, {given}")


def writer(output: str | None, others: tuple[str, ...] = ()) -> Callable[[Any], None]:
    """Return what writes a result; a file ending that is not known is refused before anything is computed."""
    from ...core.errors import UcritError

    if output is None:
        return _to_stdout
    ending = output[output.rfind(".") :] if "." in output else ""
    if ending not in FORMATS:
        raise UcritError(f"the output '{output}' must end in {', '.join((*FORMATS, *others))}")
    if ending == ".nc":
        return lambda result: _to_netcdf(result, output)
    return lambda result: getattr(result, FORMATS[ending])(output)


def _to_stdout(result: Any) -> None:
    import csv

    columns = list(result.table().columns())
    writer = csv.writer(sys.stdout, lineterminator="\n")
    writer.writerow([f"{name} [{unit}]" if unit else name for name, unit, _ in columns])
    writer.writerows(zip(*(values.tolist() for _, _, values in columns), strict=True))


def _to_netcdf(result: Any, path: str) -> None:
    """Write a netCDF file, whole or not at all."""
    from ...analyses.convert import write_whole

    content: bytes = bytes(result.to_xarray().to_netcdf(engine="scipy"))
    write_whole(path, content)
