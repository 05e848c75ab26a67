"""``ucrit bonds``: the bond graph of a model or a file."""

from __future__ import annotations

import click

from ..output import PICTURES, write_picture
from ..parameters import Name


@click.command("bonds", short_help="Causality and state equations of a bond graph; draw it.")
@click.argument("subject", metavar="MODEL_OR_FILE", type=Name("model", suffix=".bonds"))
@click.option("--draw", metavar="FILE", type=click.Path(), help="Draw the graph: .svg, .png or .pdf.")
@click.option("--text", "as_text", is_flag=True, help="Print the graph as text, to be edited, and nothing else.")
def command(subject: str, draw: str | None, as_text: bool) -> None:
    """Show a bond graph: elements, bonds with their causality, findings, state equations.

    MODEL_OR_FILE is a model's name, a Python file with a model, or a bond graph as text (FILE.bonds). Such a file
    is a model too: 'ucrit show', 'check' and 'new' take it, and vehicle files can name it.

    \b
    Examples:
      ucrit bonds trailer
      ucrit bonds trailer --draw trailer.svg
      ucrit bonds oscillator --text > mine.bonds
      ucrit bonds mine.bonds

    Exit status: 0 done; 2 wrong input.
    """
    from ...analyses.bonds import bonds
    from ...core.errors import UcritError

    if draw is not None and not draw.lower().endswith(PICTURES):
        raise UcritError(f"a drawing is written to a file ending in {', '.join(PICTURES)}, got '{draw}'")
    found = bonds(subject)
    if draw is not None:
        write_picture(found, draw)
    if as_text:
        click.echo(found.text, nl=False)
        return
    from ..render_bonds import show_bonds
    from ..terminal import terminal

    show_bonds(terminal(), found, draw)
