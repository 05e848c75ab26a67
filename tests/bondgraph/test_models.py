"""Bond graphs of the catalogue against Lagrange's and Newton's equations, and models stated by a graph alone."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import sympy as sp

from ucrit import ModelError, UcritError, bonds, check, critical, find_model, input, load, param, power_flow, simulate
from ucrit.bondgraph import TF, BondGraphModel, C, Graph, I, R, Se, equations, graph_of, one, q
from ucrit.bondgraph.equations import state_equations
from ucrit.checks.bonds import bond_graph_in_motion
from ucrit.checks.report import FailedCheckError
from ucrit.checks.subject import Subject
from ucrit.core.derivation.characteristic import characteristic_polynomial
from ucrit.core.derivation.derive import symbolic
from ucrit.core.formulas.functions import tanh
from ucrit.models.car import Car
from ucrit.models.caster_flexible_sidewall import CasterFlexibleSidewall
from ucrit.models.caster_relaxation import CasterRelaxation
from ucrit.models.oscillator import Oscillator
from ucrit.models.rigid_body import RigidBody

CASES = ["trailer", "car", "airplane-plane", "caster", "caster-flexible-sidewall", "wheelset", "rigid-body-plane"]


def momentum_polynomial(model, basic=None):
    """Return the characteristic polynomial of a graph's own state equations about rest, in symbols."""
    found = state_equations(graph_of(model))
    inputs = symbolic(model).traced.u
    rest = dict.fromkeys((*found.symbols, *inputs), sp.S.Zero) | (basic or {})
    A = sp.Matrix(found.rates).jacobian(sp.Matrix(found.symbols)).xreplace(rest)
    return characteristic_polynomial((-A.applyfunc(sp.simplify), sp.eye(A.rows)), "graph")


def trimmed(coefficients):
    while coefficients and coefficients[0] == 0:
        coefficients = coefficients[1:]
    return coefficients


@pytest.mark.parametrize("name", CASES)
def test_momenta_and_velocities_have_one_polynomial_in_symbols(name):
    model = find_model(name)
    speed = {sp.Symbol("p_mass_U", real=True): sp.prod(sp.symbols("m U_0", positive=True))}
    one = trimmed(list(momentum_polynomial(model, speed if name == "rigid-body-plane" else None).expressions))
    other = trimmed(list(symbolic(model).polynomial.expressions))
    assert len(one) == len(other)
    assert all(sp.expand(a * other[-1] - b * one[-1]) == 0 for a, b in zip(one, other, strict=True))


def test_equations_of_motion_are_newtons_symbol_by_symbol():
    """Euler's junction structures give equations (2.17) and (2.19) term by term, with the full tensor."""
    from ucrit.core.derivation.trace import trace

    graph, newton = (trace(RigidBody, None, how).residuals for how in ("equations_bond_graph", ""))
    assert all(sp.expand(a - b) == 0 for a, b in zip(graph, newton, strict=True))


def test_a_sidewall_is_a_relaxation_length():
    sidewall = momentum_polynomial(CasterFlexibleSidewall).expressions
    C, sigma = sp.symbols("C sigma", positive=True)
    swap = {sp.Symbol("k_s", positive=True): C / sigma}
    lag = symbolic(CasterRelaxation).polynomial.expressions
    ratios = {sp.simplify(a.xreplace(swap) / b) for a, b in zip(sidewall, lag, strict=True)}
    assert len(ratios) == 1


def test_rigid_wheels_make_dependent_masses():
    found = bonds("trailer-rigid-tire")
    told = " ".join(found.findings)
    assert "I 'mass_left' (bond 10) is in derivative causality: its momentum follows from I 'spin'" in told
    assert "I 'mass_ahead' (bond 11) is in derivative causality" in told
    assert "algebraic loop" not in told
    assert found.balanced


def test_a_wrong_graph_is_found_out():
    class Wrong(Oscillator):
        """Oscillator whose graph pushes the wrong way (Nobody 2000, nowhere)."""

        def bond_graph(self):
            return Graph(
                one("x"), I("mass", self.m), C("spring", effort=lambda x: -self.k * x), R("damper", self.b),
                "x -> mass", "x -> spring", "x -> damper",
            )  # fmt: skip

    failed = {c.name for c in check(Wrong).checks if c.passed is False}
    assert {"further derivations", "bond graph"} <= failed


