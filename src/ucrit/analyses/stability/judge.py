"""Stability on grids and at single points: fast where that is sure, by eigenvalues or exactly where it is not."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from fractions import Fraction
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ...core.errors import UcritError
from ...core.numeric import kernels
from ...core.numeric.bounds import coefficient_bounds
from ...core.numeric.compiled import Compiled, compiled, deciding, direction, state_space
from ...numerics.matrices import eigenvalues_with_errors
from ...numerics.rounded import judged
from ...numerics.routh import all_decay
from ..linear.modes import growth
from .grids import Grid, Tile, flat, limits, tiles

Array = npt.NDArray[Any]

BLOCK = 2**16
"""Points that NumPy handles together: a dozen temporaries of them stay in the second-level cache."""

TILE = 2**22
"""Points that a compiled kernel handles together."""

ONE_THREAD = 10**7
"""Points below which threads do not pay."""

COMPILED_PAYS = 3 * 10**7
"""Points above which a kernel is compiled unless it already is."""

CLEAR = 1e-7
"""Real part, as a share of the largest eigenvalue, below which no eigenvalue decides."""

EXACT_POINTS = 2000
"""Points of one grid that are settled exactly at least; further ones are stable if an error bound proves it."""

EXACT_OPERATIONS = 10**7
"""Exact operations for the coefficients of one grid's points, where that makes more points: some seconds."""


def decide(vehicle: Model, axes: Mapping[str, Array], engine: str) -> Array:
    """Tell for every combination of values whether the vehicle is stable, of shape (size of each axis)."""
    order = [np.argsort(x, kind="stable") for x in axes.values()]
    grid = Grid(vehicle, {name: x[i] for (name, x), i in zip(axes.items(), order, strict=True)})
    result = np.empty(grid.shape, dtype=bool)
    chosen = _chosen(grid, engine)
    open_ = _everywhere(grid, chosen, result.view(np.uint8))
    if open_.size:
        place = np.unravel_index(open_, grid.shape)
        columns = {name: x[i] for (name, x), i in zip(grid.axes.items(), place, strict=True)}
        result.reshape(-1)[open_] = settle(vehicle, columns)
    for axis, i in enumerate(order):
        if (np.diff(i) < 0).any():
            result = np.take(result, np.argsort(i), axis=axis)
    return result


def _chosen(grid: Grid, engine: str) -> str:
    if engine != "auto":
        if engine != "numpy":
            kernels.needed(engine)
        return engine
    if np.prod(grid.shape, dtype=float) < COMPILED_PAYS:
        return "numpy"
    try:
        kernels.needed("numba")
        kernels.body(grid.functions(next(tiles_of(grid, "numba"))), 0)
    except UcritError:
        return "numpy"
    return "numba"


def _everywhere(grid: Grid, engine: str, codes: Array) -> Array:
    """Write codes for the whole grid, tile by tile on all cores; return the flat indices of those that are open."""
    if engine == "cuda":
        from .device import by_device

        return by_device(grid, codes)
    work: Callable[[Tile], Array] = {
        "numpy": lambda tile: _by_numpy(grid, tile, codes),
        "numba": lambda tile: _by_numba(grid, tile, codes),
    }[engine]
    tiles = tiles_of(grid, engine)
    if codes.size < ONE_THREAD:
        found = [work(tile) for tile in tiles]
    else:
        with ThreadPoolExecutor(len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else None) as pool:
            found = list(pool.map(work, tiles))
    return np.concatenate([np.zeros(0, dtype=np.int64), *found])


def tiles_of(grid: Grid, engine: str) -> Iterator[Tile]:
    """Split a grid into the tiles of an engine."""
    return tiles(grid, {"numpy": BLOCK, "numba": TILE}[engine])


def _by_numpy(grid: Grid, tile: Tile, codes: Array) -> Array:
    functions, arguments = grid.functions(tile), grid.arguments(tile)
    with np.errstate(all="ignore"):
        a = [np.asarray(c, dtype=float) for c in deciding(functions, functions.coefficients(arguments))]
    if len(a) == 1:
        codes[tile] = 1
        return np.zeros(0, dtype=np.int64)
    sure, open_ = judged(a, *coefficient_bounds(functions, arguments, whole=True))
    codes[tile] = sure
    return flat(grid, tile, open_) if open_.any() else np.zeros(0, dtype=np.int64)


def _split(grid: Grid, tile: Tile) -> tuple[list[int], int, Array, Array, Array]:
    """Positions of the outer parameters and the inner one, and the rows of a tile with their values."""
    declared = list(type(grid.vehicle).declaration.parameters)
    *outer, inner = (declared.index(name) for name in grid.axes)
    *shape, _ = grid.shape
    rows = np.ravel_multi_index(np.ix_(*(np.arange(s.start, s.stop) for s in tile[:-1])), shape) if shape else 0
    columns = [x[s] for x, s in zip(grid.axes.values(), tile, strict=True)]
    mesh = np.meshgrid(*columns[:-1], indexing="ij")
    values = np.stack([m.ravel() for m in mesh], axis=1) if shape else np.zeros((1, 0))
    return outer, inner, np.ravel(rows).astype(np.int64), values, columns[-1]


def _by_numba(grid: Grid, tile: Tile, codes: Array) -> Array:
    functions, arguments = grid.functions(tile), grid.arguments(tile)
    if functions.order == functions.structural_zeros:
        codes[tile] = 1
        return np.zeros(0, dtype=np.int64)
    outer, inner, rows, values, along = _split(grid, tile)
    kernel = kernels.processor_kernel(functions, tuple(outer), inner)
    fixed = np.array([np.ravel(x)[0] for x in arguments], dtype=float)
    whole = codes.reshape(-1, grid.shape[-1])
    count = kernel(fixed, limits(functions, arguments), rows, values, tile[-1].start, along, whole)
    return flat(grid, tile, codes[tile] == kernels.OPEN) if count else np.zeros(0, dtype=np.int64)


