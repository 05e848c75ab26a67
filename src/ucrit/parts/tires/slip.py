"""Tires: slip angle and side force.

Sign convention: the slip angle is the angle of the contact point's velocity to the wheel's plane, positive when the
point moves to the wheel's positive lateral side; the force on the wheel opposes it. SI units and radians.
"""

from __future__ import annotations

from typing import Any

from ...core.functions import atan


def slip_angle(lateral: Any, longitudinal: Any) -> Any:
    """Return the slip angle [rad] of a wheel from its contact point's velocity components [m/s].

    The same for rolling forward and backward (Karnopp 2004, section 4.II).
    """
    return atan(lateral / abs(longitudinal))


def linear_side_force(C: Any, alpha: Any) -> Any:
    """Return the side force [N] for a cornering coefficient C [N/rad] at slip angle alpha [rad]."""
    return -C * alpha