def other_graph(base, graph):
    """Return what a check says of a model with another model's graph."""

    class Apart(base):
        """Model with another graph (Nobody 2000, nowhere)."""

        bond_graph = graph

    return {c.name: c.detail for c in check(Apart).checks if c.passed is False}["further derivations"]


def test_a_graph_that_shares_nothing_with_its_model_is_told():
    def away(self):
        return Graph(one("y"), I("mass", self.m), "y -> mass")

    def lateral(self):
        return Graph(one("V"), I("mass", self.m), "V -> mass")

    def nonlinear(self):
        return Graph(one("x"), I("mass", self.m), R("r", q("y")), one("y"), "x -> mass", "y -> r")

    assert "named like a variable of the model settles the flow of I 'mass'" in other_graph(Oscillator, away)
    assert "the bond graph gives 1 equations for 2 variables" in other_graph(Car, lateral)
    assert "the bond graph reads q_y, and 'y' is no coordinate" in other_graph(Oscillator, nonlinear)


class Rubbing(BondGraphModel):
    """Mass on a hardening spring with dry friction, pushed (Nobody 2000, nowhere)."""

    m: float = param("kg", "mass", above=0)
    k: float = param("N/m", "stiffness", above=0)
    h: float = param("N/m^3", "hardening", at_least=0)
    F_0: float = param("N", "friction", at_least=0)
    v_0: float = param("m/s", "velocity at which friction is fully there", above=0)

    F = input("N", "push")

    def bond_graph(self, u):
        return Graph(
            one("x"),
            I("mass", self.m),
            C("spring", effort=lambda z: self.k * z + self.h * z**3),
            R("friction", effort=lambda v: self.F_0 * tanh(v / self.v_0)),
            Se("push", u.F),
            "push -> x -> mass",
            "x -> spring",
            "x -> friction",
        )


def test_power_balances_in_simulation():
    vehicle = Rubbing(m=2, k=30, h=50, F_0=1, v_0=0.2)
    times = np.linspace(0, 4, 2001)
    flow = power_flow(simulate(vehicle, 4, {"q_spring": 0.5}, {"F": lambda t: np.sin(3 * t)}, times=times))
    assert flow.imbalance < 1e-8
    assert np.ptp(flow.energy) > 1
    assert flow.powers.shape == (2001, 4)
    assert (flow.dissipated >= 0).all()


def test_an_imbalance_is_seen():
    vehicle = Rubbing(m=2, k=30, h=50, F_0=1, v_0=0.2)
    flow = power_flow(simulate(vehicle, 4, {"q_spring": 0.5}))
    assert replace(flow, dissipated=1.01 * flow.dissipated).imbalance > 1e-3


def test_powers_need_a_graph_and_one_motion():
    with pytest.raises(UcritError, match="bowling-ball states no bond graph"):
        power_flow(simulate(load("bowling-ball-on-a-stick"), 1))
    with pytest.raises(UcritError, match="powers are told of one motion"):
        power_flow(simulate(load("driven-mass", {"m": [1, 2]}), 1))


def in_motion(model):
    """Return what the check along simulated motions says of a model; raise where it fails."""
    return bond_graph_in_motion(Subject.of(model, 0, None))


@pytest.mark.parametrize("name", ["satellite", "caster-flexible-sidewall", "trailer-rigid-tire", "wheelset"])
def test_elements_do_what_they_state_along_the_models_own_motion(name):
    assert "the energy changes by what comes in" in in_motion(find_model(name))


