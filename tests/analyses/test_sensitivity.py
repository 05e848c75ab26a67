"""Derivatives of eigenvalues and critical speeds, against exact differences."""

import math
from fractions import Fraction

import mpmath
import numpy as np
import pytest

from ucrit import Model, critical, load, param, speed, state
from ucrit.analyses.linear.modes import rigid_positions
from ucrit.analyses.stability.sensitivity import sensitivity
from ucrit.catalogue import vehicle_names
from ucrit.core.contract.possible import allowed
from ucrit.core.numeric.compiled import compiled, direction, state_slopes, state_space

STEP = Fraction(1, 10**30)


def exact_slopes(vehicle, parameter):
    """Roots and their derivatives from exact differences of the characteristic coefficients, 60 digits."""
    functions = compiled(type(vehicle), direction(vehicle))
    numbers = {name: Fraction(float(value)) for name, value in vehicle.values.items()}

    def coefficients(shift):
        a = functions.exact_coefficients([*{**numbers, parameter: numbers[parameter] + shift}.values()])
        return [Fraction(x) for x in a[functions.structural_zeros :]]

    with mpmath.workdps(60):
        exact = lambda x: mpmath.mpf(x.numerator) / x.denominator  # noqa: E731
        a = [exact(x) for x in coefficients(0)]
        ahead, behind = coefficients(STEP), coefficients(-STEP)
        da = [exact((x - y) / (2 * STEP)) for x, y in zip(ahead, behind, strict=True)]
        roots = mpmath.polyroots(a[::-1], maxsteps=500, extraprec=400)
        slope = [k * x for k, x in enumerate(a)][1:]
        changes = [-mpmath.polyval(da[::-1], s) / mpmath.polyval(slope[::-1], s) for s in roots]
        return np.array([complex(s) for s in roots]), np.array([complex(x) for x in changes])


# The wheels of a car on four wheels share an eigenvalue: slopes of double roots do not exist.
ONE_BY_ONE = [name for name in vehicle_names() if "omega_fl" not in type(load(name)).declaration.variables]


@pytest.mark.parametrize("name", ONE_BY_ONE)
def test_slopes_of_all_eigenvalues_of_all_vehicles(name):
    vehicle = load(name)
    found = sensitivity(vehicle)
    moving = ~rigid_positions(vehicle, found.eigenvalues)
    largest = np.abs(found.eigenvalues).max()
    compared = 0
    for parameter, slopes in found.slopes.items():
        assert not slopes[~moving].any()
        if compiled(type(vehicle), direction(vehicle)).degrees(parameter) is None:
            continue
        roots, exact = exact_slopes(vehicle, parameter)
        compared += 1
        if not moving.any():
            continue
        nearest = np.abs(found.eigenvalues[moving][:, None] - roots).argmin(axis=1)
        assert sorted(nearest) == list(range(len(roots)))
        noise = 1e-8 * largest / (abs(float(vehicle.values[parameter])) or 1)
        np.testing.assert_allclose(slopes[moving], exact[nearest], rtol=1e-7, atol=noise)
    assert compared > 0


@pytest.mark.parametrize("name", vehicle_names())
def test_slopes_of_the_state_matrix(name):
    vehicle = load(name)
    for parameter, slope in state_slopes(vehicle).items():
        now = float(vehicle.values[parameter])
        h = 1e-4 * (abs(now) or 1)
        allows = allowed(vehicle, parameter).allows
        if not allows(now + 4 * h):
            h = -h
        middle = now != 0 and allows(now + 2 * h) and allows(now - 2 * h)
        steps = None if middle else [vehicle.with_(**{parameter: now + k * h}) for k in (1, 2, 3, 4)]
        if steps:
            at = [state_space(v).A for v in (vehicle, *steps)]
            difference = (-25 * at[0] + 48 * at[1] - 36 * at[2] + 16 * at[3] - 3 * at[4]) / (12 * h)
        else:
            back2, back, on, on2 = (state_space(vehicle.with_(**{parameter: now + k * h})).A for k in (-2, -1, 1, 2))
            difference = (back2 - 8 * back + 8 * on - on2) / (12 * h)
        size = np.abs(state_space(vehicle).A).max() / (abs(now) or 1)
        np.testing.assert_allclose(slope, difference, rtol=1e-7, atol=1e-9 * size)


CRITICAL = [name for name in vehicle_names() if type(load(name)).declaration.speed and name != "vw-vanagon"]


