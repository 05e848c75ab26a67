"""Where the elements of a bond graph are drawn: networkx for the shape, then a grid on which bonds are kept straight.

On the grid every element is moved in turn to a free place, chosen by how the bonds then run and more strictly with
every round (simulated annealing by heat bath); the random numbers are the same each time, and so is the drawing.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import numpy.typing as npt

from ..bondgraph.elements import TWO_PORTS
from ..bondgraph.graph import Graph

Array = npt.NDArray[np.floating]
Whole = npt.NDArray[np.int64]

TRIES, ROUNDS, HOT, COLD = 2, 50, 5.0, 0.15
LONG, STEEP, SLANTED, BENT = 1.5, 1.2, 3.0, 1.2
CROSSING, ON_LABEL, NARROW, CRAMPED = 14.0, 18.0, 18.0, 2.5
ROWS = 0.5
SIGNAL = {"long": 0.15, "crossing": 0.8, "on label": 3.0}
WIDE = np.array([1.7, 1.0], dtype=np.float32)
"""Width and height of a place on the page, about: labels are wide."""

NEAR = np.array([(i, j) for i in range(-2, 3) for j in range(-2, 3)])
"""Places around an element that it may be moved to."""


def grid_places(graph: Graph) -> dict[str, tuple[int, int]]:
    """Return column and row of each element; unconnected pieces stand side by side."""
    import networkx as nx

    links = nx.Graph()
    links.add_nodes_from(e.name for e in graph.elements)
    links.add_edges_from((b.tail, b.head) for b in graph.bonds)
    places: dict[str, tuple[int, int]] = {}
    right = 0
    for piece in sorted(nx.connected_components(links), key=lambda names: (-len(names), min(names))):
        names = [e.name for e in graph.elements if e.name in piece]
        at = np.array(_piece_places(*_numbered(graph, names)))
        at -= [at[:, 0].min(), round(float(np.median(at[:, 1])))]
        places |= {name: (int(x) + right, int(y)) for name, (x, y) in zip(names, at, strict=True)}
        right += int(at[:, 0].max()) + 1
    return {e.name: places[e.name] for e in graph.elements}


Pairs = tuple[tuple[int, int], ...]


def _numbered(graph: Graph, names: list[str]) -> tuple[tuple[str, ...], Pairs, Pairs]:
    """Return kinds, bonds and signals of a connected piece, elements by number."""
    number = {name: i for i, name in enumerate(names)}
    bonds = tuple((number[b.tail], number[b.head]) for b in graph.bonds if b.tail in number)
    reads = ((s.source, s.target) for s in graph.signals if s.source in number and s.target in number)
    return (
        tuple(graph.by_name[name].kind for name in names),
        bonds,
        tuple(dict.fromkeys((number[a], number[b]) for a, b in reads)),
    )


@lru_cache(maxsize=256)
def _piece_places(kinds: tuple[str, ...], bonds: Pairs, signals: Pairs) -> Pairs:
    """Return column and row of each element of a connected piece: the same for graphs of the same shape."""
    if len(kinds) == 1:
        return ((0, 0),)
    at = _Piece(kinds, bonds, signals).settled(_start(len(kinds), bonds))
    return tuple((int(x), int(y)) for x, y in at)


def _start(count: int, bonds: Pairs) -> Whole:
    """Return a first placement: networkx's, the longer way across the page, each element in a place of its own."""
    import networkx as nx

    links = nx.Graph()
    links.add_nodes_from(range(count))
    links.add_edges_from(bonds)
    first = nx.planar_layout(links) if nx.check_planarity(links)[0] else nx.circular_layout(links)
    spots = nx.kamada_kawai_layout(links, pos=first)
    at = np.array([spots[i] for i in range(count)])
    at -= at.mean(axis=0)
    _, _, axes = np.linalg.svd(at, full_matrices=False)
    at = at @ (axes * np.sign(axes.sum(axis=1))[:, None]).T
    ends = np.array(bonds)
    at *= 1.3 / float(np.median(np.linalg.norm(at[ends[:, 0]] - at[ends[:, 1]], axis=1)))
    taken: list[tuple[int, int]] = []
    reach = int(np.ceil(np.sqrt(count)))  # a square of so many places has a free one
    around = np.array([(i, j) for i in range(-reach, reach + 1) for j in range(-reach, reach + 1)])
    for spot in at:
        near = np.rint(spot).astype(np.int64) + around
        order = np.argsort(((near - spot) ** 2).sum(axis=1), kind="stable")
        taken.append(next((int(x), int(y)) for x, y in near[order] if (x, y) not in taken))
    return np.array(taken, dtype=np.int64)


