"""Moment about the centre of mass against lift, at settings of a control."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from . import labels, style

if TYPE_CHECKING:
    from ..analyses.stability.pitching import MomentLine


def plot_moment_line(lines: MomentLine, *, figure: Any = None) -> Any:
    """Draw moment against lift; a line that falls is statically stable, and is trimmed where it meets zero.

    Parameters
    ----------
    lines
        `ucrit.moment_line(vehicle)`.
    figure
        Figure to draw into; a new one by default.

    Returns
    -------
    matplotlib.figure.Figure
    """
    coefficients = "C_L" in type(lines.vehicle).declaration.outputs
    lift, moment = ("C_L", "C_M") if coefficients else ("L", "M")
    declared = type(lines.vehicle).declaration.outputs
    with style.settings():
        fig = figure or style.new_figure(height=3.4)
        axes = fig.subplots()
        for row, (x, y) in enumerate(zip(lines.lift, lines.moment, strict=True)):
            text = _setting(lines, row)
            look = {"color": style.colour(row), "linestyle": style.dash(row), "linewidth": 1.9}
            axes.plot(x, y, label=text, gid=f"line-{row}", **look)
        trimmed = lines.trimmed[np.isfinite(lines.trimmed)]
        axes.plot(trimmed, np.zeros_like(trimmed), "o", color=style.INK, markersize=5, zorder=5, gid="trimmed")
        axes.axhline(0, color=style.INK, linewidth=0.9)
        axes.set_xlabel(labels.axis_label("lift", lift, declared[lift].unit))
        axes.set_ylabel(labels.axis_label("moment, nose up", moment, declared[moment].unit))
        style.tidy(axes)
        if lines.input:
            meaning = type(lines.vehicle).declaration.inputs[lines.input].meaning
            axes.legend(frameon=False, loc="lower left", title=labels.plain(meaning))
    return fig


def _setting(lines: MomentLine, row: int) -> str:
    if not lines.input:
        return ""
    unit, value = type(lines.vehicle).declaration.inputs[lines.input].unit, float(lines.settings[row])
    if unit == "rad":
        return f"{labels.number(float(np.rad2deg(value)))} degrees"
    return f"{labels.number(value)} {labels.unit_text(unit)}"
