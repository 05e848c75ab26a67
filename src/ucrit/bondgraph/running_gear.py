"""Points of bodies, axles and tires as subgraphs, the tire with or without a sidewall that yields."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from .elements import TF, C, R, zero
from .graph import Graph


def velocity(name: str, **shares: Any) -> Graph:
    """Return a 0-junction at which flows are added up: a point's velocity from those of its body.

    Parameters
    ----------
    name
        Name of the 0-junction; bonds away from it have the sum as flow, and its effort acts back on all shares.
    shares
        1-junctions or sources, each with the number of times that its flow is taken: 1 makes a bond, all else a
        transformer called ``name_share``.

    Examples
    --------
    >>> print(*velocity("axle", V=1, r=3).bonds, sep=", ")
    1: V -> axle, 2: r -> axle_r, 3: axle_r -> axle
    """
    parts: list[Any] = [zero(name)]
    for share, ratio in shares.items():
        if not hasattr(ratio, "free_symbols") and ratio == 1:
            parts.append(f"{share} -> {name}")
        else:
            parts += [TF(f"{name}_{share}", ratio), f"{share} -> {name}_{share} -> {name}"]
    return Graph(*parts)


def tire(at: str, side_force: Callable[[Any], Any], name: str = "tire") -> Graph:
    """Return a tire that resists the lateral velocity of its contact point, a bond away from junction ``at``.

    ``side_force`` is the force on the wheel as a function of this velocity, so that it opposes it (figure 8.6 of
    Karnopp, Vehicle Stability (2004)).
    """
    return Graph(R(name, effort=lambda v: -side_force(v)), f"{at} -> {name}")


def flexible_tire(
    at: str, side_force: Callable[[Any], Any], compliance: Any, name: str = "tire", sidewall: str = "sidewall"
) -> Graph:
    """Return a tire between whose rim and tread a sidewall yields (figure 8.7).

    The 0-junction ``at`` has the rim's velocity as sum of its flows: part of it deflects the sidewall, the rest is
    the lateral velocity of the tread, which meets the road.
    """
    return Graph(C(sidewall, compliance), f"{at} -> {sidewall}", tire(at, side_force, name))


def axle(name: str, side_force: Callable[[Any], Any], **shares: Any) -> Graph:
    """Return an axle: the 0-junction of its lateral velocity from its shares, see `velocity`, and its tire."""
    return Graph(velocity(name, **shares), tire(name, side_force, f"{name}_tire"))
