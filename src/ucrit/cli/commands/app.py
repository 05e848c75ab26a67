"""``ucrit app``: the explorer in the browser."""

from __future__ import annotations

import click

from ..parameters import Name


@click.command("app", short_help="Explore a vehicle in the browser, with sliders.")
@click.argument("vehicle", type=Name("vehicle", suffix=".toml"), required=False)
@click.option("--port", type=int, default=8642, metavar="PORT", help="8642 by default; 0 for any that is free.")
@click.option("--host", default="127.0.0.1", metavar="NAME", help="Serve other machines too; there is no password.")
@click.option("--no-browser", is_flag=True, help="Only print the address.")
def command(vehicle: str | None, port: int, host: str, no_browser: bool) -> None:
    """Serve a page on this machine that judges VEHICLE while its parameters are moved.

    It works without a network and asks no other machine for anything; Ctrl-C stops it. Needs the extra 'app':
    pip install 'ucrit[app]'.

    \b
    Examples:
      ucrit app
      ucrit app caravan
      ucrit app mine.toml --port 9000 --no-browser

    Exit status: 0 stopped; 2 wrong input, or the port is taken.
    """
    from ...web.serve import app
    from ..parameters import load_vehicle

    if vehicle is not None:
        load_vehicle(vehicle)
    app(vehicle, host=host, port=port, browser=not no_browser, tell=click.echo)
