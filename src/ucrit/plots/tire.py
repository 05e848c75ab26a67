"""A tire's curves: side force against slip angle and against load, longitudinal force, and both together."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from . import style

if TYPE_CHECKING:
    from ..analyses.nonlinear.tire_curves import TireCurves

LOAD_ANGLES = (2, 4, 6, 10)
"""Slip angles [degrees] of the lines over the load."""


def plot_tire(curves: TireCurves, *, figure: Any = None) -> Any:
    """Draw the curves of a tire in four panels.

    Side force over load against slip angle, for each road, or for each load where there is one road; side force
    against load; longitudinal force over load against slip; side force against longitudinal force at several slip
    angles, on the first road and for the load in the middle, with the limit of all that friction gives, the locked
    wheel, and the wheel that spins twice as fast as it rolls.

    Parameters
    ----------
    curves
        `ucrit.tire_curves(tire)`.
    figure
        Figure to draw into; a new one by default.

    Returns
    -------
    matplotlib.figure.Figure
    """
    with style.settings():
        fig = figure or style.new_figure(width=1.55 * style.WIDTH, height=6.4)
        (side, load), (along, both) = fig.subplots(2, 2)
        for axes in (side, load, along, both):
            style.tidy(axes)
        _side(side, curves)
        _loads(load, curves)
        _along(along, curves)
        _envelope(both, curves)
    return fig


def _lines(curves: TireCurves) -> list[tuple[int, int, str]]:
    """Return road, load and text of the lines that the panels over slips have."""
    if len(curves.roads) > 1:
        return [(road, curves.loads.size // 2, name) for road, name in enumerate(curves.roads)]
    return [(0, i, f"{load / 1000:.3g} kN") for i, load in enumerate(curves.loads)]


def _line(axes: Any, x: Any, y: Any, number: int, text: str) -> None:
    axes.plot(x, y, color=style.colour(number), linestyle=style.dash(number), linewidth=1.7, label=text)


def _legend(axes: Any, place: str, title: str = "") -> None:
    axes.legend(frameon=False, loc=place, fontsize=8, title=title or None, title_fontsize=8, labelcolor=style.INK)


def _side(axes: Any, curves: TireCurves) -> None:
    for number, (road, i, text) in enumerate(_lines(curves)):
        _line(axes, np.degrees(curves.alpha), -curves.F_y[road, i] / curves.loads[i], number, text)
    axes.set_xlabel("slip angle [degrees]")
    axes.set_ylabel("side force / load [1]")
    axes.set_ylim(bottom=min(0.0, axes.get_ylim()[0]), top=(1.3 if len(curves.roads) > 1 else 1) * axes.get_ylim()[1])
    _legend(axes, "upper left" if len(curves.roads) > 1 else "lower right")


def _loads(axes: Any, curves: TireCurves) -> None:
    """Draw the side force against the load, from small loads to the greatest."""
    F_z = np.linspace(curves.loads.max() / 60, curves.loads.max() * 1.1, 60)
    tire = curves.tire
    for number, degrees in enumerate(LOAD_ANGLES):
        _line(axes, F_z / 1000, -tire.side_force(F_z, np.radians(degrees)) / 1000 + 0 * F_z, number, f"{degrees} deg")
    axes.set_xlabel("load [kN]")
    axes.set_ylabel("side force [kN]")
    axes.set_ylim(bottom=0)
    _legend(axes, "upper left", "slip angle")


def _along(axes: Any, curves: TireCurves) -> None:
    braking = curves.kappa <= 0
    for number, (road, i, text) in enumerate(_lines(curves)):
        _line(axes, -100 * curves.kappa[braking], -curves.F_x[road, i, braking] / curves.loads[i], number, text)
    axes.set_xlabel("braking slip [%], 100 % locked")
    axes.set_ylabel("braking force / load [1]")
    axes.set_ylim(bottom=0, top=1.3 * axes.get_ylim()[1] if len(curves.roads) > 1 else None)
    _legend(axes, "upper right" if len(curves.roads) > 1 else "lower right")


def _envelope(axes: Any, curves: TireCurves) -> None:
    """Draw both forces of a wheel at several slip angles, those of the locked wheel, and the limit of friction."""
    i = curves.loads.size // 2
    if getattr(curves.tire, "friction", ()):
        axes.plot(
            curves.limit_x[0, i] / 1000, -curves.limit_y[0, i] / 1000, color=style.MUTED, linewidth=1, gid="limit",
            label="limit",
        )  # fmt: skip
    for number, beta in enumerate(curves.beta):
        x, y = (values[0, i, number] / 1000 for values in (curves.envelope_x, -curves.envelope_y))
        _line(axes, x, y, number, f"{np.degrees(beta):.3g} deg")
    for end, text, face in ((0, "locked", style.INK), (-1, "spinning", "none")):
        if abs(curves.kappa[end]) == 1:
            ends = curves.envelope_x[0, i, :, end] / 1000, -curves.envelope_y[0, i, :, end] / 1000
            axes.plot(*ends, "o", color=style.INK, markerfacecolor=face, markersize=4, label=text, zorder=5, gid=text)
    axes.set_xlabel(f"longitudinal force [kN], load {curves.loads[i] / 1000:.3g} kN")
    axes.set_ylabel("side force [kN]")
    axes.set_ylim(bottom=min(0.0, axes.get_ylim()[0]), top=1.5 * axes.get_ylim()[1])
    axes.legend(frameon=False, loc="upper center", fontsize=8, ncols=3, labelcolor=style.INK, columnspacing=1)
