"""Where the activated bonds of a graph run: each bowed so that it keeps off labels and bonds."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..bondgraph.graph import Graph
from .bond_room import Boxes, Places, ends, extent, inside

Array = npt.NDArray[np.float64]

BOWS = (0.15, -0.15, 0.25, -0.25, 0.4, -0.4, 0.6, -0.6, 0.85, -0.85)
"""How far the middle of a signal stands off, as a share of its length."""

POINTS = 60


def signal_paths(graph: Graph, places: Places, boxes: Boxes) -> list[Array]:
    """Return the curve of each signal, shape (points, 2), the one after the other with the least in its way."""
    paths: list[Array] = []
    bonds = [ends(b.tail, b.head, places, boxes)[:2] for b in graph.bonds]
    numbers = np.array([(a + b) / 2 for a, b in bonds]).reshape(-1, 2)
    low, high = extent(places, boxes)
    for source, target in dict.fromkeys((s.source, s.target) for s in graph.signals):
        tried = [_curve(source, target, bow, places, boxes) for bow in BOWS]
        costs = [
            _labels(path, {source, target}, places, boxes)
            + _beside(path, bonds)
            + 0.5 * float((np.linalg.norm(path[:, None] - numbers, axis=-1) < 0.1).sum())
            + sum(float((np.linalg.norm(path[:, None] - other, axis=-1).min(axis=1) < 0.05).sum()) for other in paths)
            + 8 * bow**2
            + _outside(path, low, high)
            for path, bow in zip(tried, BOWS, strict=True)
        ]
        paths.append(tried[int(np.argmin(costs))])
    return paths


def _curve(source: str, target: str, bow: float, places: Places, boxes: Boxes) -> Array:
    """Return a parabola between two labels, each left towards the middle of the bow."""
    a, b = places[source], places[target]
    top = (a + b) / 2 + 2 * bow * np.array([a[1] - b[1], b[0] - a[0]])
    start, end = (
        at + (unit := (top - at) / np.linalg.norm(top - at)) * (inside(unit, boxes[name].half) + 0.02)
        for name, at in ((source, a), (target, b))
    )
    t = np.linspace(0, 1, POINTS)[:, None]
    return np.asarray((1 - t) ** 2 * start + 2 * t * (1 - t) * top + t**2 * end)


def _labels(path: Array, own: set[str], places: Places, boxes: Boxes) -> float:
    """Count points on labels, those of the ends too."""
    cost = 0.0
    for name, box in boxes.items():
        inside_ = (np.abs(path - places[name]) < box.half - (0.04 if name in own else 0)).all(axis=1)
        cost += 3.0 * float(inside_.sum())
    return cost


def _beside(path: Array, bonds: list[tuple[Array, Array]]) -> float:
    """Count points that run along bonds: a crossing has few."""
    cost = 0.0
    for start, end in bonds:
        along = end - start
        share = np.clip((path - start) @ along / (along @ along), 0, 1)
        cost += float((np.linalg.norm(path - start - share[:, None] * along, axis=1) < 0.06).sum())
    return cost


def _outside(path: Array, low: Array, high: Array) -> float:
    """Return how far a curve leaves the page that the labels need."""
    return 15.0 * float(np.max(np.maximum(low - path, path - high).clip(min=0)))
