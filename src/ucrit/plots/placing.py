"""Where to put a label beside a point so that it covers neither lines nor other labels."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from . import style

Array = npt.NDArray[Any]

CORNERS = ((1, 1), (-1, 1), (1, -1), (-1, -1), (0, 1), (0, -1))


class Labels:
    """Places labels in an axes one after another, each beside its point where it is least in the way.

    Parameters
    ----------
    axes
        With its limits set.
    size
        Approximate width and height of the axes [pt].
    obstacles
        Points of all lines, shape (n, 2), in data coordinates.
    """

    def __init__(self, axes: Any, size: tuple[float, float], obstacles: Array) -> None:
        self._axes = axes
        self._size = np.array(size)
        self._points = self._to_points(obstacles)
        self._boxes: list[Array] = []
        self._done: set[tuple[str, tuple[float, ...]]] = set()

    def _to_points(self, data: Array) -> Array:
        x, y = self._axes.get_xlim(), self._axes.get_ylim()
        low, span = np.array([x[0], y[0]]), np.array([x[1] - x[0], y[1] - y[0]])
        return np.asarray((np.asarray(data, dtype=float) - low) / span * self._size)

    def add(
        self,
        text: str,
        at: tuple[float, float],
        *,
        font: float,
        gap: float = 4,
        must: bool = True,
        **options: Any,
    ) -> bool:
        """Write a label; without ``must`` leave it away where there is no free place."""
        lines = text.split("\n")
        extent = np.array([0.62 * font * max(map(len, lines)), 1.2 * font * len(lines)])
        anchor = self._to_points(np.array([at]))[0]
        if not must and (text, tuple(anchor.round())) in self._done:
            return False
        self._done.add((text, tuple(anchor.round())))
        corners = [(self._cost(self._box(anchor, extent, corner, gap)), corner) for corner in CORNERS]
        cost, corner = min(corners, key=lambda pair: pair[0])
        if cost and not must:
            return False
        self._boxes.append(self._box(anchor, extent, corner, gap))
        sideways, upward = corner
        style.label(
            self._axes,
            text,
            at,
            fontsize=font,
            textcoords="offset points",
            xytext=(sideways * gap, upward * gap),
            ha={1: "left", 0: "center", -1: "right"}[sideways],
            va="bottom" if upward > 0 else "top",
            **options,
        )
        return True

    def _box(self, anchor: Array, extent: Array, corner: tuple[int, int], gap: float) -> Array:
        centre = anchor + np.array(corner) * (gap + extent / 2)
        return np.array([centre - extent / 2, centre + extent / 2])

    def _cost(self, box: Array) -> float:
        """Count line points under the box; other labels and the edge weigh more."""
        low, high = box
        under = np.count_nonzero(((self._points > low - 1) & (self._points < high + 1)).all(axis=1))
        overlaps = sum(bool(np.all(low < other[1] + 3) and np.all(other[0] - 3 < high)) for other in self._boxes)
        outside = bool(np.any(low < 0) or np.any(high > self._size))
        return float(under + 200 * overlaps + 400 * outside)
