"""``ucrit list``: what is shipped."""

from __future__ import annotations

import click


@click.command("list", short_help="List the models, vehicles and controllers that are shipped.")
@click.argument("kind", required=False, type=click.Choice(["models", "vehicles", "controllers"]))
@click.option("--json", "as_json", is_flag=True, help="Print plain data (JSON) and nothing else.")
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
        import json

        click.echo(json.dumps({"schema": 1, **dataclasses.asdict(found)}, indent=2, ensure_ascii=False))
        return
    from ..render_model import show_listing
    from ..terminal import terminal

    show_listing(terminal(), found)
