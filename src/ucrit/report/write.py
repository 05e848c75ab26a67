"""The report: everything about one vehicle on one page that needs no network."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .. import __version__
from ..core.errors import UcritError
from . import derivation, drawings, formulas, tables

if TYPE_CHECKING:
    from ..analyses.stability.analyze import Analysis

HERE = Path(__file__).resolve().parent


def write_report(
    analysis: Analysis,
    path: str | os.PathLike[str],
    *,
    map_parameters: Sequence[str] | None = None,
    command: str | None = None,
) -> None:
    """Write everything that is known about a vehicle to one HTML file; it appears whole or not at all.

    The page holds its drawings and formulas itself and asks no other machine for anything. The same analysis
    gives the same bytes.

    Parameters
    ----------
    analysis
        What `ucrit.analyze` returned.
    path
        File to write.
    map_parameters
        The two parameters of the stability map; by default the speed and the parameter whose change helps
        most, or the two that help most.
    command
        How the page was made, to be printed on it.

    Raises
    ------
    UcritError
        If the file cannot be written, or there is no such parameter.

    Examples
    --------
    >>> from ucrit import analyze, write_report
    >>> write_report(analyze("caravan"), "caravan.html")  # doctest: +SKIP
    """
    from ..analyses.results.convert import write_whole

    if not os.fspath(path).lower().endswith((".html", ".htm")):
        raise UcritError(f"a report is written to a file ending in .html, got '{os.fspath(path)}'")
    write_whole(path, render(analysis, map_parameters=map_parameters, command=command).encode())


def render(analysis: Analysis, *, map_parameters: Sequence[str] | None = None, command: str | None = None) -> str:
    """Return the page as text; see `write_report`."""
    from jinja2 import Environment, FileSystemLoader, StrictUndefined
    from markupsafe import Markup

    environment = Environment(
        loader=FileSystemLoader(HERE),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    css = Markup((HERE / "page.css").read_text(encoding="utf-8"))
    content = {
        **_texts(analysis),
        **_tables(analysis),
        **_drawings(analysis, map_parameters),
        "version": __version__,
        "command": command or _command(analysis),
        "css": css,
    }
    return environment.get_template("page.html.jinja").render(content)


def _texts(analysis: Analysis) -> dict[str, Any]:
    info, model = analysis.vehicle.info, type(analysis.vehicle)
    sentence = analysis.sentence
    found = analysis.criteria
    return {
        "name": info.name or model.__name__,
        "title": model.title(),
        "model": model.model_id(),
        "source": info.source,
        "note": info.note,
        "judgement": tables.judgement(analysis),
        "sentence": sentence[:1].upper() + sentence[1:] + ".",
        "caveat": f"But {analysis.caveat}." if analysis.caveat else "",
        "goal": _goal(analysis),
        "at": "" if analysis.speed is None else f"at {_speed(analysis)}",
        "why_no_criteria": "" if found else analysis.why_no_criteria,
        "scope": found.scope if found else "",
        "in_few": found is not None and found.free is not None,
        "settled": found.settled if found else None,
        "neutral": bool(found and found.kind == "neutral"),
        "exact": bool(analysis.critical and analysis.critical.exact),
    }


def _speed(analysis: Analysis) -> str:
    from ..analyses.stability.wording import speed_text

    return speed_text(analysis.speed or 0.0)


def _goal(analysis: Analysis) -> str:
    return "stable" if analysis.speed is None else f"stable at every speed up to {_speed(analysis)}"


def _tables(analysis: Analysis) -> dict[str, Any]:
    from ..analyses.about.show import show

    described = show(analysis.vehicle)
    critical = None if analysis.critical is None else tables.critical(analysis.critical.values)
    return {
        "parameters": tables.parameters(analysis.vehicle),
        "critical": critical,
        "modes": tables.modes(analysis.modes),
        "remedies": tables.remedies(analysis),
        "helpless": [formulas.symbol(r.parameter) for r in analysis.remedies if r.value is None],
        "criteria": tables.criteria(analysis),
        "steps": derivation.steps(described),
        "sources": described.sources,
    }


def _drawings(analysis: Analysis, map_parameters: Sequence[str] | None) -> dict[str, Any]:
    followed = drawings.along(analysis)
    return {
        "speed_figures": drawings.of_locus(*followed) if followed else [],
        "map": drawings.of_map(analysis, map_parameters, followed[0] if followed else None),
        "remedy_figure": drawings.of_remedies(analysis),
        "mode_figures": drawings.of_modes(analysis),
    }


def _command(analysis: Analysis) -> str:
    """How to make the page again in Python; the vehicle is named only where its file gives these very numbers."""
    from ..catalogue import load
    from ..core.errors import UcritError

    file = analysis.vehicle.info.file
    try:
        same = bool(file) and load(file, at_speed=analysis.speed) == analysis.vehicle
    except UcritError:
        same = False
    upto = "" if analysis.speed is None else f", upto={analysis.speed!r}"
    subject = f"{file!r}{upto}" if same else "vehicle"
    return f'ucrit.write_report(ucrit.analyze({subject}), "report.html")'
