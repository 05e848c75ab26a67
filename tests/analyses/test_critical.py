"""Critical values: complete, to the last digits, of the right kind."""

import math

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ucrit import Model, UcritError, critical, find_model, load, modes, param, speed, state
from ucrit.analyses.stability.scan import scan
from ucrit.catalogue import vehicle_names
from ucrit.core.numeric.compiled import coefficients, compiled, direction


def test_damped_hitch_has_the_literatures_critical_speed():
    vehicle = load("caravan-rigid-tire")
    (found,) = critical(vehicle)
    m, I, a, b, k, c = (mpmath.mpf(float(vehicle.values[n])) for n in ("m", "I_c", "a", "b", "k", "c"))
    assert abs(found.value / (c * (a + b) / (I - m * a * b)) - 1) < 1e-15
    frequency = mpmath.sqrt((a + b) * (a + b) * k / found.value / ((I + m * b**2) / found.value)) / (2 * mpmath.pi)
    assert found.frequency_hz == pytest.approx(float(frequency), rel=1e-12)
    assert (found.kind, found.stable) == ("flutter", "below")
    assert found.closed_form.expression == "c*(a + b)/(I_c - a*b*m)"


def test_oversteering_car_diverges_at_the_literatures_speed():
    car = load("bmw-320i").with_(C_r=5e4)
    (found,) = critical(car)
    wanted = math.sqrt(-car.C_f * car.C_r * (car.a + car.b) ** 2 / (car.m * (car.b * car.C_r - car.a * car.C_f)))
    assert found.value == pytest.approx(wanted, rel=1e-14)
    assert (found.kind, found.frequency_hz, found.stable) == ("divergence", 0.0, "below")


WITH_SPEED = [name for name in vehicle_names() if type(load(name)).declaration.speed]


@pytest.mark.parametrize("name", [*WITH_SPEED, "wheelset-1-in-20"])
def test_the_boundary_is_where_an_eigenvalue_is_on_the_axis(name):
    for found in critical(load(name), *(["Psi"] if name == "wheelset-1-in-20" else [])):
        if not 1e-6 < abs(found.value) < 1e6:
            continue
        vehicle = load(name).with_(**{found.parameter: found.value})
        zeros = compiled(type(vehicle), direction(vehicle)).structural_zeros
        # rigid positions make a Jordan block, near which eigenvalues lose half their digits: the polynomial does not
        values = np.roots([float(a) for a in coefficients(vehicle)[zeros:]][::-1])
        nearest = min(values, key=lambda v: abs(v.real))
        if not zeros:
            nearest = min(modes(vehicle).eigenvalues, key=lambda v: abs(v.real))
        assert abs(nearest.real) < 1e-9 * abs(values).max()
        assert abs(nearest.imag) / (2 * math.pi) * (found.kind == "flutter") == pytest.approx(
            found.frequency_hz, abs=1e-9 * abs(values).max()
        )
        sides = [modes(vehicle.with_(**{found.parameter: found.value * f})).growth for f in (1 - 1e-4, 1 + 1e-4)]
        assert (sides[0] < sides[1]) == ((found.stable == "below") == (found.value > 0))


@given(st.floats(0.3, 3), st.floats(0.3, 3), st.floats(0.3, 3), st.floats(0.3, 3))
def test_twelve_digits_against_fifty(m, I, k, c):
    """The critical speed again, from the roots of the determinant in 50 digits."""
    caravan = load("caravan").with_(m=1200 * m, I_c=2300 * I, k=5e3 * k, c=4e3 * c)
    for found in critical(caravan):
        with mpmath.workdps(50):
            p = {key: mpmath.mpf(float(value)) for key, value in caravan.values.items()}

            def boundary(U, p=p):
                m, I, a, b, C, k, c = (p[n] for n in ("m", "I_c", "a", "b", "C", "k", "c"))
                a4 = m * I
                a3 = C * (I + m * b**2) / U + m * c
                a2 = m * C * b + k * (I + m * a**2) + C * c / U
                a1 = k * C * (a + b) ** 2 / U + C * c * 0 + k * c
                a0 = k * C * (a + b)
                return a1 * a2 * a3 - a4 * a1**2 - a0 * a3**2

            exact = mpmath.findroot(boundary, mpmath.mpf(found.value))
            assert abs(found.value / exact - 1) < mpmath.mpf(10) ** -15


