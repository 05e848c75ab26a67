"""Stability on grids and at single points: fast where that is sure, by eigenvalues or exactly where it is not."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise, product
from typing import Any

import numpy as np
import numpy.typing as npt

from ..core import kernels
from ..core.bounds import coefficient_bounds
from ..core.compiled import Compiled, compiled, deciding, direction, state_space
from ..core.errors import UcritError
from ..core.model import Model
from ..numerics.rounded import judged, slacks
from ..numerics.routh import routh
from .modes import growth

Array = npt.NDArray[Any]

BLOCK = 2**16
"""Points that NumPy handles together: a dozen temporaries of them stay in the second-level cache."""

TILE = 2**20
"""Points that a compiled kernel handles together."""

SPAN = 16.0
"""Largest ratio of a parameter's values within a tile: one bound of the rounding errors serves it all."""

ONE_THREAD = 10**7
"""Points below which threads do not pay."""

COMPILED_PAYS = 3 * 10**7
"""Points above which a kernel is compiled unless it already is."""

CLEAR = 1e-7
"""Real part, as a share of the largest eigenvalue, from which on an eigenvalue decides."""

EXACT_POINTS = 2000
"""Points of one grid that are settled in exact arithmetic; further ones by the sign of the largest real part."""

Tile = tuple[slice, ...]


