"""Mode shapes as phasors: how far, and when, each variable moves in each mode."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from . import labels, style

if TYPE_CHECKING:
    from ..analyses.modes import Mode
    from ..core.model import Model

RADIUS = 0.34
SMALLEST = 5e-4
"""Amplitudes below this share of the largest of the same unit count as no motion."""


def plot_mode_shapes(modes: Sequence[Mode], vehicle: Model, *, figure: Any = None) -> Any:
    """Draw one dial for each variable in each mode.

    The hand's length is the amplitude, as a share of the largest variable of the same unit in that mode; its
    direction is the phase, zero to the right and counter-clockwise ahead in time. Numbers are for one unit of
    the mode's largest variable. In a mode that does not oscillate, all hands lie on one line.

    Parameters
    ----------
    modes
        `ucrit.modes(vehicle)`, or the modes of an analysis.
    vehicle
        Tells the variables' units.
    figure
        Figure to draw into; a new one by default.

    Returns
    -------
    matplotlib.figure.Figure
    """
    listed = list(modes)
    names = [name for name in listed[0].shape if "'" not in name]
    with style.settings():
        fig = figure or style.new_figure(height=0.45 + 1.02 * len(listed))
        axes = fig.subplots()
        for row, mode in enumerate(listed):
            _row(axes, row, mode, names, vehicle)
        for column, name in enumerate(names):
            axes.text(
                column,
                -0.62,
                labels.math_symbol(name),
                ha="center",
                va="center",
                fontsize=11,
                color=style.INK,
            )
        axes.set_aspect("equal")
        axes.set_xlim(-1.85, max(len(names) - 0.4, 2.6))
        axes.set_ylim(len(listed) - 0.35, -0.8)
        axes.axis("off")
    return fig


def _row(axes: Any, row: int, mode: Mode, names: list[str], vehicle: Model) -> None:
    title = labels.plain(mode.name).replace(" ", "\n", mode.name.count(" ") if len(mode.name) > 18 else 0)
    how = f"{labels.number(mode.frequency_hz, 3)} Hz" if mode.oscillates else _time(mode)
    axes.text(-1.8, row - 0.03, title, ha="left", va="bottom", fontsize=8.5, color=style.INK, linespacing=1.1)
    axes.text(-1.8, row + 0.06, how, ha="left", va="top", fontsize=8, color=style.MUTED)
    units = {name: _unit(vehicle, name) for name in names}
    for column, name in enumerate(names):
        largest = max(abs(mode.shape[other]) for other in names if units[other] == units[name])
        _dial(axes, (column, row), mode.shape[name], largest, units[name])


def _unit(vehicle: Model, name: str) -> str:
    variable = type(vehicle).declaration.variables.get(name)
    return variable.unit if variable else "1"


def _time(mode: Mode) -> str:
    if mode.eigenvalue == 0:
        return "stays where it is"
    time, word = (
        (mode.time_to_half, "halves")
        if math.isfinite(mode.time_to_half)
        else (mode.time_to_double, "doubles")
    )
    return f"{word} in {labels.number(time, 3)} s"


def _dial(axes: Any, centre: tuple[float, float], value: complex, largest: float, unit: str) -> None:
    from matplotlib.patches import Circle

    x, y = centre
    axes.add_patch(Circle(centre, RADIUS, facecolor="none", edgecolor=style.GRID, linewidth=0.9))
    axes.plot([x, x + RADIUS], [y, y], color=style.GRID, linewidth=0.6, zorder=1)
    still = not largest or abs(value) < SMALLEST * largest
    if still:
        axes.plot([x], [y], "o", color=style.MUTED, markersize=3)
    else:
        share, phase = abs(value) / largest, cmath.phase(value)
        tip = (x + RADIUS * share * math.cos(phase), y - RADIUS * share * math.sin(phase))
        axes.annotate(
            "",
            tip,
            centre,
            arrowprops={
                "arrowstyle": "-|>",
                "color": style.BRANCHES[0],
                "linewidth": 1.6,
                "shrinkA": 0,
                "shrinkB": 0,
                "mutation_scale": 9,
            },
        )
    axes.text(
        x,
        y + RADIUS + 0.05,
        _numbers(value, unit, still),
        ha="center",
        va="top",
        fontsize=7.6,
        color=style.INK,
    )


def _numbers(value: complex, unit: str, still: bool) -> str:
    if still:
        return "0"
    degrees = round(math.degrees(cmath.phase(value)))
    degrees = 180 if degrees == -180 else degrees
    return f"{labels.quantity(abs(value), unit, 3)}, {labels.number(degrees, 3)}°"
