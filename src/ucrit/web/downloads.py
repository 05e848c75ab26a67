"""What visitors take away: numbers, drawings, a vehicle file that can be loaded again, the report."""

from __future__ import annotations

import csv
import io
import json
import re
import threading
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from ..analyses.stability.analyze import analyze
from ..analyses.stability.critical import critical
from ..analyses.stability.locus import Locus, locus
from ..core.contract.files import write_vehicle
from ..core.contract.model import Model
from ..core.errors import UcritError, near_match
from .ranges import drawn_range, slider_range
from .subject import ends, parameter

_drawing = threading.Lock()
"""Matplotlib's settings are those of the whole process: one drawing at a time."""


@dataclass(frozen=True)
class File:
    """A file to save: its name, its type and what is in it."""

    name: str
    media: str
    content: bytes


def download(vehicle: Model, body: Mapping[str, Any]) -> File:
    """Return the file of the asked kind."""
    kind = body.get("kind")
    if not isinstance(kind, str) or kind not in KINDS:
        raise UcritError(f"there is no download '{str(kind)[:30]}'{near_match(str(kind)[:30], KINDS)}")
    media, make = KINDS[kind]
    stem = re.sub(r"[^a-z0-9]+", "-", vehicle.info.name.lower()).strip("-")[:60] or "vehicle"
    ending = "html" if kind == "report" else kind
    return File(f"{stem}.{ending}", media, make(vehicle, body))


def _path(vehicle: Model, body: Mapping[str, Any]) -> Locus:
    """Return the root locus that the page draws, in as many points as a file deserves."""
    name = parameter(vehicle, body.get("along") or type(vehicle).declaration.speed)
    given = body.get("range")
    low, high = ends(given, f"the range of {name}") if given else slider_range(analyze(vehicle), name)
    return locus(vehicle, name, *drawn_range(vehicle, name, low, high))


def _toml(vehicle: Model, body: Mapping[str, Any]) -> bytes:
    return write_vehicle(vehicle).encode()


def _json(vehicle: Model, body: Mapping[str, Any]) -> bytes:
    return json.dumps(analyze(vehicle).to_dict(), indent=2, allow_nan=False, ensure_ascii=False).encode()


def _csv(vehicle: Model, body: Mapping[str, Any]) -> bytes:
    columns = list(_path(vehicle, body).table().columns())
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([f"{name} [{unit}]" if unit else name for name, unit, _ in columns])
    writer.writerows(zip(*(values.tolist() for _, _, values in columns), strict=True))
    return text.getvalue().encode()


def _picture(ending: str) -> Callable[[Model, Mapping[str, Any]], bytes]:
    def draw(vehicle: Model, body: Mapping[str, Any]) -> bytes:
        from ..plots import plot_overview, style

        path = _path(vehicle, body)
        content = io.BytesIO()
        with _drawing:
            figure = style.new_figure(width=10.4, height=4.6)
            plot_overview(path, critical=critical(vehicle, path.parameter), figure=figure)
            with style.settings():
                figure.savefig(content, format=ending, dpi=150)
        return content.getvalue()

    return draw


def _report(vehicle: Model, body: Mapping[str, Any]) -> bytes:
    from ..report import render

    found = analyze(vehicle)
    with _drawing:
        return render(found).encode()


KINDS: dict[str, tuple[str, Callable[[Model, Mapping[str, Any]], bytes]]] = {
    "png": ("image/png", _picture("png")),
    "svg": ("image/svg+xml", _picture("svg")),
    "csv": ("text/csv; charset=utf-8", _csv),
    "toml": ("application/toml; charset=utf-8", _toml),
    "json": ("application/json; charset=utf-8", _json),
    "report": ("text/html; charset=utf-8", _report),
}
"""By kind: type of the file, and what makes it."""
