"""One drawing per result. Only this package imports matplotlib, and only when something is drawn.

Every function returns a `matplotlib.figure.Figure` that belongs to no window: notebooks show it, ``savefig``
writes it.
"""

from __future__ import annotations

from .animation import animate, draw_frame
from .bond_graph import plot_bond_graph
from .boundary import plot_boundary
from .cycles import plot_cycles
from .damping import plot_damping
from .dispatch import plot
from .family import plot_family
from .handling import plot_handling
from .margins import plot_margins
from .mode_shapes import plot_mode_shapes
from .moment_line import plot_moment_line
from .motion import plot_simulation
from .overview import plot_overview
from .participation import plot_participation
from .remedies import plot_remedies
from .response import plot_frequency_response, plot_time_response
from .root_locus import plot_locus
from .stability_map import plot_map
from .tire import plot_tire
from .uncertainty import plot_uncertainty

__all__ = [
    "animate",
    "draw_frame",
    "plot",
    "plot_bond_graph",
    "plot_boundary",
    "plot_cycles",
    "plot_damping",
    "plot_family",
    "plot_frequency_response",
    "plot_handling",
    "plot_locus",
    "plot_map",
    "plot_margins",
    "plot_mode_shapes",
    "plot_moment_line",
    "plot_overview",
    "plot_participation",
    "plot_remedies",
    "plot_simulation",
    "plot_time_response",
    "plot_tire",
    "plot_uncertainty",
]
