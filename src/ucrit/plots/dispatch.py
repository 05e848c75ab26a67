"""The right drawing for a result."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from ..core.errors import UcritError
from .bond_graph import plot_bond_graph
from .boundary import plot_boundary
from .cycles import plot_cycles
from .family import plot_family
from .handling import plot_handling
from .margins import plot_margins
from .mode_shapes import plot_mode_shapes
from .moment_line import plot_moment_line
from .motion import plot_simulation
from .overview import plot_overview
from .remedies import plot_remedies
from .response import plot_frequency_response, plot_time_response
from .stability_map import plot_map
from .tire import plot_tire
from .uncertainty import plot_uncertainty

if TYPE_CHECKING:
    from matplotlib.figure import FigureBase


def _analysis(result: Any, *, figure: Any) -> Any:
    from ..analyses.stability.locus import locus

    if result.critical is None:
        return plot_mode_shapes(result.modes, result.vehicle, figure=figure)
    return plot_overview(locus(result.vehicle), critical=result.critical, figure=figure)


def _locus(path: Any, *, figure: Any) -> Any:
    from ..analyses.stability.critical import critical

    return plot_overview(path, critical=critical(path.vehicle, path.parameter), figure=figure)


def _modes(found: Any, *, figure: Any) -> Any:
    return plot_mode_shapes(found.list(), found.vehicle, figure=figure)


def _bonds(found: Any, *, figure: Any) -> Any:
    return plot_bond_graph(found.causality, figure=figure)


DRAWN: dict[str, tuple[str, Callable[..., Any]]] = {
    "Bonds": ("bonds", _bonds),
    "Handling": ("handling_diagram", plot_handling),
    "SteadyFamily": ("steady_family", plot_family),
    "LimitCycles": ("limit_cycles", plot_cycles),
    "Analysis": ("analyze", _analysis),
    "FrequencyResponse": ("frequency_response", plot_frequency_response),
    "TimeResponse": ("step_response", plot_time_response),
    "Locus": ("locus", _locus),
    "Margins": ("margins", plot_margins),
    "Modes": ("modes", _modes),
    "MomentLine": ("moment_line", plot_moment_line),
    "Remedy": ("remedies", plot_remedies),
    "Simulation": ("simulate", plot_simulation),
    "StabilityBoundary": ("boundary", plot_boundary),
    "StabilityMap": ("stability_map", plot_map),
    "TireCurves": ("tire_curves", plot_tire),
    "Uncertainty": ("uncertainty", plot_uncertainty),
}
"""By the name of a result's class: what returns such results, and what draws them."""


def plot(result: Any, *, figure: FigureBase | None = None) -> Any:
    """Draw a result.

    Parameters
    ----------
    result
        What one of the functions named in ``plots.dispatch.DRAWN`` returned. Of an analysis the root locus and the
        damping against speed are drawn, of a vehicle without speed its modes.
    figure
        Figure to draw into; a new one by default.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    UcritError
        If there is no drawing for such a result, or nothing in it to draw.

    Examples
    --------
    >>> from ucrit import analyze, plot
    >>> len(plot(analyze("caravan")).subfigs)
    2
    """
    kinds = {type(item) for item in result} if isinstance(result, tuple) else {type(result)}
    kind = kinds.pop() if len(kinds) == 1 else type(result)
    if kind.__name__ not in DRAWN or not kind.__module__.startswith("ucrit."):
        *names, last = (name for name, _ in DRAWN.values())
        raise UcritError(
            f"there is no drawing for {type(result).__name__}; drawn are the results of {', '.join(names)} and {last}"
        )
    return DRAWN[kind.__name__][1](result, figure=figure)
