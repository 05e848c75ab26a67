"""Tires: slip angle and side force.

Sign convention: the slip angle is the angle of the contact point's velocity to the wheel's plane, positive when the
point moves to the wheel's positive lateral side; the force on the wheel opposes it. SI units and radians.
"""

from __future__ import annotations

from typing import Any

from ...core.formulas.functions import atan


def slip_angle(lateral: Any, longitudinal: Any) -> Any:
    """Return the slip angle [rad] of a wheel from its contact point's velocity components [m/s].

    The same for rolling forward and backward (Karnopp 2004, section 4.II).
    """
    return atan(lateral / abs(longitudinal))


def longitudinal_slip(r: Any, omega: Any, longitudinal: Any) -> Any:
    """Return the longitudinal slip kappa of a wheel of dynamic rolling radius r [m] that turns at omega [rad/s].

    ``(r omega - U)/U``: 0 where the wheel rolls freely, ``U = r omega``, and -1 where it is locked (Karnopp 2004,
    eq. (4.5)).

    >>> float(longitudinal_slip(0.3, 0.0, 20.0)), float(longitudinal_slip(0.3, 110.0, 30.0))
    (-1.0, 0.1)
    """
    return (r * omega - longitudinal) / abs(longitudinal)


def linear_side_force(C: Any, alpha: Any) -> Any:
    """Return the side force [N] for a cornering coefficient C [N/rad] at slip angle alpha [rad]."""
    return -C * alpha


def is_zero(value: Any) -> bool:
    """Return whether a value is zero itself, not a symbol or an array that may be."""
    return bool(getattr(value, "is_zero", False)) or (isinstance(value, int | float) and value == 0)
