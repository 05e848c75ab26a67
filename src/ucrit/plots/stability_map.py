"""Stability over two parameters: which combinations are stable, and where the vehicle lies."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ..core.errors import UcritError
from . import labels, style

if TYPE_CHECKING:
    from ..analyses.regions.stability_map import StabilityMap
    from ..core.contract.declare import Parameter
    from ..core.contract.model import Model

Array = npt.NDArray[Any]
Point = tuple[float, float]

MOST = 1000
"""Values of an axis above which only some are drawn: a picture has no more columns."""

DAMPING = (0.02, 0.05, 0.1, 0.2, 0.4)
"""Least damping ratios at which lines are drawn where they are known."""


def plot_map(result: StabilityMap, *, vehicle: Model | None = None, figure: Any = None) -> Any:
    """Draw the stable and the unstable region of two parameters, the boundary, and the vehicle as it is.

    Parameters
    ----------
    result
        `ucrit.stability_map(vehicle, ...)` over two parameters; the first one goes to the right. With margins, lines
        of equal least damping ratio zeta are drawn too.
    vehicle
        The vehicle as it is, to be marked.
    figure
        Figure to draw into; a new one by default.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    UcritError
        If the map does not have two dimensions, both of them parameters, or one of them has a single value.
    """
    names = tuple(result.coords)
    declared = type(result.vehicle).declaration.parameters
    if len(names) != 2 or any(name not in declared for name in names):
        raise UcritError(f"a map is drawn over two parameters, this one spans {', '.join(names) or 'none'}")
    taken = [_some(name, np.asarray(result.coords[name])) for name in names]
    x, y = (np.asarray(result.coords[name], dtype=float)[i] for name, i in zip(names, taken, strict=True))
    stable = np.asarray(result.stable, dtype=bool)[np.ix_(*taken)].T
    height = _height(stable, None if result.growth is None else np.asarray(result.growth)[np.ix_(*taken)].T)
    point = None if vehicle is None else _point(vehicle, names, (x, y))
    with style.settings():
        fig = figure or style.new_figure(height=4.0)
        axes = fig.subplots()
        for axis, values in (("x", x), ("y", y)):
            if _ratios(values):
                getattr(axes, f"set_{axis}scale")("log")
        fill(axes, (x, y), stable, point, height)
        if stable.any() and not stable.all():
            axes.contour(x, y, height, levels=[0], colors=[style.INK], linewidths=1.4, zorder=3)
        if result.damping is not None:
            lines = axes.contour(x, y, result.damping[np.ix_(*taken)].T, DAMPING, colors=[style.MUTED], linewidths=0.8)
            axes.clabel(lines, fontsize=8, fmt=lambda ratio: f"$\\zeta$ = {ratio:g}")
        if point is not None:
            _design(axes, point, (x, y), stable)
        axes.set_xlim(x.min(), x.max())
        axes.set_ylim(y.min(), y.max())
        axes.set_xlabel(_axis(declared[names[0]]))
        axes.set_ylabel(_axis(declared[names[1]]))
        style.tidy(axes, grid=False)
    return fig


def _some(name: str, values: Array) -> Array:
    """Positions of the values that are drawn, rising, the least and the greatest among them."""
    rising = np.unique(values, return_index=True)[1]
    if rising.size < 2:
        raise UcritError(f"a map is drawn over ranges, but {name} is {float(values[0]):g} all over it")
    return np.asarray(rising[np.linspace(0, rising.size - 1, min(rising.size, MOST)).round().astype(int)])


def _height(stable: Array, growth: Array | None) -> Array:
    """Return what is above zero where a vehicle is stable: its decay, which bends smoothly, if that says the same."""
    if growth is None or not np.isfinite(growth).all() or ((growth < 0) != stable).any():
        return stable - 0.5
    return -growth


def fill(axes: Any, grid: tuple[Array, Array], stable: Array, point: Point | None, height: Array | None = None) -> None:
    """Colour stable and unstable regions, and name them; ``height`` is above zero where stable."""
    height = _height(stable, None) if height is None else height
    ends = [min(height.min(), 0) - 1, 0, max(height.max(), 0) + 1]
    axes.contourf(*grid, height, levels=ends, colors=[style.UNSTABLE, style.STABLE], zorder=0)
    for flags, word in ((stable, "stable"), (~stable, "unstable")):
        _name(axes, flags, grid, word, point)


def _axis(declared: Parameter) -> str:
    """Label an axis with the parameter's meaning, up to the first comma: the rest is a remark."""
    return labels.axis_label(declared.meaning.partition(",")[0], declared.name, declared.unit)


