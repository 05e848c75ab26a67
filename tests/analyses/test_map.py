"""Stability maps agree with eigenvalues at every point."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ucrit import UcritError, find_model, load
from ucrit.analyses.linear.modes import eigenvalues
from ucrit.analyses.linear.modes import growth as growth_of
from ucrit.analyses.regions.stability_map import stability_map
from ucrit.analyses.stability import judge
from ucrit.catalogue import vehicle_names
from ucrit.core.contract.possible import allowed
from ucrit.core.numeric.compiled import compiled

UNDAMPED = {"m": 1000, "a": 1.5, "I_c": 1800, "U": 25, "C": 5e4, "b": 1, "k": 1e4}


def spread(vehicle, name, count):
    now = float(vehicle.values[name])
    return (now or 1.0) * np.linspace(0.3, 3, count)


def test_the_trailer_map():
    trailer = find_model("trailer-undamped-hitch")(**UNDAMPED)
    b, k = np.linspace(0, 2, 1000), np.geomspace(1e3, 1e6, 1000)
    result = stability_map(trailer, b=b, k=k)
    assert result.stable.shape == (1000, 1000)
    assert result.share == pytest.approx(0.62, abs=0.005)
    m, a, I_c, C = (UNDAMPED[name] for name in ("m", "a", "I_c", "C"))
    B, K = b[:, None], k[None, :]
    book = (a * B * m - I_c) * (C * (I_c + B**2 * m) + K * (a * B * m - I_c) * (a + B)) > 0
    np.testing.assert_array_equal(result.stable, book)
    rows = slice(None, None, 10)
    values = eigenvalues(trailer.with_(b=b[rows], k=k[rows]))
    np.testing.assert_array_equal(result.stable[rows, rows], values.real.max(axis=-1) < 0)


@pytest.mark.parametrize("name", vehicle_names())
def test_maps_of_all_vehicles_agree_with_eigenvalues(name):
    vehicle = load(name)
    names = list(vehicle.values)
    together = hasattr(type(vehicle), "possible")
    x, y = names[0], type(vehicle).declaration.speed or names[-1 if together else 1]
    grid = {key: spread(vehicle, key, count) for key, count in ((x, 13), (y, 31))}
    grid = {key: values[allowed(vehicle, key).allows(values)] for key, values in grid.items()}
    result = stability_map(vehicle, **grid)
    swept = vehicle.with_(**result.coords)
    values = eigenvalues(swept)
    if list(swept.dims) != list(result.dims):
        values = values.swapaxes(0, 1)
    size = np.abs(values).max(axis=-1)
    growth = growth_of(swept, values)
    sure = np.abs(growth) > 1e-9 * size
    np.testing.assert_array_equal(result.stable[sure], growth[sure] < 0)
    if compiled(type(vehicle)).undamped:
        # neutral counts as stable, but for the points on a boundary
        assert sure.all() or result.stable[~sure].mean() > 0.9
    else:
        assert sure.mean() > 0.95 or result.stable[~sure].all() or not result.stable[~sure].any()


@settings(max_examples=25)
@given(data=st.data(), block=st.integers(1, 40))
def test_blocks_and_order_change_nothing(data, block):
    caravan = load("caravan")
    names = data.draw(st.permutations(["U", "m", "c"]))
    sizes = {name: data.draw(st.integers(1, 6)) for name in names}
    grid = {name: spread(caravan, name, sizes[name]) for name in names}
    whole = stability_map(caravan, **grid).stable
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(judge, "BLOCK", block)
        parts = stability_map(caravan, **grid)
    np.testing.assert_array_equal(parts.stable, whole)
    swapped = dict(reversed(grid.items()))
    np.testing.assert_array_equal(stability_map(caravan, **swapped).stable, whole.transpose(2, 1, 0))
    assert parts.share == whole.mean()


def test_a_point_on_the_boundary_is_not_stable():
    car = load("neutral-car")
    free = find_model("trailer-rigid-tire-undamped")(m=1000, I_c=1500, a=1.5, b=1, k=1e4, U=20)
    assert stability_map(free, b=[0.99, 1.0, 1.01]).stable.tolist() == [False, False, True]
    assert stability_map(car, U=[10, 20]).stable.all()


def test_text_ranges():
    result = stability_map(load("caravan"), U="36:108:3 km/h", c="0, 4000")
    np.testing.assert_allclose(result.coords["U"], [10, 20, 30])
    assert result.dims == ("U", "c")


@pytest.mark.parametrize(
    ("grid", "message"),
    [
        ({}, "needs ranges"),
        ({"V": [1, 2]}, "there is no parameter 'V'"),
        ({"m": [1, -1]}, "above 0 kg, got -1 kg"),
        ({"m": []}, "empty"),
        ({"m": 5.0}, "single value"),
        ({n: np.linspace(1, 2, 10_000) for n in ("m", "I_c", "a")}, "too large.*'stream'"),
    ],
)
def test_impossible_grids_are_refused(grid, message):
    with pytest.raises(UcritError, match=message):
        stability_map(load("caravan"), **grid)


def test_array_vehicles_are_refused():
    with pytest.raises(UcritError, match="one value each for m"):
        stability_map(load("caravan").with_(m=[1000, 1200]), U=[10, 20])
