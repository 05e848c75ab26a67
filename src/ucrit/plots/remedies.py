"""Remedies as bars of relative change."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from ..core.errors import UcritError
from . import labels, style

if TYPE_CHECKING:
    from ..analyses.stability.remedies import Remedy

LIMIT = 1.0
"""Bars end here at the latest; a longer change is told by its number and an open end."""


def plot_remedies(remedies: Sequence[Remedy], *, figure: Any = None) -> Any:
    """Draw the smallest change of each parameter alone that makes the vehicle stable, as bars.

    Parameters
    ----------
    remedies
        As `ucrit.remedies` returns them, the smallest change first; parameters that never help are left out.
    figure
        Figure to draw into; a new one by default.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    UcritError
        If no parameter alone helps, so that there is nothing to draw.
    """
    helpful = [r for r in remedies if r.value is not None]
    if not helpful:
        raise UcritError("there is no remedy to draw: the vehicle is stable, or no parameter alone makes it so")
    with style.settings():
        fig = figure or style.new_figure(height=0.75 + 0.34 * len(helpful))
        axes = fig.subplots()
        limit = _limit(helpful)
        for row, remedy in enumerate(helpful):
            _bar(axes, row, remedy, limit)
        axes.axvline(0, color=style.INK, linewidth=0.9, zorder=3)
        names = [labels.math_symbol(r.parameter) for r in helpful]
        axes.set_yticks(range(len(helpful)), names, fontsize=10)
        axes.set_ylim(len(helpful) - 0.5, -0.5)
        axes.set_xlim(-1.75 * limit, 1.75 * limit)
        axes.set_xlabel("smallest change that suffices [% of the present value]")
        style.tidy(axes, grid=False)
        axes.tick_params(axis="y", length=0)
        axes.spines["left"].set_visible(False)
        _percent_ticks(axes, limit)
    return fig


def _limit(helpful: Sequence[Remedy]) -> float:
    """End of the longest bar: one huge change must not hide the small ones."""
    finite = sorted(abs(r.relative) for r in helpful if math.isfinite(r.relative))
    if not finite:
        return LIMIT
    return min(LIMIT, finite[-1], 3 * finite[len(finite) // 2]) or LIMIT


def _bar(axes: Any, row: int, remedy: Remedy, limit: float) -> None:
    assert remedy.value is not None
    rising = remedy.value > remedy.present
    sign = 1 if rising else -1
    length = sign * min(abs(remedy.relative), limit)
    colour = style.BRANCHES[0] if rising else style.BRANCHES[1]
    axes.barh(row, length, height=0.62, color=colour, gid=f"bar-{remedy.parameter}")
    if abs(remedy.relative) > limit:
        axes.plot([length], [row], marker=">" if rising else "<", color=colour, markersize=11, clip_on=False)
    finite = math.isfinite(remedy.relative)
    text = labels.percent(remedy.relative) if finite else f"0 to {labels.quantity(remedy.value, remedy.unit, 3)}"
    gap = 7 if abs(remedy.relative) <= limit else 12
    axes.annotate(
        text,
        (length, row),
        xytext=(sign * gap, 0),
        textcoords="offset points",
        fontsize=8.5,
        color=style.INK,
        va="center",
        ha="left" if rising else "right",
    )


def _percent_ticks(axes: Any, limit: float) -> None:
    """Label the axis in percent, only where bars can reach."""
    from matplotlib.ticker import FuncFormatter, MaxNLocator

    ticks = MaxNLocator(5, steps=[1, 2, 2.5, 5, 10]).tick_values(-limit, limit)
    axes.set_xticks([t for t in ticks if abs(t) <= 1.001 * limit])
    axes.xaxis.set_major_formatter(FuncFormatter(lambda x, _: labels.number(round(100 * x, 6))))
