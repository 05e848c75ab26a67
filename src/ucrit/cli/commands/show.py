"""``ucrit show``: the equations of a model and the numbers of a vehicle."""

from __future__ import annotations

import click

from ..parameters import Name


@click.command("show", short_help="Show the equations of a model, the numbers of a vehicle.")
@click.argument("subject", metavar="MODEL_OR_VEHICLE", type=Name("model", "vehicle", suffix=".toml"))
@click.option("--json", "as_json", is_flag=True, help="Print plain data (JSON) and nothing else.")
def command(subject: str, as_json: bool) -> None:
    """Show parameters, variables, equations of motion, linear matrices, criteria and sources.

    MODEL_OR_VEHICLE is a name from 'ucrit list', a vehicle file or a Python file with a model. The formulas
    can be pasted into Python; x' is the rate of x.

    \b
    Examples:
      ucrit show car
      ucrit show caravan
      ucrit show my_model.py
      ucrit show my_model.py:Caster --json

    Exit status: 0 done; 2 wrong input.
    """
    from ...analyses.show import show

    found = show(subject)
    if as_json:
        import json

        click.echo(json.dumps(found.to_dict(), indent=2, allow_nan=False, ensure_ascii=False))
        return
    from ..render_model import show_model
    from ..terminal import terminal

    show_model(terminal(), found)
