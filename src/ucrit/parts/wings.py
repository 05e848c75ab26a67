"""Wings and wing sections: lift, drag and moment, and what can be told from the shape of a wing alone.

Angles of attack are measured from the direction of zero lift, moments are positive nose up, distances along the
chord count from the leading edge to the rear in chords. SI units and radians.
"""

from __future__ import annotations

import math
from typing import Any

from ..core.formulas.functions import atan, cos, sin, tanh


def angle_of_attack(forward: Any, downward: Any) -> Any:
    """Return the angle [rad] at which air meets a wing that moves with two velocity components [m/s]."""
    return atan(downward / forward)


def lift_slope(A: Any) -> Any:
    """Return the slope of the lift coefficient [1/rad] of an elliptical wing of aspect ratio A.

    ``2 pi A/(A + 2)``, a section's slope 2 pi for a long wing (Karnopp 2004, eq. 9.26).

    >>> round(lift_slope(6.0) / (2 * math.pi), 6)
    0.75
    """
    return 2 * math.pi * A / (A + 2)


def downwash_slope(a: Any, A: Any) -> Any:
    """Return the change of the downwash angle at the tail with angle of attack, ``2 a/(pi A)``.

    For an elliptical wing of lift slope a and aspect ratio A, far behind it (Karnopp 2004, section 9.III.A).

    >>> round(downwash_slope(lift_slope(6.0), 6.0), 6)
    0.5
    """
    return 2 * a / (math.pi * A)


def induced_drag(C_L: Any, A: Any, e: Any = 1) -> Any:
    """Return the drag coefficient that lift brings about, ``C_L^2/(pi A e)``; e is 1 for an elliptical wing.

    The lift leans back by half the downwash angle far behind (Karnopp 2004, section 9.III.A).

    >>> round(induced_drag(1.0, 10.0), 6)
    0.031831
    """
    return C_L**2 / (math.pi * A * e)


def tail_volume(l_t: Any, S_t: Any, c: Any, S: Any) -> Any:
    """Return the tail volume coefficient ``l_t S_t/(c S)`` (Karnopp 2004, eq. 9.10)."""
    return l_t * S_t / (c * S)


def moved_moment(C_M: Any, C_L: Any, start: Any, end: Any) -> Any:
    """Return the moment coefficient about ``end`` of a lift and a moment that are given about ``start``.

    A lift ahead of the point raises the nose; small angles of attack.

    >>> moved_moment(-0.5, 1.0, 0.0, 0.25)
    -0.25
    """
    return C_M + (end - start) * C_L


def thin_section(alpha: Any, camber: Any = 0) -> tuple[Any, Any]:
    """Return lift coefficient and moment coefficient about the leading edge of a thin section.

    ``alpha`` [rad] counts from zero lift; ``camber`` is A_1 - A_2, the difference of the first two coefficients
    of the cosine series of the camber line's slope (Karnopp 2004, Problem 9.1;
    H. Glauert, The Elements of Aerofoil and Airscrew Theory (1926), chapter VII).
    """
    c_l = 2 * math.pi * alpha
    return c_l, -c_l / 4 - math.pi * camber / 4


def stalling_lift(alpha: Any, slope: Any = 2 * math.pi, stall: Any = 0.25, sharpness: Any = 50.0) -> Any:
    """Return the lift coefficient of a section beyond stall too: attached flow that gives way to a flat plate's.

    ``slope * alpha`` below the angle ``stall`` [rad], ``2 sin(alpha)|sin(alpha)| cos(alpha)`` above it; the change
    takes a few times ``1/sharpness`` (R. W. Beard, T. W. McLain, Small Unmanned Aircraft (2012), eqs. (4.9), (4.10)).

    >>> [round(float(stalling_lift(alpha)), 3) for alpha in (0.05, 0.2, 0.25, 0.4)]
    [0.314, 1.167, 0.845, 0.281]
    """
    beyond, before = ((1 + tanh(sharpness * (side * alpha - stall) / 2)) / 2 for side in (1, -1))
    plate = 2 * sin(alpha) * abs(sin(alpha)) * cos(alpha)
    attached = (1 - beyond) * (1 - before)
    return attached * slope * alpha + (1 - attached) * plate


def aerodynamic_center(lift: tuple[Any, Any], moment: tuple[Any, Any]) -> Any:
    """Return the point about which the moment stays the same between two states.

    ``lift`` and ``moment`` hold the coefficients of both, moments about the leading edge (Karnopp 2004, Problem 9.1).

    >>> states = thin_section(0.02, camber=0.1), thin_section(0.10, camber=0.1)
    >>> round(aerodynamic_center(*zip(*states)), 12)
    0.25
    """
    return -(moment[1] - moment[0]) / (lift[1] - lift[0])


def center_of_pressure(C_L: Any, C_M: Any) -> Any:
    """Return the point at which the lift alone makes the moment about the leading edge (Karnopp 2004, Problem 9.1).

    >>> round(center_of_pressure(*thin_section(0.05)), 12)
    0.25
    """
    return -C_M / C_L
