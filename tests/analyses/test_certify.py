"""Certificates: no region with an unstable vehicle is ever proved, and every counter-example is one, exactly."""

from fractions import Fraction

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from ucrit import Model, UcritError, certify, coordinate, critical, find_model, load, param
from ucrit.analyses.regions.exact_ranges import exact_range
from ucrit.catalogue import vehicle_names
from ucrit.core.numeric.compiled import compiled, direction
from ucrit.numerics.routh import routh


def trailer_criterion(p):
    """Karnopp's criterion of the trailer on an undamped hitch (section 5.III)."""
    d = p["m"] * p["a"] * p["b"] - p["I_c"]
    return d * (p["C"] * (p["I_c"] + p["m"] * p["b"] ** 2) + p["k"] * (p["a"] + p["b"]) * d)


def car_criterion(p):
    moment = p["b"] * p["C_r"] - p["a"] * p["C_f"]
    return p["C_f"] * p["C_r"] * (p["a"] + p["b"]) ** 2 + p["m"] * p["U"] ** 2 * moment


CLOSED = {
    "trailer-undamped-hitch": (
        {"m": 1000, "I_c": 1800, "a": 1.5, "b": 1.2, "C": 5e4, "k": 1e4, "U": 25},
        trailer_criterion,
    ),
    "car": ({"m": 1500, "I_z": 2500, "a": 1.25, "b": 1.5, "C_f": 120e3, "C_r": 75e3, "U": 25}, car_criterion),
}


@st.composite
def regions(draw):
    name = draw(st.sampled_from(sorted(CLOSED)))
    base, criterion = CLOSED[name]
    chosen = draw(st.lists(st.sampled_from(sorted(base)), min_size=1, max_size=3, unique=True))
    region = {}
    for key in chosen:
        low = base[key] * draw(st.floats(0.5, 1.5))
        region[key] = (low, low * draw(st.floats(1.001, 1.8)))
    return name, base, criterion, region


@settings(max_examples=60)
@given(regions(), st.integers(0, 2**31))
def test_what_is_proved_is_so_and_counterexamples_are_unstable(case, seed):
    name, base, criterion, region = case
    found = certify(find_model(name)(**base), **region, boxes=3000)
    random = np.random.default_rng(seed)
    share = random.integers(0, 2, (40, len(region))) * 1.0
    share[20:] = random.uniform(size=(20, len(region)))
    ends = np.array(list(region.values()))
    points = np.clip(ends[:, 0] + share * (ends[:, 1] - ends[:, 0]), ends[:, 0], ends[:, 1])
    fixed = {key: Fraction(value) for key, value in base.items()}
    values = [criterion({**fixed, **dict(zip(region, map(Fraction, map(float, p)), strict=True))}) for p in points]
    if found.proved:
        assert min(values) > 0
        assert found.proved_share == 1
    if min(values) < 0:
        assert not found.proved
    if found.counterexample:
        at = {key: Fraction(value) for key, value in found.counterexample.values.items()}
        assert criterion({**fixed, **at}) < 0
        assert all(low <= at[key] <= high for key, (low, high) in found.ranges.items())
        assert found.counterexample.eigenvalues[0].real > -1e-6
    if not found.undecided.size:
        assert found.state in ("proved", "refuted")


def around(vehicle, share):
    """A region around a vehicle: a few parameters and the speed, as far as they may go."""
    chosen = [key for key, value in vehicle.values.items() if value][:2]
    speed = type(vehicle).declaration.speed
    region = {}
    for key in dict.fromkeys([*chosen, *([speed] if speed else [])]):
        now = float(vehicle.values[key])
        ends = sorted((now * (1 - share), now * (1 + share)))
        if type(vehicle).declaration.parameters[key].allows(ends).all():
            region[key] = tuple(ends)
    return region


