"""Root locus: the eigenvalues' paths in the complex plane as one parameter varies."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import labels, style
from .branches import Branch, at, marks, parameter, upper, view
from .placing import Labels

if TYPE_CHECKING:
    from ..analyses.stability.critical import Critical, CriticalValues
    from ..analyses.stability.locus import Locus

Array = npt.NDArray[Any]

QUIET: dict[str, Any] = {"fontsize": 8.5, "color": style.MUTED}


def plot_locus(locus: Locus, *, critical: CriticalValues | None = None, figure: Any = None) -> Any:
    """Draw the upper half of the complex plane with the path of every eigenvalue.

    Dots along the paths are round values of the parameter, arrows show where its size grows, diamonds are the
    vehicle as it is, rings the critical values. The unstable half plane is shaded.

    Parameters
    ----------
    locus
        `ucrit.locus(vehicle)`.
    critical
        Critical values of the same parameter, to be marked.
    figure
        Figure to draw into; a new one by default.

    Returns
    -------
    matplotlib.figure.Figure
    """
    where = locus.values
    declared = parameter(locus)
    branches = upper(locus)
    design = float(locus.vehicle.values[locus.parameter])
    crossings = list(marks(critical, where))
    with style.settings():
        flat = not any((np.nan_to_num(branch.values.imag) > 0).any() for branch in branches)
        fig = figure or style.new_figure(height=2.7 if flat else 4.3)
        axes = fig.subplots()
        box = view(branches, where, [v for v in (design, *(c.value for c in crossings)) if _within(where, v)])
        _frame(axes, box)
        for branch in branches:
            _path(axes, branch, where, box)
        room = Labels(axes, _room(fig), _obstacles(branches, box))
        for c in crossings:
            _crossing(axes, branches, where, c, room)
        points = [at(branch, where, design) for branch in branches]
        inside = [p for p in points if not np.isnan(p)]
        if any(p.real < box[0] for p in inside):
            axes.text(0.01, 0.985, "more roots farther left", transform=axes.transAxes, va="top", **QUIET)
        if inside:
            axes.plot(
                [p.real for p in inside],
                [p.imag for p in inside],
                "D",
                color=style.INK,
                markersize=5.5,
                zorder=7,
                gid="design",
                linestyle="none",
            )
        _dots(axes, branches, where, box, room)
        name, unit = labels.math_symbol(locus.parameter), declared.unit
        shown = f"{name} = {labels.quantity(design, unit)}"
        _legend(fig, axes, branches, shown, f"round values of {name}" + _bracketed(unit), bool(crossings))
    return fig


def _within(where: Array, value: float) -> bool:
    return bool(where[0] <= value <= where[-1])


def _bracketed(unit: str) -> str:
    inside = labels.unit_text(unit)
    return f" [{inside}]" if inside else ""


def _frame(axes: Any, box: tuple[float, float, float]) -> None:
    left, right, top = box
    axes.set_xlim(left, right)
    axes.set_ylim(-0.04 * top, top)
    axes.axvspan(0, right, color=style.UNSTABLE, linewidth=0, zorder=0)
    axes.axvline(0, color=style.MUTED, linewidth=1.0, zorder=1)
    axes.axhline(0, color=style.MUTED, linewidth=0.8, zorder=1)
    axes.text(
        0.995,
        0.985,
        "unstable",
        transform=axes.transAxes,
        ha="right",
        va="top",
        fontsize=8.5,
        color=style.MUTED,
    )
    axes.set_xlabel("real part [1/s]")
    axes.set_ylabel("imaginary part [rad/s]")
    style.tidy(axes)


def _path(axes: Any, branch: Branch, where: Array, box: tuple[float, float, float]) -> None:
    colour = style.colour(branch.index)
    axes.plot(
        branch.values.real,
        branch.values.imag,
        color=colour,
        linestyle=style.dash(branch.index),
        linewidth=1.9,
        zorder=4,
        gid=f"branch-{branch.index}",
    )
    left, right, top = box
    scaled = branch.values.real / (right - left) + 1j * branch.values.imag / top
    visible = (branch.values.real > left) & (branch.values.real < right) & (branch.values.imag < top)
    steps = np.where(visible[1:] & visible[:-1], np.abs(np.diff(scaled)), 0.0)
    total = steps.sum()
    if total < 0.06:
        return
    i = int(np.searchsorted(np.cumsum(steps), 0.55 * total))
    tail, tip = branch.values[i], branch.values[i + 1]
    if abs(where[i + 1]) < abs(where[i]):
        tail, tip = tip, tail
    axes.annotate(
        "",
        (tip.real, tip.imag),
        (tail.real, tail.imag),
        zorder=5,
        arrowprops={"arrowstyle": "-|>", "color": colour, "mutation_scale": 13, "shrinkA": 0, "shrinkB": 0},
    )


def _room(fig: Any) -> tuple[float, float]:
    """Approximate size of the axes [pt]; labels and legend take the rest of the figure."""
    box = fig.bbox
    scale = 72 / fig.dpi
    return 0.86 * box.width * scale, 0.66 * box.height * scale


def _obstacles(branches: Sequence[Branch], box: tuple[float, float, float]) -> Array:
    """Points along all branches inside the view, close enough that no label slips between two."""
    left, right, top = box
    found = []
    for branch in branches:
        values = branch.values[~np.isnan(branch.values)]
        spread = np.abs(np.diff(values.real)) / (right - left) + np.abs(np.diff(values.imag)) / top
        length = np.concatenate([[0.0], np.cumsum(spread)])
        fine = np.linspace(0, length[-1], 1 + int(min(100 * length[-1], 2000)))
        found.append(np.column_stack([np.interp(fine, length, values.real), np.interp(fine, length, values.imag)]))
    return np.concatenate(found)


def _dots(axes: Any, branches: Sequence[Branch], where: Array, box: tuple[float, float, float], room: Labels) -> None:
    """Mark round values of the parameter on all branches, and number them where there is room."""
    from matplotlib.ticker import MaxNLocator

    left, right, top = box
    ticks = [t for t in MaxNLocator(6, steps=[1, 2, 5, 10]).tick_values(where[0], where[-1]) if _within(where, t) and t]
    for branch in branches:
        for tick in ticks:
            p = at(branch, where, tick)
            if np.isnan(p) or not (left < p.real < right and p.imag < top):
                continue
            axes.plot([p.real], [p.imag], "o", color=style.colour(branch.index), markersize=3.6, zorder=5)
            room.add(labels.number(tick, 3), (p.real, p.imag), font=7.5, must=False, color=style.MUTED)


def _crossing(axes: Any, branches: Sequence[Branch], where: Array, c: Critical, room: Labels) -> None:
    """Ring the root that lies on the imaginary axis at a critical value."""
    roots = [at(branch, where, c.value) for branch in branches]
    near = [p for p in roots if not np.isnan(p) and p != 0]
    if not near:
        return
    height = 2 * np.pi * c.frequency_hz if c.kind == "flutter" else min(near, key=lambda p: abs(p.real)).imag
    axes.plot(
        [0],
        [height],
        "o",
        markersize=9,
        markerfacecolor="none",
        markeredgecolor=style.INK,
        markeredgewidth=1.5,
        zorder=7,
        gid="critical",
    )
    room.add(f"{labels.quantity(c.value, c.unit)}\n{c.kind}", (0, height), font=8, gap=6)


def _legend(fig: Any, axes: Any, branches: Sequence[Branch], design: str, dots: str, crossings: bool) -> None:
    from matplotlib.lines import Line2D

    named = {b.name: b for b in reversed(branches)}
    entries = [
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
    entries.append(Line2D([], [], color=style.INK, marker="D", markersize=5, linestyle="none", label=design))
    if crossings:
        entries.append(
            Line2D(
                [],
                [],
                color=style.INK,
                marker="o",
                markerfacecolor="none",
                markersize=7,
                linestyle="none",
                label="critical",
            )
        )
    entries.append(Line2D([], [], color=style.MUTED, marker="o", markersize=3.6, linestyle="none", label=dots))
    legend = fig.legend(
        handles=entries,
        loc="outside lower center",
        ncols=2,
        frameon=False,
        fontsize=8.5,
        handlelength=2.6,
        columnspacing=1.6,
        labelcolor=style.INK,
    )
    legend.set_in_layout(True)
