"""``ucrit list``: what is shipped."""

from __future__ import annotations

import click

from ..output import json_option, print_json


@click.command("list", short_help="List the models, vehicles and controllers that are shipped.")
@click.argument("kind", required=False, type=click.Choice(["models", "vehicles", "controllers"]))
@json_option
def command(kind: str | None, as_json: bool) -> None:
    """List the models, the vehicles and the controllers that are shipped, one a line.

    A model holds equations; a vehicle is a model with numbers, which can be analyzed; a controller drives inputs.

    \b
    Examples:
      ucrit list
      ucrit list vehicles
      ucrit list models | grep caster

    Exit status: 0 done; 2 wrong input.
    """
    from ...analyses.about.listing import listing

    found = listing(kind)
    if as_json:
        import dataclasses

        print_json({"schema": 1, **dataclasses.asdict(found)})
        return
    from ..render_model import show_listing
    from ..terminal import terminal

    show_listing(terminal(), found)
