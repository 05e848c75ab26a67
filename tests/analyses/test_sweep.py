"""Sweeps over ranges of parameters, and ranges as people type them."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ucrit import UcritError, load, modes
from ucrit.analyses.regions import sweep as module
from ucrit.analyses.regions.ranges import COUNT, MAX_COUNT, parse_range
from ucrit.analyses.regions.sweep import sweep
from ucrit.catalogue import vehicle_names
from ucrit.core.contract.possible import allowed


def test_every_entry_is_that_of_the_vehicle_with_these_values():
    caravan = load("caravan")
    result = sweep(caravan, U=[10, 25, 40], c=[0, 4000], b=[-0.0, 0.3, 0.6, 1.2])
    assert result.dims == ("U", "c", "b")
    assert result.eigenvalues.shape == (3, 2, 4, 4)
    for i, j, k in np.ndindex(3, 2, 4):
        one = caravan.with_(U=result.coords["U"][i], c=result.coords["c"][j], b=result.coords["b"][k])
        found = modes(one)
        np.testing.assert_allclose(result.eigenvalues[i, j, k], found.eigenvalues, rtol=1e-9)
        assert result.growth[i, j, k] == pytest.approx(float(found.growth))
        assert result.damping[i, j, k] == pytest.approx(min(mode.damping_ratio for mode in found))
        assert result.unstable[i, j, k] == (found.eigenvalues.real > 0).sum()
        assert result.stable[i, j, k] == (found.growth < 0)
    assert 0 < result.stable.sum() < result.stable.size


def test_dimensions_come_in_the_order_given():
    caravan = load("caravan")
    one = sweep(caravan, U=[10, 40], m=[900, 1200, 1500])
    other = sweep(caravan, m=[900, 1200, 1500], U=[10, 40])
    assert (one.dims, other.dims) == (("U", "m"), ("m", "U"))
    assert other.growth.shape == (3, 2)
    np.testing.assert_array_equal(one.growth.T, other.growth)
    np.testing.assert_array_equal(one.stable.T, other.stable)


def test_array_parameters_of_the_vehicle_follow_the_ranges():
    fleet = load("caravan").along("loading", m=[900, 1200, 1500], I_c=[1800, 2300, 2900])
    result = sweep(fleet, U=[10, 40])
    assert result.dims == ("U", "loading")
    single = sweep(load("caravan").with_(m=1500, I_c=2900), U=[10, 40])
    np.testing.assert_allclose(result.growth[:, 2], single.growth)


@pytest.mark.parametrize("name", vehicle_names())
def test_verdicts_agree_with_eigenvalues(name):
    vehicle = load(name)
    parameter = type(vehicle).declaration.speed or next(iter(vehicle.values))
    values = float(vehicle.values[parameter]) * np.linspace(0.2, 3, 41)
    result = sweep(vehicle, **{parameter: values[allowed(vehicle, parameter).allows(values)]})
    noise = 1e-9 * np.abs(result.eigenvalues).max(axis=-1)
    clear = np.abs(result.growth) > noise
    np.testing.assert_array_equal(result.stable[clear], result.growth[clear] < 0)
    np.testing.assert_array_equal(result.unstable, (result.eigenvalues.real > noise[:, None]).sum(axis=-1))


def test_blocks_change_nothing_and_report_progress(monkeypatch):
    caravan, calls = load("caravan"), []
    ranges = {"c": [0, 2000, 4000], "U": np.linspace(5, 40, 11)}
    whole = sweep(caravan, **ranges)
    monkeypatch.setattr(module, "BLOCK", 12)
    parts = sweep(caravan, progress=lambda done, total: calls.append((done, total)), **ranges)
    assert calls == [(11, 33), (22, 33), (33, 33)]
    np.testing.assert_array_equal(whole.eigenvalues, parts.eigenvalues)
    np.testing.assert_array_equal(whole.stable, parts.stable)


def test_forward_and_backward_in_one_sweep():
    caravan = load("caravan")
    result = sweep(caravan, U=[-5, 5])
    assert result.stable.tolist() == [False, True]
    np.testing.assert_allclose(result.eigenvalues[0], modes(caravan.with_(U=-5)).eigenvalues)


def test_rigid_positions_neither_grow_nor_are_damped():
    result = sweep(load("supermarket-cart"), U=[0.5, 1, 2])
    assert result.stable.all()
    assert (result.eigenvalues == 0).sum(axis=-1).min() > 0
    assert (result.growth < 0).all()
    assert np.isfinite(result.damping).all()


@pytest.mark.parametrize(
    ("ranges", "message"),
    [
        ({}, "at least one range"),
        ({"V": [1, 2]}, "there is no parameter 'V'"),
        ({"m": [1000, -5]}, "above 0 kg, got -5 kg"),
        ({"m": []}, "empty"),
        ({"m": 1200}, "single value 1200"),
        ({"m": np.ones((2, 2))}, "one-dimensional"),
        ({"U": [10, np.nan]}, "finite"),
        ({"m": "5:1 t"}, "mass m: the range '5:1 t' runs backwards"),
        ({"m": "1:2 m"}, "measured in kg"),
    ],
)
def test_ranges_that_make_no_sense_are_refused_in_a_sentence(ranges, message):
    with pytest.raises(UcritError, match=message) as caught:
        sweep(load("caravan"), **ranges)
    assert "\n" not in str(caught.value)


def test_what_does_not_fit_in_memory_is_refused_before_it_is_computed():
    with pytest.raises(UcritError, match=r"100,000,000 points .* GiB"):
        sweep(load("caravan"), m=np.linspace(500, 2000, 10_000), U=np.linspace(1, 40, 10_000))


def test_text_and_arrays_mean_the_same():
    caravan = load("caravan")
    text = sweep(caravan, U="36:108:3 km/h", m="1, 2 t")
    np.testing.assert_allclose(text.coords["U"], [10, 20, 30])
    np.testing.assert_allclose(text.coords["m"], [1000, 2000])


@pytest.mark.parametrize(
    ("text", "unit", "values"),
    [
        ("5:40:8", "m/s", np.linspace(5, 40, 8)),
        ("5:40", "m/s", np.linspace(5, 40, COUNT)),
        (" 36 : 108 : 3 km/h ", "m/s", [10, 20, 30]),
        ("36:108 km/h:3", "m/s", [10, 20, 30]),
        ("36 km/h:30 m/s:3", "m/s", [10, 20, 30]),
        ("1e3:1e6:4:log N/m", "N/m", [1e3, 1e4, 1e5, 1e6]),
        ("1e3:1e6:4:log", "N/m", [1e3, 1e4, 1e5, 1e6]),
        ("1:1000:4:log kN/m", "N/m", [1e3, 1e4, 1e5, 1e6]),
        ("-2:2:5", "1", [-2, -1, 0, 1, 2]),
        ("1, 2, 5 t", "kg", [1000, 2000, 5000]),
        ("500 kg, 1, 2 t", "kg", [500, 1000, 2000]),
        ("3,1,2", "kg", [3, 1, 2]),
    ],
)
def test_ranges_are_read(text, unit, values):
    np.testing.assert_allclose(parse_range(text, unit), values, rtol=1e-12)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("40:5", "runs backwards"),
        ("5:5", "is empty"),
        ("5", "is no range"),
        ("", "not a number"),
        ("5:", "not a number"),
        ("a:b", "not a number"),
        ("1,,2", "not a number"),
        ("1:2:3:4", "'log' comes fourth"),
        ("1:2:log", "'log' comes fourth"),
        ("1:2:3:log:5", "is no range"),
        ("1:2,3", "is no range"),
        ("log,2", "'log'"),
        ("0:5:3:log", "logarithmic"),
        ("-1:5:3:log", "logarithmic"),
        ("1:2:1", "from 2 to"),
        ("1:2:2.5", "whole number"),
        (f"1:2:{MAX_COUNT + 1}", "from 2 to"),
        ("5 km/h:40", "needs one too"),
        ("5 km/h, 10", "needs one too"),
        ("1:2 m/s:5 km/h", "strange place"),
        ("1:2:3 kg", "measured in m/s"),
        ("1:2:3 furlongs per fortnite", "not a unit"),
        ("1:1e999", "finite"),
        ("nan:3", "not a number"),
    ],
)
def test_texts_that_are_no_range_are_refused_in_a_sentence(text, message):
    with pytest.raises(UcritError, match=message) as caught:
        parse_range(text, "m/s", "trailer: speed U")
    assert str(caught.value).startswith("trailer: speed U")
    assert "\n" not in str(caught.value)


numbers = st.floats(-1e6, 1e6).map(lambda x: round(x, 6))


@given(low=numbers, high=numbers, count=st.integers(2, 50))
def test_a_range_has_its_ends_its_count_and_even_steps(low, high, count):
    if low >= high:
        return
    values = parse_range(f"{low!r}:{high!r}:{count}")
    assert values.size == count
    assert (values[0], values[-1]) == (low, high)
    assert np.ptp(np.diff(values)) <= 1e-9 * max(abs(low), abs(high))


@given(st.text(alphabet="0123456789.:, elogkmht/-+", max_size=15))
def test_any_text_gives_finite_values_or_a_sentence(text):
    values, said = np.zeros(2), ""
    try:
        values = parse_range(text, "kg")
    except UcritError as error:
        said = str(error)
    assert len(values) >= 2
    assert np.isfinite(values).all()
    assert "\n" not in said
