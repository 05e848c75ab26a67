"""``ucrit bonds``: the bond graph of a model or a file."""

from __future__ import annotations

import click

from ..output import PICTURES, json_option, print_json, write_picture
from ..parameters import Name


@click.command("bonds", short_help="Causality and state equations of a bond graph; draw it.")
@click.argument("subject", metavar="SUBJECT", type=Name("model", "vehicle", suffix=".bonds"))
@click.option("-o", "--out", metavar="FILE", type=click.Path(), help="Draw the graph: .svg, .png or .pdf.")
@click.option("--text", "as_text", is_flag=True, help="Print the graph as text, to be edited, and nothing else.")
@json_option
def command(subject: str, out: str | None, as_text: bool, as_json: bool) -> None:
    """Show a bond graph: elements, bonds with their causality, findings, state equations.

    SUBJECT is the name of a model or vehicle, a Python file with a model, a vehicle file, or a bond graph as text
    (FILE.bonds). Such a text is a model: 'ucrit show', 'check' and 'new' take it, and vehicle files can name it;
    with defaults for its parameters it is a vehicle too: 'ucrit analyze FILE.bonds'.

    \b
    Examples:
      ucrit bonds trailer
      ucrit bonds trailer -o trailer.svg
      ucrit bonds oscillator --text > mine.bonds
      ucrit bonds mine.bonds
      ucrit bonds caravan --json

    Exit status: 0 done; 2 wrong input.
    """
    from ...analyses.about.bonds import bonds
    from ...core.errors import UcritError

    if out is not None and not out.lower().endswith(PICTURES):
        raise UcritError(f"a drawing is written to a file ending in {', '.join(PICTURES)}, got '{out}'")
    if as_text and as_json:
        raise UcritError("--text and --json both print the graph: give one of them")
    found = bonds(subject)
    if out is not None:
        write_picture(found, out)
    if as_text:
        click.echo(found.text, nl=False)
        return
    if as_json:
        print_json(found)
        return
    from ..render_bonds import show_bonds
    from ..terminal import terminal

    show_bonds(terminal(), found, out)
