"""Drawing of a bond graph: half-arrows, causal strokes, numbers, dashed signals, placed by networkx.

The unit of the drawing is the inch, so that type and strokes keep their size however large the graph is.
"""

from __future__ import annotations

import math
import re
from typing import Any

import numpy as np

from ..bondgraph.causality import HEAD, Causality
from ..bondgraph.elements import JUNCTIONS, Element
from ..bondgraph.graph import Bond
from ..bondgraph.laws import LINEAR
from . import style
from .bond_room import Box, ends, extent, places_of
from .bond_signals import signal_paths

SIZE, NAME_SIZE, NUMBER_SIZE = 11.0, 7.0, 7.0
BARB, BARB_ANGLE = 0.11, math.radians(38)
STROKE = 0.15
GAP = 0.07
LONGEST_LAW = 26


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
        places = places_of(graph, boxes)
        signals = signal_paths(graph, places, boxes)
        low, high = extent(places, boxes, signals)
        if figure is None:
            figure = style.new_figure(*(high - low))
            figure.set_layout_engine("none")
        axes = figure.add_axes((0, 0, 1, 1))
        axes.set_axis_off()
        axes.set_xlim(low[0], high[0])
        axes.set_ylim(low[1], high[1])
        axes.set_aspect("equal")
        for path in signals:
            _draw_signal(axes, path)
        for bond, stroke in zip(graph.bonds, found.strokes, strict=True):
            _draw_bond(axes, bond, stroke, places, boxes, numbers)
        for element in graph.elements:
            _draw_element(axes, element, places[element.name], boxes[element.name])
        return figure


def _box(element: Element, names: bool) -> Box:
    text, name = _label(element), ""
    if element.kind in JUNCTIONS and names:
        name = _told(element.name)
    width, height = _measure(text, SIZE)
    if name:
        name_width, name_height = _measure(name, NAME_SIZE)
        width, height = max(width, name_width), height + name_height + 0.02
    half = np.array([width / 2 + GAP, height / 2 + GAP])
    return Box(text, name, np.maximum(half, 0.19) if element.kind in JUNCTIONS else half)


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


def _draw_element(axes: Any, element: Element, at: np.ndarray[Any, Any], box: Box) -> None:
    bold = "bold" if element.kind in JUNCTIONS else "normal"
    shift = (_measure(box.name, NAME_SIZE)[1] + 0.02) / 2 if box.name else 0.0
    options = {"ha": "center", "va": "center", "zorder": 5}
    axes.text(at[0], at[1] + shift, box.text, fontsize=SIZE, color=style.INK, fontweight=bold, **options)
    if box.name:
        below = at[1] + shift - (_measure(box.text, SIZE)[1] + _measure(box.name, NAME_SIZE)[1]) / 2 - 0.02
        axes.text(at[0], below, box.name, fontsize=NAME_SIZE, color=style.MUTED, **options)


def _draw_bond(axes: Any, bond: Bond, stroke: str, places: Any, boxes: Any, numbers: bool) -> None:
    tail, head, unit = ends(bond.tail, bond.head, places, boxes)
    normal = np.array([-unit[1], unit[0]])
    side = _side(normal)
    line = {"color": style.INK, "linewidth": 1.1, "solid_capstyle": "round", "zorder": 3}
    _segment(axes, tail, head, **line)
    barb = head - BARB * (math.cos(BARB_ANGLE) * unit - math.sin(BARB_ANGLE) * side * normal)
    _segment(axes, head, barb, **line)
    stroke_at = head if stroke == HEAD else tail
    _segment(axes, stroke_at - STROKE / 2 * normal, stroke_at + STROKE / 2 * normal, **{**line, "linewidth": 1.8})
    if numbers:
        at = (tail + head) / 2 - side * normal * 0.09
        options = {"ha": "center", "va": "center", "zorder": 4, "path_effects": style.halo()}
        axes.text(*at, str(bond.number), fontsize=NUMBER_SIZE, color=style.BRANCHES[0], **options)


def _side(normal: np.ndarray[Any, Any]) -> float:
    """Return the side of the barb: below a bond, or to the left of a steep one."""
    if abs(normal[1]) > 0.2:
        return -1.0 if normal[1] > 0 else 1.0
    return 1.0 if normal[0] < 0 else -1.0


def _draw_signal(axes: Any, path: np.ndarray[Any, Any]) -> None:
    """Draw an activated bond: a thin dashed full arrow."""
    from matplotlib.patches import FancyArrowPatch
    from matplotlib.path import Path

    color = style.BRANCHES[1]
    options: dict[str, Any] = {"color": color, "linewidth": 0.7, "zorder": 1}
    axes.plot(*path[:-2].T, linestyle=(0, (4, 2)), **options)
    head = Path([path[-4], path[-1]])
    axes.add_patch(FancyArrowPatch(path=head, arrowstyle="-|>", mutation_scale=7, shrinkA=0, shrinkB=0, **options))


def _segment(axes: Any, start: Any, end: Any, **line: Any) -> None:
    axes.plot([start[0], end[0]], [start[1], end[1]], **line)
