"""Wheels that roll without slipping sideways: a steered vehicle's motion follows from its steer angles alone.

Axes: x forward, y to the right; yaw rate and steer angles positive to the right. SI units and radians.
"""

from __future__ import annotations

from typing import Any

from ..core.formulas.functions import tan


def rolling_motion(U: Any, a: Any, b: Any, delta_f: Any, delta_r: Any) -> tuple[Any, Any]:
    """Return lateral velocity [m/s] and yaw rate [rad/s] of a body that two steered axles guide, a ahead and b behind.

    U is the body's velocity along its own axis. Exact for any steer angles, because each wheel moves where it
    points: ``V + a r = U tan(delta_f)`` and ``V - b r = U tan(delta_r)`` (Karnopp 2004, Problem 7.2).

    >>> V, r = rolling_motion(10.0, 0.7, 0.7, 0.02, -0.02)
    >>> float(V), round(float(r), 4)
    (0.0, 0.2858)
    """
    front, rear = tan(delta_f), tan(delta_r)
    return U * (b * front + a * rear) / (a + b), U * (front - rear) / (a + b)
