"""Axes and signs as in the trailer. SI units and radians."""

from .trailer import Trailer


class TrailerUndampedHitch(Trailer):
    """Trailer on a laterally flexible hitch without damping (Karnopp 2004, section 5.III)."""

    c = 0.0