@pytest.mark.parametrize("name", list({type(load(n)): n for n in vehicle_names()}.values()))
def test_every_vehicle_gets_a_certificate_that_agrees_with_exact_arithmetic(name):
    vehicle = load(name)
    region = around(vehicle, 0.02)
    found = certify(vehicle, **region, boxes=400)
    functions = compiled(type(vehicle), direction(vehicle))
    random = np.random.default_rng(2)
    points = [{k: float(random.uniform(low, high)) for k, (low, high) in region.items()} for _ in range(10)]
    points += [found.counterexample.values] if found.counterexample else []
    stable = []
    for at in points:
        values = {key: Fraction(float(value)) for key, value in {**vehicle.values, **at}.items()}
        a = functions.exact_coefficients([*values.values()])[functions.structural_zeros :]
        if functions.undamped:
            a = [c + (k + 1) * a[k + 1] if k + 1 < len(a) else c for k, c in enumerate(a)]
        array = routh(a) if len(a) > 1 else None
        stable.append(array is None or (a[-1] != 0 and array.right_half_plane == 0 == array.imaginary_axis))
    assert all(stable) if found.proved else True
    assert found.counterexample is None or not stable[-1]
    assert 0 <= found.proved_share <= 1 + 1e-9


def test_proofs_reach_the_critical_speed():
    caravan = load("caravan")
    limit = critical(caravan)[0].value
    assert certify(caravan, U=(0.1, limit * (1 - 1e-6))).proved
    beyond = certify(caravan, U=(0.1, limit * (1 + 1e-6)))
    assert beyond.counterexample.values["U"] > limit
    assert beyond.counterexample.eigenvalues[0].real > 0
    assert not beyond
    assert "not stable at U" in beyond.sentence


def test_an_island_between_stable_ends_is_found():
    caravan = load("caravan")
    first, second, third = (c.value for c in critical(caravan, "c"))
    assert certify(caravan, c=(first * 1.0001, second * 0.9999)).proved
    assert certify(caravan, c=(third * 1.0001, third * 1.2)).proved
    found = certify(caravan, c=(second * 0.9999, third * 1.0001))
    assert second < found.counterexample.values["c"] < third


def test_boxes_are_left_when_effort_ends():
    car = find_model("car")(**CLOSED["car"][0])
    limit = critical(car)[0].value
    region = {"m": (1000, 1500), "U": (1, limit)}  # touches the boundary in one corner
    found = certify(car, **region, boxes=20)
    assert found.state == "undecided"
    assert 0.9 < found.proved_share < 1
    assert found.boxes <= 20
    more = certify(car, **region, boxes=40)
    assert more.proved_share > found.proved_share
    box = found.undecided
    volume = np.prod((box[:, :, 1] - box[:, :, 0]) / [500, limit - 1], axis=1).sum()
    assert volume + found.proved_share == pytest.approx(1)
    assert len(found.to_dataframe()) == len(box)
    assert "of the volume is proved stable" in str(found)


def test_many_parameters_at_once():
    caravan = load("caravan")
    region = {name: (0.97 * float(x), 1.03 * float(x)) for name, x in caravan.values.items() if name != "U"}
    found = certify(caravan, **(region | {"U": "36:50 km/h"}))
    assert found.proved, found.sentence


def test_impossible_vehicles_are_no_counterexamples():
    names = [n for n in vehicle_names() if hasattr(type(load(n)), "possible")]
    for name in names[:3]:
        vehicle = load(name)
        key = next(k for k in vehicle.values if k.startswith("I"))
        now = float(vehicle.values[key])
        found = certify(vehicle, **{key: (0.2 * now, 5 * now)}, boxes=500)
        if found.counterexample:
            assert found.counterexample.vehicle.values[key]  # it could be made


def test_decimals_mean_what_they_say():
    assert exact_range("0.1:0.3", "m", "x") == (Fraction(1, 10), Fraction(3, 10))
    assert exact_range((0.1, Fraction(1, 3)), "m", "x") == (Fraction(1, 10), Fraction(1, 3))
    assert exact_range("-36:-3.6 km/h", "m/s", "x") == (-10, -1)
    assert exact_range(("1 t", "2e3"), "kg", "x") == (1000, 2000)
    assert exact_range("1e-999999999:1", "m", "x")[1] == 1
    found = certify(load("caravan"), b=("0.3", "0.31"), U=(5, 20))
    assert found.ranges["b"] == (Fraction(3, 10), Fraction(31, 100))


