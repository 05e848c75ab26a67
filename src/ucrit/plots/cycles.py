"""Bifurcation diagram: the amplitude of limit cycles against the parameter."""

from __future__ import annotations

import math
import textwrap
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ..analyses.nonlinear.cycle_words import leading_state
from ..core.errors import UcritError, near_match
from . import labels, style

if TYPE_CHECKING:
    from collections.abc import Iterator

    from ..analyses.nonlinear.cycle import CycleBranch
    from ..analyses.nonlinear.cycles import LimitCycles

Array = npt.NDArray[Any]

UNSTABLE_DASH = (0, (4, 2.2))
ROW = 32
"""Letters in a row of the vertical axis' label."""


def plot_cycles(found: LimitCycles, *, state: str | None = None, figure: Any = None) -> Any:
    """Draw the amplitude of limit cycles against the parameter.

    Solid lines are stable, dashed ones unstable; the line at zero is straight running. A ring marks where straight
    running begins to oscillate, a diamond where stable and unstable cycles meet and vanish.

    Parameters
    ----------
    found
        `ucrit.limit_cycles(vehicle)`.
    state
        Name of the state whose amplitude is drawn; by default an angle of some degrees, or else a length.
    figure
        Figure to draw into; a new one by default.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    UcritError
        If there is no such state, or no limit cycle to draw.
    """
    if not found.branches:
        raise UcritError(f"there are no limit cycles to draw: no oscillation begins in the range of {found.parameter}")
    first = found.branches[0]
    declared = type(found.vehicle).declaration
    name = leading_state(first)[0] if state is None else state
    if name not in first.states:
        raise UcritError(
            f"{type(found.vehicle).model_id()}: there is no state '{name}'{near_match(name, first.states)}"
        )
    variable, order = declared.variables[name.rstrip("'")], name.count("'")
    column = first.states.index(name)
    factor, unit = shown(variable.state_unit(order), max(b.amplitudes[:, column].max() for b in found.branches))
    parameter = declared.parameters[found.parameter]
    with style.settings():
        fig = figure or style.new_figure(height=3.4)
        axes = fig.subplots()
        left, right = window(found)
        for low, high, stable in straight(found, left, right):
            axes.plot([low, high], [0, 0], color=style.INK, linewidth=1.9, linestyle="-" if stable else UNSTABLE_DASH)
        for number, branch in enumerate(found.branches):
            for x, y, stable in pieces(branch, factor * branch.amplitudes[:, column]):
                dash = "-" if stable else UNSTABLE_DASH
                axes.plot(x, y, color=style.colour(number), linewidth=1.9, linestyle=dash)
        top = factor * max(b.amplitudes[:, column].max() for b in found.branches)
        axes.set_xlim(left, right)
        axes.set_ylim(-0.03 * top, 1.08 * top)
        axes.set_xlabel(labels.axis_label(parameter.meaning, parameter.name, parameter.unit))
        words = ("amplitude of the " if order == 0 else "amplitude of the rate of the ") + variable.meaning
        *rows, last = textwrap.wrap(words, ROW)
        axes.set_ylabel("\n".join([*map(labels.plain, rows), labels.axis_label(last, name, unit)]))
        style.tidy(axes)
        for branch in found.branches:
            _marks(axes, branch, factor * branch.amplitudes[:, column], (left, right))
        _legend(axes, found)
    return fig


def shown(unit: str, largest: float) -> tuple[float, str]:
    """Return factor and unit for the axis: degrees for angles, millimetres for short lengths."""
    if unit.startswith("rad"):
        return 180 / math.pi, "deg" + unit[3:]
    return (1e3, "mm") if unit == "m" and largest < 0.1 else (1.0, unit)


