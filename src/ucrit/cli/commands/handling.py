"""``ucrit handling``: a car's steady turns up to the limit."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from ..parameters import Name, assignments, complete_parameters, load_vehicle

if TYPE_CHECKING:
    from collections.abc import Callable

PICTURES = (".png", ".svg", ".pdf")
TABLES = {".csv": "to_csv", ".nc": "to_netcdf", ".json": "to_json", ".mat": "to_mat"}


@click.command("handling", short_help="Turns up to the limit: spin or plough-out, and the handling diagram.")
@click.argument("vehicle", type=Name("vehicle", suffix=".toml"))
@click.option(
    "--set",
    "changes",
    metavar="NAME=VALUE",
    multiple=True,
    shell_complete=complete_parameters,
    help="Change a parameter; may be repeated.",
)
@click.option("--upto", metavar="SPEED", help="Turn at this speed; the vehicle's own by default.")
@click.option("--slip", metavar="ANGLE", default="0.3", help="End at this slip angle of an axle; 0.3 rad by default.")
@click.option(
    "-o", "--out", metavar="FILE", help="Draw the diagram (.png, .svg, .pdf) or write its table (.csv, .json, .mat)."
)
def command(vehicle: str, changes: tuple[str, ...], upto: str | None, slip: str, out: str | None) -> None:
    """Follow the steady turns of VEHICLE at one speed, from straight running to what its tires can do.

    Says which axle gives way first, at what lateral acceleration, and from where on a turn is unstable with the
    steering held. Wants a car whose tires saturate, such as the model car-handling.

    \b
    Examples:
      ucrit handling spinning-car
      ucrit handling spinning-car --upto "70 km/h" --out diagram.png
      ucrit handling mine.toml --set rear_mu=0.5 --out diagram.csv

    Exit status: 0 done, whatever the limit; 2 wrong input.
    """
    from ...analyses.handling import handling_diagram

    write = _writer(out)
    result = handling_diagram(load_vehicle(vehicle, assignments(changes, "rear_mu=0.5"), upto), slip=slip)
    click.echo(result)
    write(result)


def _writer(out: str | None) -> Callable[[Any], None]:
    """Return what writes a result; a file ending that is not known is refused before anything is computed."""
    from ...core.errors import UcritError

    if out is None:
        return lambda result: None
    ending = out[out.rfind(".") :].lower() if "." in out else ""
    if ending in PICTURES:
        return lambda result: _draw(result, out)
    if ending not in TABLES:
        raise UcritError(f"the output '{out}' must end in {', '.join((*PICTURES, *TABLES))}")
    return lambda result: getattr(result, TABLES[ending])(out)


def _draw(result: Any, path: str) -> None:
    """Draw a handling diagram into a file, which appears whole or not at all."""
    import io

    from ...analyses.convert import write_whole
    from ...plots import plot_handling

    content = io.BytesIO()
    plot_handling(result).savefig(content, format=path.rpartition(".")[2].lower(), dpi=150)
    write_whole(path, content.getvalue())