@dataclass(frozen=True)
class Grid:
    """Values of some parameters of a vehicle, each axis in rising order."""

    vehicle: Model
    axes: Mapping[str, Array]

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of values of each axis."""
        return tuple(x.size for x in self.axes.values())

    def functions(self, tile: Tile) -> Compiled:
        """Compiled functions for a tile, in which the speed has one sign."""
        model = type(self.vehicle)
        name = model.declaration.speed
        if name is None or name not in self.axes:
            return compiled(model, direction(self.vehicle))
        first = self.axes[name][tile[list(self.axes).index(name)]][0]
        return compiled(model, 1 if first > 0 else -1)

    def arguments(self, tile: Tile) -> list[Any]:
        """Parameter values of a tile in declared order, shaped to broadcast."""
        values: dict[str, Any] = dict(self.vehicle.values)
        for i, (name, x) in enumerate(self.axes.items()):
            values[name] = x[tile[i]].reshape([-1 if k == i else 1 for k in range(len(tile))])
        return list(values.values())


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
    except UcritError:
        return "numpy"
    return "numba"


def _everywhere(grid: Grid, engine: str, codes: Array) -> Array:
    """Write codes for the whole grid, tile by tile on all cores; return the flat indices of those that are open."""
    work: Callable[[Tile], Array] = {
        "numpy": lambda tile: _by_numpy(grid, tile, codes),
        "numba": lambda tile: _by_numba(grid, tile, codes),
        "cuda": lambda tile: _by_cuda(grid, tile, codes),
    }[engine]
    tiles = _tiles(grid, BLOCK if engine == "numpy" else TILE)
    if codes.size < ONE_THREAD or engine == "cuda":
        found = [work(tile) for tile in tiles]
    else:
        with ThreadPoolExecutor(len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else None) as pool:
            found = list(pool.map(work, tiles))
    return np.concatenate([np.zeros(0, dtype=np.int64), *found])


def _tiles(grid: Grid, most: int) -> Iterator[Tile]:
    """Split a grid where a parameter changes its sign or by more than `SPAN`, and further to at most so many points."""
    for tile in product(*(_segments(x) for x in grid.axes.values())):
        sizes = [s.stop - s.start for s in tile]
        steps, room = [], most
        for size in reversed(sizes):
            steps.append(max(1, min(size, room)))
            room //= steps[-1]
        pieces = [
            [slice(at, min(at + step, s.stop)) for at in range(s.start, s.stop, step)]
            for s, step in zip(tile, reversed(steps), strict=True)
        ]
        yield from product(*pieces)


def _segments(x: Array) -> list[slice]:
    """Runs of rising values of one sign in which the size changes by at most a factor `SPAN`."""
    size = np.where(x == 0, 1.0, np.abs(x))
    label = np.sign(x) * (5000 + np.floor(np.log(size) / np.log(SPAN)))
    edges = [0, *(np.flatnonzero(np.diff(label)) + 1), x.size]
    return [slice(int(a), int(b)) for a, b in pairwise(edges)]


def _flat(grid: Grid, tile: Tile, inside: Array) -> Array:
    """Flat indices, in the whole grid, of the true entries of a tile."""
    place = [i + s.start for i, s in zip(np.nonzero(inside), tile, strict=True)]
    return np.asarray(np.ravel_multi_index(tuple(place), grid.shape), dtype=np.int64)


def _by_numpy(grid: Grid, tile: Tile, codes: Array) -> Array:
    functions, arguments = grid.functions(tile), grid.arguments(tile)
    with np.errstate(all="ignore"):
        a = [np.asarray(c, dtype=float) for c in deciding(functions, functions.coefficients(arguments))]
    if len(a) == 1:
        codes[tile] = 1
        return np.zeros(0, dtype=np.int64)
    sure, open_ = judged(a, *coefficient_bounds(functions, arguments, whole=True))
    codes[tile] = sure
    return _flat(grid, tile, open_) if open_.any() else np.zeros(0, dtype=np.int64)


def _limits(functions: Compiled, arguments: Sequence[Any]) -> Array:
    """What the kernels compare with, for a whole tile."""
    sizes, errors = coefficient_bounds(functions, arguments, whole=True)
    with np.errstate(all="ignore"):
        return np.array([float(x) for x in (slacks(sizes, errors) if len(sizes) < 6 else errors)]) + 1e-300


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
    flat = codes.reshape(-1, grid.shape[-1])
    count = kernel(fixed, _limits(functions, arguments), rows, values, tile[-1].start, along, flat)
    return _flat(grid, tile, codes[tile] == kernels.OPEN) if count else np.zeros(0, dtype=np.int64)


def _by_cuda(grid: Grid, tile: Tile, codes: Array) -> Array:
    functions, arguments = grid.functions(tile), grid.arguments(tile)
    if functions.order == functions.structural_zeros:
        codes[tile] = 1
        return np.zeros(0, dtype=np.int64)
    outer, inner, _, values, along = _split(grid, tile)
    cuda = kernels.needed("cuda")
    kernel = kernels.graphics_kernel(functions, tuple(outer), inner)
    fixed = np.array([np.ravel(x)[0] for x in arguments], dtype=float)
    given = [cuda.to_device(x) for x in (fixed, _limits(functions, arguments), values, np.ascontiguousarray(along))]
    out = cuda.device_array((len(values), along.size), dtype=np.uint8)
    threads = (64, 4)
    kernel[(-(-along.size // threads[0]), -(-len(values) // threads[1])), threads](*given, out)
    codes[tile] = out.copy_to_host().reshape(codes[tile].shape)
    return _flat(grid, tile, codes[tile] == kernels.OPEN)


def settle(vehicle: Model, columns: Mapping[str, Array]) -> Array:
    """Tell of single points, one value of each column, whether the vehicle is stable; shape (points,).

    Points at which rounding cannot matter are judged by the polynomial, the others by balanced eigenvalues where
    those keep clear of the imaginary axis, and the rest exactly for the numbers given.
    """
    stable = np.zeros(len(next(iter(columns.values()))), dtype=bool)
    speed = type(vehicle).declaration.speed
    signs = np.sign(columns[speed]) if speed is not None and speed in columns else np.ones(stable.size)
    left = EXACT_POINTS
    for sign in np.unique(signs):
        part = np.flatnonzero(signs == sign)
        for start in range(0, part.size, BLOCK):
            here = part[start : start + BLOCK]
            stable[here], used = _settled(vehicle, {name: x[here] for name, x in columns.items()}, left)
            left -= used
    return stable


def certain(vehicle: Model, columns: Mapping[str, Array]) -> tuple[Array, Array, Array]:
    """Return where points are stable for sure, where that is open, and the coefficients (degree + 1, points)."""
    many = vehicle.along("point", **columns)
    functions = compiled(type(many), direction(many))
    arguments = many.arguments()
    with np.errstate(all="ignore"):
        found = deciding(functions, functions.coefficients(arguments))
    a = [np.broadcast_to(np.asarray(c, dtype=float), (len(next(iter(columns.values()))),)) for c in found]
    if len(a) == 1:
        return np.ones(a[0].shape, dtype=bool), np.zeros(a[0].shape, dtype=bool), np.array(a)
    _, errors = coefficient_bounds(functions, arguments, whole=False)
    sure, open_ = judged(a, [np.abs(x) + e for x, e in zip(a, errors, strict=True)], errors)
    return sure, open_, np.array(a)


def _settled(vehicle: Model, columns: Mapping[str, Array], exact: int) -> tuple[Array, int]:
    """Verdicts of a block of points, and how many of them took exact arithmetic."""
    sure, open_, _ = certain(vehicle, columns)
    stable, rest = np.array(sure), np.flatnonzero(open_)
    if not rest.size:
        return stable, 0
    columns = {name: x[rest] for name, x in columns.items()}
    rates = _rates(vehicle.along("point", **columns))
    stable[rest] = rates < 0
    near = np.flatnonzero(~(np.abs(rates) > CLEAR))[:exact]
    functions = compiled(type(vehicle), direction(vehicle.along("point", **columns)))
    for k in near:
        stable[rest[k]] = _exactly(functions, {**vehicle.values, **{name: x[k] for name, x in columns.items()}})
    return stable, near.size


def _rates(many: Model) -> Array:
    """Largest real part as a share of the largest modulus, nan where the equations are singular."""
    rates = np.full(next(iter(many.dims.values())).size, np.nan)
    try:
        A = state_space(many).A
    except UcritError:
        return rates
    A = np.broadcast_to(A, (rates.size, *A.shape[-2:]))
    finite = np.isfinite(A).all(axis=(-2, -1))
    if not finite.any():
        return rates
    values = np.linalg.eigvals(A[finite]).astype(complex)
    size = np.abs(values).max(axis=-1)
    rates[finite] = growth(many, values) / np.where(size == 0, 1, size)
    functions = compiled(type(many), direction(many))
    if functions.undamped:
        rates[rates < CLEAR] = np.nan  # no motion can decay: only growth is clear
    return rates


def _exactly(functions: Compiled, values: Mapping[str, Any]) -> bool:
    numbers = [Fraction(float(x)) for x in values.values()]
    try:
        a = deciding(functions, functions.exact_coefficients(numbers))
    except ZeroDivisionError:
        return False
    if not a[-1]:
        return False
    array = routh(a)
    return array.right_half_plane == 0 == array.imaginary_axis
