"""Maps and sweeps cut into chunks that fit into memory, each computed by itself, anywhere."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ...core.errors import UcritError, near_match
from ...core.numeric.compiled import compiled, direction
from ..results.convert import unit_of
from .stability_map import stability_map
from .sweep import read_ranges, sweep

Array = npt.NDArray[Any]
Place = tuple[int, ...]

KINDS = {"map": 2**22, "sweep": 2**16}
"""What can be computed in chunks, and points in a chunk where none are asked for."""

MAX_CHUNKS = 10**6


@dataclass(frozen=True, eq=False)
class Job:
    """A map or sweep of one vehicle, cut into chunks; small, so that it travels to other processes.

    Attributes
    ----------
    vehicle
        With scalar parameters.
    kind
        ``"map"`` or ``"sweep"``.
    coords
        Values of each dimension [SI].
    chunk
        Points of a chunk along each dimension.
    """

    vehicle: Model
    kind: str
    coords: Mapping[str, Array]
    chunk: tuple[int, ...]

    @property
    def dims(self) -> tuple[str, ...]:
        """Names of the dimensions."""
        return tuple(self.coords)

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of points along each dimension."""
        return tuple(x.size for x in self.coords.values())

    @property
    def grid(self) -> tuple[int, ...]:
        """Number of chunks along each dimension."""
        return tuple(-(-n // c) for n, c in zip(self.shape, self.chunk, strict=True))

    def places(self) -> Iterator[Place]:
        """Yield the number of every chunk along each dimension."""
        return product(*map(range, self.grid))

    def slices(self, place: Place) -> tuple[slice, ...]:
        """Return which points a chunk holds."""
        return tuple(slice(i * c, min((i + 1) * c, n)) for i, c, n in zip(place, self.chunk, self.shape, strict=True))

    def variables(self) -> dict[str, tuple[str, str, tuple[str, ...]]]:
        """Return type, unit and further dimensions of each result."""
        if self.kind == "map":
            return {"stable": ("bool", "", ())}
        return {
            "stable": ("bool", "", ()),
            "unstable": ("int64", "1", ()),
            "growth": ("float64", "1/s", ()),
            "damping_ratio": ("float64", "1", ()),
            "eigenvalue_real": ("float64", "1/s", ("mode",)),
            "eigenvalue_imag": ("float64", "1/s", ("mode",)),
        }

    def further(self) -> dict[str, Array]:
        """Return dimensions besides the ranges', with their values."""
        if self.kind == "map":
            return {}
        return {"mode": np.arange(1, compiled(type(self.vehicle), direction(self.vehicle)).order + 1)}

    def part(self, place: Place) -> Job:
        """Return one chunk as a job of its own."""
        coords = {k: x[s] for (k, x), s in zip(self.coords.items(), self.slices(place), strict=True)}
        return Job(self.vehicle, self.kind, coords, tuple(x.size for x in coords.values()))

    def compute(self) -> dict[str, Array]:
        """Return all results, in one piece."""
        ranges: dict[str, Any] = dict(self.coords)
        if self.kind == "map":
            return {"stable": stability_map(self.vehicle, **ranges).stable}
        found = sweep(self.vehicle, **ranges)
        return {
            "stable": found.stable,
            "unstable": found.unstable,
            "growth": found.growth,
            "damping_ratio": found.damping,
            "eigenvalue_real": found.eigenvalues.real,
            "eigenvalue_imag": found.eigenvalues.imag,
        }

    def units(self) -> dict[str, dict[str, str]]:
        """Return the units of the dimensions, as attributes; a dimension that counts has none."""
        named = {name: {"units": unit_of(self.vehicle, name)} for name in self.coords}
        return {**named, **{name: {} for name in self.further()}}


def job(vehicle: Model, kind: str, chunk: int | None, ranges: Mapping[str, Any]) -> Job:
    """Cut a map or sweep into chunks.

    Parameters
    ----------
    vehicle
        With scalar parameters.
    kind
        ``"map"`` or ``"sweep"``.
    chunk
        Most points in a chunk, a good number by default.
    ranges
        Values of each parameter, as `stability_map` takes them.

    Raises
    ------
    UcritError
        If a name, a value, the kind or the size of chunks is wrong.
    """
    if kind not in KINDS:
        raise UcritError(f"there is no kind '{kind}' of results{near_match(str(kind), KINDS)}")
    if not ranges:
        raise UcritError("a map or sweep needs ranges, such as U=[10, 20, 30]")
    if vehicle.dims:
        raise UcritError(f"give one value each for {', '.join(vehicle.dims)}, and the ranges by themselves")
    most = KINDS[kind] if chunk is None else chunk
    if isinstance(most, bool) or not isinstance(most, int) or most < 1:
        raise UcritError(f"chunk must be a whole number of points above 0, got {chunk!r}")
    values = read_ranges(vehicle, dict(ranges))
    given = vehicle.with_(**values)
    coords = {name: np.asarray(given.dims[name]) for name in ranges}
    found = Job(vehicle, kind, coords, _chunk([x.size for x in coords.values()], most))
    if math.prod(found.grid) > MAX_CHUNKS:
        raise UcritError(
            f"{math.prod(found.shape):,} points in chunks of at most {most:,} are {math.prod(found.grid):,} chunks; "
            f"at most {MAX_CHUNKS:,} are allowed: take fewer points, or larger chunks"
        )
    return found


def _chunk(shape: Sequence[int], most: int) -> tuple[int, ...]:
    """Return the size of a chunk, whole in as many last dimensions as fit."""
    found: list[int] = []
    for size in reversed(shape):
        found.append(max(1, min(size, most)))
        most //= found[-1]
    return tuple(reversed(found))
