"""``ucrit tire``: what a tire law or a property file gives."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from ..output import json_option, print_json, writer, written
from ..parameters import Name, assignments

if TYPE_CHECKING:
    from ...analyses.nonlinear.tire_curves import TireCurves


@click.command("tire", short_help="Show a tire: a property file (.tir) or a law with numbers.")
@click.argument("tire", metavar="TIRE", type=Name("tire", suffix=".tir"))
@click.option("--load", "loads", metavar="FORCE", multiple=True, help='Vertical load: "4 kN"; may be repeated.')
@click.option("--set", "changes", metavar="NAME=VALUE", multiple=True, help="Set a parameter; may be repeated.")
@click.option("--road", "roads", metavar="NAME=FACTOR", multiple=True, help="Friction of a road: ice=0.1; repeatable.")
@click.option("--out", "-o", metavar="FILE", help="Write curves: .png .svg .pdf; .csv .json .mat .nc.")
@json_option
def command(
    tire: str, loads: tuple[str, ...], changes: tuple[str, ...], roads: tuple[str, ...], out: str | None, as_json: bool
) -> None:
    """Show version, units and axes of a tire file, and what the tire does under some loads.

    TIRE is the name of a tire that is shipped, a .tir file, or the name of a law that --set gives numbers to. A
    file's tire is shown without the shifts of the one that was measured; TIRE:measured keeps them, and TIRE:SLIP=angle
    sets a switch. In a vehicle file the same names go into the table [parts].

    \b
    Examples:
      ucrit tire pacejka-205-60r15
      ucrit tire pac2002-235-60r16 --load "3 kN" --load "6 kN" -o tire.png
      ucrit tire brush --set "C=1 kN/deg" --set mu=0.9 --load 4000
      ucrit tire dugoff --set C=80000 --road dry=1 --road ice=0.1 -o curves.csv

    Exit status: 0 done; 2 wrong input.
    """
    from ... import catalogue
    from ...analyses.nonlinear.tire_curves import LOADS, tire_curves
    from ...core.units import to_si

    write = None if out is None else writer(out)
    part = catalogue.tire(tire, **assignments(changes, 'mu=0.9 or "C=1 kN/deg"'))
    chosen = sorted(to_si(load, "N", "load") for load in loads) or list(LOADS)
    factors = assignments(roads, "ice=0.1", "road")
    surfaces = {name: to_si(value, "1", f"friction factor of road {name}") for name, value in factors.items()} or None
    curves = tire_curves(part, chosen, surfaces)
    if write is not None:
        write(curves)
    if as_json:
        print_json(curves)
        return
    _show(curves, tire)
    if out is not None:
        print()
        written(out)


def _show(curves: TireCurves, name: str) -> None:
    from ..terminal import Page, terminal

    page, tire = Page(terminal()), curves.tire
    page.paragraph(name, "bold")
    page.paragraph(type(tire).title())
    _file(page, name)
    page.heading("Parameters")
    page.table(
        [
            [key, f"{getattr(tire, key):.6g}", "" if p.unit == "1" else p.unit, p.meaning]
            for key, p in type(tire).parameters.items()
        ],
        right=(1,),
    )
    for road, factor in enumerate(curves.roads.values()):
        text = list(curves.roads)[road]
        page.heading("Forces" if len(curves.roads) == 1 else f"Forces on road '{text}', friction times {factor:g}")
        head = ["load", "cornering", "relaxation", "side peak", "at", "brake peak", "at", "locked"]
        units = ["N", "N/rad", "m", "N", "deg", "N", "slip", "N"]
        rows = [_row(curves, road, i) for i in range(curves.loads.size)]
        page.table([units, *rows], head, right=range(len(head)))
    page.line()
    page.paragraph(
        "A dash: the law does not tell, or the force still rises at 20 degrees or at the locked wheel.", "dim"
    )


def _file(page: Any, name: str) -> None:
    from ... import catalogue

    file, chosen = catalogue.tire_switches(name)
    if not (file.lower().endswith(".tir") or file in catalogue.tire_names()):
        return
    found = catalogue.tire_file(file)
    units = ", ".join(f"{kind.lower()} in {unit}" for kind, unit in found.units.items())
    shifts = "left out: the mean of the tire and its mirror image" if chosen.pop("symmetric", True) else "as measured"
    rows = [["version", found.version], ["units", units], ["axes", found.axes], ["shifts", shifts]]
    rows += [["switches", ", ".join(f"{key} {value}" for key, value in chosen.items())]] if chosen else []
    page.heading("Property file")
    page.table(rows)


def _row(curves: TireCurves, road: int, i: int) -> list[str]:
    import math

    from ...core.errors import UcritError

    load = float(curves.loads[i])
    try:
        relaxation = f"{float(curves.tire.relaxation_length(load)):.3f}"
    except (UcritError, TypeError):  # the law needs the sidewall's stiffness, which is no matter of the tread
        relaxation = "-"
    (side, at_angle), (brake, at_slip) = curves.peak_side, curves.peak_braking
    angle, slip = math.degrees(at_angle[road, i]), at_slip[road, i]
    peaks = [
        *((f"{side[road, i]:.0f}", f"{angle:.1f}") if math.isfinite(angle) else ("-", "-")),
        *((f"{brake[road, i]:.0f}", f"{slip:.2f}") if math.isfinite(slip) else ("-", "-")),
    ]
    return [
        f"{load:.6g}",
        f"{curves.cornering_coefficient[i]:.0f}",
        relaxation,
        *peaks,
        f"{curves.locked[road, i]:.0f}",
    ]
