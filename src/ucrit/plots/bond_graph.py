"""Drawing of a bond graph: half-arrows, causal strokes, numbers, dashed signals, placed by networkx.

The unit of the drawing is the inch, so that type and strokes keep their size however large the graph is.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..bondgraph.causality import HEAD, Causality
from ..bondgraph.elements import JUNCTIONS, Element
from ..bondgraph.graph import Bond, Graph
from ..bondgraph.laws import LINEAR
from . import style

SIZE, NAME_SIZE, NUMBER_SIZE = 11.0, 7.0, 7.0
REACH = 0.62  # least visible length of a bond [in]
BARB, BARB_ANGLE = 0.11, math.radians(38)
STROKE = 0.15
GAP = 0.07
LONGEST_LAW = 26
MARGIN = 0.12


def plot_bond_graph(found: Causality, *, numbers: bool = True, names: bool = True, figure: Any = None) -> Any:
    """Draw a bond graph with its causality.

    Parameters
    ----------
    found
        What `ucrit.bondgraph.causality` returned.
    numbers, names
        Whether bonds carry their numbers, and junctions their names.
    figure
        Figure to draw into; a new one that fits the graph by default.

    Returns
    -------
    matplotlib.figure.Figure
    """
    with style.settings():
        graph = found.graph
        boxes = {e.name: _box(e, names) for e in graph.elements}
        places = _places(graph, boxes)
        low, high = _extent(places, boxes)
        if figure is None:
            figure = style.new_figure(*(high - low))
            figure.set_layout_engine("none")
        axes = figure.add_axes((0, 0, 1, 1))
        axes.set_axis_off()
        axes.set_xlim(low[0], high[0])
        axes.set_ylim(low[1], high[1])
        axes.set_aspect("equal")
        for signal in graph.signals:
            _draw_signal(axes, signal.source, signal.target, places, boxes)
        for bond, stroke in zip(graph.bonds, found.strokes, strict=True):
            _draw_bond(axes, bond, stroke, places, boxes, numbers)
        for element in graph.elements:
            _draw_element(axes, element, places[element.name], boxes[element.name])
        return figure


@dataclass(frozen=True)
class _Box:
    """Label of an element, the small name below it, and half the width and height of both [in]."""

    text: str
    name: str
    half: np.ndarray[Any, Any]


def _box(element: Element, names: bool) -> _Box:
    text, name = _label(element), ""
    if element.kind in JUNCTIONS and names:
        name = _told(element.name)
    width, height = _measure(text, SIZE)
    if name:
        name_width, name_height = _measure(name, NAME_SIZE)
        width, height = max(width, name_width), height + name_height + 0.02
    half = np.array([width / 2 + GAP, height / 2 + GAP])
    return _Box(text, name, np.maximum(half, 0.19) if element.kind in JUNCTIONS else half)


def _measure(text: str, size: float) -> tuple[float, float]:
    from matplotlib.textpath import TextPath

    box = TextPath((0, 0), text, size=size).get_extents()
    return 1.04 * float(box.width) / 72, max(float(box.height) / 72, 0.9 * size / 72)


def _label(element: Element) -> str:
    """Return kind and law as mathematics, or the name where the law is long."""
    if element.law is None:
        return element.kind
    law = _law(element)
    shown = f"${law}$" if law else _told(element.name)
    return f"{element.label} : {shown}"


def _told(name: str) -> str:
    """Return a name as it is written beside its element: single letters and Greek ones as symbols."""
    import sympy as sp

    symbol = str(sp.latex(sp.Symbol(name)))
    return f"${symbol}$" if len(name) == 1 or symbol.startswith("\\") else name.replace("_", " ")


def _law(element: Element) -> str:
    import sympy as sp

    law = element.law
    assert law is not None
    matrix = law.coefficients
    if law.ports > 1 or (law.takes and matrix is None):
        return ""
    expression = law.expressions[0] if matrix is None else matrix[0, 0]
    if law.takes and (law.gives, law.takes) not in LINEAR:
        expression = 1 / expression
    swap = {s: sp.Symbol(_reading(s.name)) for s in law.reads}
    expression = expression.xreplace(swap)
    if len(str(expression)) > LONGEST_LAW:
        return ""
    text = str(sp.latex(expression, fold_short_frac=True, ln_notation=True))
    text = re.sub(r"(?<=[\w}]) (?=\\(sin|cos|tan|a?tan|operatorname)\b)", r"\\,", text)
    return text.replace(r"\left", "").replace(r"\right", "").replace(r"\operatorname", r"\mathrm")


def _reading(name: str) -> str:
    """Return how a reading is written in a label: a displacement and a flow by their junction's name."""
    variable, element, *port = name.split(".")
    index = "_".join([element, *port])
    return element if variable in ("q", "f") and not port else f"{variable}_{index}".replace("__", "_")


