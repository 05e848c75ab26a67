"""Algorithms over arrays and polynomials that know no model and no vehicle.

Coefficients of polynomials are in ascending powers everywhere, ``a[0] + a[1] s + ... + a[n] s^n``.
"""

from .determinants import determinant, hurwitz_determinants, hurwitz_matrix, hurwitz_polynomial
from .hurwitz import right_half_plane, stable
from .real_roots import isolate, real_roots, refine
from .routh import RouthArray, routh
from .tracking import Tracked, refine_where, track, track_adaptive

__all__ = [
    "RouthArray",
    "Tracked",
    "determinant",
    "hurwitz_determinants",
    "hurwitz_matrix",
    "hurwitz_polynomial",
    "isolate",
    "real_roots",
    "refine",
    "refine_where",
    "right_half_plane",
    "routh",
    "stable",
    "track",
    "track_adaptive",
]
