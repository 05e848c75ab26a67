"""State equations with answers known in closed form: dependent stores, loops, gyrators, fields, laws, sources."""

from __future__ import annotations

import pytest
import sympy as sp

from ucrit import ModelError
from ucrit.bondgraph import GY, TF, C, Graph, I, R, Se, Sf, e, f, one, p, q, zero
from ucrit.bondgraph.equations import state_equations
from ucrit.bondgraph.power import power_balance

m, M, n, k, c, r, F = sp.symbols("m M n k c r F", positive=True)


def rate(graph, state, inputs=()):
    found = state_equations(graph, inputs)
    return sp.simplify(found.rates[found.states.index(state)])


def test_masses_on_a_lever_move_as_one():
    graph = Graph(
        one("x"), I("near", m), TF("lever", n), one("y"), I("far", M), Se("push", F), "x -> near", "x -> lever -> y",
        "y -> far", "push -> x",
    )  # fmt: skip
    found = state_equations(graph)
    assert sp.simplify(found.rates[0] - F * m / (m + n**2 * M)) == 0
    (dependence,) = found.dependences
    assert str(dependence) == "I 'far' (bond 4) is in derivative causality: its momentum follows from I 'near'; solved"
    assert sp.simplify(dependence.state - M * n * found.symbols[0] / m) == 0
    assert power_balance(found).conserved


def test_springs_in_parallel_share_their_force_by_stiffness():
    graph = Graph(zero("a"), C("soft", 1 / k), C("hard", c), Sf("pull", F), "pull -> a", "a -> soft", "a -> hard")
    assert rate(graph, "q_soft") == sp.simplify(F / (k * (c + 1 / k)))


def test_a_loop_of_resistances_is_solved_and_told():
    graph = Graph(
        one("x"), Se("push", F), R("r1", r), zero("z"), R("r2", c), one("y"), R("r3", n), I("mass", m),
        "push -> x -> r1", "x -> z -> r2", "z -> y -> mass", "y -> r3",
    )  # fmt: skip
    found = state_equations(graph)
    v = found.symbols[0] / m
    assert sp.simplify(found.rates[0] - (c * (F - r * v) / (r + c) - n * v)) == 0
    (loop,) = found.loops
    assert loop.bonds == (2, 3, 4)
    assert "R 'r1', R 'r2'" in str(loop)


def test_a_loop_that_may_have_several_solutions_is_refused():
    graph = Graph(
        one("x"), Se("push", F), R("r1", r), R("r2", effort=lambda v: k * v**3 + c * v), "push -> x -> r1", "x -> r2"
    )
    with pytest.raises(ModelError, match="cannot be solved"):
        state_equations(graph)


def test_a_motor_turns_current_into_torque():
    graph = Graph(
        one("i"), I("coil", m), R("wire", r), GY("motor", k), one("w"), I("rotor", M), R("air", c), Se("battery", F),
        "battery -> i -> coil", "i -> wire", "i -> motor -> w -> rotor", "w -> air",
    )  # fmt: skip
    found = state_equations(graph)
    flux, spin = found.symbols
    assert sp.simplify(found.rates[0] - (F - r * flux / m - k * spin / M)) == 0
    assert sp.simplify(found.rates[1] - (k * flux / m - c * spin / M)) == 0


def test_fields_couple_their_ports():
    inertia, stiffness = sp.Matrix([[3, 1], [1, 2]]), sp.Matrix([[5, -2], [-2, 4]])
    drag = sp.Matrix([[2, 1], [0, 1]])
    graph = Graph(
        one("x"), one("y"), I("body", inertia), C("mount", stiffness.inv()), R("drag", drag),
        *(f"{a} -> {b}" for b in ("body", "mount", "drag") for a in "xy"),
    )  # fmt: skip
    found = state_equations(graph)
    A = sp.Matrix(found.rates).jacobian(sp.Matrix(found.symbols))
    expected = sp.Matrix([[-drag * inertia.inv(), -stiffness], [inertia.inv(), sp.zeros(2, 2)]])
    assert found.states == ("p_body_1", "p_body_2", "q_mount_1", "q_mount_2")
    assert expected == A
    assert power_balance(found).conserved


def test_a_field_with_one_port_in_each_causality():
    graph = Graph(
        one("x"), one("y"), I("body", [[3, 1], [1, 2]]), Sf("drive", 4), "x -> body", "y -> body", "drive -> y"
    )
    found = state_equations(graph)
    assert found.states == ("p_body_1",)
    assert found.rates == (0,)
    assert found.flows[0] == found.symbols[0] / 3 - sp.Rational(4, 3)


def test_laws_that_are_not_linear_integrate_to_an_energy():
    graph = Graph(
        one("x"), I("fast", flow=lambda p: p / sp.sqrt(m**2 + p**2)), C("hard", effort=lambda z: k * z + z**3),
        "x -> fast", "x -> hard",
    )  # fmt: skip
    found = state_equations(graph)
    balance = power_balance(found)
    assert balance.conserved
    assert sp.simplify(sp.diff(balance.energy, found.symbols[0]) - found.flows[0]) == 0


