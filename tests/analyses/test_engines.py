"""All engines give one answer, that of exact arithmetic, on random models and exactly on boundaries."""

import math
import os
import subprocess
import sys
from fractions import Fraction
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ucrit import Model, UcritError, coordinate, find_model, load, param, stability_map, sweep
from ucrit.analyses.linear.modes import eigenvalues, growth
from ucrit.analyses.stability import judge
from ucrit.analyses.stability.judge import settle
from ucrit.core.errors import MissingExtraError
from ucrit.core.numeric import kernels, rows
from ucrit.core.numeric.compiled import compiled

pytest.importorskip("numba")


class Chain(Model):
    """Three masses between springs, pushed round by follower forces: of sixth order."""

    m: float = param("kg", "mass", above=0)
    k: float = param("N/m", "stiffness", above=0)
    c: float = param("N s/m", "damping", above=0)
    f: float = param("N/m", "cross stiffness")

    x = coordinate("m", "first displacement")
    y = coordinate("m", "second displacement")
    z = coordinate("m", "third displacement")

    def matrices(self):
        K = [[2 * self.k, -self.k, self.f], [-self.k - self.f, 2 * self.k, -self.k], [0, -self.k, self.k]]
        return K, [[self.c, 0, 0], [0, self.c, 0], [0, 0, self.c]], [[self.m, 0, 0], [0, self.m, 0], [0, 0, self.m]]


def around(vehicle, names, sizes, low=0.3, high=3.0):
    values = (float(vehicle.values[name]) or 1.0 for name in names)
    return {name: now * np.linspace(low, high, n) for name, now, n in zip(names, values, sizes, strict=True)}


@pytest.mark.parametrize(
    ("name", "names"),
    [
        ("caravan", ("c", "U")),
        ("caravan", ("U", "m", "c")),
        ("shimmying-caster", ("U", "k")),
        ("chain", ("k", "c")),
        ("satellite-largest-axis", ("I_zz", "Omega")),
        ("boeing-747", ("U",)),
    ],
)
def test_engines_agree(name, names):
    vehicle = Chain(m=1, k=1, c=0.1, f=0.3) if name == "chain" else load(name)
    names = [n for n in names if n in vehicle.values] or list(vehicle.values)[:2]
    narrow = {"low": 1.0, "high": 1.5} if hasattr(vehicle, "possible") else {}
    grid = around(vehicle, names, (37, 23, 5)[: len(names)], **narrow)
    numpy = stability_map(vehicle, engine="numpy", **grid)
    numba = stability_map(vehicle, engine="numba", **grid)
    np.testing.assert_array_equal(numpy.stable, numba.stable)
    place = np.indices(numpy.stable.shape).reshape(len(names), -1)
    columns = {n: x[i] for (n, x), i in zip(grid.items(), place, strict=True)}
    np.testing.assert_array_equal(numpy.stable.ravel(), settle(vehicle, columns))


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 10**6), st.sampled_from(["caravan", "coach-truck", "car-and-caravan", "wheelset", "navion"]))
def test_the_answer_is_that_of_eigenvalues_on_random_vehicles(seed, name):
    vehicle = load(name)
    random = np.random.default_rng(seed)
    parameters = type(vehicle).declaration.parameters
    changed = {n: float(v) * 10 ** random.uniform(-1, 1) for n, v in vehicle.values.items()}
    vehicle = vehicle.with_(**{n: x for n, x in changed.items() if parameters[n].allows(x)})
    free = [n for n in parameters if parameters[n].allows(float(vehicle.values[n]) * 3)]
    grid = {str(n): float(vehicle.values[n]) * np.geomspace(0.4, 2, 12) for n in random.choice(free, 2, replace=False)}
    grid = {n: x for n, x in grid.items() if parameters[n].allows(x).all() and np.ptp(x)}
    if not grid:
        return
    result = stability_map(vehicle, engine="numpy", **grid)
    swept = vehicle.with_(**grid)
    values = eigenvalues(swept)
    rates = (growth(swept, values) / np.abs(values).max(axis=-1)).transpose([list(swept.dims).index(n) for n in grid])
    sure = np.abs(rates) > 1e-7
    np.testing.assert_array_equal(result.stable[sure], (rates < 0)[sure])


