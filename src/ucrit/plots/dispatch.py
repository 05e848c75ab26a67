"""The right drawing for a result."""

from __future__ import annotations

from typing import Any

from ..core.errors import UcritError
from .mode_shapes import plot_mode_shapes
from .moment_line import plot_moment_line
from .overview import plot_overview
from .remedies import plot_remedies
from .stability_map import plot_map
from .uncertainty import plot_uncertainty


def plot(result: Any, *, figure: Any = None) -> Any:
    """Draw a result: an analysis, a root locus, modes, remedies, a stability map, uncertainty, lines of moment.

    Parameters
    ----------
    result
        What `ucrit.analyze`, `locus`, `modes`, `remedies`, `stability_map`, `uncertainty` or `moment_line` returned.
        Of an analysis the root locus and the damping against speed are drawn, of a vehicle without speed its modes.
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
    from ..analyses.analyze import Analysis
    from ..analyses.locus import Locus
    from ..analyses.modes import Modes
    from ..analyses.pitching import MomentLine
    from ..analyses.remedies import Remedy
    from ..analyses.stability_map import StabilityMap
    from ..analyses.uncertainty import Uncertainty

    if isinstance(result, Analysis):
        return _analysis(result, figure)
    if isinstance(result, Locus):
        return plot_overview(result, critical=_critical(result), figure=figure)
    if isinstance(result, Modes):
        return plot_mode_shapes(result.list(), result.vehicle, figure=figure)
    if isinstance(result, StabilityMap):
        return plot_map(result, figure=figure)
    if isinstance(result, MomentLine):
        return plot_moment_line(result, figure=figure)
    if isinstance(result, Uncertainty):
        return plot_uncertainty(result, figure=figure)
    if isinstance(result, tuple) and result and all(isinstance(item, Remedy) for item in result):
        return plot_remedies(result, figure=figure)
    raise UcritError(
        f"there is no drawing for {type(result).__name__}; "
        "drawn are the results of analyze, locus, modes, remedies, stability_map, uncertainty and moment_line"
    )


def _analysis(result: Any, figure: Any) -> Any:
    from ..analyses.locus import locus

    if result.critical is None:
        return plot_mode_shapes(result.modes, result.vehicle, figure=figure)
    return plot_overview(locus(result.vehicle), critical=result.critical, figure=figure)


def _critical(path: Any) -> Any:
    from ..analyses.critical import critical

    return critical(path.vehicle, path.parameter)
