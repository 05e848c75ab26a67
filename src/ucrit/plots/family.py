"""A family of steady motions: what adjusts itself against what moves."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from . import labels, style

if TYPE_CHECKING:
    from ..analyses.nonlinear.steady_family import SteadyFamily


def plot_family(family: SteadyFamily, quantity: str | None = None, *, figure: Any = None) -> Any:
    """Draw one quantity of a family of steady motions against the moving one; unstable motions are dashed.

    Parameters
    ----------
    family
        `ucrit.steady_family(vehicle, ...)`.
    quantity
        What to draw; by default the first that is free, or the first state.
    figure
        Figure to draw into; a new one by default.

    Returns
    -------
    matplotlib.figure.Figure
    """
    others = [name for name in (*family.free, *family.values) if name != family.along]
    name = quantity or others[0]
    x, y, stable = family[family.along], family[name], family.stable
    with style.settings():
        fig = figure or style.new_figure()
        axes = fig.subplots()
        for flag, dash, word in ((True, "-", "stable"), (False, (0, (3, 1.6)), "unstable")):
            mask = stable == flag
            wide = mask.copy()
            if not flag:
                wide[:-1] |= mask[1:]
            if wide.any():
                axes.plot(
                    np.where(wide, x, np.nan), np.where(wide, y, np.nan), color=style.colour(2 if flag else 1),
                    linestyle=dash, linewidth=1.9, label=word, gid=word,
                )  # fmt: skip
        for change in family.changes:
            axes.plot([change.value], [change.values[name]], "o", color=style.INK, markersize=5, zorder=5, gid="change")
            at = (change.value, change.values[name])
            style.label(axes, change.kind, at, xytext=(6, 6), textcoords="offset points")
        axes.set_xlabel(_label(family, family.along))
        axes.set_ylabel(_label(family, name))
        axes.legend(frameon=False, fontsize=8.5)
        style.tidy(axes)
    return fig


def _label(family: SteadyFamily, name: str) -> str:
    declared = type(family.vehicle).declaration
    groups = (declared.variables, declared.inputs, declared.outputs, declared.parameters)
    meaning = next((group[name].meaning for group in groups if name in group), "")
    return labels.axis_label(meaning, name, family.units[name])