def test_what_laws_can_read():
    graph = Graph(
        one("x"), zero("y"), I("mass", m), C("spring", c), R("r1", r + f("x") ** 2 + p("mass") ** 2),
        R("r2", 1 + q("x") ** 2 + e("y") ** 2 + q("spring") ** 2),
        "x -> mass", "x -> r1", "x -> y -> spring", "y -> r2",
    )  # fmt: skip
    found = state_equations(graph)
    momentum, spring, total = found.symbols
    resistance = 1 + total**2 + (spring / c) ** 2 + spring**2
    assert found.states == ("p_mass", "q_spring", "q_x")
    assert sp.simplify(found.rates[1] - (momentum / m - spring / c / resistance)) == 0
    assert found.rates[2] == momentum / m


@pytest.mark.parametrize(
    ("parts", "sentence"),
    [
        ((), "there is no element"),
        ((one("x"),), "1-junction 'x': no bond leads to it"),
        ((one("x"), one("x")), "two elements are called 'x'"),
        ((one("x"), I("mass", 1), "x -> mas"), "bond 1: x -> mas: there is no element 'mas'; did you mean 'mass'?"),
        ((one("x"), "x -> x"), "bond 1: x -> x: it joins an element to itself"),
        ((one("x"), I("mass", 1), "mass -> x"), "I 'mass': bond 1: mass -> x must lead to it"),
        ((one("x"), TF("t", 2), "x -> t"), "TF 't': one bond must lead to it and one away from it, it has bonds 1"),
        ((one("x"), I("mass", [[1, 0], [0, 1]]), "x -> mass"), "I 'mass': its law has 2 ports, it has bonds 1"),
        ((one("x"), R("r", f("y")), "x -> r"), "MR 'r' reads f.y: there is no element 'y'"),
        ((one("x"), R("r", e("x")), "x -> r"), "MR 'r' reads e.x: of 1-junction 'x', f and q can be read"),
        ((one("x"), R("r", 1), I("m", 1), TF("t", p("m", 2)), one("y"), "x -> t -> y -> m", "x -> r"),
         "MTF 't' reads p.m.2: I 'm' has 1 port, write p.m"),
        ((one("x"), R("r", 1), R("s", f("t")), TF("t", 2), one("y"), "x -> t -> y -> s", "x -> r"),
         "MR 's' reads f.t: of TF 't', nothing can be read"),
        ((zero("x"), Se("a", 1), Se("b", 2), "a -> x", "b -> x"),
         "causal conflict: Se 'a' and Se 'b' ask for opposite causalities of bond 2: b -> x"),
        ((one("x"), Sf("a", 1), TF("t", 2), one("y"), Sf("b", 2), "a -> x -> t -> y", "b -> y"),
         "causal conflict: Sf 'a' and Sf 'b' ask for opposite causalities of bond 4: b -> y"),
        ((one("x"), TF("t", 0), one("y"), R("r", 1), Se("a", 1), "a -> x -> t -> y -> r"),
         "TF 't': its ratio is zero, so that it would pass on nothing; leave it out"),
        ((one("x"), R("r", effort=lambda v: v**3 - v), Se("a", 1), "a -> x -> r"),
         "R 'r': its law gives effort and cannot be solved for flow"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_told(parts, sentence):
    with pytest.raises(ModelError) as caught:
        state_equations(Graph(*parts))
    assert sentence in str(caught.value)


@pytest.mark.parametrize(
    ("wrong", "sentence"),
    [
        (lambda: Graph(one("x"), "x y"), "a bond such as 'a -> b', got 'x y'"),
        (lambda: Graph(3), "got 3"),
        (lambda: I("mass"), "state its law once, by a number, a matrix or momentum=... or flow=..."),
        (lambda: C("spring", 1, effort=lambda z: z), "state its law once"),
        (lambda: R("r", [[1, 2]]), "a field needs a square matrix, got 1 rows and 2 columns"),
        (lambda: one("1st"), "a name is made of letters"),
    ],
)
def test_what_cannot_be_built_is_told(wrong, sentence):
    with pytest.raises(ModelError) as caught:
        wrong()
    assert sentence in str(caught.value)


def test_a_dependent_store_cannot_follow_an_input():
    speed = sp.Symbol("v", real=True)
    graph = Graph(one("x"), Sf("drive", speed), I("mass", m), "drive -> x -> mass")
    with pytest.raises(ModelError, match=r"I 'mass' .bond 2. is in derivative causality and follows the input v"):
        state_equations(graph, (speed,))
    assert state_equations(graph).states == ()


@pytest.mark.parametrize("order", [1, -1])
def test_a_law_that_cannot_be_turned_round_has_its_way(order):
    stores = [I("fast", momentum=lambda v: v + v**3), I("mass", m)][::order]
    found = state_equations(Graph(one("x"), *stores, Se("push", F), "push -> x", "x -> fast", "x -> mass"))
    assert found.states == ("p_mass",)
    v = found.symbols[0] / m
    assert sp.simplify(found.rates[0] - F * m / (m + 1 + 3 * v**2)) == 0
