"""Where in a plane (or box) of parameters a vehicle is stable: a million points in some milliseconds.

No eigenvalue is computed: the coefficients of the characteristic polynomial are known functions of the
parameters, and the conditions of Lienard and Chipart are a few products of them. Where rounding might matter,
eigenvalues or exact arithmetic decide.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ...core.errors import UcritError
from ..linear.modes import eigenvalues, growth, rigid_positions
from ..results.convert import Series, Table, Tabular, unit_of
from ..stability.judge import decide
from .sweep import MAX_BYTES, read_ranges

Array = npt.NDArray[Any]

MAX_POINTS = 2**31

MARGIN_BLOCK = 20_000
"""Points whose eigenvalues are held at once."""


@dataclass(frozen=True, eq=False)
class StabilityMap(Tabular):
    """Stability of a vehicle over a grid of parameters.

    Attributes
    ----------
    vehicle
        The vehicle, with the grid's values put in.
    coords
        Names of the dimensions, in the order given, with their values [SI].
    stable
        Shape of the grid, bool: every motion decays (where none can decay: none grows). A point exactly on a
        boundary is not stable.
    growth
        Largest real part [1/s] but for rigid positions, where margins were asked for.
    damping
        Least damping ratio of all modes but rigid positions, likewise.
    """

    vehicle: Model
    coords: dict[str, Array]
    stable: Array
    growth: Array | None = None
    damping: Array | None = None

    @property
    def dims(self) -> tuple[str, ...]:
        """Names of the dimensions."""
        return tuple(self.coords)

    @property
    def share(self) -> float:
        """Share of the points that are stable, 0 to 1."""
        return float(np.count_nonzero(self.stable) / self.stable.size)

    def findings(self) -> dict[str, Any]:
        """Return the share of the points that is stable."""
        return {"share": self.share}

    def table(self) -> Table:
        """Return the map with its coordinates."""
        coords = tuple(Series(name, (name,), x, unit_of(self.vehicle, name)) for name, x in self.coords.items())
        data = [Series("stable", self.dims, self.stable)]
        if self.growth is not None and self.damping is not None:
            data += [
                Series("growth", self.dims, self.growth, "1/s"),
                Series("damping_ratio", self.dims, self.damping, "1"),
            ]
        return Table("stability map", self.vehicle, coords, tuple(data), self.dims)

    def _repr_html_(self) -> str:
        from ..results import notebook

        return notebook.stability_map(self)


def stability_map(
    vehicle: Model, /, *, engine: str = "auto", margins: bool = False, **ranges: Sequence[float] | Array | str
) -> StabilityMap:
    """Tell which combinations of some parameters' values are stable.

    Parameters
    ----------
    vehicle
        With scalar parameters, but for those of the grid.
    engine
        What computes: ``"numpy"``, ``"numba"`` (compiled code, twenty times faster after a second for compiling),
        ``"cuda"`` (an NVIDIA GPU), or ``"auto"``: numba for maps so large that it pays, where it is installed.
        The answer is the same.
    margins
        Whether to compute the largest real part and the least damping ratio too, from eigenvalues.
    **ranges
        Values of each parameter [SI]: a one-dimensional array, or text such as ``"1e3:1e6:400:log"``
        (see `parse_range`). The result's dimensions come in this order.

    Returns
    -------
    StabilityMap
        Verdicts are right for the numbers given: points where rounding might matter are decided by balanced
        eigenvalues, and close to the boundary exactly. Of more than 2000 such points (100,000 of a simple model) some
        that are stable by no more than rounding may be called not stable, never the other way round.

    Raises
    ------
    UcritError
        If there is no such parameter, a value is impossible, there are more than 2e9 points, or an engine is
        unknown.
    MissingExtraError
        If the engine is not installed.

    Examples
    --------
    >>> from ucrit import load
    >>> stability_map(load("caravan"), c=[0, 2000, 4000], U=[15, 30]).stable.tolist()
    [[False, False], [False, False], [True, False]]
    """
    if not ranges:
        raise UcritError("a stability map needs ranges, such as b=[0.1, 0.2], k=[1e4, 1e5]")
    if extra := [name for name in vehicle.dims if name not in ranges]:
        raise UcritError(f"a stability map is that of one vehicle: give one value each for {', '.join(extra)}")
    mapped = vehicle.with_(**read_ranges(vehicle, ranges))
    coords = {name: mapped.dims[name] for name in ranges}
    shape = tuple(x.size for x in coords.values())
    points = 1
    for count in shape:
        points *= count
    if points > MAX_POINTS:
        raise UcritError(
            f"{type(vehicle).model_id()}: a map of {points:,} points is too large; at most {MAX_POINTS:,} are held in "
            "memory, a .zarr store takes more (in Python with 'stream')"
        )
    rates, damping = _margins(vehicle, coords) if margins else (None, None)
    return StabilityMap(mapped, coords, decide(vehicle, coords, engine), rates, damping)


def _margins(vehicle: Model, coords: dict[str, Array]) -> tuple[Array, Array]:
    """Largest real part and least damping ratio at every point, from batched eigenvalues."""
    shape = tuple(x.size for x in coords.values())
    points = int(np.prod(shape, dtype=object))
    if 16 * points > MAX_BYTES:
        limit = MAX_BYTES // 16
        raise UcritError(f"{type(vehicle).model_id()}: margins of {points:,} points are too many; at most {limit:,}")
    rates, damping = np.empty(points), np.empty(points)
    for start in range(0, points, MARGIN_BLOCK):
        here = np.arange(start, min(start + MARGIN_BLOCK, points))
        place = np.unravel_index(here, shape)
        many = vehicle.along("point", **{name: x[i] for (name, x), i in zip(coords.items(), place, strict=True)})
        rates[here], damping[here] = margins_of(many)
    return rates.reshape(shape), damping.reshape(shape)


def margins_of(vehicle: Model) -> tuple[Array, Array]:
    """Return the largest real part [1/s] and the least damping ratio of all modes but rigid positions."""
    values = eigenvalues(vehicle)
    size = np.where(values == 0, 1, np.abs(values))
    ratios = np.where(rigid_positions(vehicle, values), np.inf, -values.real / size)
    return growth(vehicle, values), np.asarray(ratios.min(axis=-1))