def _ratios(values: Array) -> bool:
    """Whether values rise by equal ratios."""
    if values.size < 3 or values.min() <= 0:
        return False
    steps = values[1:] / values[:-1]
    return bool(np.ptp(steps) < 1e-6 * steps[0] and not np.isclose(steps[0], 1, atol=1e-9))


def _name(axes: Any, flags: Array, grid: tuple[Array, Array], word: str, point: Point | None) -> None:
    """Write a region's name where it is widest, away from the vehicle."""
    if flags.mean() < 0.02:
        return
    x, y = grid
    row, column = _deepest(flags, None if point is None else _cell(point, grid))
    looks = {"ha": "center", "va": "center", "fontsize": 10.5, "color": style.INK, "zorder": 4}
    ground = {"facecolor": style.STABLE if word == "stable" else style.UNSTABLE, "edgecolor": "none", "pad": 1.5}
    axes.text(x[column], y[row], word, bbox=ground, **looks)


def _deepest(flags: Array, avoid: tuple[int, int] | None) -> tuple[int, int]:
    """Cell of a region farthest from its border, the map's and one cell more, on a coarse copy of it."""
    rows = np.linspace(0, flags.shape[0] - 1, 27).astype(int)
    columns = np.linspace(0, flags.shape[1] - 1, 27).astype(int)
    coarse = np.pad(flags[np.ix_(rows, columns)][1:-1, 1:-1], 1)
    if avoid is not None:
        coarse[np.abs(rows - avoid[0]).argmin(), np.abs(columns - avoid[1]).argmin()] = False
    inside, outside = np.argwhere(coarse), np.argwhere(~coarse)
    if not len(inside):
        row, column = np.argwhere(flags)[0]
        return int(row), int(column)
    wide = np.array([1.0, 1.6])
    gaps = np.linalg.norm((inside[:, None] - outside[None]) * wide, axis=2).min(axis=1)
    row, column = inside[int(np.argmax(np.round(gaps, 6)))]
    return int(rows[row]), int(columns[column])


def _point(vehicle: Model, names: tuple[str, ...], grid: tuple[Array, Array]) -> Point | None:
    """The vehicle's place on the map; ``None`` where it lies outside."""
    across, up = (float(vehicle.values[name]) for name in names)
    x, y = grid
    inside = x.min() <= across <= x.max() and y.min() <= up <= y.max()
    return (across, up) if inside else None


def _cell(point: Point, grid: tuple[Array, Array]) -> tuple[int, int]:
    """Row and column of the cell nearest to a point."""
    return int(np.abs(grid[1] - point[1]).argmin()), int(np.abs(grid[0] - point[0]).argmin())


def _design(axes: Any, point: Point, grid: tuple[Array, Array], stable: Array) -> None:
    """Mark the vehicle, its name on the side that lies in the same region."""
    axes.plot([point[0]], [point[1]], "D", color=style.INK, markersize=6.5, zorder=6, gid="design")
    row, column = _cell(point, grid)
    reach = max(1, stable.shape[0] // 12)
    above = bool(stable[min(row + reach, stable.shape[0] - 1), column] == stable[row, column])
    right = column > 0.75 * stable.shape[1]
    style.label(
        axes,
        "this vehicle",
        point,
        xytext=(-9 if right else 9, 7 if above else -13),
        textcoords="offset points",
        ha="right" if right else "left",
    )
