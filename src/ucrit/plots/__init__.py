"""One drawing per result. Only this package imports matplotlib, and only when something is drawn.

Every function returns a `matplotlib.figure.Figure` that belongs to no window: notebooks show it, ``savefig``
writes it.
"""

from __future__ import annotations

from .damping import plot_damping
from .dispatch import plot
from .mode_shapes import plot_mode_shapes
from .moment_line import plot_moment_line
from .overview import plot_overview
from .participation import plot_participation
from .remedies import plot_remedies
from .root_locus import plot_locus
from .stability_map import plot_map
from .uncertainty import plot_uncertainty

__all__ = [
    "plot",
    "plot_damping",
    "plot_locus",
    "plot_map",
    "plot_mode_shapes",
    "plot_moment_line",
    "plot_overview",
    "plot_participation",
    "plot_remedies",
    "plot_uncertainty",
]
