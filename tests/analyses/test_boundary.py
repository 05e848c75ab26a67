"""Boundaries show all that grids of the same resolution show, and lie where stability changes."""

import importlib

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ucrit import UcritError, boundary, critical, find_model, load, plot, stability_map
from ucrit.analyses.modes import eigenvalues

UNDAMPED = {"m": 1000, "a": 1.5, "I_c": 1800, "U": 25, "C": 5e4, "b": 1, "k": 1e4}


module = importlib.import_module("ucrit.analyses.boundary")
lattice = importlib.import_module("ucrit.analyses.lattice")


def cells_of_grid(vehicle, result):
    """Cells of the full grid of the same resolution whose corners differ."""
    n = round(1 / result.tolerance)
    share = np.linspace(0, 1, n + 1)
    grid = {
        name: lo * (hi / lo) ** share if log else lo + (hi - lo) * share
        for name, lo, hi, log in zip(result.parameters, result.lower, result.upper, result.log, strict=True)
    }
    stable = stability_map(vehicle, **grid).stable
    for axis in range(stable.ndim):
        low, high = np.delete(stable, -1, axis), np.delete(stable, 0, axis)
        stable = np.stack([low, high], axis=-1) if axis == 0 else np.concatenate([low, high], axis=-1)
    return stable.any(axis=-1) & ~stable.all(axis=-1), n


def cells_of_points(result, n):
    """Cells of that grid which hold a point of the boundary."""
    share = [
        np.log(x / lo) / np.log(hi / lo) if log else (x - lo) / (hi - lo)
        for x, lo, hi, log in zip(result.points.T, result.lower, result.upper, result.log, strict=True)
    ]
    hit = np.zeros((n,) * len(share), dtype=bool)
    for step in np.ndindex(*(2,) * len(share)):  # a point on an edge belongs to the cells on both sides
        shift = (np.array(step) - 0.5)[:, None] * 2e-6
        hit[tuple(np.clip(np.floor(np.array(share) * n + shift).astype(int), 0, n - 1))] = True
    return hit


CASES = [
    ("caravan", {"c": (0, 8000), "U": (5, 50)}),
    ("caravan", {"m": (200, 3000), "b": (0, 1)}),
    ("oversteering-car", {"U": "1:60:log", "a": (0.5, 2)}),
    ("shimmying-caster", {"U": (1, 30), "k": "1e3:1e6:log"}),
    ("coach-truck-rigid", {"V": (10, 200), "k_s": (0, 2e6)}),
]


@pytest.mark.parametrize(("name", "ranges"), CASES)
def test_nothing_is_missed_that_a_grid_shows(name, ranges):
    vehicle = load(name)
    result = boundary(vehicle, tolerance=1 / 128, **ranges)
    wanted, n = cells_of_grid(vehicle, result)
    hit = cells_of_points(result, n)
    assert wanted.any()
    assert not (wanted & ~hit).any()


@settings(max_examples=12, deadline=None)
@given(st.lists(st.floats(0.4, 2.5), min_size=8, max_size=8), st.sampled_from(["m", "a", "C", "k", "I_c"]))
def test_nothing_is_missed_on_random_trailers(factors, first):
    caravan = load("caravan")
    names = list(caravan.values)
    values = {name: float(caravan.values[name]) * f for name, f in zip(names, factors, strict=False)}
    vehicle = caravan.with_(**values)
    now = values[first]
    result = boundary(vehicle, tolerance=1 / 64, **{first: (0.2 * now, 4 * now), "U": (2, 60)})
    wanted, n = cells_of_grid(vehicle, result)
    assert not (wanted & ~cells_of_points(result, n)).any()
    if len(result.points):
        growth = eigenvalues(vehicle.along("point", **dict(zip(result.parameters, result.points.T, strict=True))))
        assert np.abs(growth.real.max(axis=-1)).max() < 1e-6 * np.abs(growth).max()


def test_the_boundary_is_the_books_formula():
    trailer = find_model("trailer-undamped-hitch")(**UNDAMPED)
    result = boundary(trailer, b=(0, 2), k="1e3:1e6:log", tolerance=1 / 256)
    m, a, I_c, C = (UNDAMPED[name] for name in ("m", "a", "I_c", "C"))
    b, k = result.points.T
    terms = (a * b * m, I_c), (C * (I_c + b**2 * m), k * (a * b * m - I_c) * (a + b))
    off = [abs((x - y) if x is a * b * m else x + y) / (abs(x) + abs(y)) for x, y in terms[1:]]
    first = abs(a * b * m - I_c) / I_c
    assert np.minimum(first, off[0]).max() < 1e-9
    assert len(result.lines) == 2
    assert set(result.kinds) == {"flutter"}


