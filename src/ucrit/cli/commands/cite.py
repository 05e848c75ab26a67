"""``ucrit cite``: the sources of what was used."""

from __future__ import annotations

import click

from ..output import json_option, print_json
from ..parameters import Name


@click.command("cite", short_help="List the sources of vehicles, models and analyses.")
@click.argument("subjects", metavar="[NAME]...", nargs=-1, type=Name("vehicle", "model", "tire", suffix=".toml"))
@click.option("--bibtex", is_flag=True, help="Print BibTeX entries of the works, and nothing else.")
@json_option
def command(subjects: tuple[str, ...], bibtex: bool, as_json: bool) -> None:
    """List the sources of what was used, and how to cite ucrit itself.

    NAME is a vehicle, a model, a tire, a controller, the file of one, or an analysis ("critical").

    \b
    Examples:
      ucrit cite caravan critical
      ucrit cite navion --bibtex > sources.bib
      ucrit cite --bibtex

    Exit status: 0 done; 2 wrong input.
    """
    from ...analyses.about.cite import cite
    from ...core.errors import UcritError

    if bibtex and as_json:
        raise UcritError("--bibtex and --json print different things: give one of them")
    found = cite(*subjects)
    if bibtex:
        click.echo(found.bibtex(), nl=False)
        return
    if as_json:
        print_json(found)
        return
    from ..render_model import show_citations
    from ..terminal import terminal

    show_citations(terminal(), found)