@pytest.mark.parametrize("engine", ["numpy", "numba"])
def test_exactly_marginal_points_are_not_stable(engine):
    free = find_model("trailer-rigid-tire-undamped")(m=1000, I_c=1500, a=1.5, b=1, k=1e4, U=20)
    assert stability_map(free, engine=engine, b=[0.99, 1.0, 1.01]).stable.tolist() == [False, False, True]
    b = np.array([np.nextafter(1, 0), 1.0, np.nextafter(1, 2)])
    assert stability_map(free, engine=engine, b=b).stable.tolist() == [False, False, True]
    # marginal all over: a b m = I_c with numbers that are not exact in binary
    m = np.geomspace(0.1, 1e5, 50)
    many = free.with_(a=0.1, b=0.3)
    flags = [stability_map(many.with_(I_c=float(x) * 0.1 * 0.3), engine=engine, m=[x, 2 * x]).stable for x in m]
    for x, (at, above) in zip(m, flags, strict=True):
        assert above
        assert at == (Fraction(float(x)) * Fraction(0.1) * Fraction(0.3) > Fraction(float(x) * 0.1 * 0.3))


@pytest.mark.parametrize(("operations", "count"), [(judge.EXACT_OPERATIONS, 5_000), (1, 100_000)])
def test_a_long_line_on_the_boundary_is_not_stable(operations, count, monkeypatch):
    """However few of its points are settled exactly."""
    monkeypatch.setattr(judge, "EXACT_OPERATIONS", operations)
    free = find_model("trailer-rigid-tire-undamped")(m=1000, I_c=1500, a=1.5, b=1, k=1e4, U=20)
    other = find_model("trailer-undamped-hitch")(m=1000, a=1.5, I_c=1500, U=25, C=5e4, b=1, k=1e4)
    for vehicle in (free, other):
        found = stability_map(vehicle, b=[1.0, 1.1], k=np.geomspace(1e3, 1e6, count)).stable
        assert not found[0].any()
        assert found[1].all()
    line = sweep(free, k=np.geomspace(1e3, 1e6, 2_000))
    assert not line.stable.any()


class Cascade(Model):
    """Three equal oscillators, each driving the next: triple eigenvalues with one eigenvector."""

    m: float = param("kg", "mass", above=0)
    k: float = param("N/m", "stiffness", above=0)
    c: float = param("N s/m", "damping")
    f: float = param("N/m", "drive")

    x = coordinate("m", "first displacement")
    y = coordinate("m", "second displacement")
    z = coordinate("m", "third displacement")

    def matrices(self):
        m, k, c, f = self.m, self.k, self.c, self.f
        K = [[k, 0, 0], [-f, k, 0], [0, -f, k]]
        return K, [[c, 0, 0], [0, c, 0], [0, 0, c]], [[m, 0, 0], [0, m, 0], [0, 0, m]]


class Coupled(Model):
    """Two masses with inertial coupling, whose mass matrix may be singular."""

    m: float = param("kg", "mass", above=0)
    n: float = param("kg", "other mass", above=0)
    s: float = param("kg", "coupling")
    c: float = param("N s/m", "damping", above=0)
    k: float = param("N/m", "stiffness", above=0)

    x = coordinate("m", "first displacement")
    y = coordinate("m", "second displacement")

    def matrices(self):
        return [[2 * self.k, 0], [0, 3 * self.k]], [[self.c, 0], [0, self.c]], [[self.m, self.s], [self.s, self.n]]


def exactly(vehicle, **grid):
    """Verdicts in rational numbers, point by point."""
    functions = compiled(type(vehicle))
    (outer, x), (inner, y) = grid.items()
    at = [[judge._exactly(functions, {**vehicle.values, outer: a, inner: b}) for b in y] for a in x]
    return np.array(at)


@pytest.mark.parametrize("engine", ["numpy", "numba"])
def test_coinciding_eigenvalues_do_not_decide(engine):
    grid = {"f": [0.5, 2.0], "c": np.concatenate([-(10.0 ** np.arange(-16, 0)), [0.0], 10.0 ** np.arange(-16, 0)])}
    vehicle = Cascade(m=1.1, k=1.3, c=0, f=2)
    for order in (grid, dict(reversed(grid.items()))):
        np.testing.assert_array_equal(stability_map(vehicle, engine=engine, **order).stable, exactly(vehicle, **order))


