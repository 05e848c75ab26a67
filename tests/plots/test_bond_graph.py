"""Drawings of bond graphs: everything is on them, in its place and legible."""

from __future__ import annotations

import numpy as np
import pytest

from ucrit import bonds, find_model, plot
from ucrit.analyses.bonds import stating
from ucrit.bondgraph import Graph, I, R, causality, graph_of, one
from ucrit.plots import bond_graph as drawing
from ucrit.plots.bond_layout import places_of

NAMES = stating()


def laid_out(graph):
    boxes = {e.name: drawing._box(e, True) for e in graph.elements}
    return boxes, places_of(graph, boxes)


@pytest.mark.parametrize("name", NAMES)
def test_labels_keep_off_each_other_and_bonds_have_length(name):
    graph = graph_of(find_model(name))
    boxes, places = laid_out(graph)
    names = list(boxes)
    for i, a in enumerate(names):
        for b in names[i + 1 :]:
            gap = np.abs(places[a] - places[b]) - boxes[a].half - boxes[b].half
            assert gap.max() > 0, f"{a} and {b} overlap"
    for bond in graph.bonds:
        tail, head, _ = drawing._ends(bond.tail, bond.head, places, boxes)
        assert 0.4 < np.linalg.norm(head - tail) < 4, f"bond {bond}"


def test_every_bond_has_its_line_barb_stroke_and_number():
    found = bonds("trailer")
    figure = plot(found)
    (axes,) = figure.axes
    assert len(axes.lines) == 3 * len(found.rows)
    texts = [text.get_text() for text in axes.texts]
    assert {str(row.number) for row in found.rows} <= set(texts)
    assert r"TF : $a + b$" in texts
    assert len(axes.patches) == len(found.graph.signals)


def test_the_stroke_stands_where_the_effort_acts():
    graph = Graph(one("x"), I("mass", 1), R("drag", 1), "x -> mass", "x -> drag")
    found = causality(graph)
    figure = drawing.plot_bond_graph(found)
    boxes, places = laid_out(graph)
    for bond, stroke, line in zip(graph.bonds, found.strokes, figure.axes[0].lines[2::3], strict=True):
        middle = np.mean(line.get_xydata(), axis=0)
        ends = drawing._ends(bond.tail, bond.head, places, boxes)
        assert np.allclose(middle, ends[1] if stroke == "head" else ends[0])
    assert found.strokes == ("head", "tail")


def test_names_and_numbers_can_be_left_out():
    figure = drawing.plot_bond_graph(bonds("oscillator").causality, numbers=False, names=False)
    assert sorted(text.get_text() for text in figure.axes[0].texts) == ["1", "C : $1 / k$", "I : $m$", "R : $b$"]
