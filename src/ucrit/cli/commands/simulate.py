"""``ucrit simulate``: a vehicle's non-linear motion in time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from ..output import json_option, print_json, writer
from ..parameters import Name, assignments, complete_parameters, load_vehicle
from ..progress import progress

if TYPE_CHECKING:
    from collections.abc import Callable

FILMS = (".gif", ".mp4", ".html")


@click.command("simulate", short_help="Follow a vehicle's non-linear motion, with events, and animate it.")
@click.argument("vehicle", type=Name("vehicle", suffix=".toml"))
@click.option("--until", required=True, metavar="TIME", help="Last time: a number of seconds, or with a unit.")
@click.option(
    "--initial",
    "starts",
    metavar="STATE=VALUE",
    multiple=True,
    help="Value of a state at time 0, theta or theta'; may be repeated.",
)
@click.option(
    "--input",
    "inputs",
    metavar="INPUT=SHAPE",
    multiple=True,
    help="An input over time, see above; may be repeated.",
)
@click.option(
    "--set",
    "changes",
    metavar="NAME=VALUE",
    multiple=True,
    shell_complete=complete_parameters,
    help="Change a parameter; may be repeated.",
)
@click.option("--points", type=click.IntRange(2, 1_000_000), default=400, help="Times of the result; 400 by default.")
@click.option("--method", default="auto", metavar="NAME", help="DOP853, Radau, BDF, LSODA; by default auto.")
@click.option("--tolerance", type=float, metavar="SHARE", help="Relative error of a step; by default 1e-12.")
@click.option("--enlarge", type=float, default=1.0, metavar="FACTOR", help="Animate departures so many times as large.")
@click.option(
    "-o",
    "--out",
    "outputs",
    metavar="FILE",
    multiple=True,
    help="Write .csv, .nc, .json or .mat (numbers), .png, .svg or .pdf (curves), .gif, .mp4 or .html (animation).",
)
@json_option
def command(
    vehicle: str,
    until: str,
    starts: tuple[str, ...],
    inputs: tuple[str, ...],
    changes: tuple[str, ...],
    points: int,
    method: str,
    tolerance: float | None,
    enlarge: float,
    outputs: tuple[str, ...],
    as_json: bool,
) -> None:
    """Follow the non-linear motion of VEHICLE from time 0 and tell events, peaks and the end.

    \b
    Shapes of inputs; words behind the size in any order, units as everywhere:
      2 deg                                    constant
      step 2 deg at 1 s
      ramp 2 deg at 1 s over 3 s
      sine 2 deg with 0.5 Hz at 1 s over 4 s
      dwell 5 deg at 1 s with 0.7 Hz hold 0.5 s  (sine, held at its 2nd peak)
      pulse 2 deg at 1 s over 0.2 s
      gust 15 m/s at 1 s over 0.5 s            (1 - cos)/2
      step 2 deg at 1 s + step -2 deg at 3 s   sums
      table steer.csv                          (headed "time [s],delta_f [deg]")

    \b
    Examples:
      ucrit simulate understeering-car --until 9 --input "delta_f=step 1 deg"
      ucrit simulate caravan --until "20 s" --initial theta="1 deg" -o sway.html
      ucrit simulate bmw-320i --until 6 --input "delta_f=dwell 3 deg" -o run.gif

    Exit status: 0 done; 2 wrong input, nothing is written then.
    """
    import numpy as np

    from ...analyses.motion.simulate import simulate
    from ..render_motion import show_motion
    from ..terminal import terminal

    writers = [_writer(path, enlarge) for path in outputs]
    if enlarge != 1 and not any(path.lower().endswith(FILMS) for path in outputs):
        raise click.UsageError("--enlarge is for an animation: give --out FILE.gif, .mp4 or .html too")
    subject = load_vehicle(vehicle, assignments(changes, 'a=1.9 or "m=2 t"'))
    if any(path.lower().endswith(FILMS) for path in outputs):
        from ...analyses.motion.scene import refuse_without_drawing

        refuse_without_drawing(subject)
    given = assignments(starts, 'theta="1 deg"', "initial value")
    driven = assignments(inputs, 'delta_f="step 2 deg at 1 s"', "input")
    with progress("simulate") as advance:
        found = simulate(subject, until, given, driven, method=method, tolerance=tolerance, progress=advance)
    found = found.at(np.linspace(0, found.times[-1], points))
    for write in writers:
        write(found)
    if as_json:
        print_json(found)
        return
    show_motion(terminal(), found, until, outputs)


def _writer(path: str, enlarge: float) -> Callable[[Any], None]:
    """Return what writes a result; a file ending that is not known is refused before anything is computed."""
    if path.lower().endswith(FILMS):
        from ...plots.animation import film_format

        film_format(path)
    return writer(path, more=dict.fromkeys(FILMS, lambda result: _film(result, path, enlarge)))


def _film(result: Any, path: str, enlarge: float) -> None:
    from ...plots import animate

    with progress("animate") as advance:
        animate(result, path, enlarge=enlarge, progress=advance)