@pytest.mark.parametrize("engine", ["numpy", "numba"])
def test_roots_next_to_infinity(engine):
    random = np.random.default_rng(0)
    for _ in range(12):
        s, m = random.uniform(0.5, 2, 2)
        vehicle = Coupled(m=m, n=1, s=s, c=0.3, k=1)
        grid = {"n": np.unique(s * s / m * (1 + 1.1e-16 * np.arange(-6, 7))), "c": np.array([0.3, 0.6])}
        for order in (grid, dict(reversed(grid.items()))):
            stable = stability_map(vehicle, engine=engine, **order).stable
            np.testing.assert_array_equal(stable, exactly(vehicle, **order))


def test_rows_are_polynomials_where_the_inner_parameter_allows_it():
    bicycle, names = load("benchmark-bicycle"), ("U", "lambda_", "c")
    for inner, row in (("U", True), ("lambda_", False), ("c", True)):
        made = kernels.body(compiled(type(bicycle)), list(bicycle.values).index(inner))
        assert bool(made.row) is row
        outer = next(n for n in names if n != inner)
        grid = {outer: np.linspace(0.5, 1.4, 9), inner: np.linspace(0.1, 1.4, 31)}
        one, two = (stability_map(bicycle, engine=e, **grid).stable for e in ("numpy", "numba"))
        np.testing.assert_array_equal(one, two)


@pytest.mark.parametrize(
    ("text", "at", "expected"),
    [
        ("(-(v0 - 2*v1)*v0/4 + v1**3, )", (3.0, 5.0), -(3 - 10) * 3 / 4 + 125),
        ("(v1*numpy.where((v1 < 2), v1, 7)*v0*v0, )", (3.0, 5.0), 5 * 7 * 9),
        ("(v0*abs(v1 - 9) + numpy.maximum(v1, numpy.minimum(v1, 8)), )", (3.0, 5.0), 3 * 4 + 5),
        ("((v0*v0 - v0*v0)*numpy.cos(numpy.pi*v1), )", (3.0, 5.0), 0),
    ],
)
def test_polynomials_along_rows(text, at, expected):
    functions = SimpleNamespace(
        source=f"def coefficients(g0):\n    v0, v1, = g0\n    return {text}\n", structural_zeros=0, undamped=False
    )
    made = rows.Rows()
    (polynomial,) = rows.polynomials(functions, 0, made)
    names = {"math": math, "v1": at[1], "x": at[0]}
    exec("\n".join(made.steps), names)
    assert eval(made.horner(polynomial), names) == pytest.approx(expected)
    functions.source = functions.source.replace("v0", "numpy.arcsin(v0)", 2).replace("numpy.arcsin(v0)", "v0", 1)
    with pytest.raises(rows.NotAPolynomialError):
        rows.polynomials(functions, 0, rows.Rows())
    functions.source = functions.source.replace("return (", "return (numpy.sign(v1)*")
    with pytest.raises(UcritError, match="do not know the function sign"):
        rows.polynomials(functions, None, rows.Rows())


@pytest.mark.parametrize("engine", ["numpy", "numba"])
def test_extreme_numbers(engine):
    caravan = load("caravan")
    grid = {"k": np.array([1e-200, 1e-3, 1e5, 1e200]), "C": np.array([1e-150, 1e5, 1e150])}
    stable = stability_map(caravan, engine=engine, **grid).stable
    assert stable.shape == (4, 3)
    np.testing.assert_array_equal(stable, stability_map(caravan, engine="numpy", **grid).stable)


def test_both_directions_and_values_out_of_order():
    caravan = load("caravan")
    U = np.array([30.0, -5.0, 10.0, -20.0, 25.0])
    for engine in ("numpy", "numba"):
        result = stability_map(caravan, engine=engine, U=U, c=[4000.0, 0.0])
        single = [[stability_map(caravan, U=[u], c=[c]).stable[0, 0] for c in (4000.0, 0.0)] for u in U]
        np.testing.assert_array_equal(result.stable, single)


def test_threads_change_nothing(monkeypatch):
    grid = around(load("caravan"), ("c", "U"), (211, 113))
    whole = {e: stability_map(load("caravan"), engine=e, **grid).stable for e in ("numpy", "numba")}
    monkeypatch.setattr(judge, "ONE_THREAD", 1)
    monkeypatch.setattr(judge, "TILE", 999)
    monkeypatch.setattr(judge, "BLOCK", 777)
    for engine, expected in whole.items():
        np.testing.assert_array_equal(stability_map(load("caravan"), engine=engine, **grid).stable, expected)


