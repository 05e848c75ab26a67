"""The picture of a vehicle: root locus and damping against speed, side by side."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..core.errors import UcritError
from . import style
from .damping import plot_damping
from .root_locus import plot_locus

if TYPE_CHECKING:
    from ..analyses.stability.critical import CriticalValues
    from ..analyses.stability.locus import Locus


def plot_overview(locus: Locus, *, critical: CriticalValues | None = None, figure: Any = None) -> Any:
    """Draw the root locus on the left, damping and frequency on the right.

    Parameters
    ----------
    locus
        `ucrit.locus(vehicle)`.
    critical
        Critical values of the same parameter.
    figure
        Figure to draw into, without a layout engine's constraints of its own; a new one by default.

    Returns
    -------
    matplotlib.figure.Figure
    """
    with style.settings():
        fig = figure or style.new_figure(width=2 * style.WIDTH, height=4.1)
    if fig.get_axes():
        raise UcritError("the overview needs an empty figure, this one has axes already")
    left, right = fig.subfigures(1, 2, wspace=0.04)
    plot_locus(locus, critical=critical, figure=left)
    plot_damping(locus, critical=critical, figure=right)
    return fig
