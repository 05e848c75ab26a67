"""What a vehicle looks like: the contract of a model's ``drawing(self, x, u)``, and the lines it is made of.

``drawing`` returns a `Drawing`: bodies, each a few lines in axes of its own with a position and an angle, in one view.
It runs on numbers, not on symbols; any of them may be an array over time. The drawing's axes are the model's own:
what is ahead first, then what its second axis calls positive (``turned`` tells which). A model whose equations are in
axes that move says how these travel over the ground, and the path follows by integration.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ..errors import ModelError, near_match

Array = npt.NDArray[Any]
Point = tuple[Any, Any]

VIEWS = {"top": "seen from above", "side": "seen from the side", "rear": "seen from behind"}

LOOKS = ("body", "wheel", "part", "ground")
"""Looks of a body: filled, a wheel, a thin line, or something that stays where it is."""


@dataclass(frozen=True)
class Body:
    """Lines that move together.

    Attributes
    ----------
    points
        Corners in the body's own axes [m], shape (points, 2).
    at
        Position of the body's origin [m], two numbers or arrays.
    angle
        From the first axis towards the second [rad].
    look
        One of `LOOKS`.
    closed
        Whether the last point is joined with the first.
    """

    points: Array
    at: Point = (0.0, 0.0)
    angle: Any = 0.0
    look: str = "body"
    closed: bool = True

    def placed(self) -> Array:
        """Return the corners where they are, shape (..., points, 2)."""
        x, y, angle = (np.asarray(v, dtype=float)[..., None] for v in (*self.at, self.angle))
        along, across = self.points[:, 0], self.points[:, 1]
        cosine, sine = np.cos(angle), np.sin(angle)
        corners = np.broadcast_arrays(x + cosine * along - sine * across, y + sine * along + cosine * across)
        return np.stack(corners, axis=-1)


@dataclass(frozen=True)
class Drawing:
    """Bodies in one view.

    Attributes
    ----------
    view
        ``"top"``, ``"side"`` or ``"rear"``.
    bodies
        What is drawn, from the back to the front.
    turned
        Whether the second axis points to the right (top view) or down (side, rear view), not to the left or up.
    travel
        Velocity of the axes along their own first and second axis [m/s] and their rate of turn towards the
        second [rad/s]: numbers or arrays. Zero for axes that stand still.
    """

    view: str
    bodies: Sequence[Body]
    turned: bool = False
    travel: tuple[Any, Any, Any] = (0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        if self.view not in VIEWS:
            raise ModelError(f"there is no view '{self.view}'{near_match(self.view, VIEWS)}")
        for body in self.bodies:
            if body.look not in LOOKS:
                raise ModelError(f"there is no look '{body.look}' of a body{near_match(body.look, LOOKS)}")


def box(length: float, width: float, at: Point = (0.0, 0.0), angle: Any = 0.0, ahead: float = 0.0) -> Body:
    """Return a rectangle whose middle lies ``ahead`` of the body's origin.

    >>> box(4, 2, ahead=1).placed().tolist()
    [[3.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [3.0, -1.0]]
    """
    front, rear, side = ahead + length / 2, ahead - length / 2, width / 2
    return Body(np.array([[front, side], [rear, side], [rear, -side], [front, -side]], dtype=float), at, angle)


def wheel(length: float, width: float, at: Point, angle: Any = 0.0) -> Body:
    """Return a wheel from above or from behind: a dark rectangle about its middle."""
    return Body(box(length, width).points, at, angle, "wheel")


def line(*points: Point, at: Point = (0.0, 0.0), angle: Any = 0.0, look: str = "part") -> Body:
    """Return a thin open line through points that are numbers."""
    return Body(np.array(points, dtype=float), at, angle, look, closed=False)


def disc(radius: float, at: Point, angle: Any = 0.0, look: str = "body") -> Body:
    """Return a circle with a radius drawn in, so that its turning is seen."""
    around = np.linspace(0, 2 * np.pi, 25)
    rim = np.stack([radius * np.cos(around), radius * np.sin(around)], axis=1)
    return Body(np.concatenate([rim, [[0.0, 0.0]]]), at, angle, look)


def moved(body_at: Point, angle: Any, ahead: Any, aside: Any = 0.0) -> Point:
    """Return where a point of a body is that lies ``ahead`` and ``aside`` of the body's origin.

    >>> moved((1, 2), 0, 3, 1)
    (np.float64(4.0), np.float64(3.0))
    """
    cosine, sine = np.cos(angle), np.sin(angle)
    return body_at[0] + cosine * ahead - sine * aside, body_at[1] + sine * ahead + cosine * aside
