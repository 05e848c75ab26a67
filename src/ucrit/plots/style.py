"""One look for all drawings: colours that colour-blind readers tell apart, type sizes, axes without junk.

Every colour is one of the constants below, so that a page can exchange them for its own in dark mode.
"""

from __future__ import annotations

from typing import Any

INK = "#1b1f24"
MUTED = "#5b6471"
GRID = "#d3d8de"
STABLE = "#dbebf6"
UNSTABLE = "#fbe2d3"
PAPER = "#fefefe"
BRANCHES = ("#0072b2", "#d55e00", "#00805e", "#a8478f", "#8a6d00", "#3a8fc0", "#7a5195", "#6b6b6b")
"""After M. Okabe and K. Ito (2008), the pale ones darkened so that thin lines show on white."""

DASHES: tuple[Any, ...] = ("-", (0, (6, 2)), (0, (2, 1.2)), (0, (6, 1.5, 1.5, 1.5)))

WIDTH = 5.2
"""Width of a drawing [in]; shown at this size on a telephone, its 9 pt type stays readable."""

RC = {
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans"],
    "mathtext.fontset": "dejavusans",
    "font.size": 9,
    "axes.unicode_minus": True,
    "svg.fonttype": "path",
    "svg.hashsalt": "ucrit",
    "path.simplify": True,
    "path.simplify_threshold": 0.2,
    "figure.dpi": 100,
    "savefig.dpi": 100,
}

_LOOKS = (
    *("axes", "contour", "figure", "font", "grid", "hatch", "legend", "lines", "mathtext"),
    *("patch", "path", "savefig", "svg", "text", "xtick", "ytick"),
)


def settings() -> Any:
    """Return a context in which figures are made and saved, whatever the user's own settings are."""
    import matplotlib

    defaults = {k: v for k, v in matplotlib.rcParamsDefault.items() if k.partition(".")[0] in _LOOKS}
    return matplotlib.rc_context({**defaults, **RC})


def new_figure(width: float = WIDTH, height: float = 3.6) -> Any:
    """Return an empty figure with a white background that belongs to no window."""
    from matplotlib.figure import Figure

    return Figure(figsize=(width, height), layout="constrained", facecolor="white")


def colour(index: int) -> str:
    """Colour of the branch or mode of this number."""
    return BRANCHES[index % len(BRANCHES)]


def dash(index: int) -> Any:
    """Line style of the branch or mode of this number: a second way to tell it, beside its colour."""
    return DASHES[(index // len(BRANCHES) + index) % len(DASHES)]


def plain_numbers(axis: Any) -> None:
    """Label a logarithmic axis at 1, 2 and 5 times powers of ten, without powers."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    axis.set_major_locator(LogLocator(subs=(1, 2, 5), numticks=7))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_formatter(NullFormatter())


def tidy(axes: Any, grid: bool = True) -> None:
    """Take away the box, set quiet ticks and a quiet grid under the data."""
    axes.set_facecolor("none")
    axes.set_axisbelow(True)
    for side, spine in axes.spines.items():
        spine.set_visible(side in ("left", "bottom"))
        spine.set_color(MUTED)
        spine.set_linewidth(0.8)
    axes.tick_params(colors=MUTED, labelcolor=INK, width=0.8, length=3, labelsize=8.5)
    axes.xaxis.label.set_color(INK)
    axes.yaxis.label.set_color(INK)
    if grid:
        axes.grid(True, color=GRID, linewidth=0.6)


def halo() -> list[Any]:
    """Return an outline in the paper's colour that keeps a label readable on top of lines."""
    from matplotlib.patheffects import withStroke

    return [withStroke(linewidth=2.6, foreground=PAPER)]


def label(axes: Any, text: str, at: tuple[float, float], **options: Any) -> Any:
    """Write a small label into the axes, in data coordinates unless told otherwise."""
    chosen = {
        "color": INK,
        "fontsize": 8.5,
        "path_effects": halo(),
        "zorder": 6,
        "xycoords": "data",
        **options,
    }
    return axes.annotate(text, at, **chosen)
