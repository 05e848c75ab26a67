"""Casters: criteria, critical values, the rake's geometry, and tires that need some distance."""

import math

import numpy as np
import pytest
from agreement import SETS, agree, crossing, growth, varied

from ucrit import criteria, critical, find_model, load, modes
from ucrit.checks import check_model
from ucrit.core.derivation.derive import symbolic

CASTERS = (
    "caster",
    "caster-raked",
    "caster-flexible-pivot",
    "caster-flexible-pivot-damped",
    "caster-flexible-pivot-rigid-tire",
    "caster-relaxation",
    "caster-flexible-sidewall",
)
SEEDS = range(SETS)


def conditions(name):
    return [str(c) for c in criteria(find_model(name))]


@pytest.mark.parametrize("name", CASTERS)
def test_every_check_passes(name):
    check_model(find_model(name)).raise_if_failed()


@pytest.mark.parametrize(
    ("caster", "trailer"),
    [
        ("caster", "trailer-rigid-hitch"),
        ("caster-flexible-pivot-damped", "trailer"),
        ("caster-flexible-pivot", "trailer-undamped-hitch"),
        ("caster-flexible-pivot-rigid-tire", "trailer-rigid-tire"),
    ],
)
def test_a_caster_moves_as_a_trailer(caster, trailer):
    one, other = (symbolic(find_model(name)).polynomial.expressions for name in (caster, trailer))
    assert [str(a) for a in one] == [str(a) for a in other]


@pytest.mark.parametrize("name", [n for n in CASTERS if n != "caster-raked"])
def test_backward_every_caster_is_unstable(name):
    assert criteria(find_model(name), direction=-1).settled is False


def test_vertical_pivot_is_stable_forward():
    assert criteria(find_model("caster")).settled is True


@pytest.mark.parametrize("seed", SEEDS)
def test_vertical_pivot_eigenvalues(seed):
    caster = varied(load("furniture-caster"), seed)
    m, I_c, a, b, C, U = caster.values.values()
    expected = np.roots([I_c + m * a**2, C * (a + b) ** 2 / U, C * (a + b)])
    assert sorted(modes(caster).eigenvalues, key=abs) == pytest.approx(sorted(expected, key=abs), rel=1e-9)


@pytest.mark.parametrize("seed", SEEDS)
def test_rake_turns_the_wheel_like_a_hooke_joint_and_tilts_it(seed):
    from ucrit.core.contract.methods import Names

    fork = varied(load("motorcycle-front-fork"), seed)
    x = Names("x", {"theta": 0.02 * (seed + 1)})
    assert math.tan(fork.ground_steer_angle(x)) == pytest.approx(math.cos(fork.beta) * math.tan(x.theta))
    assert math.sin(fork.camber(x)) == pytest.approx(math.sin(fork.beta) * math.sin(x.theta), rel=1e-12)
    assert np.hypot(*fork.wheel_axle(x)[:2]) == pytest.approx(math.cos(fork.camber(x)), rel=1e-12)


@pytest.mark.parametrize("seed", SEEDS)
def test_rake_stiffness_and_damping(seed):
    fork = varied(load("motorcycle-front-fork"), seed)
    m, I_c, C, a, b, beta, C_gamma = (fork.values[n] for n in ("m", "I_c", "C", "a", "b", "beta", "C_gamma"))
    stiffness = (a + b) * (C * math.cos(beta) + C_gamma * math.sin(beta))
    expected = np.roots([I_c + m * a**2, C * (a + b) ** 2 / fork.U, stiffness])
    assert sorted(modes(fork).eigenvalues, key=abs) == pytest.approx(sorted(expected, key=abs), rel=1e-8)
    trail = (a + b) / math.cos(beta)
    aligning_moment_per_slip_angle = stiffness - (a + b) * C_gamma * math.sin(beta)
    assert aligning_moment_per_slip_angle == pytest.approx(C * trail * math.cos(beta) ** 2, rel=1e-12)


@pytest.mark.parametrize("seed", SEEDS)
def test_raked_caster_diverges_when_the_trail_vanishes(seed):
    fork = varied(load("motorcycle-front-fork"), seed)
    (found,) = critical(fork, "a")
    assert (found.value, found.kind, found.stable) == (-fork.b, "divergence", "above")
    assert growth(fork.with_(a=-0.999 * fork.b)) < 0 < growth(fork.with_(a=-1.001 * fork.b))


def test_rigid_tire_criterion():
    assert conditions("caster-flexible-pivot-rigid-tire") == ["U*(a*b*m - I_c) + c*(a + b) > 0"]


@pytest.mark.parametrize("seed", SEEDS)
def test_rigid_tire_critical_speed(seed):
    caster = varied(load("schwab-meijaard-caster").with_(I_c=4, c=30), seed)
    m, I_c, a, b, c = (caster.values[n] for n in ("m", "I_c", "a", "b", "c"))
    caster = caster.with_(I_c=max(I_c, 1.5 * m * a * b))
    found = agree(caster, "U", c * (a + b) / (caster.I_c - m * a * b))
    assert (found.kind, found.stable) == ("flutter", "below")
    assert str(found.closed_form) == "U = c*(a + b)/(I_c - a*b*m)"


