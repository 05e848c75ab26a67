"""``ucrit handling``: a car's steady turns up to the limit."""

from __future__ import annotations

import click

from ..output import json_option, print_json, writer, written
from ..parameters import Name, assignments, complete_parameters, load_vehicle


@click.command("handling", short_help="Turns up to the limit: spin or plough-out, and the handling diagram.")
@click.argument("vehicle", type=Name("vehicle", suffix=".toml"))
@click.option(
    "--set",
    "changes",
    metavar="NAME=VALUE",
    multiple=True,
    shell_complete=complete_parameters,
    help="Change a parameter or an axle's tire; may be repeated.",
)
@click.option("--at", metavar="SPEED", help="Turn at this speed; the vehicle's own by default.")
@click.option("--radius", metavar="LENGTH", help="Keep the radius, the speed rising.")
@click.option("--steer", metavar="ANGLE", help="Keep the steer angle, the speed rising.")
@click.option("--upto", metavar="SPEED", help="With --radius or --steer: end at this speed.")
@click.option("--slip", metavar="ANGLE", default="0.3", help="End at this slip angle of an axle; 0.3 rad by default.")
@click.option(
    "-o",
    "--out",
    metavar="FILE",
    help="Draw the diagram (.png, .svg, .pdf) or write its table (.csv, .json, .mat, .nc).",
)
@json_option
def command(
    vehicle: str,
    changes: tuple[str, ...],
    at: str | None,
    radius: str | None,
    steer: str | None,
    upto: str | None,
    slip: str,
    out: str | None,
    as_json: bool,
) -> None:
    """Follow the steady turns of VEHICLE to what its tires can do.

    They are driven as in one of the three tests of ISO 4138: at constant speed from straight running on, the steer
    angle growing; or with --radius or --steer at a constant radius or steer angle, the speed rising.

    Says which axle gives way first, at what lateral acceleration, and from where on a turn is unstable with the
    steering held. Wants a car whose tires saturate, such as the model car-handling.

    \b
    Examples:
      ucrit handling spinning-car
      ucrit handling spinning-car --at "70 km/h" --out diagram.png
      ucrit handling ploughing-car --radius "60 m" --out circle.png
      ucrit handling spinning-car --steer "2 deg" --upto "150 km/h"
      ucrit handling ploughing-car --set rear_mu=0.5 --out diagram.csv
      ucrit handling ploughing-car --set front=mine.tir --set rear=mine.tir

    Exit status: 0 done, whatever the limit; 2 wrong input.
    """
    from ...analyses.nonlinear.handling import handling_diagram

    write = None if out is None else writer(out)
    if at is not None and (radius is not None or steer is not None):
        raise click.UsageError("--at keeps the speed, which rises with --radius and --steer; --upto says how far")
    car = load_vehicle(vehicle, assignments(changes, "rear_mu=0.5"), at)
    result = handling_diagram(car, slip=slip, radius=radius, angle=steer, upto=upto)
    if write is not None:
        write(result)
    if as_json:
        print_json(result)
        return
    click.echo(result)
    if out is not None:
        print()
        written(out)
