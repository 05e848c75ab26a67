"""Stability over ranges of parameters: every combination, with named dimensions."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ...core.errors import UcritError
from ...core.numeric.compiled import coefficients, compiled, direction
from ...numerics.hurwitz import right_half_plane
from ..linear.modes import eigenvalues, growth, rigid_positions
from ..results.convert import Series, Table, Tabular, complex_series, unit_of
from ..stability.judge import settle
from .ranges import parse_range

Array = npt.NDArray[Any]
Progress = Callable[[int, int], None]

BLOCK = 20_000
"""Points handled together, so that temporaries stay small."""

MAX_BYTES = 2**31
"""Size of a result that is refused."""


@dataclass(frozen=True, eq=False)
class Sweep(Tabular):
    """Eigenvalues and stability of a vehicle over ranges of parameters.

    Attributes
    ----------
    vehicle
        The vehicle, with the ranges put in.
    coords
        Names of the dimensions, in the order given, with their values [SI].
    eigenvalues
        Shape (..., n) [1/s], each row from the least to the most stable.
    growth
        Shape (...): largest real part [1/s] but for rigid positions.
    unstable
        Shape (...): number of eigenvalues in the right half plane.
    stable
        Shape (...): whether every motion decays (where none can decay: whether none grows).
    damping
        Shape (...): least damping ratio of all modes but rigid positions; negative where one grows.
    """

    vehicle: Model
    coords: dict[str, Array]
    eigenvalues: Array
    growth: Array
    unstable: Array
    stable: Array
    damping: Array

    @property
    def dims(self) -> tuple[str, ...]:
        """Names of the dimensions."""
        return tuple(self.coords)

    def table(self) -> Table:
        """Return all arrays with their units; the eigenvalues are numbered along ``mode``."""
        dims, numbers = self.dims, np.arange(1, self.eigenvalues.shape[-1] + 1)
        coords = [Series(name, (name,), x, unit_of(self.vehicle, name)) for name, x in self.coords.items()]
        data = (
            Series("stable", dims, self.stable),
            Series("unstable", dims, self.unstable, "1"),
            Series("growth", dims, self.growth, "1/s"),
            Series("damping_ratio", dims, self.damping, "1"),
            *complex_series("eigenvalue", (*dims, "mode"), self.eigenvalues, "1/s"),
        )
        return Table("sweep", self.vehicle, (*coords, Series("mode", ("mode",), numbers)), data, dims)


def sweep(vehicle: Model, /, *, progress: Progress | None = None, **ranges: Sequence[float] | Array | str) -> Sweep:
    """Return eigenvalues and stability for all combinations of some parameters' values.

    Parameters
    ----------
    vehicle
        Array parameters that it already has span further dimensions, after the ranges.
    progress
        Called with the number of points done and of all, after each block.
    **ranges
        Values of each parameter [SI]: a one-dimensional array, or text such as ``"20:130:12 km/h"``
        (see `parse_range`). The result's dimensions come in this order.

    Returns
    -------
    Sweep
        Eigenvalues are those of LAPACK's balanced QR; the verdicts are those of `stability_map`, also next to the
        boundary, where an eigenvalue's rounding might tell otherwise.

    Raises
    ------
    UcritError
        If there is no such parameter, a value is impossible, or the result would not fit in memory.

    Examples
    --------
    >>> from ucrit import load
    >>> result = sweep(load("caravan"), U=[20, 40, 60], c=[0, 4000])
    >>> result.dims, result.stable.tolist()
    (('U', 'c'), [[False, True], [False, False], [False, False]])
    """
    if not ranges:
        raise UcritError("a sweep needs at least one range, such as U=[10, 20, 30]")
    swept = vehicle.with_(**read_ranges(vehicle, ranges))
    dims = [*ranges, *(name for name in swept.dims if name not in ranges)]
    coords = {name: swept.dims[name] for name in dims}
    shape = tuple(x.size for x in coords.values())
    order = compiled(type(swept), direction(swept)).order
    _check_size(shape, order, type(swept).model_id())
    parts: list[tuple[Array, ...]] = []
    first, total = coords[dims[0]], int(np.prod(shape))
    step = max(1, BLOCK // int(np.prod(shape[1:])))
    for start in range(0, first.size, step):
        block = swept.with_(**{dims[0]: first[start : start + step]})
        place = [list(block.dims).index(name) for name in dims]
        parts.append(tuple(x.transpose([*place, *range(len(place), x.ndim)]) for x in _evaluate(block)))
        if progress is not None:
            progress(min(start + step, first.size) * (total // first.size), total)
    return Sweep(swept, coords, *(np.concatenate(arrays) for arrays in zip(*parts, strict=True)))


def read_ranges(vehicle: Model, ranges: dict[str, Any]) -> dict[str, Any]:
    """Return ranges with texts read, single numbers refused, and names left for `Model.with_` to check."""
    declared = type(vehicle).declaration.parameters
    values: dict[str, Any] = {}
    for name, given in ranges.items():
        parameter = declared.get(name)
        thing = f"{type(vehicle).model_id()}: {parameter.meaning if parameter else 'parameter'} {name}"
        values[name] = given
        if isinstance(given, str) and parameter is not None:
            values[name] = parse_range(given, parameter.unit, thing)
        elif parameter is not None and np.ndim(given) == 0:
            raise UcritError(f"{thing} needs several values here, got the single value {given!r}")
        elif np.size(given) == 0:
            raise UcritError(f"{thing} needs several values here, got an empty range")
    return values


def _check_size(shape: tuple[int, ...], order: int, where: str) -> None:
    points = 1
    for count in shape:
        points *= count
    size = points * (16 * order + 25)
    if size > MAX_BYTES:
        raise UcritError(
            f"{where}: a sweep of {points:,} points needs {size / 2**30:.1f} GiB and "
            f"{MAX_BYTES / 2**30:.1f} GiB are allowed; take fewer points, or write them to a .zarr store "
            "(in Python with 'stream')"
        )


def _evaluate(vehicle: Model) -> tuple[Array, ...]:
    """Eigenvalues, growth, number unstable, stable and least damping, over the dimensions of the vehicle."""
    values = eigenvalues(vehicle)
    shape = values.shape[:-1]
    rigid = rigid_positions(vehicle, values)
    size = np.where(values == 0, 1, np.abs(values))
    damping = np.where(rigid, np.inf, -values.real / size).min(axis=-1)
    functions = compiled(type(vehicle), direction(vehicle))
    a = np.stack([np.broadcast_to(x, shape) for x in coefficients(vehicle)[functions.structural_zeros :]], axis=-1)
    if not a[..., -1].all():
        raise UcritError(f"{type(vehicle).model_id()}: the equations are singular for these parameters")
    arrays = {name: x for name, x in zip(vehicle.values, vehicle.arguments(), strict=True) if np.ndim(x)}
    stable = settle(vehicle, {name: np.broadcast_to(x, shape).ravel() for name, x in arrays.items()}).reshape(shape)
    unstable = np.where(stable, 0, right_half_plane(a))
    return values, growth(vehicle, values), unstable, stable, damping
