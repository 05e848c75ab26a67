"""Bond graphs as text: read, written, and every mistake told with its line."""

from __future__ import annotations

import pytest
import sympy as sp
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from ucrit import ModelError, critical, modes
from ucrit.analyses.about.bonds import stating
from ucrit.bondgraph import Graph, I, R, one
from ucrit.bondgraph.laws import reading
from ucrit.bondgraph.model import graph_of, model_from_text
from ucrit.bondgraph.text import read_graph, read_sheet
from ucrit.bondgraph.writing import write_graph, write_sheet
from ucrit.catalogue import find_model, find_part, load, part_names, tire_names
from ucrit.core.formulas.functions import length, where
from ucrit.parts.tires import Tire

SHEET = """title Mass on a spring with friction
param m [kg] above 0: mass
param k [N/m] above 0: stiffness
param F_0 [N] at_least 0 default 0: friction
param v_0 [m/s] above 0: velocity at which friction is fully there
input F [N]: force

1 x
I mass = m
C spring = 1/k
R friction: effort = F_0*tanh(flow/v_0)   # of the bearings
Se push = F
push -> x -> mass
x -> spring
x -> friction
"""


def test_a_sheet_is_a_model():
    model = model_from_text(SHEET, "Sheet")
    vehicle = model(m=2.0, k=8.0, v_0=0.1, F_0=0.4)
    units = {v.name: v.unit for v in model.declaration.variables.values()}
    assert units == {"p_mass": "N s", "q_spring": "m"}
    eigenvalue = modes(vehicle).list()[0].eigenvalue
    assert eigenvalue.real == pytest.approx(-1.0)
    assert abs(eigenvalue) == pytest.approx(2.0)


def test_a_sheet_is_written_as_it_was_read():
    model = model_from_text(SHEET, "Sheet")
    declared = model.declaration
    text = write_sheet(model.title(), declared.parameters, declared.inputs, graph_of(model))
    again = model_from_text(text, "Sheet")
    assert graph_of(again) == graph_of(model)
    assert again.declaration == declared


@pytest.mark.parametrize("name", stating())
def test_graphs_of_the_catalogue_are_read_back(name):
    graph = graph_of(find_model(name))
    laws = [x for element in graph.elements if element.law for x in element.law.expressions]
    names = {symbol.name: symbol for x in laws for symbol in x.free_symbols}
    assert read_graph(write_graph(graph), names) == graph


def test_the_sheet_of_a_model_has_its_critical_speed():
    trailer = load("caravan")
    declared = type(trailer).declaration
    text = write_sheet("Trailer", declared.parameters, declared.inputs, graph_of(type(trailer)))
    stated = model_from_text(text, "Trailer")(**trailer.values)
    assert critical(stated)[0].value == pytest.approx(critical(trailer)[0].value, rel=1e-9)


@pytest.mark.parametrize(
    ("line", "sentence"),
    [
        ("J mass = m", "a line begins with a kind of element or is a bond, got 'J'"),
        ("I mass m", "an element is written 'I name = number' or 'I name: effort = ...', got 'mass m'"),
        ("I mass = mm", "I 'mass': the formula 'mm' uses 'mm'; did you mean 'm'?"),
        ("I mass = m +", "the formula 'm +' cannot be read"),
        ("I mass: effort = m*flow", "I 'mass': its law is momentum = ... or flow = ..., numbered in a field"),
        ("I mass = [m, 0; 0]", "I 'mass': a field needs a square matrix, got [m, 0; 0]"),
        ("I mass = [m, 0; 0, m", "a matrix is written [a, b; c, d]"),
        ("Se push: effort = m", "Se 'push': write 'Se push = ...'"),
        ("1", "a 1-junction needs a name"),
        ("1 y", "1-junction 'y': no bond leads to it"),
        ("1 x", "there is an element 'x' in line 2 already"),
        ("R drag: effort = where(m, flow, 0)", "holds 'm' where a condition such as 'a < b' is needed"),
        ("R drag: effort = where(flow < 1, flow)", "holds 'flow < 1', which is no formula"),
        ("R drag: effort = max()", "gives max 0 values, which it does not take"),
        ("R drag = m/0", "the formula 'm/0' has no finite value"),
        ("R drag = 9**9**9", "holds a power of 387420489, which is too large"),
        ("TF lever = 0", "TF 'lever': no bond leads to it"),
        ("speed U over 3: speed", "there is no bound 'over'"),
        ("x -> nowhere", "bond 3: x -> nowhere: there is no element 'nowhere'"),
        ("x ->", "a bond is written 'a -> b', got 'x ->'"),
        ("R drag = f.z", "MR 'drag' reads f.z: there is no element 'z'"),
        ("param m [kg] above 0: mass", "'m' is declared twice"),
        ("param flow [m/s]: flow", "a quantity cannot be called 'flow', it stands for a variable of a law"),
        ("param n: number", "a quantity is declared by 'param m [kg]: meaning', got 'param n: number'"),
        ("param n [kgg]: number", "unit 'kgg': 'kgg' is not a coherent SI unit"),
        ("param n [kg] over 0: number", "there is no bound 'over'"),
        ("param n [kg] above zero: number", "above must be followed by a number, got 'zero'"),
        ("input u [N] above 0: force", "an input has no bounds, got 'above 0'"),
        ("speed U", "a speed is declared by 'speed U: forward speed'"),
    ],
)
def test_a_wrong_line_is_named(line, sentence):
    text = f"param m [kg] above 0: mass\n1 x\nI inert = m\nC spring = 1/m\nx -> inert\nx -> spring\n{line}\n"
    with pytest.raises(ModelError) as caught:
        read_graph(text, where="mine.bonds")
    assert str(caught.value).startswith("mine.bonds, line 7: ")
    assert sentence in str(caught.value)


