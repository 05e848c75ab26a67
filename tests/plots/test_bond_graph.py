"""Drawings of bond graphs: everything is on them, in its place and legible."""

from __future__ import annotations

import numpy as np
import pytest

from ucrit import bonds, find_model, plot
from ucrit.bondgraph import Graph, I, R, causality, graph_of, one
from ucrit.plots import bond_graph as drawing
from ucrit.plots.bond_room import ends, places_of, touches
from ucrit.plots.bond_signals import signal_paths

SHAPES = ["car", "trailer", "caster-flexible-sidewall", "airplane-plane", "rigid-body", "satellite", "wheelset"]


def laid_out(graph):
    boxes = {e.name: drawing._box(e, True) for e in graph.elements}
    return boxes, places_of(graph, boxes)


@pytest.mark.parametrize("name", SHAPES)
def test_labels_keep_off_each_other_and_bonds_have_length(name):
    graph = graph_of(find_model(name))
    boxes, places = laid_out(graph)
    names = list(boxes)
    for i, a in enumerate(names):
        for b in names[i + 1 :]:
            gap = np.abs(places[a] - places[b]) - boxes[a].half - boxes[b].half
            assert gap.max() > 0, f"{a} and {b} overlap"
    for bond in graph.bonds:
        tail, head, _ = ends(bond.tail, bond.head, places, boxes)
        assert 0.4 < np.linalg.norm(head - tail) < 4, f"bond {bond}"
        for other in set(names) - {bond.tail, bond.head}:
            assert not touches(tail, head, places[other], boxes[other].half), f"bond {bond} on {other}"


@pytest.mark.parametrize("name", SHAPES[:4])
def test_plane_graphs_are_drawn_straight_and_without_crossings(name):
    graph = graph_of(find_model(name))
    boxes, places = laid_out(graph)
    lines = [ends(b.tail, b.head, places, boxes)[:2] for b in graph.bonds]
    for i, (a, b) in enumerate(lines):
        for c, d in lines[i + 1 :]:
            turns = [np.linalg.det([q - p, r - p]) for p, q, r in ((a, b, c), (a, b, d), (c, d, a), (c, d, b))]
            assert turns[0] * turns[1] > -1e-9 or turns[2] * turns[3] > -1e-9
    along = sum(bool(np.isclose(a, b).any()) for a, b in lines)
    assert along >= 0.7 * len(lines)


def test_signals_keep_off_labels():
    graph = graph_of(find_model("trailer"))
    boxes, places = laid_out(graph)
    pairs = list(dict.fromkeys((s.source, s.target) for s in graph.signals))
    for path, pair in zip(signal_paths(graph, places, boxes), pairs, strict=True):
        for name, box in boxes.items():
            on = (np.abs(path - places[name]) < box.half - 0.05).all(axis=1)
            assert name in pair or on.mean() < 0.1


def test_a_drawing_is_the_same_each_time():
    from ucrit.plots import bond_layout

    graph = graph_of(find_model("oscillator"))
    first = bond_layout.grid_places(graph)
    bond_layout._piece_places.cache_clear()
    assert bond_layout.grid_places(graph) == first


def test_unconnected_pieces_stand_side_by_side():
    graph = Graph(one("x"), one("y"), I("m", 1), I("n", 2), "x -> m", "y -> n")
    _, places = laid_out(graph)
    assert len({tuple(at) for at in places.values()}) == 4


def test_every_bond_has_its_line_barb_stroke_and_number():
    found = bonds("trailer")
    figure = plot(found)
    (axes,) = figure.axes
    pairs = {(s.source, s.target) for s in found.graph.signals}
    assert len(axes.lines) == 3 * len(found.rows) + len(pairs)
    texts = [text.get_text() for text in axes.texts]
    assert {str(row.number) for row in found.rows} <= set(texts)
    assert r"TF : $a + b$" in texts
    assert len(axes.patches) == len(pairs)


def test_the_stroke_stands_where_the_effort_acts():
    graph = Graph(one("x"), I("mass", 1), R("drag", 1), "x -> mass", "x -> drag")
    found = causality(graph)
    figure = drawing.plot_bond_graph(found)
    boxes, places = laid_out(graph)
    for bond, stroke, line in zip(graph.bonds, found.strokes, figure.axes[0].lines[2::3], strict=True):
        middle = np.mean(line.get_xydata(), axis=0)
        meets = ends(bond.tail, bond.head, places, boxes)
        assert np.allclose(middle, meets[1] if stroke == "head" else meets[0])
    assert found.strokes == ("head", "tail")


def test_names_and_numbers_can_be_left_out():
    figure = drawing.plot_bond_graph(bonds("oscillator").causality, numbers=False, names=False)
    assert sorted(text.get_text() for text in figure.axes[0].texts) == ["1", "C : $1 / k$", "I : $m$", "R : $b$"]


def test_many_elements_at_one_junction_find_room():
    count = 30
    graph = Graph(one("x"), *(part for k in range(count) for part in (R(f"r{k}", 1), f"x -> r{k}")))
    _boxes, places = laid_out(graph)
    assert len({tuple(at.round(3)) for at in places.values()}) == count + 1
    assert all(np.isfinite(at).all() for at in places.values())
