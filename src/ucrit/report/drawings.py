"""The drawings of the page, each with its caption and a description for readers who do not see it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from markupsafe import Markup

from ..plots.labels import number, percent, unit_text
from . import choices, formulas
from .figures import svg

if TYPE_CHECKING:
    from ..analyses.stability.analyze import Analysis
    from ..analyses.stability.critical import CriticalValues
    from ..analyses.stability.locus import Locus

LOCUS_POINTS = 300
MAP_POINTS = 240


@dataclass(frozen=True)
class Drawing:
    """An SVG element and the words under it."""

    svg: Markup
    caption: str | Markup


def along(analysis: Analysis) -> tuple[Locus, CriticalValues] | None:
    """Follow the eigenvalues along the speed or, without one, along the parameter of the best remedy."""
    from ..analyses.stability.critical import critical
    from ..analyses.stability.locus import locus

    vehicle = analysis.vehicle
    name = type(vehicle).declaration.speed
    if all(mode.eigenvalue == 0 for mode in analysis.modes):
        return None  # nothing but rigid positions, which stay where they are
    if name is not None:
        return locus(vehicle, points=LOCUS_POINTS), analysis.critical or critical(vehicle)
    helpful = [r.parameter for r in analysis.remedies if r.value is not None]
    if not helpful:
        return None
    ends = choices.map_range(analysis, helpful[0], 2)
    return locus(vehicle, helpful[0], ends[0], ends[-1], LOCUS_POINTS), critical(vehicle, helpful[0])


def of_locus(path: Locus, found: CriticalValues) -> list[Drawing]:
    """Draw the root locus, and damping and frequency."""
    from ..plots.damping import plot_damping
    from ..plots.root_locus import plot_locus

    unit = unit_text(path.unit)
    ends = f"from {number(path.values[0], 3)} to {number(path.values[-1], 3)} {unit}".strip()
    told = "; ".join(
        f"{c.kind} of the {c.motion} at {number(c.value, 4)} {unit}, stable {c.stable} it".replace("  ", " ")
        for c in found
        if path.values[0] <= c.value <= path.values[-1]
    )
    crossing = f" Critical: {told}." if told else " No root crosses the imaginary axis in this range."
    symbol = formulas.symbol(path.parameter)
    return [
        Drawing(
            svg(
                plot_locus(path, critical=found),
                "locus",
                f"Root locus along {path.parameter} {ends}.{crossing}",
            ),
            Markup("Paths of the eigenvalues as {} goes {}; what lies in the shaded half grows.").format(symbol, ends),
        ),
        Drawing(
            svg(
                plot_damping(path, critical=found),
                "damping",
                f"Damping and frequency along {path.parameter} {ends}.{crossing}",
            ),
            Markup("The modes' damping and frequency; stable ranges of {} are shaded.").format(symbol),
        ),
    ]


def of_map(analysis: Analysis, asked: Sequence[str] | None, path: Locus | None) -> Drawing | None:
    """Draw where in the plane of two parameters the vehicle is stable."""
    from ..analyses.regions.stability_map import stability_map
    from ..plots.stability_map import plot_map

    names = choices.map_parameters(analysis, asked)
    if names is None:
        return None
    across, up = names
    first = choices.map_range(analysis, across, MAP_POINTS, path)
    beside = analysis.vehicle.with_(**{across: first[[0, -1]]})
    second = choices.map_range(analysis, up, MAP_POINTS, path, beside)
    ranges: dict[str, Any] = {across: first, up: second}
    result = stability_map(analysis.vehicle, **ranges)
    description = f"Map of stability over {across} and {up}: stable on {number(100 * result.share, 3)} % of it."
    return Drawing(
        svg(plot_map(result, vehicle=analysis.vehicle), "map", description),
        Markup("Stability over {} and {}, all other parameters as they are.{}{}").format(
            formulas.symbol(across),
            formulas.symbol(up),
            _uniform(result.share),
            "" if _speed(analysis) in names else _at_speed(analysis),
        ),
    )


def _uniform(share: float) -> str:
    """Say so where a map has one colour only."""
    return {0.0: " All of it is unstable.", 1.0: " All of it is stable."}.get(share, "")


def _speed(analysis: Analysis) -> str | None:
    return type(analysis.vehicle).declaration.speed


def _at_speed(analysis: Analysis) -> str:
    return "" if analysis.speed is None else f" Speed: {number(analysis.speed)} m/s."


def of_remedies(analysis: Analysis) -> Drawing | None:
    """Draw the remedies as bars."""
    from ..plots.remedies import plot_remedies

    helpful = [r for r in analysis.remedies if r.value is not None]
    if not helpful:
        return None
    told = ", ".join(f"{r.parameter} {percent(r.relative)}" for r in helpful)
    return Drawing(
        svg(plot_remedies(helpful), "remedies", f"Bars of the smallest sufficient changes: {told}."),
        "The smallest change of each parameter alone. Bars with a pointed end are cut off.",
    )


def of_modes(analysis: Analysis) -> list[Drawing]:
    """Draw the mode shapes and the participation of the states."""
    from ..plots.mode_shapes import plot_mode_shapes
    from ..plots.participation import plot_participation

    names = ", ".join(mode.name for mode in analysis.modes)
    shares = "; ".join(
        f"{mode.name}: " + ", ".join(f"{state} {100 * share:.0f} %" for state, share in mode.participation.items())
        for mode in analysis.modes
    )
    return [
        Drawing(
            svg(
                plot_mode_shapes(analysis.modes, analysis.vehicle),
                "shapes",
                f"Dials of amplitude and phase of each variable in {names}.",
            ),
            "Shape of each mode: a hand's length is the amplitude, its direction the phase, "
            "counter-clockwise ahead. Lengths compare variables of one unit; the largest counts as 1.",
        ),
        Drawing(
            svg(plot_participation(analysis.modes), "participation", f"Participation of the states. {shares}."),
            "Share of each state in each mode [%]; a row adds up to 100.",
        ),
    ]
