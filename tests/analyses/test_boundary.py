"""Boundaries show all that grids of the same resolution show, and lie where stability changes."""

import importlib

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ucrit import Model, UcritError, boundary, coordinate, critical, find_model, load, param, plot, stability_map
from ucrit.analyses.linear.modes import eigenvalues

UNDAMPED = {"m": 1000, "a": 1.5, "I_c": 1800, "U": 25, "C": 5e4, "b": 1, "k": 1e4}


module = importlib.import_module("ucrit.analyses.regions.boundary")
lattice = importlib.import_module("ucrit.analyses.regions.lattice")


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


def test_cells_that_are_excluded_and_whole_grids_agree(monkeypatch):
    caravan, ranges = load("caravan"), {"c": (0, 8000), "U": (5, 50), "m": (500, 2500)}
    monkeypatch.setattr(lattice, "SLAB", 3000)
    for names, tolerance in ((("c", "U"), 1 / 256), (tuple(ranges), 1 / 32)):
        asked = {name: ranges[name] for name in names}
        whole = boundary(caravan, tolerance=tolerance, **asked)
        with monkeypatch.context() as patch:
            patch.setattr(module, "SMALL_GRID", 0)
            sure = boundary(caravan, tolerance=tolerance, **asked)
            patch.setattr(lattice, "WIDE", 0.1)  # excludes too little: given up
            given_up = boundary(caravan, tolerance=tolerance, **asked)
        np.testing.assert_allclose(np.sort(whole.points, axis=0), np.sort(sure.points, axis=0), rtol=1e-9)
        np.testing.assert_array_equal(whole.points, given_up.points)
        assert given_up.evaluations > whole.evaluations > (1 / tolerance + 1) ** len(names)


class Shaped(Model):
    """A mass whose damping has a shape over three numbers."""

    m: float = param("kg", "mass", above=0)
    k: float = param("N/m", "stiffness", above=0)
    c: float = param("N s/m", "damping", above=0)
    p: float = param("1", "first number")
    q: float = param("1", "second number")
    r: float = param("1", "third number")

    x = coordinate("m", "displacement")

    def matrices(self):
        return [[self.k]], [[self.c * type(self).shape(self.p, self.q, self.r)]], [[self.m]]


def island(p, q, r):
    return (p - 0.31) ** 2 + (q - 0.47) ** 2 + (r - 0.5) ** 2 - 4e-4


def cusp(p, q, r):
    return (p - 0.3) ** 3 - (q - 0.4) ** 2 + 1e-3 * r


def crossing(p, q, r):
    return (p - 0.3) * (q - 0.4) - 0.01 * (r - 0.5)


def nearly_touching(p, q, r):
    return (q - 0.4 - 0.2 * p) ** 2 - 1e-5 + 0 * r


def two_shells(p, q, r):
    return ((p - 0.5) ** 2 + (q - 0.5) ** 2 + (r - 0.5) ** 2 - 0.1) ** 2 - 1e-5


@pytest.mark.parametrize("small", [0, 2**19])
@pytest.mark.parametrize("shape", [island, cusp, crossing, nearly_touching, two_shells])
def test_islands_cusps_and_curves_that_touch(shape, small, monkeypatch):
    monkeypatch.setattr(module, "SMALL_GRID", small)
    model = type(shape.__name__, (Shaped,), {"shape": staticmethod(shape), "__doc__": "Damped."})
    vehicle = model(m=1, k=1, c=1, p=0.5, q=0.5, r=0.5)
    for ranges, tolerance in (
        ({"p": (0, 1), "q": (0.02, 0.97)}, 1 / 256),
        ({"p": (0, 1), "q": (0, 0.9), "r": (0, 1)}, 1 / 64),
    ):
        result = boundary(vehicle, tolerance=tolerance, **ranges)
        wanted, n = cells_of_grid(vehicle, result)
        assert wanted.any()
        assert not (wanted & ~cells_of_points(result, n)).any()
        p, q, r = (result.points[:, list(ranges).index(x)] if x in ranges else 0.5 for x in "pqr")
        assert np.abs(shape(p, q, r)).max() < 1e-9


@pytest.mark.parametrize("small", [0, 2**19])
def test_twelve_states_over_three_parameters(small, monkeypatch):
    monkeypatch.setattr(module, "SMALL_GRID", small)
    truck = load("coach-truck")
    ranges = {name: (0.4 * float(truck.values[name]), 2.2 * float(truck.values[name])) for name in ("V", "k_s", "m_f")}
    result = boundary(truck, tolerance=1 / 16, **ranges)
    wanted, n = cells_of_grid(truck, result)
    assert wanted.any()
    assert not (wanted & ~cells_of_points(result, n)).any()


def test_few_evaluations_are_needed():
    result = boundary(load("caravan"), c=(0, 8000), U=(5, 50), tolerance=1 / 4096)
    assert 40 * result.evaluations < 4097**2


def test_a_point_of_a_curve_and_pictures():
    result = boundary(load("caravan"), c=(0, 8000), U="20:180 km/h", tolerance=1 / 64)
    assert "flutter" in str(result)
    assert result.to_dataframe().shape == (len(result.points), 5)
    drawn = plot(result).axes[0]
    assert len(drawn.get_lines()) >= 2
    assert {"stable", "unstable"} <= {text.get_text() for text in drawn.texts}
    assert result.sides.stable.shape == (65, 65)
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
        ({"U": (5, float("nan")), "m": (1, 2)}, "list of numbers, got"),
        ({"U": (5, 50), "m": (1, "x")}, "list of numbers, got"),
        ({"U": (5, 50), "m": (1, 2), "tolerance": "x"}, "tolerance must be a number"),
        ({"U": (5, 50), "m": (1, 2), "tolerance": 1e-9}, "tolerance"),
    ],
)
def test_impossible_ranges_are_refused(ranges, message):
    with pytest.raises(UcritError, match=message):
        boundary(load("caravan"), **ranges)
