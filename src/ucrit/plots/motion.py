"""States, outputs and inputs of a simulation over time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.errors import UcritError
from . import style
from .labels import unit_text

if TYPE_CHECKING:
    from ..analyses.motion.simulation import Simulation

MOST = 8
"""Curves that are drawn at most."""


def plot_simulation(result: Simulation, *, figure: Any = None) -> Any:
    """Draw what moves in a simulation over time, one quantity below the other, and mark the events.

    Parameters
    ----------
    result
        What `ucrit.simulate` returned; of a batch of one dimension all members are drawn.
    figure
        Figure to draw into; a new one by default.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    UcritError
        If the batch has more than one dimension.

    Examples
    --------
    >>> from ucrit import load, simulate
    >>> from ucrit.plots import plot_simulation
    >>> len(plot_simulation(simulate(load("caravan"), 2, {"theta": 0.01})).axes)
    4
    """
    if len(result.dims) > 1:
        raise UcritError(f"a drawing shows a batch of one dimension, got {', '.join(result.dims)}")
    units = result.units()
    names = [*result.inputs, *result.states, *result.outputs]
    moving = [name for name in names if np.nanmax(np.ptp(result[name], axis=-1), initial=0.0) > 0] or names
    shown = moving[:MOST]
    with style.settings():
        figure = figure or style.new_figure(height=max(1.0 * len(shown) + 0.5, 2.2))
        panels = np.atleast_1d(figure.subplots(len(shown), sharex=True))
        for i, (axes, name) in enumerate(zip(panels, shown, strict=True)):
            style.tidy(axes)
            unit = unit_text(units[name])
            for member in np.atleast_2d(result[name]):
                axes.plot(result.times, member, color=style.colour(i), linewidth=1.4, gid=name)
            axes.set_ylabel(f"{name}\n[{unit}]" if unit else name, rotation=0, ha="right", va="center")
            if not result.dims:
                for event in result.events:
                    axes.axvline(event.time, color=style.MUTED, linewidth=0.8, linestyle=":")
        if not result.dims:
            for event in result.events[:6]:
                style.label(panels[0], event.name, (event.time, 1.02), xycoords=("data", "axes fraction"), ha="right")
        panels[-1].set_xlabel("time [s]")
        figure.align_ylabels()
    return figure
