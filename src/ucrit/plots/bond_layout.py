"""Where the elements of a bond graph are drawn: networkx for the shape, then room for labels. Lengths in inches."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..bondgraph.graph import Graph

REACH = 0.62
"""Least visible length of a bond."""

MARGIN = 0.12


@dataclass(frozen=True)
class Box:
    """Label of an element, the small name below it, and half the width and height of both [in]."""

    text: str
    name: str
    half: np.ndarray[Any, Any]


def places_of(graph: Graph, boxes: dict[str, Box]) -> dict[str, np.ndarray[Any, Any]]:
    """Place the elements: networkx for the shape, then scaled until the bonds have length, and boxes pushed apart."""
    import networkx as nx

    links = nx.Graph()
    links.add_nodes_from(e.name for e in graph.elements)
    links.add_edges_from((b.tail, b.head) for b in graph.bonds)
    pieces = [links.subgraph(c) for c in sorted(nx.connected_components(links), key=len, reverse=True)]
    places: dict[str, np.ndarray[Any, Any]] = {}
    right = 0.0
    for piece in pieces:
        spots = _piece(piece, boxes)
        low, high = extent(spots, boxes)
        places |= {name: at - [low[0] - right, (low[1] + high[1]) / 2] for name, at in spots.items()}
        right += high[0] - low[0] + REACH
    return {e.name: places[e.name] for e in graph.elements}


def _piece(links: Any, boxes: dict[str, Box]) -> dict[str, np.ndarray[Any, Any]]:
    import networkx as nx

    names = sorted(links)
    if len(names) == 1:
        return {names[0]: np.zeros(2)}
    start = nx.planar_layout(links) if nx.check_planarity(links)[0] else nx.circular_layout(links)
    spots = nx.kamada_kawai_layout(links, pos=start)
    at = np.array([spots[name] for name in names])
    at -= at.mean(axis=0)
    _, _, axes = np.linalg.svd(at, full_matrices=False)  # the longer way across the page
    at = at @ axes.T
    half = np.array([boxes[name].half for name in names])
    index = {name: i for i, name in enumerate(names)}
    pairs = [(index[a], index[b]) for a, b in links.edges]
    lengths = [float(np.linalg.norm(at[a] - at[b])) for a, b in pairs]
    at *= (REACH + 0.45) / float(np.median(lengths))
    _relax(at, half, pairs)
    return {name: at[index[name]] for name in names}


def _relax(at: np.ndarray[Any, Any], half: np.ndarray[Any, Any], pairs: list[tuple[int, int]]) -> None:
    """Push boxes apart until none overlap, none lies on a foreign bond, and each bond has its visible length."""
    n = len(at)
    for _ in range(400):
        moved = 0.0
        for a in range(n):
            for b in range(a + 1, n):
                moved += _push(at, half, a, b, 0.10)
        for a, b in pairs:
            direction = at[b] - at[a]
            length = float(np.linalg.norm(direction)) or 1e-9
            unit = direction / length
            wanted = REACH + inside(unit, half[a]) + inside(unit, half[b])
            if length < wanted:
                at[a] -= unit * (wanted - length) / 2
                at[b] += unit * (wanted - length) / 2
                moved += wanted - length
            moved += sum(_off(at, half, c, a, b) for c in range(n) if c not in (a, b))
        if moved < 1e-3:
            return


def _push(at: np.ndarray[Any, Any], half: np.ndarray[Any, Any], a: int, b: int, room: float) -> float:
    overlap = half[a] + half[b] + room - np.abs(at[b] - at[a])
    if overlap.min() <= 0:
        return 0.0
    axis = int(np.argmin(overlap))
    step = overlap[axis] / 2 * (1 if at[b][axis] >= at[a][axis] else -1)
    at[a][axis] -= step
    at[b][axis] += step
    return float(overlap[axis])


def _off(at: np.ndarray[Any, Any], half: np.ndarray[Any, Any], c: int, a: int, b: int) -> float:
    """Move box ``c`` off the bond from a to b."""
    along = at[b] - at[a]
    share = float(np.clip(np.dot(at[c] - at[a], along) / np.dot(along, along), 0, 1))
    if not 0.05 < share < 0.95:
        return 0.0
    away = at[c] - (at[a] + share * along)
    normal = np.array([-along[1], along[0]]) / np.linalg.norm(along)
    clear = float(np.dot(np.abs(normal), half[c])) + 0.10
    distance = float(np.dot(away, normal))
    if abs(distance) >= clear:
        return 0.0
    step = (clear - abs(distance)) * (1 if distance >= 0 else -1) / 2
    at[c] += normal * step
    at[a] -= normal * step / 2
    at[b] -= normal * step / 2
    return abs(step)


def inside(unit: np.ndarray[Any, Any], half: np.ndarray[Any, Any]) -> float:
    """Return how far the box, rounded where it is nearly square, reaches from its centre in a direction."""
    if half.max() < 1.6 * half.min():
        return float(1.06 / np.linalg.norm(unit / half))
    with np.errstate(divide="ignore"):
        return float(np.min(half / np.maximum(np.abs(unit), 1e-12)))


def extent(places: dict[str, np.ndarray[Any, Any]], boxes: dict[str, Box]) -> tuple[Any, Any]:
    """Return the lower left and the upper right corner of all boxes with a margin."""
    low = np.min([places[name] - boxes[name].half for name in places], axis=0)
    high = np.max([places[name] + boxes[name].half for name in places], axis=0)
    return low - MARGIN, high + MARGIN