@pytest.mark.parametrize("name", ["caravan", "caravan-rigid-tire", "wheelset", "shimmying-caster-damped"])
@pytest.mark.parametrize("number", range(3))
def test_exact_search_and_scan_by_eigenvalues_agree(name, number):
    vehicle = load(name)
    keys = [k for k in vehicle.values if k != type(vehicle).declaration.speed]
    random = np.random.default_rng(number)
    vehicle = vehicle.with_(**{k: float(vehicle.values[k]) * 10 ** random.uniform(-0.2, 0.2) for k in keys})
    found = critical(vehicle, upper=200.0)
    edges, stable = scan(vehicle, found.parameter, found.lower, found.upper)
    assert found.exact
    assert [c.value for c in found] == pytest.approx([value for value, _ in edges], rel=1e-9)
    assert [{c.kind} for c in found] == [kinds for _, kinds in edges]
    assert stable[0] == found.stable_at_lower


def test_every_parameter_has_its_critical_values_and_windows():
    found = critical(load("caravan"), "c")
    assert len(found) == 3
    assert [c.stable for c in found] == ["above", "below", "above"]
    ranges = found.stable_ranges()
    assert len(ranges) == 2
    assert ranges[1][1] == math.inf


def test_ranges_are_respected_and_checked():
    caravan = load("caravan")
    assert len(critical(caravan, "c", 1e4, 2e4)) == 2
    assert len(critical(caravan, "c", 0, 1e3)) == 0
    with pytest.raises(UcritError, match="the range from 5 to 3 N m s/rad is empty"):
        critical(caravan, "c", 5, 3)
    with pytest.raises(UcritError, match="did you mean 'c'"):
        critical(caravan, "cc")
    with pytest.raises(UcritError, match="one vehicle at a time"):
        critical(caravan.with_(m=[1.0, 2.0]))
    with pytest.raises(UcritError, match="has no speed"):
        critical(load("wheelset-1-in-20"))


def test_undamped_motion_changes_where_its_roots_leave_the_axis():
    (found,) = critical(load("wheelset-1-in-20"), "Psi")
    assert (found.value, found.kind, found.stable) == (0.0, "divergence", "above")


class Tilted(Model):
    """A pendulum on a slope, damped: no polynomial in the angle (a source)."""

    beta: float = param("rad", "slope", above=-3, below=3)
    c: float = param("1/s", "damping", above=0)
    U: float = speed()
    y = state("m", "position")
    v = state("m/s", "rate")

    def equations(self, x, dx):
        from ucrit.core import cos

        per_second = self.U / self.U
        return dx.y - x.v, dx.v + self.c * x.v + cos(self.beta) * self.c**2 * per_second * x.y


def test_a_model_that_is_no_polynomial_in_the_parameter_is_scanned():
    found = critical(Tilted(beta=0.1, c=2, U=1), "beta")
    assert not found.exact
    assert [c.value for c in found] == pytest.approx([-math.pi / 2, math.pi / 2], rel=1e-12)
    assert [c.kind for c in found] == ["divergence", "divergence"]


def test_backing_up_is_searched_among_negative_speeds():
    found = critical(load("caravan").with_(U=-5))
    assert (found.lower, found.upper) == (-math.inf, 0.0)
    assert not found.stable_ranges()


def test_several_models_of_one_limit_agree():
    undamped = load("caravan-rigid-tire-undamped")
    damped = find_model("trailer-rigid-tire")(**undamped.values, c=0)
    assert [c.value for c in critical(damped, "I_c")] == [c.value for c in critical(undamped, "I_c")]


def test_a_root_through_infinity():
    """Where the mass is Z_wdot, the force per downward acceleration, nothing resists that acceleration."""
    (found,) = critical(load("boeing-747"), "m")
    assert (found.kind, found.stable, found.frequency_hz) == ("order", "above", 0.0)
    assert found.value == pytest.approx(load("boeing-747").Z_wdot, rel=1e-15)
    assert str(found).endswith("kg: root through infinity of the short period motion, stable above")


def test_no_critical_speed_beyond_that_of_light_comes_from_rounding():
    van = load("vw-vanagon")  # neutral but for the last digits of its coefficients
    assert not critical(van)
    assert critical(van).stable_at_lower
    assert van.a * van.C_f != van.b * van.C_r
