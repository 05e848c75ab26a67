"""Creep: the small sliding of rolling steel wheels on steel rails, and the forces that come with it.

Axes: x along the track, y to the left; left wheel first. Velocities of the contact points and forces on the
wheels are taken along and across the wheelset, which is turned by the yaw angle psi. SI units and radians.
"""

from __future__ import annotations

from typing import Any

from ..core.formulas.functions import cos, length, maximum, sin, where


def contact_velocities(V: Any, y: Any, psi: Any, dy: Any, dpsi: Any, d: Any, r_0: Any, conicity: Any) -> Any:
    """Return the velocities (along, across) [m/s] of a wheelset's left and right contact points on the rails.

    The wheelset spins at V/r_0; displaced to the left, it rolls on a larger radius there and on a smaller
    one to the right. The contact points are 2 d apart (Karnopp 2004, section 10.II).
    """
    spin = V / r_0
    forward = V * cos(psi) + dy * sin(psi)
    across = dy * cos(psi) - V * sin(psi)
    left = forward - d * dpsi - spin * (r_0 + conicity * y)
    right = forward + d * dpsi - spin * (r_0 - conicity * y)
    return (left, across), (right, across)


def creepage(velocity: Any, V: Any) -> Any:
    """Return the creepage: velocity of the contact point over the rail as a share of the speed V."""
    return velocity / V


def creep_force(f: Any, creepage: Any) -> Any:
    """Return the force [N] on a wheel for a creep coefficient f [N], linear in the creepage."""
    return -f * creepage


def creep_forces(V: Any, velocities: Any, f_x: Any, f_y: Any) -> tuple[tuple[Any, Any], ...]:
    """Return the pairs (force, velocity), along and across, of all contact points."""
    return tuple(
        (creep_force(f, creepage(velocity, V)), velocity)
        for point in velocities
        for f, velocity in zip((f_x, f_y), point, strict=True)
    )


def saturated_share(f_x: Any, f_y: Any, creepages: tuple[Any, Any], limit: Any) -> Any:
    """Return the share of the linear creep force that friction lets through, its resultant bounded by a limit [N].

    P. J. Vermeulen and K. L. Johnson, Journal of Applied Mechanics 31 (1964), for a contact that is not spinning.
    """
    along, across = creepages
    demand = length(f_x * along / limit, f_y * across / limit)
    return where(demand < 3, 1 - demand / 3 + demand**2 / 27, 1 / maximum(demand, 3))
