"""Cars near the limit: axle characteristics, handling curve, and what the driver does or the car goes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ..core.errors import UcritError
from . import labels, style

if TYPE_CHECKING:
    from ..analyses.nonlinear.handling import Handling

Array = npt.NDArray[Any]

GRAVITY = 9.80665
ROOM = 1.06
REGIONS = {"oversteer": style.STABLE, "unstable": style.UNSTABLE}
"""Tints of regions in the picture of the steer angle."""


def plot_handling(found: Handling, *, figure: Any = None) -> Any:
    """Draw a handling diagram.

    On the left the lateral acceleration that each axle gives against its slip angle; in the middle the difference of
    the two slip angles at equal lateral acceleration, the handling curve; on the right, with the regions of oversteer
    and instability, and what a neutral car would do, the steer angle against the curvature of the path (at constant
    speed), the steer angle against the lateral acceleration (at constant radius), or the curvature against the lateral
    acceleration (at constant steer angle). Unstable turns are dashed.

    Parameters
    ----------
    found
        `ucrit.handling_diagram(vehicle)`.
    figure
        Empty figure to draw into; a new one by default.

    Returns
    -------
    matplotlib.figure.Figure
    """
    with style.settings():
        fig = figure or style.new_figure(width=2 * style.WIDTH, height=3.6)
        if fig.get_axes():
            raise UcritError("the handling diagram needs an empty figure, this one has axes already")
        axles, curve, steer = fig.subplots(1, 3)
        curve.sharey(axles)
        _axles(axles, found)
        _curve(curve, found)
        _steer(steer, found)
        for axes in (axles, curve, steer):
            style.tidy(axes)
    return fig


def _axles(axes: Any, found: Handling) -> None:
    height = found.a_y / GRAVITY
    for index, (name, slip) in enumerate((("front axle", found.front), ("rear axle", found.rear))):
        axes.plot(
            np.rad2deg(slip), height, color=style.colour(index), linestyle=style.dash(index), linewidth=1.9, label=name,
            gid=name.replace(" ", "-"),
        )  # fmt: skip
    axes.set_xlabel("slip angle [deg]")
    axes.set_ylabel("lateral acceleration [g]")
    axes.set_ylim(0, ROOM * height.max())
    axes.set_xlim(0, None)
    axes.legend(frameon=False, fontsize=8.5, loc="lower right")


def _curve(axes: Any, found: Handling) -> None:
    axes.axvline(0, color=style.MUTED, linewidth=0.8)
    _by_stability(axes, np.rad2deg(found.difference), found.a_y / GRAVITY, found.stable, "handling")
    inside = np.rad2deg(found.difference)[found.a_y <= 0.99 * found.largest]
    reach = max(float(np.abs(inside).max()), 0.5) * 1.25
    axes.set_xlim(-reach, reach)
    side = {"ha": "center", "va": "bottom", "xycoords": ("axes fraction", "axes fraction")}
    style.label(axes, "oversteer", (0.25, 0.02), **side)
    style.label(axes, "understeer", (0.75, 0.02), **side)
    left = np.abs(inside.min()) > np.abs(inside.max())
    axes.legend(frameon=False, fontsize=8.5, loc="center right" if left else "center left")
    axes.set_xlabel("front less rear slip angle [deg]")


def _steer(axes: Any, found: Handling) -> None:
    """Draw what moves against what the test makes move: see `plot_handling`."""
    constant, height = found.turns.constant, found.a_y / GRAVITY
    x = found.curvature if constant == "speed" else height
    y = found.curvature if constant == "steer angle" else np.rad2deg(found.delta)
    named = set()
    for part in found.ranges:
        if part.kind in REGIONS:
            low, high = sorted(part.curvature if constant == "speed" else np.array(part.a_y) / GRAVITY)
            text = None if part.kind in named else part.kind
            axes.axvspan(low, high, color=REGIONS[part.kind], linewidth=0, zorder=0, gid=part.kind, label=text)
            named.add(part.kind)
    neutral = _neutral(found) * x if constant == "speed" else np.full(len(x), y[0])
    axes.plot(x, neutral, color=style.MUTED, linewidth=1, linestyle=":", label="neutral", gid="neutral")
    _by_stability(axes, x, y, found.stable, "steer", texts=("", ""))
    near = found.a_y <= 0.995 * found.largest
    low, high = float(y[near].min()), float(y[near].max())
    low, high = (low, high) if high - low > 1e-3 * abs(high) else (0.5 * low, 1.5 * high)
    axes.set_ylim(low - 0.15 * (high - low) if low < -1e-6 * high else 0, high + 0.25 * (high - low))
    axes.set_xlim(0, ROOM * float(x.max()))
    for part, after in zip(found.ranges[:-1], found.ranges[1:], strict=True):
        at = part.curvature[1] if constant == "speed" else part.a_y[1] / GRAVITY
        axes.plot([at], [np.interp(at, x[near], y[near])], "o", color=style.INK, markersize=4,
                  gid=f"{part.kind}-{after.kind}")  # fmt: skip
    axes.locator_params(axis="x", nbins=4)
    axes.legend(frameon=False, fontsize=8.5, loc="upper left")
    curvature = f"curvature 1/{labels.math_symbol('R')} [{labels.unit_text('1/m')}]"
    angle = f"steer angle {labels.math_symbol(found.steer)} [deg]"
    axes.set_xlabel(curvature if constant == "speed" else "lateral acceleration [g]")
    axes.set_ylabel(curvature if constant == "steer angle" else angle)


def _neutral(found: Handling) -> float:
    """Return the slope [deg m] that the steer angle would have if the slip angles did not differ: the wheelbase."""
    near = found.curvature <= 0.1 * found.curvature.max()
    near[:2] = True
    rest = found.delta - found.difference
    return float(np.rad2deg(np.polyfit(found.curvature[near], rest[near], 1)[0]))


def _by_stability(
    axes: Any, x: Array, y: Array, stable: Array, gid: str, texts: tuple[str, str] = ("stable", "unstable")
) -> None:
    """Draw a curve, stable pieces solid and unstable ones dashed, joined where they meet."""
    for flag, dash, word, text in ((True, "-", "stable", texts[0]), (False, (0, (3, 1.6)), "unstable", texts[1])):
        mask = stable == flag
        beside = mask.copy()
        if not flag:
            beside[:-1] |= mask[1:]
        if beside.any():
            axes.plot(
                np.where(beside, x, np.nan), np.where(beside, y, np.nan), color=style.colour(2 if flag else 1),
                linestyle=dash, linewidth=1.9, label=text, gid=f"{gid}-{word}",
            )  # fmt: skip