@pytest.mark.parametrize(("length", "stiffness", "speed"), [(1, 1e4, 10), (0.05, 1e6, 0.3), (3, 10, 60)])
def test_caster_of_schwab_and_meijaard(length, stiffness, speed):
    caster = load("schwab-meijaard-caster").with_(I_c=0.21 * 5 * length**2, k=stiffness, U=speed)

    def at(share):
        return growth(caster.with_(a=share * length, b=(1 - share) * length))

    shares = np.linspace(0.005, 0.995, 100)
    assert [at(share) < 0 for share in shares] == [0.3 < share < 0.7 for share in shares]
    (condition,) = criteria(find_model("caster-flexible-pivot-rigid-tire"))
    for share in (0.3, 0.7):
        on_boundary = caster.with_(a=share * length, b=(1 - share) * length)
        assert condition.value(on_boundary) == pytest.approx(0, abs=1e-14 * speed * length**2 * 5)
        assert abs(at(share)) < 1e-9 * np.abs(modes(on_boundary).eigenvalues).max()


def test_flexible_pivot_criterion():
    assert conditions("caster-flexible-pivot") == ["(a*b*m - I_c)*(C*(I_c + b**2*m) + k*(a*b*m - I_c)*(a + b)) > 0"]


@pytest.mark.parametrize("seed", SEEDS)
def test_flexible_pivot_is_stable_again_beyond_a_second_boundary(seed):
    caster = varied(load("shimmying-caster"), seed)
    m, a, b, C = (caster.values[n] for n in ("m", "a", "b", "C"))
    k = max(caster.k, 1.5 * C / (a + b))
    first, second = m * a * b, m * b * (C * b + k * a * (a + b)) / (k * (a + b) - C)
    found = critical(caster.with_(k=k), "I_c")
    crossings = [crossing(caster.with_(k=k), "I_c", c.value) for c in found]
    assert [c.value for c in found] == pytest.approx([first, second], rel=1e-9)
    assert crossings == pytest.approx([first, second], rel=1e-9)
    assert [c.stable for c in found] == ["below", "above"]
    (condition,) = criteria(find_model("caster-flexible-pivot"))
    inertias = [0.9 * first, (first + second) / 2, 1.1 * second]
    assert [condition.value(caster.with_(k=k, I_c=I_c)) > 0 for I_c in inertias] == [True, False, True]


@pytest.mark.parametrize("seed", SEEDS)
def test_flexible_pivot_critical_stiffness(seed):
    caster = varied(load("shimmying-caster"), seed)
    m, a, b, C = (caster.values[n] for n in ("m", "a", "b", "C"))
    I_c = max(caster.I_c, 2 * m * a * b)
    found = agree(caster.with_(I_c=I_c), "k", C * (I_c + m * b**2) / ((a + b) * (I_c - m * a * b)))
    assert (found.kind, found.stable) == ("flutter", "above")


def test_flexible_pivot_stability_does_not_depend_on_speed():
    assert len(critical(load("shimmying-caster"))) == 0


@pytest.mark.parametrize("seed", SEEDS)
def test_damped_flexible_pivot_has_the_rigid_tires_critical_speed_in_the_limit(seed):
    caster = varied(load("shimmying-caster-damped").with_(k=2e4), seed)
    m, a, b, c = (caster.values[n] for n in ("m", "a", "b", "c"))
    caster = caster.with_(I_c=2 * m * a * b)
    slow = c * (a + b) / (caster.I_c - m * a * b)
    soft, stiff = (critical(caster.with_(C=C), "U")[0].value for C in (1e8, 1e9))
    assert stiff == pytest.approx(slow, rel=1e-3)
    assert (stiff - slow) / (soft - slow) == pytest.approx(0.1, rel=0.02)


@pytest.mark.parametrize("seed", SEEDS)
def test_damped_flexible_pivot_critical_speed_by_routh_and_eigenvalues(seed):
    caster = varied(load("shimmying-caster-damped"), seed).with_(C=1e5, k=1e4)
    caster = caster.with_(I_c=2 * caster.m * caster.a * caster.b)
    for found in critical(caster):
        assert crossing(caster, "U", found.value) == pytest.approx(found.value, rel=1e-9)


def test_relaxation_criterion():
    assert conditions("caster-relaxation") == ["a + b - sigma > 0"]
    assert conditions("caster-flexible-sidewall") == ["k_s*(a + b) - C > 0"]


@pytest.mark.parametrize("seed", SEEDS)
def test_relaxation_boundary_is_the_trail_at_any_speed(seed):
    caster = varied(load("pneumatic-caster"), seed)
    for U in (0.1, 3, 50):
        found = agree(caster.with_(U=U), "sigma", caster.a + caster.b)
        expected = math.sqrt(caster.C * (caster.a + caster.b) / (caster.I_c + caster.m * caster.a**2))
        assert found.frequency_hz == pytest.approx(expected / (2 * math.pi), rel=1e-9)
        assert found.stable == "below"


@pytest.mark.parametrize("seed", SEEDS)
def test_flexible_sidewall_is_a_relaxation_length(seed):
    sidewall = varied(load("pneumatic-caster-sidewall"), seed)
    values = {name: value for name, value in sidewall.values.items() if name != "k_s"}
    lag = find_model("caster-relaxation")(**values, sigma=sidewall.C / sidewall.k_s)
    assert modes(sidewall).eigenvalues == pytest.approx(modes(lag).eigenvalues, rel=1e-9)
    agree(sidewall, "k_s", sidewall.C / (sidewall.a + sidewall.b))
