"""Rigid bodies as subgraphs, in axes that move with them: Euler's junction structures.

The gyrators of these structures carry momentum from one axis to another while the axes turn; together they pass
on power and neither store nor spend it. Their ratios read the rates of turning, or the angular momenta.

Source: D. Karnopp, Vehicle Stability (2004), section 2.III and figures 2.2 to 2.4.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ..core.formulas.functions import cos, sin
from .elements import GY, I, f, one, p, q
from .graph import Graph
from .running_gear import velocity


def translation(m: Any, axes: Sequence[str] = ("U", "V", "W"), spin: Sequence[str] = ("p", "q", "r")) -> Graph:
    """Return the mass of a body and 1-junctions for its velocities along three axes that turn with it.

    A name in ``axes`` that is empty stands for a velocity held at zero, one in ``spin`` for a rate held at zero; the
    rates are those of 1-junctions of these names elsewhere in the graph. Adds elements ``mass_U`` and so on.

    >>> [str(element) for element in translation(5, ("U", "V", ""), ("", "", "r")).elements]
    ["1-junction 'U'", "I 'mass_U'", "1-junction 'V'", "I 'mass_V'", "MGY 'turn_r'"]
    """
    parts: list[Any] = []
    for axis in filter(None, axes):
        parts += [one(axis), I(f"mass_{axis}", m), f"{axis} -> mass_{axis}"]
    return Graph(*parts, *_structure(axes, spin, [m * f(name) if name else 0 for name in spin], "turn"))


def rotation(inertia: Any, axes: Sequence[str] = ("p", "q", "r"), name: str = "spin") -> Graph:
    """Return the inertia of a body and 1-junctions for its rates of turning about its axes.

    ``inertia`` is its tensor about the centre of mass, a field ``name`` whose ports follow the axes. The gyrator
    between two axes has the angular momentum about the third as its ratio.
    """
    given = [axis for axis in axes if axis]
    if not given:
        return Graph()
    rows = [[entry for entry, axis in zip(row, axes, strict=True) if axis] for row in inertia]
    matrix = [row for row, axis in zip(rows, axes, strict=True) if axis]
    parts: list[Any] = [one(axis) for axis in given]
    parts += [I(name, matrix), *(f"{axis} -> {name}" for axis in given)]
    port = {axis: k if len(given) > 1 else None for k, axis in enumerate(given, 1)}
    momenta = [-p(name, port[axis]) if axis else 0 for axis in axes]
    return Graph(*parts, *_structure(axes, axes, momenta, "gyro"))


def rigid_body(m: Any, inertia: Any) -> Graph:
    """Return a rigid body with six velocities U, V, W, p, q, r, each a 1-junction of that name (figure 2.3)."""
    return Graph(translation(m), rotation(inertia))


def plane_body(m: Any, I_z: Any, axes: Sequence[str] = ("U", "V"), rate: str = "r") -> Graph:
    """Return a rigid body in plane motion: two velocities and one rate, with the one gyrator that is left (figure 2.4).

    ``axes`` and ``rate`` name the 1-junctions; a positive rate turns the first axis towards the second.
    """
    first, second = axes
    return Graph(translation(m, (first, second, ""), ("", "", rate)), one(rate), I("spin", I_z), f"{rate} -> spin")


def swinging_body(m: Any, I_c: Any, a: Any, ahead: str, left: str = "", theta: str = "theta") -> Graph:
    """Return a body whose centre of mass trails a pivot at the distance ``a``, in axes fixed to the ground.

    Parameters
    ----------
    m, I_c
        Mass, and moment of inertia about the centre of mass.
    a
        Distance from the pivot back to the centre of mass.
    ahead, left
        1-junctions of the pivot's velocities ahead and to the left; ``left`` is empty where it goes straight.
    theta
        Name for the 1-junction of the rate of turning; its displacement, the angle, is positive when the centre of
        mass swings to the left.
    """
    angle = q(theta)
    sideways = {left: 1} if left else {}
    return Graph(
        one(theta),
        I("spin", I_c),
        velocity("left", **sideways, **{theta: a * cos(angle)}),
        I("mass_left", m),
        velocity("ahead", **{ahead: 1, theta: a * sin(angle)}),
        I("mass_ahead", m),
        f"{theta} -> spin",
        "left -> mass_left",
        "ahead -> mass_ahead",
    )


def _structure(axes: Sequence[str], names: Sequence[str], ratios: Sequence[Any], prefix: str) -> list[Any]:
    """Return the ring of gyrators: that of axis 3 makes ``e_1 = r f_2`` on axis 1 and takes ``e_2 = r f_1`` from 2."""
    parts: list[Any] = []
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        if axes[i] and axes[j] and ratios[k] != 0:
            gyrator = f"{prefix}_{names[k]}"
            parts += [GY(gyrator, ratios[k]), f"{axes[j]} -> {gyrator} -> {axes[i]}"]
    return parts
