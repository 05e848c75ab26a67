"""``ucrit check``: is a model what it claims to be?"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from ..output import json_option, print_json
from ..parameters import Name

FAILED = 1


@click.command("check", short_help="Check a model against units, literature, symmetry, energy.")
@click.argument("model", type=Name("model", "vehicle", suffix=".py"))
@click.option("--published", metavar="FILE.toml", type=click.Path(), help="Equations and numbers to compare with.")
@json_option
def command(model: str, published: str | None, as_json: bool) -> int:
    """Check MODEL: units, published equations and numbers, further derivations, symmetry, energy.

    MODEL is a model's name, a vehicle, or a Python file, all of whose models are then checked
    (file.py:Class checks one).

    \b
    Examples:
      ucrit check trailer
      ucrit check my_model.py
      ucrit check my_model.py:Caster --published caster.toml

    Exit status: 0 all checks passed; 1 one failed; 2 wrong input.
    """
    from ...analyses.about.show import resolve
    from ...catalogue import models_in_file
    from ...checks import check_model
    from ...checks.published import read_published
    from ..render_model import show_report
    from ..terminal import terminal

    if published is not None:
        read_published(Path(published))  # a file that is wrong is wrong input, not a check that fails
    if model.endswith(".py"):
        subjects: list[Any] = list(models_in_file(Path(model)))
    else:
        found, vehicle = resolve(model)
        subjects = [found if vehicle is None else vehicle]
    reports = [check_model(subject, published=published) for subject in subjects]
    if as_json:
        print_json({"schema": 1, "reports": [report.to_dict() for report in reports]})
        return 0 if all(report.ok for report in reports) else FAILED
    for report in reports:
        show_report(terminal(), report)
    return 0 if all(report.ok for report in reports) else FAILED