@dataclass(frozen=True)
class _Group:
    """Elements that are moved together, and what their places have to do with, by numbers of elements and lines.

    ``crossings`` are pairs of lines without a common end, ``angles`` pairs of bonds with one, and the sign that makes
    both lead away from it; ``labels`` are elements, and lines that may run over them.
    """

    members: Whole
    lines: Whole
    crossings: Whole
    crossing_weights: Array
    angles: Whole
    labels: Whole
    label_weights: Array
    two_ports: tuple[int, ...]
    in_row: bool


class _Piece:
    """A connected piece of a graph, its elements by number; ``lines`` are its bonds, then its signals."""

    def __init__(self, kinds: tuple[str, ...], bonds: Pairs, signals: Pairs) -> None:
        self.lines = np.array([*bonds, *signals]).reshape(-1, 2)
        self.bond = np.arange(len(self.lines)) < len(bonds)
        beside: dict[int, list[int]] = {i: [] for i in range(len(kinds))}
        for a, b in bonds:
            beside[a].append(b)
            beside[b].append(a)
        self.through = {i: (beside[i][0], beside[i][1]) for i, kind in enumerate(kinds) if kind in TWO_PORTS}
        self.row = np.array([i for i, kind in enumerate(kinds) if kind == "1"], dtype=np.int64)
        self.singles = [self._group([i]) for i in beside]
        leaves = {i: [j for j in beside[i] if len(beside[j]) == 1] for i in beside}
        around = {i: [j for j in beside[i] if j in self.through] for i in beside if i not in self.through}
        groups = [[i, *leaves[i]] for i in beside] + [[i, *leaves[i], *near] for i, near in around.items() if near]
        self.groups = [*self.singles, *(self._group(group) for group in groups if len(group) > 1)]

    def _group(self, members: list[int]) -> _Group:
        lines, bond = self.lines, self.bond
        mine = [k for k, line in enumerate(lines) if set(line) & set(members)]
        pairs = [(i, j) for i in mine for j in range(len(lines)) if j not in mine or i < j]
        crossings = [(i, j) for i, j in pairs if not set(lines[i]) & set(lines[j])]
        weight = {2: CROSSING, 1: SIGNAL["crossing"], 0: 0.2}
        angles = [
            (i, j, 1 if a == b else -1)
            for i, j in pairs
            if bond[i] and bond[j]
            for a in (0, 1)
            for b in (0, 1)
            if lines[i][a] == lines[j][b]
        ]
        labels = [(k, i) for i in mine for k in range(lines.max(initial=-1) + 1) if k not in lines[i]]
        labels += [(k, i) for i in range(len(lines)) if i not in mine for k in members if k not in lines[i]]
        near = {*members, *lines[mine].ravel().tolist()}
        return _Group(
            np.array(members),
            np.array(mine, dtype=np.int64),
            np.array(crossings, dtype=np.int64).reshape(-1, 2),
            np.array([weight[int(bond[i]) + int(bond[j])] for i, j in crossings]),
            np.array(angles, dtype=np.int64).reshape(-1, 3),
            np.array(labels, dtype=np.int64).reshape(-1, 2),
            np.array([ON_LABEL if bond[i] else SIGNAL["on label"] for _, i in labels]),
            tuple(near & self.through.keys()),
            bool(set(members) & set(self.row.tolist())),
        )

    def settled(self, at: Whole) -> Whole:
        """Return better places."""
        found = [self._annealed(at, np.random.default_rng(seed)) for seed in range(TRIES)]
        return min(found, key=self._worth)

    def _worth(self, at: Whole) -> float:
        return sum(float(self._costs(at[None], group)[0]) for group in self.singles)

    def _annealed(self, at: Whole, rng: np.random.Generator) -> Whole:
        for heat in (*np.geomspace(HOT, COLD, ROUNDS), 1e-6, 1e-6):
            for k in rng.permutation(len(self.groups)):
                at = self._moved(at, self.groups[k], float(heat), rng)
        return at

    def _moved(self, at: Whole, group: _Group, heat: float, rng: np.random.Generator) -> Whole:
        others = np.delete(at, group.members, axis=0)
        landed = at[group.members][None] + NEAR[:, None]
        free = ~(landed[:, :, None] == others[None, None]).all(axis=-1).any(axis=(1, 2))
        tried = np.repeat(at[None], int(free.sum()), axis=0)
        tried[:, group.members] = landed[free]
        costs = self._costs(tried, group)
        chance = np.exp((costs.min() - costs) / heat)
        chosen: Whole = tried[rng.choice(len(tried), p=chance / chance.sum())]
        return chosen

    def _costs(self, at: Whole, group: _Group) -> Array:
        """Return what each placement costs as far as a group has part in it; ``at`` (placements, elements, 2)."""
        x = at.astype(np.float32)
        start = x[:, self.lines[:, 0]]
        along = x[:, self.lines[:, 1]] - start
        cost = self._runs(along[:, group.lines], self.bond[group.lines])
        cost += _crossed(start, along, group.crossings) @ group.crossing_weights
        cost += _narrow(along, group.angles).sum(axis=1)
        cost += _covered(x, start, along, group.labels) @ group.label_weights
        for two_port in group.two_ports:
            one, other = (x[:, end] - x[:, two_port] for end in self.through[two_port])
            cost += BENT * (1 + _cosine(one, other))
        if group.in_row and len(self.row) > 1:
            rows = x[:, self.row, 1]
            cost += ROWS * np.abs(rows - np.median(rows, axis=1)[:, None]).sum(axis=1)
        return np.asarray(cost, dtype=np.float64)

    @staticmethod
    def _runs(along: Array, bond: npt.NDArray[np.bool_]) -> Array:
        """Lengths, and directions other than along the grid."""
        across, up = np.moveaxis(np.abs(along), -1, 0)
        steep = np.where(np.minimum(across, up) == 0, 0.0, np.where(across == up, STEEP, SLANTED))
        length = np.hypot(across, up) - 1
        return np.asarray(np.where(bond, LONG * length + steep, SIGNAL["long"] * length).sum(axis=1))


