"""``ucrit uncertainty``: how sure the critical speed is."""

from __future__ import annotations

import click

from ..output import json_option, print_json, writer, written
from ..parameters import Name, assignments, complete_parameters, load_vehicle
from ..progress import progress


@click.command("uncertainty", short_help="How sure the critical speed is, with the tolerances of the vehicle file.")
@click.argument("vehicle", type=Name("vehicle", suffix=".toml"))
@click.option(
    "--set",
    "changes",
    metavar="NAME=VALUE",
    multiple=True,
    shell_complete=complete_parameters,
    help="Change a parameter, not its tolerance; may be repeated.",
)
@click.option("--upto", metavar="SPEED", help="Look up to this speed only.")
@click.option("--samples", type=int, default=4096, show_default=True, help="Vehicles to draw, a power of two.")
@click.option("--seed", type=int, default=0, show_default=True, help="The same seed gives the same result.")
@click.option("--indices", is_flag=True, help="Tell which tolerances matter, by Sobol indices (needs SALib).")
@click.option(
    "-o",
    "--out",
    metavar="FILE",
    help="Write the vehicles drawn (.csv .nc .json .mat) or a picture (.svg .png .pdf).",
)
@json_option
def command(
    vehicle: str,
    changes: tuple[str, ...],
    upto: str | None,
    samples: int,
    seed: int,
    indices: bool,
    out: str | None,
    as_json: bool,
) -> None:
    """Draw many vehicles from the tolerances in VEHICLE's file and tell how their critical speeds are distributed.

    \b
    In a vehicle file:
      m = { value = 1500, sd = 20 }               normal, standard deviation
      k = { value = "5 kN/m", min = 4e3, max = 6e3 }   uniform
      [correlations]
      m = { I_z = 0.8 }

    \b
    Examples:
      ucrit uncertainty caravan
      ucrit uncertainty caravan --indices -o caravan.svg
      ucrit uncertainty mine.toml --samples 65536 --upto "130 km/h" -o mine.csv

    Exit status: 0 done; 2 wrong input.
    """
    from ...analyses.regions.uncertainty import uncertainty

    write = None if out is None else writer(out)
    subject = load_vehicle(vehicle, assignments(changes, 'a=1.9 or "m=2 t"'))
    with progress("vehicles") as advance:
        found = uncertainty(subject, samples=samples, seed=seed, upto=upto, indices=indices, progress=advance)
    if as_json:
        if write is not None:
            write(found)
        print_json(found)
        return
    from ..render_sure import show_uncertainty
    from ..terminal import terminal

    show_uncertainty(terminal(), found)
    if write is not None:
        write(found)
        print()
        written(str(out))
