"""An analysis as text for a terminal."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from ..analyses.results.digits import percent
from ..analyses.stability.advice import advice
from ..analyses.stability.criteria import in_words
from ..analyses.stability.wording import speed_text
from .terminal import Page, vehicle_head
from .wrap import number, short_numbers, shorten

if TYPE_CHECKING:
    from rich.console import Console

    from ..analyses.linear.modes import Mode
    from ..analyses.stability.analyze import Analysis
    from ..analyses.stability.criteria import Criteria
    from ..analyses.stability.critical import Critical
    from ..analyses.stability.remedies import Remedy

CLOSED_FORM_LINES = 6
CRITERION_LINES = 16
LEAST_SHARE = 0.05
TIE = "~"


def show_analysis(console: Console, found: Analysis, report: str | None = None) -> None:
    """Print an analysis; ``report`` is the file that it has been written to."""
    page = Page(console)
    vehicle_head(page, found.vehicle)
    _verdict(page, found)
    _critical(page, found)
    _modes(page, found)
    _criteria(page, found)
    _remedies(page, found)
    if report is not None:
        page.line()
        page.line(f"Written to {report}")


def verdict_word(found: Analysis) -> tuple[str, str]:
    """Return the verdict as one word and its colour."""
    if found.stable:
        return ("NEUTRAL", "yellow") if found.verdict.state == "neutral" else ("STABLE", "green")
    if found.verdict.stable:
        return "STABLE IN PART", "yellow"
    return ("NEUTRAL", "yellow") if found.verdict.state == "neutral" else ("UNSTABLE", "red")


def _verdict(page: Page, found: Analysis) -> None:
    word, colour = verdict_word(found)
    at = "" if found.speed is None else f" at {_speed(found.speed)}"
    page.line()
    page.line((word, f"bold {colour}"), (at, "bold"))
    sentence = found.sentence
    page.paragraph(sentence[:1].upper() + sentence[1:] + ".")
    if found.caveat:
        page.paragraph(f"But {found.caveat}.", "yellow")
    if found.audit is not None:
        page.paragraph(f"Audit: {found.audit.sentence}.", "" if found.audit.agrees else "bold red")


def _speed(speed: float) -> str:
    return speed_text(abs(speed)) + (" backing up" if speed < 0 else "")


def _critical(page: Page, found: Analysis) -> None:
    if found.critical is None:
        return
    page.heading("Critical speeds")
    values = sorted(found.critical, key=lambda c: abs(c.value))
    if not values:
        page.paragraph("none, whatever the speed", indent=2)
    for c in values:
        page.paragraph(f"{_speed(c.value)}: {_event(c)}", indent=2, hanging=2)
        if c.closed_form:
            page.formula(str(c.closed_form), indent=6, most=CLOSED_FORM_LINES)
    if not found.critical.exact:
        page.paragraph("(searched numerically: one may have been missed)", "dim", indent=2)


def _event(c: Critical) -> str:
    at = f" at {number(c.frequency_hz)} Hz" if c.frequency_hz else ""
    sides = {"below": "below", "above": "above"}
    if c.value < 0:  # backing up, the lower value is the higher speed
        sides = {"below": "above", "above": "below"}
    return f"{c.kind} of the {c.motion}{at}; stable {sides[c.stable]}"


def _modes(page: Page, found: Analysis) -> None:
    page.heading("Modes" if found.speed is None else f"Modes at {_speed(found.speed)}")
    head = ["mode", "eigenvalue [1/s]", "Hz", "damping", "in time"]
    rows = [[mode.name, *_mode_cells(mode, page.plus_minus)] for mode in found.modes]
    widths = [max(len(row[i]) for row in [head, *rows]) for i in range(1, 5)]
    name_width = min(max(len(row[0]) for row in [head, *rows]), page.width - 2 - sum(w + 2 for w in widths))
    for number_, row in enumerate([head, *rows]):
        cells = [cell.rjust(w) for cell, w in zip(row[1:4], widths, strict=False)] + [row[4]]
        style = "dim" if number_ == 0 else ""
        if len(row[0]) > name_width:
            page.line("  " + row[0])
        name = row[0] if len(row[0]) <= name_width else ""
        page.line((f"  {name:<{name_width}}  " + "  ".join(cells), style))
        if number_:
            for line in page.wrapped(_shares(found.modes[number_ - 1]), 6):
                page.line((line.replace(TIE, " "), "dim"))


def _mode_cells(mode: Mode, plus_minus: str) -> list[str]:
    re, im = mode.eigenvalue.real, mode.eigenvalue.imag
    value = number(re) + (f" {plus_minus} {number(im)}j" if im else "")
    ratio = number(mode.damping_ratio, 3) if math.isfinite(mode.damping_ratio) else "-"
    time = "stays"
    if re > 0:
        time = f"doubles {number(mode.time_to_double, 3)} s"
    elif re < 0:
        time = f"halves {number(mode.time_to_half, 3)} s"
    return [value, number(mode.frequency_hz) if im else "-", ratio, time]


def _shares(mode: Mode) -> str:
    """Return which states take part, with ties where a line must not break."""
    shares = sorted(mode.participation.items(), key=lambda item: -item[1])
    return ", ".join(f"{name}{TIE}{share:.0%}" for name, share in shares if share >= LEAST_SHARE)


def _criteria(page: Page, found: Analysis) -> None:
    if found.criteria is None:
        page.heading("Criteria")
        page.paragraph(found.why_no_criteria, indent=2)
        return
    if found.criteria.free is not None:
        page.heading("Criteria")
        page.paragraph(in_few(found.criteria, found.why_no_criteria), indent=2)
    if found.criteria.settled is not None:
        if found.criteria.free is None:
            page.heading("Criteria")
        page.paragraph(str(found.criteria), indent=2)
        return
    holding = [c for c in found.criteria if c not in found.failing]
    if found.failing:
        page.heading("Stability needs, and it fails" + ("" if found.speed is None else " at this speed"))
        for c in found.failing:
            page.line("  ", (f"{c.name}, against {_failure(c.failure)}", "red"))
            page.formula(short_numbers(str(c)), indent=6, most=CRITERION_LINES)
    if holding:
        page.heading("Stability needs, and it holds" + ("" if found.speed is None else " at this speed"))
        names = max(len(c.name) for c in holding)
        for c in holding:
            page.line("  " + shorten(short_numbers(f"{c.name:<{names}}  {c}"), page.width - 2))


def in_few(found: Criteria, why: str) -> str:
    """Return what conditions are about in which the vehicle's numbers stand for most parameters."""
    symbols = in_words(found.free or ())
    return f"{why + '; ' if why else ''}in {symbols}, with the vehicle's numbers for the rest (--free takes others):"


def _failure(kind: str) -> str:
    return "a root passing through infinity" if kind == "order" else kind


def _remedies(page: Page, found: Analysis) -> None:
    if found.stable:
        page.heading("Remedies: none needed")
        return
    helping = [r for r in found.remedies if r.value is not None]
    in_part = found.speed is not None and found.verdict.stable
    if helping:
        aim = " for all lower speeds too" if in_part else ""
        page.heading(f"Remedies, each enough alone{aim}, the smallest change first")
        page.table([_remedy_cells(r, found) for r in helping], right=(2, 5))
    else:
        aim = " at all lower speeds too" if in_part else ""
        page.heading(f"Remedies: no parameter alone makes it stable{aim}")
    useless = [r.parameter for r in found.remedies if r.value is None]
    if useless:
        page.paragraph(f"no value helps: {', '.join(useless)}", "dim", indent=2, hanging=2)


def _remedy_cells(remedy: Remedy, found: Analysis) -> list[str]:
    told = advice(remedy, found)
    unit = "" if remedy.unit == "1" else remedy.unit
    change = "" if told.relative is None else percent(told.relative)
    return [remedy.parameter, told.word, told.text, unit, f"instead of {number(remedy.present, 6)}", change]