def test_kinds_and_values_agree_with_critical_speeds():
    bicycle = load("benchmark-bicycle")
    result = boundary(bicycle, c=(0.02, 0.14), U=(1, 10), tolerance=1 / 64)
    for kind, expected in (("flutter", critical(bicycle)[0].value), ("divergence", critical(bicycle)[1].value)):
        line = result.points[result.kinds == kind]
        order = np.argsort(line[:, 0])
        assert np.interp(0.08, *line[order].T) == pytest.approx(expected, rel=1e-3)


def test_surfaces_agree_with_the_curves_in_their_planes():
    caravan = load("caravan")
    result = boundary(caravan, c=(0, 8000), U=(5, 50), m=(500, 2500), tolerance=1 / 32)
    wanted, n = cells_of_grid(caravan, result)
    assert not (wanted & ~cells_of_points(result, n)).any()
    assert result.triangles.shape[1:] == (3, 3)
    edges = np.sort(result.pieces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    assert np.unique(edges, axis=0, return_counts=True)[1].max() == 2  # the surface has no branches


def test_whole_grids_agree(monkeypatch):
    """Where enclosures are of no use; slabs change nothing."""
    caravan, ranges = load("caravan"), {"c": (0, 8000), "U": (5, 50), "m": (500, 2500)}
    for names, tolerance in ((("c", "U"), 1 / 256), (tuple(ranges), 1 / 16)):
        asked = {name: ranges[name] for name in names}
        sure = boundary(caravan, tolerance=tolerance, **asked)
        with monkeypatch.context() as patch:
            patch.setattr(module._Search, "_enclosable", lambda self: False)
            patch.setattr(lattice, "SLAB", 3000)
            whole = boundary(caravan, tolerance=tolerance, **asked)
        np.testing.assert_allclose(np.sort(whole.points, axis=0), np.sort(sure.points, axis=0), rtol=1e-9)
        assert whole.evaluations > (1 / tolerance + 1) ** len(names)


def test_few_evaluations_are_needed():
    result = boundary(load("caravan"), c=(0, 8000), U=(5, 50), tolerance=1 / 4096)
    assert 40 * result.evaluations < 4097**2


def test_a_point_of_a_curve_and_pictures():
    result = boundary(load("caravan"), c=(0, 8000), U="20:180 km/h", tolerance=1 / 64)
    assert "flutter" in str(result)
    assert result.to_dataframe().shape == (len(result.points), 5)
    assert len(plot(result).axes[0].get_lines()) >= 2
    assert plot(boundary(load("caravan"), c=(0, 8000), U=(5, 50), m=(500, 2500), tolerance=1 / 8)).axes
    nothing = boundary(load("understeering-car"), U=(1, 60), m=(500, 2500), tolerance=1 / 64)
    assert len(nothing.points) == 0 == len(nothing.lines)
    with pytest.raises(UcritError, match="no boundary to draw"):
        plot(nothing)


@pytest.mark.parametrize(
    ("ranges", "message"),
    [
        ({"U": (5, 50)}, "two or three parameters, got 1"),
        ({"U": (5, 50), "cc": (1, 2)}, "there is no parameter 'cc'"),
        ({"U": (5, 5), "c": (1, 2)}, "is empty"),
        ({"U": (5, 50), "m": (-1, 2)}, "above 0 kg"),
        ({"U": (5, 50), "m": (1, 2, 3)}, "both ends"),
        ({"U": "5:50:7", "m": (1, 2)}, "LO:HI"),
        ({"U": (-5, 50), "m": (1, 2)}, "must not cross 0"),
        ({"U": (5, float("nan")), "m": (1, 2)}, "empty"),
        ({"U": (5, 50), "m": (1, 2), "tolerance": 1e-9}, "tolerance"),
    ],
)
def test_impossible_ranges_are_refused(ranges, message):
    with pytest.raises(UcritError, match=message):
        boundary(load("caravan"), **ranges)
