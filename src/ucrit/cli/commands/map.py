"""``ucrit map``: where in a plane of parameters a vehicle is stable."""

from __future__ import annotations

from typing import Any

import click

from ..output import PICTURES, json_option, print_json, save, writer, written
from ..parameters import Name, assignments, complete_parameters, load_vehicle
from .sweep import EXAMPLE, ZARR, refuse_both, refuse_json, stream_to

TEXTS = (".csv", ".json")
MAX_ROWS = 5_000_000
"""Points that a file of text may hold: some gigabytes of memory while it is written."""


@click.command("map", short_help="Where in a plane of parameters a vehicle is stable, as a picture.")
@click.argument("vehicle", type=Name("vehicle", suffix=".toml"))
@click.argument("ranges", nargs=-1, required=True, metavar="X=RANGE Y=RANGE", shell_complete=complete_parameters)
@click.option(
    "--set",
    "changes",
    metavar="NAME=VALUE",
    multiple=True,
    shell_complete=complete_parameters,
    help="Change a parameter that is not in the ranges; may be repeated.",
)
@click.option("--margins", is_flag=True, help="Tell growth and damping too, from eigenvalues: takes longer.")
@click.option(
    "--engine",
    default="auto",
    show_default=True,
    metavar="ENGINE",
    help="What computes: auto, numpy, numba (compiled) or cuda (an NVIDIA GPU); the answer is the same.",
)
@click.option(
    "-o", "--out", metavar="FILE", help="Draw a .svg, .png or .pdf, or write .csv, .nc (netCDF), .json, .mat, .zarr."
)
@json_option
def command(
    vehicle: str,
    ranges: tuple[str, ...],
    changes: tuple[str, ...],
    margins: bool,
    engine: str,
    out: str | None,
    as_json: bool,
) -> None:
    """Judge VEHICLE for every combination of two parameters' values, or of more, and tell what share is stable.

    \b
    A range is LO:HI (100 values), LO:HI:COUNT, LO:HI:COUNT:log or values
    separated by commas:
      "U=20:130:400 km/h"   400 speeds
      k=1e3:1e6:400:log     400 stiffnesses, one ratio between neighbours

    \b
    Examples:
      ucrit map caravan c=0:8000:400 "U=20:180:400 km/h" -o map.svg
      ucrit map caravan m=500:2500 I_c=500:4000 --set "U=100 km/h" --margins
      ucrit map caravan c=0:8000:10000 U=5:50:10000 --engine numba

    A picture marks the vehicle as it is; with --margins it has lines of equal damping. A Zarr store is written piece by
    piece, may be larger than memory, and is gone on with after an interruption.

    Exit status: 0 done, stable or not; 2 wrong input, nothing is written then.
    """
    from ...analyses.regions.stability_map import stability_map
    from ...core.errors import UcritError

    read, changed = assignments(ranges, EXAMPLE), assignments(changes, "a=1.9")
    refuse_both(read, changed)
    if out is not None and out.endswith(ZARR):
        refuse_json(as_json)
        if margins or engine != "auto":
            raise UcritError("a map in a .zarr store has verdicts only, computed by the engine 'auto'")
        stream_to(vehicle, read, changed, out, "map", None)
        return
    subject = load_vehicle(vehicle, changed)

    def draw(result: Any) -> None:
        from ...plots import plot_map

        save(plot_map(result, vehicle=subject), str(out))

    write = None if out is None else writer(out, pictures=(), more={**dict.fromkeys(PICTURES, draw), ZARR: draw})
    if out is not None and out.lower().endswith(PICTURES) and len(read) != 2:
        raise UcritError(f"a map is drawn over two parameters, got {', '.join(read)}; other files may have more")
    result = stability_map(subject, engine=engine, margins=margins, **read)
    if out is not None and out.lower().endswith(TEXTS) and result.stable.size > MAX_ROWS:
        raise UcritError(
            f"a map of {result.stable.size:,} points is too large for '{out}', at most {MAX_ROWS:,} as text; "
            "take .nc, .mat or .zarr"
        )
    if write is not None:
        write(result)
    if as_json:
        print_json(result)
        return
    from ..render_map import show_map
    from ..terminal import terminal

    show_map(terminal(), subject, result)
    if out is not None:
        written(out)
