"""Descriptions of models: formulas in three notations that say the same as the equations."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from html import unescape

import numpy as np
import pytest
import sympy as sp
from sympy.core.function import AppliedUndef

from ucrit import show
from ucrit.analyses.linear.pieces import named_pieces
from ucrit.catalogue import find_model, load
from ucrit.core.derivation.derive import symbolic
from ucrit.core.derivation.trace import Traced, written
from ucrit.core.errors import UcritError
from ucrit.core.numeric.compiled import coefficients

MODELS = ["car", "trailer", "caster", "trailer-kinematic", "wheelset-kinematic", "cart-inertial"]


@pytest.mark.parametrize("name", MODELS)
def test_tidied_equations_are_the_stated_ones(name: str) -> None:
    traced = symbolic(find_model(name)).traced
    values = _numbers(traced)
    primed = {s.name: sp.Symbol(s.name.replace("'", "_dot")) for s in values}
    for stated, formula in zip(traced.residuals, show(name).equations, strict=True):
        text = formula.text.replace("'", "_dot")
        read = sp.sympify(text, locals={s.name: s for s in primed.values()})
        swapped = read.subs({primed[s.name]: v for s, v in values.items()})
        assert abs(sp.N(swapped - stated.subs(values), 20)) < 1e-15


@pytest.mark.parametrize("name", ["caravan-steered-by-yaw-rate", "motorcycle-steered-at-both-ends"])
def test_law_put_into_the_vehicles_equations_gives_the_closed_loop(name: str) -> None:
    traced = symbolic(type(load(name))).traced
    told = written(traced)
    assert told.law
    values = _numbers(traced)
    for stated, residual in zip(told.residuals, traced.residuals, strict=True):
        assert abs(sp.N((_put_in(stated, told.definitions) - residual).subs(values), 20)) < 1e-15
    assert set(show(load(name)).definitions) == {s.name for s in told.definitions}


def test_repeated_pieces_of_long_equations_have_names() -> None:
    traced = symbolic(find_model("car-four-wheels")).traced
    told = written(traced).residuals
    found, pieces = named_pieces(told, ["p_1", "w"])
    assert pieces
    assert all(s.name.startswith("z_") for s in pieces)
    values = _numbers(traced)
    for short, residual in zip(found, told, strict=True):
        assert abs(_value(_put_in(short, pieces), values) - _value(residual, values)) < 1e-12
    longest = max(len(f.text) for f in show("car-four-wheels").equations)
    assert longest < max(len(str(e)) for e in told) / 10


def _put_in(expression: sp.Expr, definitions: dict[sp.Symbol, sp.Expr]) -> sp.Expr:
    while expression.free_symbols & definitions.keys():
        expression = expression.xreplace(definitions)
    return expression


def _value(expression: sp.Expr, values: dict[sp.Symbol, sp.Float]) -> sp.Expr:
    """Return a number; a force without a formula counts as a sum of its arguments with weights."""
    while forces := expression.atoms(AppliedUndef):
        expression = expression.xreplace({f: sum((k + 2) * a for k, a in enumerate(f.args)) for f in forces})
    return sp.N(expression.subs(values), 20)


def _numbers(traced: Traced) -> dict[sp.Symbol, sp.Float]:
    symbols = [*traced.parameters.values(), *traced.u, *(s for chain in traced.q for s in chain)]
    chosen = np.random.default_rng(7).uniform(0.2, 1, len(symbols))
    return {s: sp.Float(str(round(float(v), 6)), 30) for s, v in zip(symbols, chosen, strict=True)}


@pytest.mark.parametrize("name", MODELS)
def test_mathml_is_well_formed_and_without_names_of_greek_letters(name: str) -> None:
    for formula in show(name).equations:
        text = unescape(formula.mathml.replace("&InvisibleTimes;", "*").replace("&ApplyFunction;", ""))
        ET.fromstring(f"<math>{text}</math>")
        assert "theta" not in text
        assert "Zz" not in text + formula.latex
        assert "'" not in formula.latex


def test_polynomial_is_that_of_the_compiled_model() -> None:
    vehicle = load("caravan")
    names = {k: float(v) for k, v in vehicle.values.items()}
    symbols = {k: sp.Symbol(k) for k in names}
    for formula, value in zip(show("trailer").polynomial, coefficients(vehicle), strict=True):
        read = sp.sympify(formula.text, locals=symbols).subs({symbols[k]: v for k, v in names.items()})
        assert float(read) == pytest.approx(float(value), rel=1e-12)


def test_accepts_classes_vehicles_and_names() -> None:
    model = find_model("trailer")
    assert show(model).vehicle is None
    assert show(load("caravan")).vehicle == load("caravan")
    assert show("caravan").model == show("trailer").model == "trailer"
    with pytest.raises(UcritError, match="did you mean 'trailer'"):
        show("trialer")


def test_shows_in_a_notebook() -> None:
    found = show("trailer")
    assert "<math" in found._repr_html_()
    assert found.equations[0]._repr_latex_().startswith("$")
    assert "hitch to centre of mass" in str(found)
    assert "<math" in found.polynomial._repr_html_()
    assert "s^{4}" in found.polynomial._repr_latex_()
    assert str(found.polynomial).splitlines()[0] == "a_0 = C*U*k*(a + b)"


def test_shows_how_well_parameters_are_known(run) -> None:
    printed = " ".join(run("show", "caravan").stdout.split())
    assert "mass (sd 60); above 0" in printed
    assert "lateral stiffness of the hitch (from 4000 to 6000); above 0" in printed
    assert "m and I_c are correlated: 0.7" in printed
    assert "sd 60" not in run("show", "trailer").stdout
    vehicle = show("caravan").to_dict()["vehicle"]
    assert vehicle["tolerances"]["m"] == {"sd": 60.0}
    assert vehicle["tolerances"]["k"] == {"min": 4000.0, "max": 6000.0}
    assert vehicle["correlations"] == [["m", "I_c", 0.7]]
    assert "from 4000 to 6000" in load("caravan")._repr_html_()
    assert "tolerance" not in load("bmw-320i")._repr_html_()


def test_criteria_in_few_parameters_say_so(run) -> None:
    printed = " ".join(run("analyze", "car-with-stability-control").stdout.split())
    assert "too long to be read; in b, with the vehicle's numbers for the rest (--free takes others)" in printed
    assert "b - 0.705" in printed
    assert "in U, with the vehicle's numbers for the rest" in run("show", "caravan", "--free", "U").stdout
    assert "did you mean 'a'" in run("analyze", "caravan", "--free", "aa").stderr
    assert "need a vehicle" in run("show", "trailer", "--free", "U").stderr
    assert "a controller alone has none" in run("show", "yaw-rate-feedback", "--free", "U").stderr