class Shaped(Model):
    """A mass whose damping has a shape over two numbers."""

    m: float = param("kg", "mass", above=0)
    k: float = param("N/m", "stiffness", above=0)
    c: float = param("N s/m", "damping", above=0)
    p: float = param("1", "first number")
    q: float = param("1", "second number")

    x = coordinate("m", "displacement")

    def matrices(self):
        return [[self.k]], [[self.c * type(self).shape(self.p, self.q)]], [[self.m]]


@pytest.mark.parametrize(
    ("shape", "states"),
    [
        (lambda p, q: (p - 0.3) ** 2, "undecided"),  # touches, but nowhere in doubles
        (lambda p, q: (p - 0.3) ** 2 + 1e-9, "proved"),
        (lambda p, q: (p - 0.5123) ** 2 + (q - 0.3) ** 2 - 1e-12, "refuted"),
        (lambda p, q: 2 - p - q, "undecided"),  # touches in a corner
        (lambda p, q: 1 / (p - 0.4) ** 2, "undecided"),  # a pole between stable points
        (lambda p, q: 1 + sp.tan(2 * p + q) ** 2, "undecided"),  # the same
        (lambda p, q: 1 + sp.sqrt(p - 0.2), "undecided"),  # not defined everywhere
        (lambda p, q: sp.sin(30 * p) + 1.00001, "proved"),
        (lambda p, q: sp.sin(30 * p) + 0.99999, "refuted"),
        (lambda p, q: abs(p - q) + 1e-9, "proved"),
        (lambda p, q: abs(p - q) - 1e-9 * q, "refuted"),
    ],
)
def test_poles_touching_boundaries_and_spikes_do_not_fool_it(shape, states):
    model = type("Shape", (Shaped,), {"shape": staticmethod(shape), "__doc__": "Damped."})
    found = certify(model(m=1, k=1, c=1, p=0.5, q=0.5), p=(0, 1), q=(0, 1), boxes=3000)
    assert found.state == states


def test_what_cannot_be_enclosed_is_said():
    model = type("Larger", (Shaped,), {"shape": staticmethod(lambda p, q: sp.Max(p, q)), "__doc__": "Damped."})
    with pytest.raises(UcritError, match="contain maximum, whose range cannot be proved"):
        certify(model(m=1, k=1, c=1, p=0.5, q=0.5), p=(0, 1))


@pytest.mark.parametrize(
    ("region", "message"),
    [
        ({}, "a region is a range for each of 1 to 12 parameters"),
        ({"V": (1, 2)}, "there is no parameter 'V'"),
        ({"U": (0, 2)}, "speed of the towing vehicle U must be other than 0 m/s, got 0 m/s"),
        ({"U": (-1, 2)}, "U cannot run through 0: certify each direction by itself"),
        ({"m": (1200, 1200)}, "mass m: the range from 1200 to 1200 is empty"),
        ({"m": (1300, 1200)}, "runs backwards"),
        ({"m": (-1, 1200)}, "mass m must be above 0 kg, got -1 kg"),
        ({"m": (1, float("nan"))}, "mass m must be finite, got nan"),
        ({"m": 3}, "mass m: 3 is no range; give a pair of numbers"),
        ({"m": "3"}, "mass m: '3' is no range"),
        ({"m": "3:4 m"}, "mass m is measured in kg, got '3 m'"),
        ({"m": "1:1e999"}, "must be a finite number"),
        ({"m": (1, "x")}, "mass m must be a number"),
        ({"m": (1, None)}, "None is no number"),
    ],
)
def test_wrong_regions_are_refused_in_a_sentence(region, message):
    with pytest.raises(UcritError) as caught:
        certify(load("caravan"), **region)
    assert message in str(caught.value)
    with pytest.raises(UcritError, match="boxes must be a whole number above 0"):
        certify(load("caravan"), m=(1, 2), boxes=0)
    with pytest.raises(UcritError, match="one value each for c"):
        certify(load("caravan").with_(c=[1, 2]), m=(1, 2))
