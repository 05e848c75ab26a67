"""``ucrit new``: a vehicle file to fill in."""

from __future__ import annotations

import click

from ..parameters import Name


@click.command("new", short_help="Print a vehicle file to fill in.")
@click.argument("model", type=Name("model", "vehicle", suffix=".py"))
@click.option("--like", metavar="VEHICLE", type=Name("vehicle", suffix=".toml"), help="Take a vehicle's values.")
def command(model: str, like: str | None) -> None:
    """Print a vehicle file for MODEL, each parameter with its unit, meaning and bounds.

    MODEL is a model's name, a Python file with a model, or a vehicle to copy. Parameters without a usual
    value are commented out; 'ucrit analyze' names the first one that is missing.

    \b
    Examples:
      ucrit new trailer > mine.toml
      ucrit new caravan > mine.toml
      ucrit new trailer-rigid-hitch --like caravan > stiff.toml
      ucrit new my_model.py > mine.toml

    Exit status: 0 done; 2 wrong input.
    """
    from ...analyses.about.listing import template

    click.echo(template(model, like), nl=False)
