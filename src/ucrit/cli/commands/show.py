"""``ucrit show``: the equations of a model and the numbers of a vehicle."""

from __future__ import annotations

import click

from ..output import json_option, print_json
from ..parameters import Name


@click.command("show", short_help="Show the equations of a model, the numbers of a vehicle.")
@click.argument("subject", metavar="NAME", type=Name("model", "vehicle", "controller", suffix=".toml"))
@click.option(
    "--free",
    metavar="NAMES",
    default="few",
    help="Parameters that the criteria keep as symbols, such as U,a; numbers for the rest. If not given, all, or the "
    "few that matter most where all would be too long.",
)
@json_option
def command(subject: str, free: str, as_json: bool) -> None:
    """Show parameters, variables, equations of motion, linear matrices, criteria and sources.

    NAME is one from 'ucrit list', of a model, a vehicle or a controller; or a vehicle file or a Python file with a
    model. The formulas can be pasted into Python; x' is the rate of x.

    \b
    Examples:
      ucrit show car
      ucrit show caravan
      ucrit show caravan --free U,a
      ucrit show lean-by-front-steering
      ucrit show my_model.py
      ucrit show my_model.py:Caster --json

    Exit status: 0 done; 2 wrong input.
    """
    from ...analyses.about.laws import describe_controller
    from ...analyses.about.show import show
    from ...catalogue import controller_names

    law = subject.replace("_", "-") in controller_names()
    if law and free != "few":
        raise click.UsageError("--free chooses symbols of a vehicle's criteria; a controller alone has none")
    found = describe_controller(subject) if law else show(subject, free=free)
    if as_json:
        print_json(found)
        return
    from ...analyses.about.show import ModelDescription
    from ..render_model import show_controller, show_model
    from ..terminal import terminal

    if isinstance(found, ModelDescription):
        show_model(terminal(), found)
    else:
        show_controller(terminal(), found)