def test_a_text_without_elements_is_refused():
    with pytest.raises(ModelError, match=r"mine.bonds: there is no element"):
        read_graph("# nothing\n", where="mine.bonds")


def test_a_law_without_a_name_in_the_text_form_is_refused():
    graph = Graph(one("x"), R("r", effort=lambda v: sp.erf(v)), "x -> r")
    with pytest.raises(ModelError, match=r"R 'r': the text form has no name for erf\(flow\)"):
        write_graph(graph)


@pytest.mark.parametrize("law", [name for name in (*part_names(Tire), *tire_names()) if not name.startswith("magic")])
def test_tires_that_saturate_are_read_back(law):
    graph = graph_of(find_model("trailer-handling").fitted(tire=find_part(law, Tire)))
    laws = [x for element in graph.elements if element.law for x in element.law.expressions]
    names = {symbol.name: symbol for x in laws for symbol in x.free_symbols}
    assert read_graph(write_graph(graph), names) == graph


TAKEN, READ, NUMBER = sp.Symbol("flow", real=True), reading("f", "x"), sp.Symbol("k", positive=True)
formulas = st.recursive(
    st.sampled_from([TAKEN, READ, NUMBER, sp.Integer(2), sp.Rational(3, 7)]),
    lambda inner: st.one_of(
        st.builds(sp.Add, inner, inner),
        st.builds(sp.Mul, inner, inner),
        st.builds(lambda f, x: f(x), st.sampled_from([sp.Abs, sp.sin, sp.atan, sp.tanh, sp.exp, sp.sign]), inner),
        st.builds(lambda f, x, y: f(x, y), st.sampled_from([sp.Min, sp.Max, length]), inner, inner),
        st.builds(
            lambda r, join, a, b, x, y: where(join(r(a, b), a < NUMBER), x, y),
            st.sampled_from([sp.Lt, sp.Le, sp.Gt, sp.Ge]),
            st.sampled_from([sp.And, sp.Or]),
            inner, inner, inner, inner,
        ),
    ),
    max_leaves=6,
)  # fmt: skip


@settings(max_examples=60, deadline=None, derandomize=True)
@given(formulas)
def test_any_law_is_read_back(law):
    assume(not law.has(sp.nan, sp.zoo, sp.oo, sp.I))
    graph = Graph(one("x"), I("mass", 1), R("r", effort=law), "x -> mass", "x -> r")
    found = read_graph(write_graph(graph), {"k": NUMBER})
    again, meant = (g.by_name["r"].law.expressions[0] for g in (found, graph))
    swap = {TAKEN: sp.Rational(3, 10), READ: sp.Rational(-7, 10), NUMBER: sp.Rational(11, 10)}
    assert again == meant or abs(sp.N((again - meant).xreplace(swap))) < 1e-12


def test_remarks_and_modulated_kinds_are_read():
    sheet = read_sheet("# only a remark\n1 x\nMSe push = f.x # pushes\npush -> x\nR r = 1\nx -> r")
    graph = sheet.graph({})
    assert graph.by_name["push"].label == "MSe"
    assert [s.source for s in graph.signals] == ["x"]