def _places(graph: Graph, boxes: dict[str, _Box]) -> dict[str, np.ndarray[Any, Any]]:
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
        low, high = _extent(spots, boxes)
        places |= {name: at - [low[0] - right, (low[1] + high[1]) / 2] for name, at in spots.items()}
        right += high[0] - low[0] + REACH
    return {e.name: places[e.name] for e in graph.elements}


def _piece(links: Any, boxes: dict[str, _Box]) -> dict[str, np.ndarray[Any, Any]]:
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
            wanted = REACH + _inside(unit, half[a]) + _inside(unit, half[b])
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


def _inside(unit: np.ndarray[Any, Any], half: np.ndarray[Any, Any]) -> float:
    """Return how far the box, rounded where it is nearly square, reaches from its centre in a direction."""
    if half.max() < 1.6 * half.min():
        return float(1.06 / np.linalg.norm(unit / half))
    with np.errstate(divide="ignore"):
        return float(np.min(half / np.maximum(np.abs(unit), 1e-12)))


def _extent(places: dict[str, np.ndarray[Any, Any]], boxes: dict[str, _Box]) -> tuple[Any, Any]:
    low = np.min([places[name] - boxes[name].half for name in places], axis=0)
    high = np.max([places[name] + boxes[name].half for name in places], axis=0)
    return low - MARGIN, high + MARGIN


def _draw_element(axes: Any, element: Element, at: np.ndarray[Any, Any], box: _Box) -> None:
    bold = "bold" if element.kind in JUNCTIONS else "normal"
    shift = (_measure(box.name, NAME_SIZE)[1] + 0.02) / 2 if box.name else 0.0
    options = {"ha": "center", "va": "center", "zorder": 5}
    axes.text(at[0], at[1] + shift, box.text, fontsize=SIZE, color=style.INK, fontweight=bold, **options)
    if box.name:
        below = at[1] + shift - (_measure(box.text, SIZE)[1] + _measure(box.name, NAME_SIZE)[1]) / 2 - 0.02
        axes.text(at[0], below, box.name, fontsize=NAME_SIZE, color=style.MUTED, **options)


def _draw_bond(axes: Any, bond: Bond, stroke: str, places: Any, boxes: Any, numbers: bool) -> None:
    tail, head, unit = _ends(bond.tail, bond.head, places, boxes)
    normal = np.array([-unit[1], unit[0]])
    side = _side(normal)
    line = {"color": style.INK, "linewidth": 1.1, "solid_capstyle": "round", "zorder": 3}
    _segment(axes, tail, head, **line)
    barb = head - BARB * (math.cos(BARB_ANGLE) * unit - math.sin(BARB_ANGLE) * side * normal)
    _segment(axes, head, barb, **line)
    end = head if stroke == HEAD else tail
    _segment(axes, end - STROKE / 2 * normal, end + STROKE / 2 * normal, **{**line, "linewidth": 1.8})
    if numbers:
        at = (tail + head) / 2 - side * normal * 0.09
        options = {"ha": "center", "va": "center", "zorder": 4, "path_effects": style.halo()}
        axes.text(*at, str(bond.number), fontsize=NUMBER_SIZE, color=style.BRANCHES[0], **options)


def _side(normal: np.ndarray[Any, Any]) -> float:
    """Return the side of the barb: below a bond, or to the left of a steep one."""
    if abs(normal[1]) > 0.2:
        return -1.0 if normal[1] > 0 else 1.0
    return 1.0 if normal[0] < 0 else -1.0


def _ends(source: str, target: str, places: Any, boxes: Any, gap: float = 0.0) -> tuple[Any, Any, Any]:
    a, b = places[source], places[target]
    unit = (b - a) / np.linalg.norm(b - a)
    start = a + unit * (_inside(unit, boxes[source].half) + gap)
    return start, b - unit * (_inside(unit, boxes[target].half) + gap), unit


def _draw_signal(axes: Any, source: str, target: str, places: Any, boxes: Any) -> None:
    """Draw an activated bond: a thin dashed full arrow, bowed so that it keeps off the bonds."""
    from matplotlib.patches import FancyArrowPatch

    start, end, _ = _ends(source, target, places, boxes, 0.02)
    axes.add_patch(
        FancyArrowPatch(
            tuple(start),
            tuple(end),
            arrowstyle="-|>",
            connectionstyle="arc3,rad=0.22",
            mutation_scale=7,
            linewidth=0.7,
            linestyle=(0, (4, 2)),
            color=style.BRANCHES[1],
            zorder=1,
            shrinkA=0,
            shrinkB=0,
        )
    )


def _segment(axes: Any, start: Any, end: Any, **line: Any) -> None:
    axes.plot([start[0], end[0]], [start[1], end[1]], **line)
