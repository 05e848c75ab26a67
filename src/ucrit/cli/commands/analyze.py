"""``ucrit analyze``: the verdict on one vehicle."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from ..output import json_option, print_json
from ..parameters import Name, assignments, complete_parameters, load_vehicle

if TYPE_CHECKING:
    from ...analyses.stability.analyze import Analysis

NOT_STABLE = 3


@click.command("analyze", short_help="Judge a vehicle: stable up to what speed, and how it fails.")
@click.argument("vehicle", type=Name("vehicle", suffix=".toml"))
@click.option(
    "--set",
    "changes",
    metavar="NAME=VALUE",
    multiple=True,
    shell_complete=complete_parameters,
    help="Change a parameter; may be repeated.",
)
@click.option("--upto", metavar="SPEED", help="Judge up to this speed; the vehicle's own by default.")
@click.option("--report", type=click.Path(), metavar="FILE.html", help="Write a report: one page, with drawings.")
@click.option(
    "--map",
    "map_parameters",
    nargs=2,
    metavar="X Y",
    shell_complete=complete_parameters,
    help="The two parameters of the report's stability map.",
)
@click.option("--audit", is_flag=True, help="Check the verdict by simulating the non-linear equations.")
@click.option(
    "--free",
    metavar="NAMES",
    default="few",
    help="Parameters that the criteria keep as symbols, such as U,a; numbers for the rest. If not given, all, or the "
    "few that matter most where all would be too long.",
)
@json_option
@click.option("--fail-if-unstable", is_flag=True, help="Leave with status 3 if not stable up to the speed.")
def command(
    vehicle: str,
    changes: tuple[str, ...],
    upto: str | None,
    report: str | None,
    map_parameters: tuple[str, str] | None,
    audit: bool,
    free: str,
    as_json: bool,
    fail_if_unstable: bool,
) -> int:
    """Judge VEHICLE: is it stable, up to what speed, how does it fail, what to change?

    VEHICLE is the name of one that is shipped (see 'ucrit list') or a vehicle file (see 'ucrit new').

    \b
    Examples:
      ucrit analyze caravan
      ucrit analyze caravan --upto "130 km/h"
      ucrit analyze caravan --set a=1.9 --set "m=2 t" --set "C=1.5 kN/deg"
      ucrit analyze caravan --audit
      ucrit analyze caravan --free U,a
      ucrit analyze mine.toml --report mine.html --map a m
      ucrit analyze mine.toml --upto 30 --json | jq .verdict.sentence
      ucrit analyze mine.toml --fail-if-unstable || echo "do not drive"

    A number is in SI units; other units are written behind it: "110 km/h", "2 t", "3 deg".
    Backing up is a negative speed: --upto="-10 km/h".

    \b
    Exit status: 0 judged, stable or not; 2 wrong input;
                 3 not stable up to the speed (only with --fail-if-unstable).
    """
    from ...analyses.stability.analyze import analyze

    if map_parameters and report is None:
        raise click.UsageError("--map chooses what the report draws: give --report FILE.html too")
    subject = load_vehicle(vehicle, assignments(changes, 'a=1.9 or "m=2 t"'), upto)
    found = analyze(subject, audit=audit, free=free)
    if report is not None:
        _write(found, report, map_parameters)
    if as_json:
        print_json(found)
    else:
        from ..render import show_analysis
        from ..terminal import terminal

        show_analysis(terminal(), found, report)
    return NOT_STABLE if fail_if_unstable and not found.stable else 0


def _write(found: Analysis, path: str, map_parameters: tuple[str, str] | None) -> None:
    from ...core.errors import UcritError
    from ...report import write_report

    try:
        write_report(found, path, map_parameters=map_parameters)
    except OSError as error:
        raise UcritError(f"the report '{path}' cannot be written: {error.strerror or error}") from None
