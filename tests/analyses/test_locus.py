"""Root loci: continuous branches that lose nothing and carry the right names."""

import numpy as np
import pytest

from ucrit import UcritError, critical, load, modes
from ucrit.analyses.linear.modes import eigenvalues
from ucrit.analyses.stability.dense import dense_branches
from ucrit.analyses.stability.locus import FARTHEST, SMALLEST, STEP, locus
from ucrit.catalogue import vehicle_names


def speeds():
    return [name for name in vehicle_names() if type(load(name)).declaration.speed]


def around(vehicle, name=None):
    now = float(vehicle.values[name or type(vehicle).declaration.speed])
    return sorted((0.05 * now, 2 * now))


@pytest.mark.parametrize("name", speeds())
def test_each_row_holds_all_eigenvalues(name):
    vehicle = load(name)
    result = locus(vehicle, None, *around(vehicle), points=60)
    direct = eigenvalues(vehicle.with_(**{result.parameter: result.values}))
    size = np.abs(direct).max() or 1.0
    key = lambda rows: np.sort_complex(np.round(rows / size, 9))  # noqa: E731
    np.testing.assert_array_equal(key(result.branches), key(direct))
    assert (np.diff(result.values) > 0).all()


@pytest.mark.parametrize("name", speeds())
def test_branches_are_continuous_and_keep_their_half_planes(name):
    vehicle = load(name)
    result = locus(vehicle, None, *around(vehicle), points=200)
    jump = np.abs(np.diff(result.branches, axis=0))
    size = np.abs(result.branches)
    floor = np.median(size[size > 0]) if size.any() else 0.0
    assert (jump <= 8 * STEP * np.maximum(np.maximum(size[1:], size[:-1]), floor)).all()
    sides = np.sign(result.branches.imag)
    assert (sides[1:] * sides[:-1] >= 0).all()


def test_names_are_those_of_the_modes_of_the_vehicle():
    caravan = load("caravan")
    result = locus(caravan)
    here = int(np.flatnonzero(result.values == caravan.values["U"])[0])
    found = modes(caravan)
    assert result.reference == caravan.values["U"]
    assert result.names == found.names
    np.testing.assert_allclose(result.branches[here], found.eigenvalues)
    outside = locus(caravan, "U", 1, 5)
    assert outside.reference == 5
    assert outside.names == modes(caravan.with_(U=5)).names


def test_default_range_shows_the_critical_speed_and_the_present_one():
    caravan = load("caravan")
    top = 1.5 * max(caravan.values["U"], critical(caravan)[-1].value)
    result = locus(caravan)
    assert result.values[-1] == pytest.approx(top, rel=1e-5)
    assert result.values[0] == pytest.approx(SMALLEST * top, rel=1e-2)
    slow = locus(caravan.with_(U=10))
    assert slow.values[-1] == pytest.approx(1.5 * critical(caravan)[-1].value, rel=1e-5)


def test_far_critical_values_do_not_stretch_the_range():
    caravan = load("caravan").with_(U=23.235 / FARTHEST / 2)
    assert locus(caravan).values[-1] == pytest.approx(1.5 * caravan.values["U"], rel=1e-5)


def test_backing_up_runs_over_negative_speeds():
    result = locus(load("caravan").with_(U=-5))
    assert result.values[0] == pytest.approx(-7.5, rel=1e-5)
    assert result.values[-1] == pytest.approx(-0.075, rel=1e-2)


def test_growth_changes_sign_at_the_critical_speed():
    result = locus(load("caravan"))
    change = result.values[np.flatnonzero(np.diff(np.sign(result.growth)))]
    assert change == pytest.approx([critical(load("caravan"))[0].value], rel=0.01)


def test_points_are_denser_where_eigenvalues_move_fast():
    result = locus(load("caravan"), points=100)
    assert 100 < result.values.size <= 800
    assert np.diff(result.values).min() < 0.1 * np.diff(result.values).max()


def test_another_parameter():
    result = locus(load("caravan"), "c", 0, 12000, points=50)
    assert (result.parameter, result.unit) == ("c", "N m s/rad")
    assert result.growth[0] > 0 > result.growth[-1]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"parameter": "speed"}, "there is no parameter 'speed'"),
        ({"lower": 5, "upper": 5}, "empty"),
        ({"lower": 5, "upper": 2}, "empty"),
        ({"upper": float("inf")}, "finite"),
        ({"parameter": "m", "lower": -3, "upper": 5}, "above 0 kg, got -3 kg"),
        ({"points": 1}, "needs 2 to 10000000 points, got 1"),
        ({"points": 2.5}, "needs 2 to 10000000 points, got 2.5"),
    ],
)
def test_impossible_requests_are_refused(arguments, message):
    with pytest.raises(UcritError, match=message):
        locus(load("caravan"), **arguments)


def test_array_vehicles_and_missing_speeds_are_refused():
    with pytest.raises(UcritError, match="one value each for m"):
        locus(load("caravan").with_(m=[1000, 1200]))
    with pytest.raises(UcritError, match="a range must be given"):
        locus(load("caravan-rigid-hitch").with_(b=0), "b")


@pytest.mark.parametrize(
    ("name", "top"),
    [("benchmark-bicycle", 10), ("caravan", 45), ("shimmying-caster", 30), ("car-inertial", 40)],
)
def test_filled_in_branches_are_the_eigenvalues(name, top):
    name = name if name in vehicle_names() else "bmw-320i"
    vehicle = load(name)
    speed = type(vehicle).declaration.speed
    dense, coarse = (locus(vehicle, speed, 0.1, top, points=n) for n in (2500, 500))
    exact = eigenvalues(vehicle.with_(**{speed: dense.values}))
    size = np.abs(exact).max()
    for k in range(dense.branches.shape[1]):  # each branch value is an eigenvalue, and none is taken twice
        gap = np.abs(exact - dense.branches[:, k : k + 1])
        assert gap.min(axis=1).max() < 1e-8 * size
        exact[np.arange(len(exact)), gap.argmin(axis=1)] = np.inf
    step = np.abs(np.diff(dense.branches, axis=0)).max() / size
    assert step < 0.05
    assert dense.names == coarse.names
    np.testing.assert_allclose(dense.branches.sum(axis=1).imag, 0, atol=1e-9 * size)


def test_branches_of_high_order_are_not_filled_in():
    truck = load("coach-truck")
    nodes = np.array([10.0, 20.0])
    found = eigenvalues(truck.with_(V=nodes))
    assert dense_branches(truck, "V", np.linspace(10, 20, 9), nodes, found) is None
