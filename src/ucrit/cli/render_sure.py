"""Uncertainty and certificates as text for a terminal."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from ..analyses.stability.wording import speed_text
from .terminal import Page, vehicle_head
from .wrap import number

if TYPE_CHECKING:
    from rich.console import Console

    from ..analyses.regions.certificate import Certificate
    from ..analyses.regions.uncertainty import Uncertainty

SHARES = (0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99)


def show_uncertainty(console: Console, found: Uncertainty) -> None:
    """Print the distribution of a critical speed."""
    page = Page(console)
    vehicle_head(page, found.vehicle)
    page.line()
    sentence = found.sentence
    page.paragraph(sentence[:1].upper() + sentence[1:] + ".", "bold")
    if found.quantile(0.0) == math.inf or (not found.varies and found.as_given == found.critical[0]):
        return
    page.heading(f"Stability is first lost below ({found.samples} vehicles drawn)")
    rows = [(f"{number(100 * share)} %", _speed(found.quantile(share))) for share in SHARES]
    page.table([*rows, ("as given", _speed(found.as_given))], right=(0,))
    if found.influence is None:
        return
    page.heading("Share of its variance that comes from the tolerance of")
    order = sorted(range(len(found.influence.groups)), key=lambda i: -found.influence.total[i])  # type: ignore[union-attr]
    page.table(
        [
            (
                found.influence.names[i],
                _share(found.influence.first[i], found.influence.first_error[i], page.plus_minus),
                _share(found.influence.total[i], found.influence.total_error[i], page.plus_minus),
            )
            for i in order
        ],
        head=("", "alone", "with interplay"),
        right=(1, 2),
    )
    if math.isfinite(found.influence.cut):
        page.paragraph(f"Higher critical speeds count as {_speed(found.influence.cut)}.", "dim", indent=2)


def _speed(speed: float) -> str:
    return "not at all" if math.isinf(speed) else "unstable at every speed" if speed == 0 else speed_text(speed)


def _share(share: float, error: float, plus_minus: str) -> str:
    return f"{100 * share:.1f} {plus_minus} {100 * error:.1f} %"


WORDS = {"proved": ("PROVED", "green"), "refuted": ("NOT STABLE", "red"), "undecided": ("UNDECIDED", "yellow")}


def show_certificate(console: Console, found: Certificate) -> None:
    """Print a proof, a counter-example with its eigenvalues, or what is left open."""
    page = Page(console)
    vehicle_head(page, found.vehicle)
    word, colour = WORDS[found.state]
    page.line()
    page.line((word, f"bold {colour}"))
    sentence = found.sentence.replace("±", page.plus_minus)
    page.paragraph(sentence[:1].upper() + sentence[1:] + ".")
    if found.counterexample is not None:
        page.heading("Eigenvalues there [1/s]")
        seen = [z for z in found.counterexample.eigenvalues if z.imag >= 0]
        for z in seen:
            page.line(f"  {number(z.real)}" + (f" {page.plus_minus} {number(z.imag)}j" if z.imag else ""))
    elif found.state == "undecided":
        page.heading("Left open, the first of them")
        for box in found.undecided[:5]:
            units = type(found.vehicle).declaration.parameters
            ends = [
                f"{name} {low:.8g} to {high:.8g} {units[name].unit}"
                for name, (low, high) in zip(found.ranges, box, strict=True)
            ]
            page.paragraph(", ".join(ends), indent=2, hanging=2)