def _crossed(start: Array, along: Array, pairs: Whole) -> Array:
    """Tell which pairs of lines cross."""
    i, j = pairs.T
    between, r, s = start[:, j] - start[:, i], along[:, i], along[:, j]
    turn = _cross(r, s)
    with np.errstate(divide="ignore", invalid="ignore"):
        t, u = _cross(between, s) / turn, _cross(between, r) / turn
    return np.asarray((turn != 0) & (t > 0) & (t < 1) & (u > 0) & (u < 1))


def _narrow(along: Array, pairs: Whole) -> Array:
    """Return what small angles between bonds at one element cost."""
    near = pairs[:, 2] * _cosine(WIDE * along[:, pairs[:, 0]], WIDE * along[:, pairs[:, 1]])
    return np.where(near > 0.9, NARROW, np.where(near > 0.6, CRAMPED, 0.0))


def _covered(x: Array, start: Array, along: Array, pairs: Whole) -> Array:
    """Return how far lines run over elements, from 0 to 1."""
    spot, line = pairs.T
    way, off = along[:, line], x[:, spot] - start[:, line]
    share = np.clip((off * way).sum(axis=-1) / np.maximum((way**2).sum(axis=-1), 1e-9), 0, 1)
    away = np.linalg.norm(off - share[..., None] * way, axis=-1)
    return np.asarray(np.clip(1.3 - 2 * away, 0, 1))


def _cross(a: Array, b: Array) -> Array:
    return np.asarray(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])


def _cosine(a: Array, b: Array) -> Array:
    lengths = np.linalg.norm(a, axis=-1) * np.linalg.norm(b, axis=-1)
    return np.asarray((a * b).sum(axis=-1) / np.maximum(lengths, 1e-9))
