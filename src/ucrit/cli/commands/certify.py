"""``ucrit certify``: stability of a whole region, proved."""

from __future__ import annotations

import click

from ..output import json_option, print_json
from ..parameters import Name, assignments, complete_parameters, load_vehicle
from ..progress import progress

NOT_STABLE = 3
UNDECIDED = 1


@click.command("certify", short_help="Prove stability for every vehicle of a region, or find one that is not stable.")
@click.argument("vehicle", type=Name("vehicle", suffix=".toml"))
@click.argument("ranges", nargs=-1, required=True, metavar="NAME=LO:HI...", shell_complete=complete_parameters)
@click.option(
    "--set",
    "changes",
    metavar="NAME=VALUE",
    multiple=True,
    shell_complete=complete_parameters,
    help="Change a parameter that is not in the region; may be repeated.",
)
@click.option("--boxes", type=int, default=100_000, show_default=True, help="Boxes to look at before giving up.")
@click.option("--fail-if-unstable", is_flag=True, help="Leave with status 3 if refuted, 1 if undecided.")
@json_option
def command(
    vehicle: str, ranges: tuple[str, ...], changes: tuple[str, ...], boxes: int, fail_if_unstable: bool, as_json: bool
) -> int:
    """Prove that VEHICLE is stable for every value in the ranges, or find values for which it is not.

    The proof holds for all real numbers in the region: it is computed with intervals that are rounded outward, and
    decimals mean what they say.

    \b
    Examples:
      ucrit certify caravan m=1000:1300 "U=20:60 km/h"
      ucrit certify caravan c=4000:6000 "k=5:6 kN/m" U=1:20 --fail-if-unstable

    \b
    Exit status: 0 done, proved or not; 2 wrong input;
                 with --fail-if-unstable also 3 a counter-example, 1 undecided.
    """
    from ...analyses.regions.certify import certify
    from .sweep import refuse_both

    changed, region = assignments(changes, "a=1.9"), assignments(ranges, "m=1000:1300")
    refuse_both(region, changed)
    subject = load_vehicle(vehicle, changed)
    with progress("boxes") as advance:
        found = certify(subject, boxes=boxes, progress=advance, **region)
    if as_json:
        print_json(found)
    else:
        from ..render_sure import show_certificate
        from ..terminal import terminal

        show_certificate(terminal(), found)
    failing = {"refuted": NOT_STABLE, "undecided": UNDECIDED}.get(found.state, 0)
    return failing if fail_if_unstable else 0