@pytest.mark.parametrize("name", CRITICAL)
def test_slopes_of_critical_speeds(name):
    vehicle = load(name)
    found = sensitivity(vehicle)
    values = [c.value for c in critical(vehicle)]
    assert [one.critical.value for one in found.critical] == values
    for i, one in enumerate(found.critical):
        assert set(one.slopes) == set(vehicle.values) - {type(vehicle).declaration.speed}
        for parameter, slope in one.slopes.items():
            now = float(vehicle.values[parameter])
            if now == 0:
                continue
            ends = [critical(vehicle.with_(**{parameter: now * (1 + h)})) for h in (-1e-4, 1e-4)]
            assert [len(end) for end in ends] == [len(values)] * 2
            relative = (ends[1][i].value - ends[0][i].value) / 2e-4 / values[i]
            assert one.normalised[parameter] == pytest.approx(relative, rel=1e-5, abs=1e-6)
            assert slope == pytest.approx(one.normalised[parameter] * values[i] / now)


def test_the_car_in_closed_form():
    car = load("oversteering-car")
    one = sensitivity(car).critical[0]
    # U_crit^2 = C_f C_r (a + b)^2 / (m (C_f a - C_r b)): mass enters as m^-1/2, yaw inertia not at all
    assert one.normalised["m"] == pytest.approx(-0.5, rel=1e-9)
    assert one.slopes["I_z"] == pytest.approx(0, abs=1e-12)
    assert one.critical.kind == "divergence"


def test_growth_is_that_of_the_least_stable_mode():
    found = sensitivity(load("caravan"))
    for name, slope in found.growth.items():
        assert slope == found.slopes[name][0].real
    np.testing.assert_array_equal(found.normalised["m"], 1200 * found.slopes["m"])


def test_arrays_of_vehicles():
    caravan = load("caravan")
    fleet = sensitivity(caravan.with_(U=[10, 20, 30], c=[0, 4000]))
    one = sensitivity(caravan.with_(U=20, c=4000))
    assert fleet.critical == ()
    for name, slope in one.slopes.items():
        assert fleet.slopes[name].shape == (2, 3, 4)
        np.testing.assert_allclose(fleet.slopes[name][1, 1], slope, rtol=1e-8)
        assert fleet.growth[name][1, 1] == pytest.approx(one.growth[name])
    assert fleet.normalised["U"].shape == (2, 3, 4)


def test_backing_up():
    back = load("caravan").with_(U=-5)
    slopes = state_slopes(back.with_(U=[-5, 5]))["U"]
    np.testing.assert_allclose(slopes[0], state_slopes(back)["U"])
    np.testing.assert_allclose(slopes[1], state_slopes(load("caravan").with_(U=5))["U"])
    assert not np.allclose(slopes[0], slopes[1])


class Pair(Model):
    """Two decays with rates p and q, which couple through g."""

    p: float = param("1/s", "first rate", above=0)
    q: float = param("1/s", "second rate", above=0)
    g: float = param("1/s", "coupling")

    x = state("m", "first place")
    y = state("m", "second place")

    def equations(self, x, dx):
        return dx.x + self.p * x.x - self.g * x.y, dx.y + self.q * x.y


@pytest.mark.parametrize("coupling", [0.0, 1.0])
def test_repeated_eigenvalues_have_no_derivative(coupling):
    found = sensitivity(Pair(p=2, q=2, g=coupling))
    for slope in found.slopes.values():
        assert np.isnan(slope).all()
    assert all(math.isnan(slope) for slope in found.growth.values())
    apart = sensitivity(Pair(p=2, q=3, g=coupling))
    np.testing.assert_allclose(apart.slopes["p"], [-1, 0], atol=1e-12)
    np.testing.assert_allclose(apart.slopes["q"], [0, -1], atol=1e-12)


def test_one_repeated_pair_leaves_the_other_points_alone():
    found = sensitivity(Pair(p=[1.0, 2.0, 3.0], q=2, g=1))
    np.testing.assert_allclose(found.slopes["p"][[0, 2]], [[-1, 0], [0, -1]], atol=1e-12)
    assert np.isnan(found.slopes["p"][1]).all()


class Twins(Model):
    """Two equal axes that lose their stability together at U = p."""

    p: float = param("m/s", "critical speed", above=0)
    g: float = param("1/m", "gain", above=0)
    U: float = speed("speed")

    x = state("m", "first place")
    y = state("m", "second place")

    def equations(self, x, dx):
        rate = self.g * (self.U - self.p)
        return dx.x - rate * x.x, dx.y - 2 * rate * x.y


def test_two_modes_that_cross_together_give_no_slope():
    found = sensitivity(Twins(p=10, g=1, U=5))
    assert [math.isnan(one.slopes["p"]) for one in found.critical] == [True]
