"""Mode shapes as phasors: how far, and when, each variable moves in each mode."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from . import labels, style

if TYPE_CHECKING:
    from ..analyses.linear.modes import Mode
    from ..core.contract.model import Model

RADIUS = 0.28
PITCH = 0.86
ROW = 1.12
"""Radius of a dial, distance of dials and height of a row [in]."""

SMALLEST = 5e-4
"""Amplitudes below this share of the largest of the same unit count as no motion."""


ROUNDING = 1e-9
"""Amplitudes below this share of the mode's largest variable are rounding errors, whatever their unit."""


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
    width, height = max(style.WIDTH, PITCH * len(names) + 0.1), ROW * len(listed) + 0.05
    with style.settings():
        fig = figure or style.new_figure(width, height)
        axes = fig.subplots()
        for row, mode in enumerate(listed):
            _row(axes, ROW * row, mode, names, vehicle)
        axes.set_aspect("equal", anchor="NW")
        axes.set_xlim(0, width)
        axes.set_ylim(height, 0)
        axes.axis("off")
    return fig


def _row(axes: Any, top: float, mode: Mode, names: list[str], vehicle: Model) -> None:
    how = f"{labels.number(mode.frequency_hz, 3)} Hz" if mode.oscillates else _time(mode)
    title = f"{labels.plain(mode.name)}, {how}"
    axes.text(0.02, top + 0.1, title, ha="left", va="center", fontsize=9, color=style.INK)
    units = {name: _unit(vehicle, name) for name in names}
    for column, name in enumerate(names):
        largest = max(abs(mode.shape[other]) for other in names if units[other] == units[name])
        centre = (PITCH * (column + 0.5), top + 0.24 + RADIUS)
        still = abs(mode.shape[name]) < max(SMALLEST * largest, ROUNDING)
        _dial(axes, centre, 0 if still else mode.shape[name] / largest)
        text = f"{labels.math_symbol(name)}  {_numbers(mode.shape[name], units[name], still)}"
        place = (centre[0], centre[1] + RADIUS + 0.03)
        axes.text(*place, text, ha="center", va="top", fontsize=7.6, color=style.INK, linespacing=1.15)


def _unit(vehicle: Model, name: str) -> str:
    variable = type(vehicle).declaration.variables.get(name)
    return variable.unit if variable else "1"


def _time(mode: Mode) -> str:
    if mode.eigenvalue == 0:
        return "stays where it is"
    if math.isfinite(mode.time_to_half):
        return f"halves in {labels.number(mode.time_to_half, 3)} s"
    return f"doubles in {labels.number(mode.time_to_double, 3)} s"


def _dial(axes: Any, centre: tuple[float, float], hand: complex) -> None:
    from matplotlib.patches import Circle

    x, y = centre
    axes.add_patch(Circle(centre, RADIUS, facecolor="none", edgecolor=style.GRID, linewidth=0.9))
    axes.plot([x, x + RADIUS], [y, y], color=style.GRID, linewidth=0.6, zorder=1)
    if not hand:
        axes.plot([x], [y], "o", color=style.MUTED, markersize=3)
        return
    tip = (x + RADIUS * hand.real, y - RADIUS * hand.imag)
    arrow = {
        "arrowstyle": "-|>",
        "color": style.BRANCHES[0],
        "linewidth": 1.6,
        "shrinkA": 0,
        "shrinkB": 0,
        "mutation_scale": min(9, 2 + 9 * abs(hand)),
    }
    axes.annotate("", tip, centre, arrowprops=arrow)


def _numbers(value: complex, unit: str, still: bool) -> str:
    if still:
        return "0"
    degrees = round(math.degrees(cmath.phase(value)))
    degrees = 180 if degrees == -180 else degrees
    return f"{labels.quantity(abs(value), unit, 3)}\n{labels.number(degrees, 3)}°"
