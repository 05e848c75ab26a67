"""Limits of parameters: lower models by machine, against the models that constraints make."""

from math import inf

import numpy as np
import pytest
import sympy as sp

from ucrit import UcritError, find_model, load, modes
from ucrit.analyses.stability.limits import limit
from ucrit.core.derivation.derive import symbolic
from ucrit.core.derivation.limits import limit_polynomial

LOWER = [
    ("trailer-undamped-hitch", {"C": inf}, "trailer-rigid-tire-undamped"),
    ("trailer", {"C": inf}, "trailer-rigid-tire"),
    ("trailer-undamped-hitch", {"k": inf}, "trailer-rigid-hitch"),
    ("trailer-rigid-hitch", {"C": inf}, "trailer-kinematic"),
    ("trailer-undamped-hitch", {"k": inf, "C": inf}, "trailer-kinematic"),
    ("trailer-undamped-hitch", {"C": inf, "k": inf}, "trailer-kinematic"),
    ("trailer", {"c": 0}, "trailer-undamped-hitch"),
    ("trailer", {"C": inf, "c": 0}, "trailer-rigid-tire-undamped"),
    ("caster-flexible-pivot-damped", {"C": inf}, "caster-flexible-pivot-rigid-tire"),
    ("caster-flexible-pivot", {"k": inf}, "caster"),
    ("caster-relaxation", {"sigma": 0}, "caster"),
    ("caster-flexible-sidewall", {"k_s": inf}, "caster"),
]


def monic(coefficients):
    return [sp.together(c / coefficients[-1]) for c in coefficients]


@pytest.mark.parametrize("direction", [1, -1])
@pytest.mark.parametrize(("higher", "to", "lower"), LOWER)
def test_limit_is_the_lower_model(higher, to, lower, direction):
    if direction < 0 and not find_model(higher).declaration.parameters["U"].lower < 0:
        direction = 1
    found, _ = limit_polynomial(find_model(higher), to, direction)
    expected = symbolic(find_model(lower), direction).polynomial.expressions
    assert len(found.expressions) == len(expected)
    for left, right in zip(monic(found.expressions), monic(expected), strict=True):
        assert sp.simplify(left - right) == 0


@pytest.mark.parametrize(("higher", "to", "lower"), LOWER)
def test_no_root_is_forgotten(higher, to, lower):
    system = symbolic(find_model(higher)).polynomial
    found, escapes = limit_polynomial(find_model(higher), to)
    assert len(found.coefficients) + sum(e.count for e in escapes) == len(system.coefficients)


def test_lost_roots_are_where_the_asymptotes_say():
    trailer = load("caravan-undamped-hitch").with_(C=1e12)
    (lost,) = limit(find_model("trailer-undamped-hitch"), C=inf).lost
    assert (lost.count, lost.power, lost.fast, lost.stable) == (1, 1, True, True)
    m, I, b, U = (trailer.values[n] for n in ("m", "I_c", "b", "U"))
    fastest = modes(trailer).eigenvalues[np.argmax(np.abs(modes(trailer).eigenvalues))]
    assert fastest == pytest.approx(-trailer.C * (I + m * b**2) / (m * I * U), rel=1e-6)


def test_stiff_hitch_gives_an_undamped_fast_pair():
    (lost,) = limit(find_model("trailer-undamped-hitch"), k=inf).lost
    assert (lost.count, lost.power, lost.stable) == (2, 0.5, None)
    assert "undamped to leading order" in str(lost)
    trailer = load("caravan-undamped-hitch").with_(k=1e14)
    fastest = np.abs(modes(trailer).eigenvalues).max()
    m, I, a = (trailer.values[n] for n in ("m", "I_c", "a"))
    assert fastest == pytest.approx(np.sqrt(trailer.k * (I + m * a**2) / (m * I)), rel=1e-5)


def test_roots_of_the_limit_are_the_slow_ones():
    trailer = load("caravan")
    limits = np.sort_complex(limit(trailer, C=inf).roots(trailer))
    values = modes(trailer.with_(C=1e13)).eigenvalues
    slow = np.sort_complex(values[np.argsort(np.abs(values))[:3]])
    assert slow == pytest.approx(limits, rel=1e-6)


def test_criteria_of_the_limit():
    assert [str(c) for c in limit(find_model("trailer-undamped-hitch"), C=inf).criteria] == ["a*b*m - I_c > 0"]
    assert limit(find_model("trailer-rigid-hitch"), C=inf).criteria.settled is True
    assert limit(find_model("trailer-rigid-hitch"), C=inf, direction=-1).criteria.settled is False
    (damped,) = limit(find_model("trailer"), C=inf).criteria
    assert str(damped.boundary("U")) == "U = c*(a + b)/(I_c - a*b*m)"


def test_the_limit_of_a_large_model_is_given_without_its_criteria():
    truck = load("coach-truck")
    found = limit(truck, m=inf)
    assert (found.order, [lost.count for lost in found.lost]) == (8, [4])
    assert found.criteria is None
    assert str(found).endswith("the conditions for stability are too long to be read")
    values = modes(truck.with_(m=truck.m * 1e9)).eigenvalues
    fast = np.sort_complex(values[np.argsort(np.abs(values))[4:]])
    assert fast == pytest.approx(np.sort_complex(found.roots(truck)), rel=1e-5)


def test_no_root_left():
    found = limit(find_model("trailer-rigid-hitch"), C=0)
    assert (found.order, found.lost[0].fast, found.lost[0].power) == (0, False, 0.5)
    assert "no root stays finite" in str(found)


def test_positions_stay():
    found = limit(find_model("car-inertial"), C_f=inf, C_r=inf)
    assert found.polynomial == ("0", "0", "1")
    assert [lost.parameter for lost in found.lost] == ["C_f", "C_r"]


def test_order_of_limits_that_matters_is_reported():
    found = limit(find_model("trailer-undamped-hitch"), C=0, k=inf)
    other = limit(find_model("trailer-undamped-hitch"), k=inf, C=0)
    assert found.order_matters == (found.polynomial != other.polynomial)
    assert not limit(find_model("trailer-undamped-hitch"), C=inf, k=inf).order_matters


def test_text_and_latex():
    found = limit(find_model("trailer-undamped-hitch"), C=inf)
    assert found.text == "(I_c + b**2*m)*s**3 + U*b*m*s**2 + k*(a + b)**2*s + U*k*(a + b)"
    assert str(found).splitlines()[2] == "    1 root goes to infinity like C, decaying"
    assert found._repr_latex_().startswith(r"$\displaystyle \left(I_{c} + b^{2} m\right) s^{3}")


@pytest.mark.parametrize(
    ("model", "to", "message"),
    [
        ("trailer", {}, "trailer: name the parameters that go to infinity or 0, such as C=math.inf"),
        ("trailer", {"CC": inf}, "trailer: there is no parameter 'CC'; did you mean 'C'?"),
        ("trailer", {"C": 5}, "trailer: the limit of C must be infinity or 0, got 5"),
        ("trailer", {"C": -inf}, "trailer: the limit of C must be infinity or 0, got -inf"),
        ("caster-raked", {"beta": 0}, "beta occurs inside a function, so that its limit is not that of a polynomial"),
    ],
)
def test_refusals(model, to, message):
    with pytest.raises(UcritError) as error:
        limit(find_model(model), **to)
    assert str(error.value) == message
