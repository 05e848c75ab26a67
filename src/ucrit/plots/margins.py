"""Margins of a control loop against one parameter, usually the speed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ..core.errors import UcritError
from . import labels, style

if TYPE_CHECKING:
    from ..analyses.stability.margins import Margins

Array = npt.NDArray[Any]

ROOM = 1.6
"""Factor that a gain axis goes beyond the largest margin that is finite."""


def plot_margins(result: Margins, *, figure: Any = None) -> Any:
    """Draw gain, phase, delay and disk margins over the parameter; ranges without stability are shaded.

    Parameters
    ----------
    result
        `ucrit.margins` of a vehicle one of whose parameters is an array.
    figure
        Figure to draw into; a new one by default.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    UcritError
        If not exactly one parameter is an array of several values, or the loop is stable nowhere.
    """
    dims = result.vehicle.dims
    if len(dims) != 1 or np.size(next(iter(dims.values()))) < 2:
        over = ", ".join(dims) or "none"
        raise UcritError(f"margins are drawn over one parameter, such as U=9:40:60; parameters with a range: {over}")
    if not result.stable.any():
        raise UcritError(f"no margins at {result.input} to draw: the closed loop is unstable at every value")
    ((name, values),) = dims.items()
    x = np.asarray(values, dtype=float)
    with style.settings():
        fig = figure or style.new_figure(height=5.6)
        axes = fig.subplots(4, 1, sharex=True, gridspec_kw={"height_ratios": [1.3, 1, 1, 1]})
        _gain(axes[0], x, result)
        delay, unit = (1e3 * result.delay, "ms") if np.nanmin(result.delay) < 1 else (result.delay, "s")
        drawn = (("phase", np.degrees(result.phase), "phase\n[degrees]"), ("delay", delay, f"delay [{unit}]"))
        for panel, (gid, y, text) in zip(axes[1:], (*drawn, ("disk", result.disk, "disk")), strict=True):
            _line(panel, x, y, gid)
            panel.set_ylabel(text)
            panel.set_ylim(0, _top(y))
        for panel in axes:
            _shade(panel, x, result.stable)
            panel.set_xlim(x.min(), x.max())
            style.tidy(panel)
        parameter = type(result.vehicle).declaration.parameters[name]
        axes[-1].set_xlabel(labels.axis_label(parameter.meaning, name, parameter.unit))
        axes[0].set_title(f"margins at {result.input}", fontsize=9, loc="left", color=style.INK)
        fig.align_ylabels(axes)
    return fig


def _line(axes: Any, x: Array, y: Array, gid: str, **options: Any) -> None:
    finite = np.where(np.isfinite(y), y, np.nan)
    axes.plot(x, finite, color=style.colour(0), linewidth=1.9, gid=gid, **options)


def _top(y: Array) -> float:
    """Return the end of an axis: a single very large margin must not hide the others."""
    finite = y[np.isfinite(y)]
    if not finite.size:
        return 1.0
    return float(1.1 * min(finite.max(), 6 * np.median(finite))) or 1.0


def _gain(axes: Any, x: Array, result: Margins) -> None:
    """Fill what the gain may be times, from the lower limit to the upper one, on a logarithmic axis."""
    limits = np.concatenate([result.gain_down, result.gain_up])
    finite = limits[np.isfinite(limits) & (limits > 0)]
    top = ROOM * max([*finite, 2.0])
    bottom = min([*finite, 0.5]) / ROOM
    low = np.where(result.gain_down > 0, result.gain_down, bottom)
    high = np.minimum(result.gain_up, top)
    axes.fill_between(x, low, high, where=result.stable, color=style.STABLE, linewidth=0, gid="gain")
    _line(axes, x, np.where(result.gain_down > 0, result.gain_down, np.nan), "gain_down")
    _line(axes, x, result.gain_up, "gain_up")
    axes.axhline(1, color=style.INK, linewidth=0.9)
    axes.set_yscale("log")
    axes.set_ylim(bottom, top)
    style.plain_numbers(axes.yaxis)
    axes.set_ylabel("gain times")


def _shade(axes: Any, x: Array, stable: Array) -> None:
    """Shade where the closed loop is unstable, up to half way to the next stable value."""
    edges = np.concatenate([x[:1], (x[1:] + x[:-1]) / 2, x[-1:]])
    changes = np.flatnonzero(np.diff(np.concatenate([[1], stable, [1]]).astype(int)))
    for first, last in changes.reshape(-1, 2):
        axes.axvspan(edges[first], edges[last], color=style.UNSTABLE, linewidth=0, zorder=0, gid="unstable")
