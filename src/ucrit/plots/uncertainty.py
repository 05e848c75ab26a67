"""How sure a critical speed is: probability of instability against speed, and what makes it unsure."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ..core.errors import UcritError
from . import labels, style

if TYPE_CHECKING:
    from ..analyses.regions.influence import Influence
    from ..analyses.regions.uncertainty import Uncertainty

Array = npt.NDArray[Any]

POINTS = 300
SHARES = (0.05, 0.5, 0.95)


def plot_uncertainty(result: Uncertainty, *, figure: Any = None) -> Any:
    """Draw the probability of instability against speed with quantiles, and bars of influence where there are any.

    Parameters
    ----------
    result
        What `ucrit.uncertainty` returned.
    figure
        Figure to draw into; a new one by default.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    UcritError
        If no vehicle drawn ever changes its stability.
    """
    edges = result.crossings.edges[np.isfinite(result.crossings.edges) & (result.crossings.edges <= result.upto)]
    if not edges.size:
        raise UcritError("stability never changes within these tolerances: there is nothing to draw")
    with style.settings():
        count = 1 if result.influence is None else 2
        fig = figure or style.new_figure(width=style.WIDTH * (1 if count == 1 else 1.8), height=3.3)
        axes = np.atleast_1d(fig.subplots(1, count))
        _curve(axes[0], result, edges)
        if result.influence is not None:
            _tornado(axes[1], result.influence)
    return fig


def _curve(axes: Any, result: Uncertainty, edges: Array) -> None:
    low, high = np.quantile(edges, [0.002, 0.98])
    gap = max(high - low, 0.02 * high)
    left, right = max(low - 0.15 * gap, 1e-3 * high), min(high + 0.1 * gap, result.upto)
    speeds = np.linspace(left, right, POINTS)
    share = result.probability(speeds)
    axes.fill_between(speeds, 100 * share, 0, color=style.UNSTABLE, zorder=0, linewidth=0)
    axes.fill_between(speeds, 100 * share, 100, color=style.STABLE, zorder=0, linewidth=0)
    axes.plot(speeds, 100 * share, color=style.INK, linewidth=1.6, zorder=3, gid="probability")
    for level in SHARES:
        speed = result.quantile(level)
        if speed < right and result.probability(max(speed, left)) > 0:
            at = 100 * float(result.probability(speed)) if speed > 0 else 0.0
            axes.plot([speed, speed], [0, at], color=style.MUTED, linewidth=0.9, linestyle=style.DASHES[1], zorder=2)
            text = f"{labels.number(100 * level)} %: {labels.quantity(speed, 'm/s', 3)}"
            side = "right" if speed > (left + right) / 2 else "left"
            style.label(
                axes, text, (speed, at), xytext=(-6 if side == "right" else 6, 3), textcoords="offset points", ha=side
            )
    axes.set_xlim(left, right)
    axes.set_ylim(0, 100)
    axes.set_xlabel("speed [m/s]")
    axes.set_ylabel("probability of instability [%]")
    style.tidy(axes, grid=False)


def _tornado(axes: Any, found: Influence) -> None:
    """Bars of both indices, the largest on top; what the total has more than the first comes from interplay."""
    order = np.argsort(-found.total)
    rows = np.arange(len(order))
    axes.barh(
        rows - 0.19,
        100 * found.total[order],
        0.36,
        xerr=100 * found.total_error[order],
        color=style.BRANCHES[0],
        error_kw={"elinewidth": 0.8, "ecolor": style.MUTED},
        label="with all interplay",
    )
    axes.barh(
        rows + 0.19,
        100 * found.first[order],
        0.36,
        xerr=100 * found.first_error[order],
        color=style.BRANCHES[1],
        error_kw={"elinewidth": 0.8, "ecolor": style.MUTED},
        label="alone",
    )
    names = [", ".join(labels.math_symbol(name) for name in found.groups[i]) for i in order]
    axes.set_yticks(rows, names, fontsize=10)
    axes.set_ylim(len(rows) - 0.4, -0.6)
    axes.set_xlim(0, None)
    axes.set_xlabel("share of the critical speed's variance [%]")
    axes.legend(frameon=False, loc="lower right")
    style.tidy(axes, grid=False)
    axes.tick_params(axis="y", length=0)