@pytest.mark.parametrize("name", ["hitch", "mass_ahead", "damper", "axle_x", "tire", "speed"])
def test_any_wrong_element_is_found_along_a_motion(name):
    trailer = find_model("trailer")

    class Wrong(trailer):
        """Trailer with a graph in which one element is a tenth too large (Nobody 2000, nowhere)."""

        def bond_graph(self):
            graph = trailer.bond_graph(self)
            swap = {e: replace(e, law=scaled(e.law)) if e.name == name else e for e in graph.elements}
            return Graph(*swap.values(), *(f"{b.tail} -> {b.head}" for b in graph.bonds))

    with pytest.raises(FailedCheckError, match="the energy of the stores is not what sources give"):
        in_motion(Wrong)


def scaled(law):
    return replace(law, expressions=tuple(sp.Rational(11, 10) * x for x in law.expressions))


@pytest.mark.parametrize(
    ("kind", "sentence"),
    [
        ("_two_port", "TF 'lever' does not do what it states"),
        ("_resistance", "R 'damper' does not do what it states"),
    ],
)
def test_a_wrong_derivation_is_found_along_a_motion(monkeypatch, kind, sentence):
    from ucrit.bondgraph import assignments

    def wrong(work, element, bonds, inward):
        before = dict(work.of)
        right(work, element, bonds, inward)
        first = next(symbol for symbol in work.of if symbol not in before)
        work.of[first] *= sp.Rational(11, 10)

    class Levered(BondGraphModel):
        """Mass on a lever with a damper and a spring (Nobody 2000, nowhere)."""

        m: float = param("kg", "mass", above=0)
        k: float = param("N/m", "stiffness", above=0)
        c: float = param("N s/m", "damping", above=0)
        n: float = param("1", "leverage", above=0)

        def bond_graph(self):
            return Graph(
                one("x"), one("y"), I("mass", self.m), C("spring", 1 / self.k), R("damper", self.c),
                TF("lever", self.n),
                "x -> mass", "x -> lever -> y -> spring", "y -> damper",
            )  # fmt: skip

    right = getattr(assignments, kind)
    caches = (equations.assembled, equations.state_equations)
    monkeypatch.setattr(assignments, kind, wrong)
    for cached in caches:
        cached.cache_clear()
    try:
        with pytest.raises(FailedCheckError, match=sentence):
            in_motion(Levered)
    finally:
        for cached in caches:
            cached.cache_clear()


def test_a_model_of_a_graph_has_every_analysis():
    class Swaying(BondGraphModel):
        """Trailer, stated by its bond graph alone (Karnopp 2004, figure A.2)."""

        locals().update(find_model("trailer").declaration.parameters)
        bond_graph = find_model("trailer").bond_graph
        tire_bonds = find_model("trailer").tire_bonds
        tire_force = find_model("trailer").tire_force

    caravan = load("caravan")
    swaying = Swaying(**caravan.values)
    assert critical(swaying)[0].value == pytest.approx(critical(caravan)[0].value, rel=1e-9)
    report = check(Swaying)
    assert report.ok, str(report)


def cubic(self):
    return Graph(one("x"), I("mass", momentum=lambda v: v**3), "x -> mass")


def lone(self):
    return Graph(one("x"), I("mass", self.n), "x -> mass")


def unitless(self):
    return Graph(one("x"), I("mass", self.n), R("r", 1), "x -> mass", "x -> r")


@pytest.mark.parametrize(
    ("graph", "sentence"),
    [
        (lambda self: None, "bond_graph must return a Graph, got NoneType"),
        (lambda self, w: None, "Wrong.bond_graph: there is no argument 'w'; allowed: u"),
        (cubic, "I 'mass': its law gives momentum and cannot be solved for flow"),
        (unitless, "the law of R 'r' is a number without a unit, make it a parameter"),
        (lone, "the unit of p_mass does not follow from the graph; declare it by state()"),
    ],
)
def test_a_wrong_graph_model_is_told(graph, sentence):
    with pytest.raises(ModelError) as caught:
        type("Wrong", (BondGraphModel,), {"n": param("1", "number", above=0), "bond_graph": graph})
    assert sentence in str(caught.value)


def test_a_graph_of_another_motion_is_not_shown():
    with pytest.raises(UcritError, match="satellite-damped states no bond graph"):
        bonds("satellite-damped")
    with pytest.raises(UcritError, match="did you mean 'trailer'"):
        bonds("trailr")
