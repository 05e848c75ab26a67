"""Trailers: all checks of the steered trailer, and what problems 5.2, 5.3, 5.12 and 5.13 ask for."""

import numpy as np
import pytest
import sympy as sp
from agreement import SETS, agree, crossing, varied

from ucrit import criteria, critical, find_model, load, modes, verdict
from ucrit.analyses.linear.transfer import transfer
from ucrit.analyses.stability.limits import limit
from ucrit.analyses.stability.static import static_stability
from ucrit.checks import check_model
from ucrit.core.derivation.derive import symbolic
from ucrit.core.derivation.linear import linear_system

SEEDS = range(SETS)


def test_every_check_of_the_steered_trailer_passes():
    check_model(find_model("trailer-active-steering")).raise_if_failed()


def test_steering_adds_damping_going_forward():
    (condition,) = criteria(find_model("trailer-active-steering"))
    assert str(condition) == "U*g + a + b > 0"
    assert condition.failure == "flutter"


def test_steering_cannot_stabilise_a_trailer_that_backs_up():
    backing = criteria(find_model("trailer-active-steering"), direction=-1)
    assert backing.settled is False
    trailer = load("caravan-active-steering", {"U": -2})
    assert verdict(trailer).static == "unstable"
    assert not any(verdict(trailer.with_(g=g)).stable for g in (-10, -1, 0, 1, 10))


def test_more_gain_gives_more_damping():
    ratios = [next(iter(modes(load("caravan-active-steering", {"g": g})))).damping_ratio for g in (0, 0.1, 0.2)]
    assert ratios[0] < ratios[1] < ratios[2]


@pytest.mark.parametrize("seed", SEEDS)
def test_critical_speed_of_a_gain_of_the_wrong_sign(seed):
    trailer = varied(load("caravan-active-steering", {"g": -0.2}), seed)
    found = agree(trailer, "U", -(trailer.a + trailer.b) / trailer.g)
    assert (found.kind, found.stable) == ("flutter", "below")
    assert str(found.closed_form) == "U = -(a + b)/g"


def test_in_a_steady_turn_the_gain_pushes_the_wheels_further_out():
    angles = [transfer(load("caravan-active-steering", {"g": g}), "omega", "theta").static_gain for g in (0, 0.2)]
    trailer = load("caravan-active-steering")
    assert angles[1] - angles[0] == pytest.approx(-trailer.g, rel=1e-12)
    plain = trailer.m * trailer.a * trailer.U / (trailer.C * 4) - 4 / trailer.U
    assert angles[0] == pytest.approx(plain, rel=1e-12)


def test_without_gain_it_is_the_trailer_on_a_rigid_hitch():
    names = find_model("trailer-rigid-hitch").declaration.parameters
    steered = load("caravan-active-steering", {"g": 0})
    plain = find_model("trailer-rigid-hitch")(**{name: steered.values[name] for name in names})
    assert modes(plain).eigenvalues == pytest.approx(modes(steered).eigenvalues, rel=1e-12)


@pytest.mark.parametrize("name", ["trailer", "trailer-rigid-hitch"])
def test_newton_gives_what_lagrange_gives(name):
    model = find_model(name)
    lagrange, newton = (
        linear_system(model).polynomial,
        linear_system(model, method="equations_newton").polynomial,
    )
    assert lagrange.expressions == newton.expressions


def test_root_locus_of_the_rigid_hitch_is_a_circle():
    trailer = load("caravan-active-steering", {"g": 0}).with_(U=np.linspace(20, 80, 30))
    eigenvalues = modes(trailer).eigenvalues
    length = trailer.a + trailer.b
    radius = np.sqrt(trailer.C * length / (trailer.I_c + trailer.m * trailer.a**2))
    assert np.all(eigenvalues.imag[:, 0] > 0)
    assert np.abs(eigenvalues) == pytest.approx(radius, rel=1e-12)


