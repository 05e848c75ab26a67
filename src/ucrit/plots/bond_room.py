"""Room for the labels of a bond graph: columns and rows of its grid, in inches."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ..bondgraph.graph import Graph
from .bond_layout import grid_places

Array = npt.NDArray[np.float64]

REACH = 0.46
"""Least visible length of a bond [in]."""

APART = 0.12
"""Least room between labels, and between a label and a foreign bond [in]."""

LEAST = (0.5, 0.42)
"""Least width of a column and height of a row [in]."""

MARGIN = 0.12


@dataclass(frozen=True)
class Box:
    """Label of an element, the small name below it, and half the width and height of both [in]."""

    text: str
    name: str
    half: Array


Places = dict[str, Array]
Boxes = dict[str, Box]


def places_of(graph: Graph, boxes: Boxes) -> Places:
    """Return the centres of all elements: on the grid, with columns and rows wide enough."""
    grid = grid_places(graph)
    columns, rows = (sorted({place[axis] for place in grid.values()}) for axis in (0, 1))
    cell = {name: (columns.index(x), rows.index(y)) for name, (x, y) in grid.items()}
    gaps: list[dict[tuple[int, int], float]] = [{}, {}]
    for axis, low, high, room in _needs(graph, cell, boxes):
        gaps[axis][low, high] = max(room, gaps[axis].get((low, high), 0.0))
    for _ in range(30):
        at = [_positions(len(lines), gaps[axis], LEAST[axis]) for axis, lines in enumerate((columns, rows))]
        places = {name: np.array([at[0][x], at[1][y]]) for name, (x, y) in cell.items()}
        if not _widened(graph, cell, places, boxes, gaps):
            break
    return places


def _needs(graph: Graph, cell: dict[str, tuple[int, int]], boxes: Boxes) -> Iterator[tuple[int, int, int, float]]:
    """Yield axis, two columns or rows, and how far they must be apart."""
    names = list(cell)
    bonded = {frozenset((b.tail, b.head)) for b in graph.bonds}
    for i, a in enumerate(names):
        for b in names[i + 1 :]:
            for axis in (0, 1):
                if cell[a][1 - axis] == cell[b][1 - axis]:
                    low, high = sorted((cell[a][axis], cell[b][axis]))
                    room = REACH if frozenset((a, b)) in bonded else APART
                    yield axis, low, high, float(boxes[a].half[axis] + boxes[b].half[axis]) + room
    for bond in graph.bonds:  # a straight bond beside a label
        for axis in (0, 1):
            if cell[bond.tail][axis] == cell[bond.head][axis]:
                line, span = cell[bond.tail][axis], sorted((cell[bond.tail][1 - axis], cell[bond.head][1 - axis]))
                for name in names:
                    here = cell[name]
                    if here[axis] != line and span[0] <= here[1 - axis] <= span[1]:
                        low, high = sorted((here[axis], line))
                        yield axis, low, high, float(boxes[name].half[axis]) + APART


def _positions(count: int, gaps: dict[tuple[int, int], float], least: float) -> Array:
    at = np.zeros(count)
    for k in range(1, count):
        at[k] = max([at[k - 1] + least, *(at[low] + room for (low, high), room in gaps.items() if high == k)])
    return at


def _widened(
    graph: Graph, cell: dict[str, tuple[int, int]], places: Places, boxes: Boxes, gaps: list[dict[Any, float]]
) -> bool:
    """Ask for more room where a slanting bond is short or runs over a label; tell whether any was asked for."""
    asked = False

    def ask(one: str, other: str, axes: tuple[int, ...], factor: float) -> None:
        nonlocal asked
        for axis in axes:
            low, high = sorted((cell[one][axis], cell[other][axis]))
            if low != high:
                apart = float(abs(places[one][axis] - places[other][axis]))
                gaps[axis][low, high] = max(gaps[axis].get((low, high), 0.0), factor * apart)
                asked = True

    for bond in graph.bonds:
        tail, head, _ = ends(bond.tail, bond.head, places, boxes)
        if np.linalg.norm(head - tail) < 0.95 * REACH:
            ask(bond.tail, bond.head, (0, 1), 1.12)
        for name, box in boxes.items():
            if name not in (bond.tail, bond.head) and touches(tail, head, places[name], box.half + APART / 2):
                for end in (bond.tail, bond.head):  # labels are wide: room is wanted to their sides
                    ask(end, name, (0,), 1.08)
    return asked


def ends(source: str, target: str, places: Places, boxes: Boxes, gap: float = 0.0) -> tuple[Array, Array, Array]:
    """Return where a line between two labels begins and ends, and its direction."""
    a, b = places[source], places[target]
    unit = (b - a) / np.linalg.norm(b - a)
    start = a + unit * (inside(unit, boxes[source].half) + gap)
    return start, b - unit * (inside(unit, boxes[target].half) + gap), unit


def touches(start: Array, end: Array, centre: Array, half: Array) -> bool:
    """Tell whether a segment meets a box."""
    along = end - start
    with np.errstate(divide="ignore", invalid="ignore"):
        near, far = (centre - half - start) / along, (centre + half - start) / along
    enter, leave = np.minimum(near, far), np.maximum(near, far)
    still = along == 0
    if bool(np.any(still & (np.abs(start - centre) >= half))):
        return False
    first, last = float(np.max(enter[~still], initial=0.0)), float(np.min(leave[~still], initial=1.0))
    return first < last


def inside(unit: Array, half: Array) -> float:
    """Return how far the box, rounded where it is nearly square, reaches from its centre in a direction."""
    if half.max() < 1.6 * half.min():
        return float(1.06 / np.linalg.norm(unit / half))
    with np.errstate(divide="ignore"):
        return float(np.min(half / np.maximum(np.abs(unit), 1e-12)))


def extent(places: Places, boxes: Boxes, paths: Sequence[Array] = ()) -> tuple[Array, Array]:
    """Return the lower left and the upper right corner of all boxes and curves with a margin."""
    low = np.min([*(places[name] - boxes[name].half for name in places), *(p.min(axis=0) for p in paths)], axis=0)
    high = np.max([*(places[name] + boxes[name].half for name in places), *(p.max(axis=0) for p in paths)], axis=0)
    return low - MARGIN, high + MARGIN