def test_margins_are_those_of_a_sweep():
    grid = {"c": [0, 2000, 4000], "U": [15, 30]}
    result, expected = stability_map(load("caravan"), margins=True, **grid), sweep(load("caravan"), **grid)
    np.testing.assert_allclose(result.growth, expected.growth, rtol=1e-9)
    np.testing.assert_allclose(result.damping, expected.damping, rtol=1e-9)
    assert {"growth", "damping_ratio"} <= {series.name for series in result.table().data}


def test_unknown_and_missing_engines_are_refused(monkeypatch):
    with pytest.raises(UcritError, match=r"no engine 'nunba'; did you mean 'numba'\?"):
        stability_map(load("caravan"), engine="nunba", U=[10, 20])
    monkeypatch.setitem(sys.modules, "numba", None)
    with pytest.raises(MissingExtraError, match=r"pip install 'ucrit\[fast\]'"):
        stability_map(load("caravan"), engine="numba", U=[10, 20])
    monkeypatch.setattr(judge, "COMPILED_PAYS", 1)
    assert stability_map(load("caravan"), U=[10, 20]).stable.tolist() == [True, True]


def test_no_gpu_is_said():
    from numba import cuda

    if not cuda.is_available():
        with pytest.raises(UcritError, match="needs an NVIDIA GPU"):
            kernels.needed("cuda")


SIMULATED = """
import numpy as np
from ucrit import find_model, load, stability_map
from ucrit.analyses.stability import device
from ucrit.core.numeric import kernels

kernels.THREADS, device.PIECE = 4, 5
caravan, truck = load("caravan"), load("coach-truck")
marginal = find_model("trailer-rigid-tire-undamped")(m=1000, I_c=1500, a=1.5, b=1, k=1e4, U=20)
U, c = np.array([-20.0, -1, -15, 0.7, 9, 14, 21, 28, 60]), np.geomspace(1, 1e4, 9)
for device.POINTS, device.ROWS in ((2**28, 2**20), (20, 2), (4, 1)):
    for vehicle, grid in (
        (marginal, dict(b=[0.99, 1, 1.01])),
        (caravan, dict(U=U, c=c)),
        (caravan, dict(c=c, U=U)),
        (caravan, dict(U=U)),
        (caravan, dict(m=[900, 1500], c=[1.0, 4e3], U=U)),
        (caravan, dict(k=[1e-200, 1e-3, 1e5, 1e200], C=[1e-150, 1e5, 1e150])),
        (truck, dict(c_s=[0.0, 30, 300, 2e3, 2e4], V=[2.0, 9, 20, 35, 70])),
    ):
        one, two = (stability_map(vehicle, engine=e, **grid).stable for e in ("numpy", "cuda"))
        assert (one == two).all() and one.any() and not one.all(), (vehicle, list(grid), device.POINTS)
"""


def test_the_kernel_for_gpus_in_numbas_simulator():
    """Several segments of both axes, both directions of running, and launches of few rows, columns and points."""
    done = subprocess.run(
        [sys.executable, "-c", SIMULATED],
        env={**os.environ, "NUMBA_ENABLE_CUDASIM": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr


def test_the_kernel_compiles_for_gpus_that_are_not_there():
    """Where NVIDIA's compiler is installed, a device is not needed for that."""
    import numba
    from numba import cuda

    row, table, whole = numba.float64[::1], numba.float64[:, ::1], numba.int64[::1]
    given = (row, numba.float64[:, :, ::1], whole, whole, table, numba.int64[:, ::1], row)
    given += (numba.uint8[:, ::1], numba.uint8[::1])
    for name, outer, inner in (("caravan", "c", "U"), ("chain", "k", "c")):
        vehicle = Chain(m=1, k=1, c=0.1, f=0.3) if name == "chain" else load(name)
        names, made = list(vehicle.values), {}
        exec(kernels.source(compiled(type(vehicle)), (names.index(outer),), names.index(inner), "cuda"), made)
        try:
            text, _ = cuda.compile_ptx(made["kernel"], given, cc=(9, 0))
        except (ImportError, OSError, cuda.cudadrv.error.NvvmSupportError) as error:
            pytest.skip(f"needs NVIDIA's compiler: {error}")
        assert "fma.rn.f64" in text
        assert "sm_90" in text
