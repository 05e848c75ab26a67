"""Damping and frequency of every mode against one parameter, usually the speed."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import labels, style
from .branches import Branch, marks, parameter, upper

if TYPE_CHECKING:
    from ..analyses.stability.critical import CriticalValues
    from ..analyses.stability.locus import Locus

Array = npt.NDArray[Any]

LABEL = 0.85
"""Room that the label of a marked value takes [in]; one that is nearer to the next goes above it."""


def plot_damping(locus: Locus, *, critical: CriticalValues | None = None, figure: Any = None) -> Any:
    """Draw how damping and frequency of the modes depend on the parameter.

    The upper half shows the damping ratio, negative where a motion grows; or, where a motion that does not
    oscillate becomes unstable, the growth rate (real part): such a motion's damping ratio, 1 or -1, tells
    nothing. Stable ranges are shaded where critical values are given.

    Parameters
    ----------
    locus
        `ucrit.locus(vehicle)`.
    critical
        Critical values of the same parameter.
    figure
        Figure to draw into; a new one by default.

    Returns
    -------
    matplotlib.figure.Figure
    """
    where = locus.values
    declared = parameter(locus)
    branches = upper(locus)
    oscillating = [b for b in branches if (np.nan_to_num(b.values.imag) > 0).any()]
    growth = not oscillating or not all(_told_by_ratio(branch) for branch in branches)
    with style.settings():
        fig = figure or style.new_figure(height=4.3 if oscillating else 3.4)
        ratios = {"height_ratios": [1.35, 1]}
        axes = fig.subplots(2, 1, sharex=True, gridspec_kw=ratios) if oscillating else [fig.subplots()]
        _rates(axes[0], branches, where, growth)
        if oscillating:
            _frequencies(axes[1], oscillating, where)
        for panel in axes:
            _ranges(panel, critical, where)
            panel.set_xlim(where[0], where[-1])
            style.tidy(panel)
        _lines(axes, locus, critical, where)
        axes[-1].set_xlabel(labels.axis_label(declared.meaning, locus.parameter, declared.unit))
        _legend(fig, branches, critical is not None and bool(critical.stable_ranges()))
    return fig


def _told_by_ratio(branch: Branch) -> bool:
    """Whether the damping ratio says how stable a branch is: it oscillates wherever it is unstable."""
    values = branch.values[~np.isnan(branch.values)]
    return bool((values.imag[values.real > 1e-9 * np.abs(values).max()] > 0).all())


def _rates(axes: Any, branches: Sequence[Branch], where: Array, growth: bool) -> None:
    tops, bottoms = [], []
    later = np.abs(where) >= 0.3 * np.abs(where).max()
    for branch in branches:
        size = np.abs(branch.values)
        ratio = np.divide(-branch.values.real, size, out=np.full(size.shape, np.nan), where=size > 0)
        y = branch.values.real if growth else ratio
        axes.plot(
            where,
            y,
            color=style.colour(branch.index),
            linestyle=style.dash(branch.index),
            linewidth=1.9,
            gid=f"rate-{branch.index}",
        )
        seen = y[later][~np.isnan(y[later])]
        if seen.size:
            tops.append(float(seen.max()))
            bottoms.append(float(seen.min()))
    axes.axhline(0, color=style.INK, linewidth=0.9)
    if growth:
        axes.set_ylabel("growth rate [1/s]")
        top, bottom = max([*tops, 0.0]), min([*bottoms, 0.0])
        nearest = [b for b in bottoms if b > bottom / 8]
        bottom = min([*nearest, 0.0]) if nearest and top > 0 else bottom
        margin = 0.1 * (top - bottom) or 1.0
        axes.set_ylim(bottom - margin, top + margin)
    else:
        axes.set_ylabel("damping ratio [1]")
        axes.set_ylim(
            max(-1.08, min([-0.15, *(b - 0.1 for b in bottoms)])),
            1.08 if max(tops, default=1) > 0.6 else max(tops) + 0.12,
        )


def _frequencies(axes: Any, branches: Sequence[Branch], where: Array) -> None:
    for branch in branches:
        hertz = branch.values.imag / (2 * math.pi)
        apart = np.where((np.nan_to_num(hertz) > 0) | _beside(np.nan_to_num(hertz) > 0), hertz, np.nan)
        axes.plot(
            where,
            apart,
            color=style.colour(branch.index),
            linestyle=style.dash(branch.index),
            linewidth=1.9,
            gid=f"frequency-{branch.index}",
        )
    later = np.abs(where) >= 0.1 * np.abs(where).max()
    highest = [float(np.nanmax(np.nan_to_num(b.values.imag[later]))) / (2 * math.pi) for b in branches]
    axes.set_ylim(0, 1.12 * max(highest) or 1)
    axes.set_ylabel("frequency [Hz]")


def _beside(flags: Array) -> Array:
    """Points next to a flagged one, so that a frequency is drawn down to where it vanishes."""
    wider = flags.copy()
    wider[1:] |= flags[:-1]
    wider[:-1] |= flags[1:]
    return wider


def _ranges(axes: Any, critical: CriticalValues | None, where: Array) -> None:
    for low, high in critical.stable_ranges() if critical is not None else ():
        a, b = max(low, where[0]), min(high, where[-1])
        if a < b:
            axes.axvspan(a, b, color=style.STABLE, linewidth=0, zorder=0, gid="stable")


def _lines(axes: Any, locus: Locus, critical: CriticalValues | None, where: Array) -> None:
    """Mark the critical values and the vehicle's own value in all panels, and name them above the first."""
    design = float(locus.vehicle.values[locus.parameter])
    unit = parameter(locus).unit
    named = [(c.value, f"{labels.quantity(c.value, c.unit)}\n{c.kind}", "-") for c in marks(critical, where)]
    if where[0] <= design <= where[-1]:
        named.append((design, f"{labels.quantity(design, unit)}\nthis vehicle", ":"))
    span, level, last = where[-1] - where[0], 0, -math.inf
    near = span * LABEL / (0.86 * axes[0].figure.bbox.width / axes[0].figure.dpi)
    for value, text, dash in sorted(named):
        for panel in axes:
            panel.axvline(value, color=style.INK, linewidth=1.1, linestyle=dash, zorder=3)
        level = level + 1 if value - last < near else 0
        last = value
        axes[0].annotate(
            text,
            (value, 1),
            xycoords=("data", "axes fraction"),
            xytext=(0, 3 + 22 * (level % 3)),
            fontsize=8,
            textcoords="offset points",
            ha="center",
            va="bottom",
            color=style.INK,
            annotation_clip=False,
        )


def _legend(fig: Any, branches: Sequence[Branch], shaded: bool) -> None:
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    named = {b.name: b for b in branches}
    entries: list[Any] = [
        Line2D(
            [],
            [],
            color=style.colour(b.index),
            linestyle=style.dash(b.index),
            linewidth=1.9,
            label=labels.plain(b.name),
        )
        for b in sorted(named.values(), key=lambda b: b.index)
    ]
    if shaded:
        entries.append(Patch(facecolor=style.STABLE, label="stable"))
    fig.legend(
        handles=entries,
        loc="outside lower center",
        ncols=2,
        frameon=False,
        fontsize=8.5,
        handlelength=2.6,
        columnspacing=1.6,
        labelcolor=style.INK,
    )
