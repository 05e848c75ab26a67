"""Which states take part in which mode, as a strip of shaded cells."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from . import labels, style

if TYPE_CHECKING:
    from ..analyses.linear.modes import Mode


def plot_participation(modes: Iterable[Mode], *, figure: Any = None) -> Any:
    """Draw the share [%] of each state in each mode, a darker cell for a larger one.

    Parameters
    ----------
    modes
        `ucrit.modes(vehicle)`, or the modes of an analysis.
    figure
        Figure to draw into; a new one by default.

    Returns
    -------
    matplotlib.figure.Figure
    """
    listed = list(modes)
    states = list(listed[0].participation)
    with style.settings():
        from matplotlib.patches import Rectangle

        fig = figure or style.new_figure(height=0.55 + 0.34 * len(listed))
        axes = fig.subplots()
        for row, mode in enumerate(listed):
            for column, state in enumerate(states):
                share = mode.participation[state]
                cell = Rectangle(
                    (column - 0.48, row - 0.45),
                    0.96,
                    0.9,
                    color=style.BRANCHES[0],
                    alpha=0.8 * share,
                    linewidth=0,
                )
                axes.add_patch(cell)
                if share >= 0.005:
                    axes.text(
                        column,
                        row,
                        f"{100 * share:.0f}",
                        ha="center",
                        va="center",
                        fontsize=8.5,
                        color=style.INK,
                    )
        axes.set_xlim(-0.5, len(states) - 0.5)
        axes.set_ylim(len(listed) - 0.5, -0.5)
        axes.set_xticks(range(len(states)), [labels.math_symbol(state) for state in states], fontsize=10)
        axes.set_yticks(range(len(listed)), [_wrapped(mode.name) for mode in listed])
        style.tidy(axes, grid=False)
        axes.xaxis.tick_top()
        axes.tick_params(length=0)
        for spine in axes.spines.values():
            spine.set_visible(False)
    return fig


def _wrapped(name: str) -> str:
    """Break a long name in two lines."""
    lines = textwrap.wrap(name, max(18, 2 + len(name) // 2))
    return labels.plain("\n".join(lines))
