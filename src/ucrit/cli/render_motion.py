"""A simulation as text for a terminal."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from ..analyses.motion.motion_summary import peaks, tendency, tendency_text
from .terminal import Page, vehicle_head
from .wrap import number

if TYPE_CHECKING:
    from rich.console import Console

    from ..analyses.motion.simulation import Simulation

MOST_EVENTS, SHORT = 12, 40
"""Events that are listed one by one, and the length up to which the states at an event are told."""


def show_motion(console: Console, found: Simulation, until: str, files: Sequence[str]) -> None:
    """Print events, peaks and the end of a motion, how it goes on, and which files have been written."""
    page = Page(console)
    vehicle_head(page, found.vehicle)
    page.heading(f"Motion over {number(float(found.times[-1]))} s, followed by {found.method}")
    if found.ended:
        page.paragraph(f"It {found.ended} at {number(float(found.times[-1]))} s: the end.", "yellow", indent=2)
    page.paragraph(f"At the end it {tendency_text(tendency(found))}.", indent=2)
    _events(page, found)
    page.heading("States and outputs")
    head = ["", "unit", "peak", "at", "end"]
    rows = [[p.name, _unit(p.unit), number(p.value), f"{number(p.time)} s", number(p.end)] for p in peaks(found)]
    page.table(rows, head, right=(2, 3, 4))
    for path in files:
        page.line()
        page.line(f"Written to {path}")


def _events(page: Page, found: Simulation) -> None:
    if not found.events:
        return
    page.heading("Events")
    rows = [[f"{number(e.time, 6)} s", e.name, _states(e.states)] for e in found.events]
    if len(rows) > MOST_EVENTS:
        rows = _counted(found)
    page.table([row if max(len(r[2]) for r in rows) <= SHORT else row[:2] for row in rows], right=(0,))


def _counted(found: Simulation) -> list[list[str]]:
    """Return one row for each kind of event: when first, how often, and when last."""
    kinds: dict[str, list[float]] = {}
    for e in found.events:
        kinds.setdefault(e.name, []).append(e.time)
    return [
        [f"{number(at[0], 6)} s", name, f"{len(at)} times, last at {number(at[-1], 6)} s" if at[1:] else ""]
        for name, at in kinds.items()
    ]


def _states(states: dict[str, float] | object) -> str:
    assert isinstance(states, dict)
    return ", ".join(f"{name} = {number(value)}" for name, value in states.items())


def _unit(unit: str) -> str:
    return "" if unit == "1" else unit