def judge(vehicle: Model) -> Array:
    """Tell whether a vehicle is stable, for every combination of its array parameters; shape of ``vehicle.dims``."""
    shape = tuple(len(values) for values in vehicle.dims.values())
    arguments = dict(zip(vehicle.values, map(np.asarray, vehicle.arguments()), strict=True))
    varying = {n: x for n, x in arguments.items() if x.ndim} or dict([next(iter(arguments.items()))])
    columns = {n: np.array(np.broadcast_to(x, shape), dtype=float).ravel() for n, x in varying.items()}
    one = vehicle.with_(**{n: float(x[0]) for n, x in columns.items()})
    return settle(one, columns).reshape(shape)


def settle(vehicle: Model, columns: Mapping[str, Array]) -> Array:
    """Tell of single points, one value of each column, whether the vehicle is stable; shape (points,).

    Points at which rounding cannot matter are judged by the polynomial, the others by balanced eigenvalues where
    those keep clear of the imaginary axis, and the rest exactly for the numbers given. Of very many that are left the
    nearest to the axis are; further ones are called stable if the error bound of their eigenvalues proves it.
    """
    stable = np.zeros(len(next(iter(columns.values()))), dtype=bool)
    speed = type(vehicle).declaration.speed
    signs = np.sign(columns[speed]) if speed is not None and speed in columns else np.ones(stable.size)
    left = max(EXACT_POINTS, EXACT_OPERATIONS // _operations(vehicle))
    for sign in (-1.0, 0.0, 1.0):
        part = np.flatnonzero(signs == sign)
        for start in range(0, part.size, BLOCK):
            here = part[start : start + BLOCK]
            stable[here], used = _settled(vehicle, {name: x[here] for name, x in columns.items()}, left)
            left -= used
    return stable


class Judged(NamedTuple):
    """What is known of points: arrays of shape (points,), coefficients of shape (degree + 1, points).

    ``sure`` means stable for sure, ``doubt`` neither that nor unstable for sure, ``signed`` that rounding left the
    leading coefficient its sign.
    """

    sure: Array
    doubt: Array
    signed: Array
    coefficients: Array


def judged_points(vehicle: Model, columns: Mapping[str, Array]) -> Judged:
    """Judge single points, one value of each column, by the polynomial."""
    many = vehicle.along("point", **columns)
    functions = compiled(type(many), direction(many))
    arguments = many.arguments()
    with np.errstate(all="ignore"):
        found = deciding(functions, functions.coefficients(arguments))
    a = [np.broadcast_to(np.asarray(c, dtype=float), (len(next(iter(columns.values()))),)) for c in found]
    if len(a) == 1:
        every = np.ones(a[0].shape, dtype=bool)
        return Judged(every, ~every, every, np.array(a))
    _, errors = coefficient_bounds(functions, arguments, whole=False)
    sure, open_ = judged(a, [np.abs(x) + e for x, e in zip(a, errors, strict=True)], errors)
    return Judged(sure, open_, np.abs(a[-1]) > errors[-1], np.array(a))


def _operations(vehicle: Model) -> int:
    """How many operations the coefficients take."""
    text = compiled(type(vehicle), direction(vehicle)).source
    return max(1, sum(map(text.count, "+-*/")))


def _settled(vehicle: Model, columns: Mapping[str, Array], exact: int) -> tuple[Array, int]:
    """Verdicts of a block of points, and how many of them took exact arithmetic."""
    known = judged_points(vehicle, columns)
    stable, rest = np.array(known.sure), np.flatnonzero(known.doubt)
    if not rest.size:
        return stable, 0
    columns = {name: x[rest] for name, x in columns.items()}
    rates, errors = _rates(vehicle.along("point", **columns))
    errors[~known.signed[rest]] = np.inf  # a root next to infinity has an eigenvalue of either sign
    stable[rest] = rates < -errors
    near = np.flatnonzero(~(np.abs(rates) > np.maximum(CLEAR, errors)))
    near = near[np.argsort(np.abs(rates[near]), kind="stable")][:exact]
    functions = compiled(type(vehicle), direction(vehicle.along("point", **columns)))
    for k in near:
        stable[rest[k]] = _exactly(functions, {**vehicle.values, **{name: x[k] for name, x in columns.items()}})
    return stable, near.size


def _rates(many: Model) -> tuple[Array, Array]:
    """Largest real part and a bound of its error, as shares of the largest modulus; nan for singular equations."""
    rates = np.full(next(iter(many.dims.values())).size, np.nan)
    bounds = np.full(rates.size, np.inf)
    try:
        A = state_space(many).A
    except UcritError:
        return rates, bounds
    A = np.broadcast_to(A, (rates.size, *A.shape[-2:]))
    finite = np.isfinite(A).all(axis=(-2, -1))
    if not finite.any():
        return rates, bounds
    values, errors = eigenvalues_with_errors(A[finite])
    size = np.abs(values).max(axis=-1)
    size[size == 0] = 1
    rates[finite] = growth(many, values) / size
    bounds[finite] = errors / size
    if compiled(type(many), direction(many)).undamped:
        bounds[~(rates > 0)] = np.inf  # no motion can decay: only growth is clear
    return rates, bounds


def _exactly(functions: Compiled, values: Mapping[str, Any]) -> bool:
    numbers = [Fraction(float(x)) for x in values.values()]
    try:
        a = deciding(functions, functions.exact_coefficients(numbers))
    except ZeroDivisionError:
        return False
    return bool(a[-1]) and all_decay(a)
