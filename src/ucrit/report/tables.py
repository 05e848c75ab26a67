"""What the tables of the page hold: texts and formulas, row by row."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ..analyses.stability.advice import advice
from ..analyses.stability.wording import speed_text
from ..plots.labels import NOTHING, fixed, number, percent, unit_text
from . import formulas

if TYPE_CHECKING:
    from collections.abc import Callable

    from ..analyses.linear.modes import Mode
    from ..analyses.stability.analyze import Analysis
    from ..analyses.stability.critical import Critical
    from ..core.contract.model import Model

KINDS = {
    "flutter": "flutter: an oscillation grows",
    "divergence": "divergence: it runs away without oscillating",
    "order": "a root passes through infinity",
}


@dataclass(frozen=True)
class Judgement:
    """The verdict in one word, with the class that colours it and a sign that does not need the colour."""

    word: str
    style: str
    sign: str


def judgement(analysis: Analysis, say: Callable[[float], str] = speed_text) -> Judgement:
    """Return the verdict in a few words; ``say`` writes a speed [m/s]."""
    if analysis.stable:
        neutral = analysis.verdict.state == "neutral"
        return Judgement("Neutral", "neutral", "○") if neutral else Judgement("Stable", "good", "✓")
    if analysis.speed is None:
        return Judgement("Unstable", "bad", "✕")
    at = say(analysis.speed)
    if analysis.verdict.growing:
        return Judgement(f"Unstable at {at}", "bad", "✕")
    return Judgement(f"Not stable at every speed up to {at}", "bad", "✕")


def parameters(vehicle: Model) -> list[dict[str, Any]]:
    """Return symbol, meaning, value and unit of every parameter."""
    rows = []
    for name, declared in type(vehicle).declaration.parameters.items():
        value = float(vehicle.values[name])
        unit = unit_text(declared.unit)
        if declared.is_speed:
            unit += f" ({number(3.6 * value, 4)} km/h)"
        rows.append(
            {
                "symbol": formulas.symbol(name),
                "name": name,
                "meaning": declared.meaning,
                "value": number(value, 7),
                "unit": unit,
            }
        )
    return rows


def modes(found: tuple[Mode, ...]) -> list[dict[str, Any]]:
    """Return name, eigenvalue, frequency, damping ratio and doubling or halving time of every mode."""
    rows = []
    for mode in found:
        value = mode.eigenvalue
        text = fixed(value.real)
        if mode.oscillates:
            text += f" ± {fixed(abs(value.imag))} i"
        rows.append(
            {
                "name": mode.name,
                "eigenvalue": text,
                "frequency": fixed(mode.frequency_hz) if mode.oscillates else NOTHING,
                "damping": fixed(mode.damping_ratio, 3) if mode.oscillates else NOTHING,
                "time": _time(mode),
                "grows": value.real > 0,
            }
        )
    return rows


def _time(mode: Mode) -> str:
    if math.isfinite(mode.time_to_double):
        return f"doubles in {fixed(mode.time_to_double, 3)} s"
    if math.isfinite(mode.time_to_half):
        return f"halves in {fixed(mode.time_to_half, 3)} s"
    return "stays"


def critical(found: tuple[Critical, ...]) -> list[dict[str, Any]]:
    """Return value, kind, frequency, mode, stable side and closed form of every critical speed."""
    rows = []
    for c in found:
        closed = None
        if c.closed_form and not formulas.too_long(c.closed_form.mathml):
            closed = formulas.equality(formulas.power(c.parameter, c.closed_form.power), c.closed_form.mathml)
        rows.append(
            {
                "value": number(c.value, 6),
                "road": number(3.6 * c.value, 4) if c.unit == "m/s" else "",
                "kind": KINDS.get(c.kind, c.kind),
                "frequency": number(c.frequency_hz) if c.frequency_hz else NOTHING,
                "mode": c.mode,
                "stable": c.stable,
                "closed": closed,
            }
        )
    return rows


def remedies(analysis: Analysis) -> list[dict[str, Any]]:
    """Return the remedies that help, each with the value to reach, rounded to the safe side."""
    rows = []
    for r in analysis.remedies:
        if r.value is None:
            continue
        told = advice(r, analysis)
        rows.append(
            {
                "symbol": formulas.symbol(r.parameter),
                "meaning": r.meaning,
                "present": number(r.present, 6),
                "word": told.word,
                "value": told.text,
                "unit": unit_text(r.unit),
                "change": percent(math.inf if told.relative is None else told.relative),
            }
        )
    return rows


def criteria(analysis: Analysis) -> list[dict[str, Any]]:
    """Return every condition: its origin, formula and failure, whether it holds, what was dropped."""
    rows = []
    for c in analysis.criteria or ():
        rows.append(
            {
                "origin": _origin(c.name),
                "name": formulas.symbol(c.name),
                "formula": None if formulas.too_long(c.expression) else formulas.formula(c.mathml, "> 0"),
                "length": len(c.expression),
                "failure": KINDS.get(c.failure, c.failure),
                "fails": c in analysis.failing,
                "dropped": [formulas.from_text(text) for text in c.dropped if len(text) < 400],
                "left_out": sum(len(text) >= 400 for text in c.dropped),
            }
        )
    return rows


def _origin(name: str) -> str:
    letter, _, index = name.partition("_")
    if letter == "a":
        return "coefficient of the characteristic polynomial" if index else "coefficient"
    return f"Hurwitz determinant of order {index}"