def window(found: LimitCycles) -> tuple[float, float]:
    """Return the values of the parameter between which the branches are drawn."""
    values = np.concatenate([branch.values for branch in found.branches])
    ends = np.array([values.min(), values.max(), *(b.critical.value for b in found.branches if b.critical)])
    margin = 0.15 * (ends.max() - ends.min()) or 0.1 * abs(ends[0])
    return max(found.lower, float(ends.min() - 1.5 * margin)), min(found.upper, float(ends.max() + margin))


def straight(found: LimitCycles, left: float, right: float) -> Iterator[tuple[float, float, bool]]:
    """Yield the parts of straight running: from, to, whether it is stable."""
    edges = [left, *(c.value for c in found.critical if left < c.value < right), right]
    ranges = found.critical.stable_ranges()
    for low, high in pairwise(edges):
        yield low, high, any(a <= 0.5 * (low + high) <= b for a, b in ranges)


def pieces(branch: CycleBranch, size: Array) -> Iterator[tuple[Array, Array, bool]]:
    """Yield the parts of a branch that are stable throughout or unstable throughout: values, sizes, which it is."""
    x, y, kind = branch.values, size, branch.stable.copy()
    fold = np.array([cycle.fold for cycle in branch.cycles])
    if branch.critical is not None:
        x, y, kind = np.append(branch.critical.value, x), np.append(0.0, y), np.append(kind[:1], kind)
        fold = np.append(False, fold)
    for i in (np.flatnonzero(fold[1:]) + 1).tolist():  # a fold belongs to what comes before it, and ends it
        kind[i] = kind[i - 1]
    start = 0
    for i in range(1, len(x)):
        last = i == len(x) - 1
        if last or kind[i + 1] != kind[i]:
            yield x[start : i + 1], y[start : i + 1], bool(kind[i])
            start = i


def _marks(axes: Any, branch: CycleBranch, size: Array, window: tuple[float, float]) -> None:
    ring = {"marker": "o", "markerfacecolor": style.PAPER, "markeredgecolor": style.INK, "markersize": 6.5}
    unit = branch.unit
    if branch.critical is not None:
        at = branch.critical.value
        axes.plot([at], [0], linestyle="none", markeredgewidth=1.4, zorder=5, clip_on=False, **ring)
        side = -1 if at > 0.5 * sum(window) else 1
        style.label(
            axes,
            labels.quantity(at, unit),
            (at, 0),
            xytext=(side * 6, 7),
            textcoords="offset points",
            ha="left" if side > 0 else "right",
        )
    top = size.max()
    for cycle, height in zip(branch.cycles, size, strict=True):
        if cycle.fold:
            axes.plot([cycle.value], [height], "D", color=style.INK, markersize=4.6, zorder=5)
            if height > 0.03 * top:
                style.label(
                    axes,
                    labels.quantity(cycle.value, unit),
                    (cycle.value, height),
                    xytext=(-7, 0),
                    textcoords="offset points",
                    ha="right",
                    va="center",
                )


def _legend(axes: Any, found: LimitCycles) -> None:
    from matplotlib.lines import Line2D

    unstable = any(not cycle.stable for branch in found.branches for cycle in branch.cycles if not cycle.fold)
    ring: dict[str, Any] = {"marker": "o", "markerfacecolor": style.PAPER, "markeredgecolor": style.INK}
    items = [(Line2D([], [], color=style.colour(0), linewidth=1.9), "stable limit cycle")]
    if unstable:
        items.append((Line2D([], [], color=style.colour(0), linewidth=1.9, linestyle=UNSTABLE_DASH), "unstable one"))
    items.append((Line2D([], [], color=style.INK, linewidth=1.9), "straight running"))
    if any(branch.critical is not None for branch in found.branches):
        items.append((Line2D([], [], linestyle="none", **ring), "critical value"))
    if any(branch.folds for branch in found.branches):
        items.append((Line2D([], [], linestyle="none", marker="D", color=style.INK, markersize=4.6), "fold"))
    lines, texts = zip(*items, strict=True)
    axes.figure.legend(lines, texts, loc="outside lower center", ncols=3, frameon=False, fontsize=8.5, handlelength=2.4)
