"""``ucrit routh``: Routh's criterion for a bare polynomial."""

from __future__ import annotations

import click

from ..output import json_option, print_json


@click.command("routh", short_help="Routh's array of a polynomial, with numbers or symbols.")
@click.argument("polynomial")
@click.option("--variable", metavar="NAME", default="s", show_default=True, help="Name of the variable.")
@click.option("--positive", metavar="NAMES", default="", help='Symbols that can only be positive: "m,c".')
@json_option
def command(polynomial: str, variable: str, positive: str, as_json: bool) -> None:
    """Show Routh's array of POLYNOMIAL, the number of unstable roots and, for symbols, the conditions.

    ^ is a power, and 2 s or a(b + c) a product.

    \b
    Examples:
      ucrit routh "s^4 + 2 s^3 + 3 s^2 + 4 s + 5"
      ucrit routh "s^3 + 4 s^2 + 5 s + K"
      ucrit routh "m s^2 + c s + k" --positive m,c
      ucrit routh "(z + 1)(z^2 + k)" --variable z

    A polynomial that begins with a minus comes after --:  ucrit routh -- "-s + 1"

    Exit status: 0 done, whatever the roots; 2 wrong input.
    """
    from ...analyses.stability.routh import routh

    found = routh(polynomial, variable, positive.replace(",", " ").split())
    if as_json:
        print_json(found)
    else:
        click.echo(found)