@pytest.mark.parametrize(("U", "stable"), [(5.0, True), (-5.0, False)])
def test_static_stability_of_the_trailer(U, stable):
    found = static_stability(load("caravan-rigid-hitch", {"U": U}))
    assert (found.stable, found.dynamic, found.decides) == (stable, stable, True)
    sign = "-" if stable else ""
    assert found.formula == f"{sign}C*(a + b)/(I_c + a**2*m)"


def test_static_stability_of_a_trailer_on_a_flexible_hitch_does_not_decide():
    found = static_stability(load("caravan"))
    assert found.stable
    assert not found.dynamic
    assert not found.decides
    assert "does not decide" in str(found)


@pytest.mark.parametrize("seed", SEEDS)
def test_stiffness_at_which_a_short_trailer_with_soft_tires_gains_stability(seed):
    trailer = varied(load("caravan-undamped-hitch", {"a": 1.0, "b": 0.25}), seed)
    m, I, a, b, C = (trailer.values[name] for name in ("m", "I_c", "a", "b", "C"))
    assert m * a * b < I, "the case that stiffness can make stable"
    found = critical(trailer, "k")
    assert [c.stable for c in found] == ["above"]
    k = C * (I + m * b**2) / ((a + b) * (I - m * a * b))
    assert found[0].value == pytest.approx(k, rel=1e-9)
    assert crossing(trailer, "k", k) == pytest.approx(k, rel=1e-9)


@pytest.mark.parametrize("seed", SEEDS)
def test_critical_speed_with_hitch_damping_and_rigid_tires(seed):
    trailer = varied(load("caravan-rigid-tire"), seed)
    m, I, a, b, c = (trailer.values[name] for name in ("m", "I_c", "a", "b", "c"))
    if m * a * b > I:
        assert len(critical(trailer)) == 0
        assert verdict(trailer).stable
    else:
        assert agree(trailer, "U", c * (a + b) / (I - m * a * b)).stable == "below"


@pytest.mark.parametrize("seed", SEEDS)
def test_critical_inertia_of_an_undamped_hitch_and_rigid_tires(seed):
    trailer = varied(load("caravan-rigid-tire-undamped"), seed)
    m, a, b = (trailer.values[name] for name in ("m", "a", "b"))
    assert agree(trailer, "I_c", m * a * b).stable == "below"


@pytest.mark.parametrize("seed", SEEDS)
def test_critical_speeds_of_the_flexible_hitch_by_hurwitz_and_eigenvalues(seed):
    trailer = varied(load("caravan"), seed)
    m, I, a, b, C, k, c = (trailer.values[name] for name in ("m", "I_c", "a", "b", "C", "k", "c"))
    P = np.polynomial.Polynomial  # in 1/U
    a_0, a_1 = P([k * C * (a + b)]), P([k * c, k * C * (a + b) ** 2])
    a_2, a_3 = P([m * C * b + k * (I + m * a**2), C * c]), P([m * c, C * (I + m * b**2)])
    roots = (a_1 * a_2 * a_3 - m * I * a_1**2 - a_0 * a_3**2).roots()
    speeds = sorted(1 / r.real for r in roots if abs(r.imag) < 1e-9 * abs(r) and r.real > 0)
    assert [found.value for found in critical(trailer)] == pytest.approx(speeds, rel=1e-9)
    for speed in speeds:
        assert crossing(trailer, "U", speed) == pytest.approx(speed, rel=1e-9)


def test_criterion_of_the_full_fourth_order():
    (condition,) = criteria(find_model("trailer-undamped-hitch"))
    m, I, a, b, C, k = (
        symbolic(find_model("trailer-undamped-hitch")).traced.parameters[n] for n in ("m", "I_c", "a", "b", "C", "k")
    )
    names = {s.name: s for s in (m, I, a, b, C, k)}
    book = (m * a * b - I) * (C * (I + m * b**2) + k * (a + b) * (m * a * b - I))
    assert sp.expand(sp.sympify(condition.expression, locals=names) - book) == 0


def test_rigid_tire_limit_is_independent_of_speed_and_stiffness():
    found = limit(find_model("trailer-undamped-hitch"), C=np.inf)
    assert [str(c) for c in found.criteria] == ["a*b*m - I_c > 0"]
