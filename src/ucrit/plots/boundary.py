"""Where stability changes: curves over two parameters, a surface over three."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.errors import UcritError
from . import labels, style
from .stability_map import fill

if TYPE_CHECKING:
    from ..analyses.regions.boundary_result import StabilityBoundary

LIGHT = np.array([-0.36, -0.48, 0.8])
"""Where the light on surfaces comes from, as a unit vector of shares of the ranges."""

DASHES = {"flutter": "-", "divergence": "--", "order": ":"}


def plot_boundary(result: StabilityBoundary, *, figure: Any = None) -> Any:
    """Draw the boundary over its parameters, flutter and divergence by different lines, and mark the vehicle.

    Parameters
    ----------
    result
        What `ucrit.boundary` returned.
    figure
        Figure to draw into; a new one by default.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    UcritError
        If stability does not change in these ranges.
    """
    if not len(result.points):
        raise UcritError(f"stability does not change over {', '.join(result.parameters)}: there is no boundary to draw")
    with style.settings():
        fig = figure or style.new_figure(height=4.0)
        axes = fig.subplots() if len(result.parameters) == 2 else fig.add_subplot(projection="3d")
        (_curves if len(result.parameters) == 2 else _surface)(axes, result)
        declared = type(result.vehicle).declaration.parameters
        now = [float(result.vehicle.values[name]) for name in result.parameters]
        inside = bool(np.all((result.lower <= now) & (now <= result.upper)))
        if result.sides is not None:
            grid = tuple(np.asarray(result.sides.coords[name]) for name in result.parameters)
            fill(axes, (grid[0], grid[1]), result.sides.stable.T, (now[0], now[1]) if inside else None)
        if inside:
            axes.plot(*([x] for x in now), "D", color=style.INK, markersize=6.5, zorder=6, gid="design")
        for axis, name, lo, hi, log in zip(
            "xyz", result.parameters, result.lower, result.upper, result.log, strict=False
        ):
            getattr(axes, f"set_{axis}lim")(lo, hi)
            if log:
                getattr(axes, f"set_{axis}scale")("log")
            parameter = declared[name]
            meaning = parameter.meaning.partition(",")[0] if len(result.parameters) == 2 else ""
            text = labels.axis_label(meaning, name, parameter.unit).strip()
            getattr(axes, f"set_{axis}label")(text)
        axes.legend(loc="upper left")
        if len(result.parameters) == 2:
            style.tidy(axes, grid=False)
    return fig


def _curves(axes: Any, result: StabilityBoundary) -> None:
    """Draw each line in runs of one kind; a point where the kind changes belongs to both."""
    named: set[str] = set()
    begin = 0
    for line in result.lines:
        own = result.kinds[begin : begin + np.count_nonzero(result.line == result.line[begin])]
        begin += own.size
        kinds = np.append(own, own[: len(line) - own.size])
        edges = [0, *(np.flatnonzero(kinds[1:] != kinds[:-1]) + 1), len(line)]
        for first, last in pairwise(edges):
            kind = str(kinds[first])
            text = None if kind in named else kind
            named.add(kind)
            run = line[max(first - 1, 0) : last]
            axes.plot(*run.T, DASHES[kind], color=style.INK, linewidth=1.4, label=text, zorder=3)


def _surface(axes: Any, result: StabilityBoundary) -> None:
    """Draw triangles, those that face the light brighter."""
    from matplotlib.colors import to_rgb
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    shares = (result.points - result.lower) / (result.upper - result.lower)
    for kind in np.unique(result.kinds):
        part = result.pieces[(result.kinds[result.pieces] == kind).any(axis=1)]
        a, b, c = (shares[part[:, k]] for k in range(3))
        normal = np.cross(b - a, c - a)
        length = np.linalg.norm(normal, axis=1)
        bright = 0.6 + 0.4 * np.abs(normal @ LIGHT) / np.where(length > 0, length, 1)
        colours = bright[:, None] * np.array(to_rgb(style.STABLE if kind == "flutter" else style.UNSTABLE))
        faces = Poly3DCollection(
            result.points[part], facecolors=colours, edgecolors=colours, linewidths=0.3, label=str(kind)
        )
        axes.add_collection3d(faces)
