"""Curves and surfaces in parameter space on which stability changes, without judging the area between.

Cells in which a boundary cannot run are excluded by enclosures of the stability conditions, the others halved; in
the smallest that are left the boundary is found to many digits. Where the grid of the smallest cells is small, or
enclosures exclude too little of it, it is judged as a whole, so that nothing is missed that it shows.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ...core.errors import UcritError
from ...core.formulas.codegen import build
from ...core.numeric.compiled import Compiled, compiled, deciding, direction
from ...core.units import to_si
from ...numerics.enclosures import Enclosure, EnclosureFunctions, excluded
from ...numerics.rounded import conditions
from ..stability.judge import BLOCK, decide, judged_points, settle
from .boundary_result import StabilityBoundary, in_lines
from .lattice import Lattice, crossed, differing, simplices, subdivided
from .ranges import parse_range
from .stability_map import StabilityMap

Array = npt.NDArray[np.float64]
Places = npt.NDArray[np.int64]

FINEST = {2: 2**14, 3: 2**9}
"""Most steps of a range, by the number of parameters."""

USUAL = {2: 1 / 512, 3: 1 / 64}
"""Tolerances where none is given."""

SMALL_GRID = 2**19
"""Points of a grid that are judged faster than cells are excluded."""

SIDES = 128
"""Cells of each axis of the coarse map."""

WITHIN = 1e-9
"""How far a point may be from the boundary, as a share of the smallest cell."""


def boundary(
    vehicle: Model, /, *, tolerance: float | None = None, **ranges: str | Sequence[float] | Array
) -> StabilityBoundary:
    """Find the curves in two, or surfaces in three, parameters on which a vehicle's stability changes.

    Parameters
    ----------
    vehicle
        With scalar parameters.
    tolerance
        Share of each range down to which boundaries are looked for, 1/512 by default for two parameters and 1/64
        for three; the next lower power of two is taken. Nothing is missed that a grid of that many
        steps shows. Points found are correct to about 1e-9 of such a step.
    **ranges
        Two or three parameters, each with its range [SI]: two numbers, or text such as ``"20:130 km/h"`` or
        ``"1e3:1e6:log"`` (see `parse_range`).

    Returns
    -------
    StabilityBoundary
        Points with their kind, joined to lines or triangles.

    Raises
    ------
    UcritError
        If there is no such parameter, a range is empty or not allowed, there are not two or three ranges, the
        tolerance is too small, or the boundary runs through more than four million cells.

    Examples
    --------
    >>> from ucrit import load
    >>> result = boundary(load("caravan"), c=(0, 8000), U="40:160 km/h", tolerance=1 / 64)
    >>> len(result.lines), sorted(set(result.kinds.tolist()))
    (1, ['flutter'])
    """
    lattice = _lattice(vehicle, ranges, tolerance)
    search = _Search(vehicle, lattice)
    cells = search.cells()
    size = len(lattice.names)
    parts = (cells[:, None, None] + simplices(size)).reshape(-1, size + 1, size)
    keys = lattice.keys(parts)
    edges, pieces = crossed(keys, search.stable(keys))
    places, kinds = search.refined(edges)
    if len(lattice.names) == 2:
        order, pieces, line = in_lines(pieces, len(places))
        places, kinds = places[order], kinds[order]
    else:
        line = np.zeros(len(places), dtype=np.int64)
    points = np.stack(list(lattice.columns(places).values()), axis=1)
    sides = search.sides() if size == 2 else None
    return StabilityBoundary(
        vehicle,
        lattice.names,
        lattice.lower,
        lattice.upper,
        lattice.log,
        1 / lattice.count,
        points,
        kinds,
        line,
        pieces,
        search.evaluations,
        sides,
    )


def _lattice(vehicle: Model, ranges: dict[str, Any], tolerance: float | None) -> Lattice:
    where = type(vehicle).model_id()
    if vehicle.dims:
        raise UcritError(f"a boundary is that of one vehicle: give one value each for {', '.join(vehicle.dims)}")
    if len(ranges) not in FINEST:
        raise UcritError(f"{where}: a boundary is found over two or three parameters, got {len(ranges)}")
    tolerance = USUAL[len(ranges)] if tolerance is None else to_si(tolerance, "1", f"{where}: the tolerance")
    finest = FINEST[len(ranges)]
    if not 1 / finest <= tolerance < 1:
        raise UcritError(
            f"{where}: the tolerance over {len(ranges)} parameters must be at least 1/{finest} and below 1, "
            f"got {tolerance:g}"
        )
    ends, logs = [], []
    for name, given in ranges.items():
        lo, hi, log = _ends(vehicle, name, given)
        ends.append((lo, hi))
        logs.append(log)
    for end in (0, 1):
        vehicle.with_(**{name: pair[end] for name, pair in zip(ranges, ends, strict=True)})
    speed = type(vehicle).declaration.speed
    for name, (lo, hi) in zip(ranges, ends, strict=True):
        if name == speed and lo < 0 < hi:
            raise UcritError(f"{where}: the range of {name} must not cross 0, at which the equations are singular")
    lower, upper = np.array(ends, dtype=float).T
    return Lattice(tuple(ranges), lower, upper, tuple(logs), 2 ** int(np.ceil(np.log2(1 / tolerance) - 1e-9)))


def _ends(vehicle: Model, name: str, given: Any) -> tuple[float, float, bool]:
    """Return both ends of a range, and whether its steps are those of the logarithm."""
    parameter = type(vehicle).declaration.parameters.get(name)
    if parameter is None:
        vehicle.with_(**{name: 0.0})
    thing = f"{type(vehicle).model_id()}: {parameter.meaning if parameter else 'parameter'} {name}"
    log = False
    if isinstance(given, str):
        parts = [part.strip() for part in given.split(":")]
        log = len(parts) == 3 and parts[2].startswith("log")
        if not (len(parts) == 2 or log):
            raise UcritError(f"{thing}: {given!r} is no range of a boundary; write LO:HI or LO:HI:log, then a unit")
        text = re.sub(r":\s*log", ":2:log", given) if log else given
        values = parse_range(text, parameter.unit if parameter else "1", thing)
        lo, hi = float(values[0]), float(values[-1])
    else:
        if np.ndim(given) != 1 or np.size(given) != 2:
            raise UcritError(f"{thing}: a boundary needs both ends of its range, got {given!r}")
        lo, hi = (to_si(end, parameter.unit if parameter else "1", thing) for end in np.asarray(given, dtype=object))
    if not np.isfinite([lo, hi]).all():
        raise UcritError(f"{thing} must be finite, got the range from {lo:g} to {hi:g}")
    if not lo < hi:
        raise UcritError(f"{thing}: the range from {lo:g} to {hi:g} is empty; the first end must be below the second")
    return lo, hi, log


class _Search:
    """Judges cells, corners and points of one lattice, each corner once, and counts what that takes."""

    def __init__(self, vehicle: Model, lattice: Lattice) -> None:
        self.vehicle, self.lattice, self.evaluations = vehicle, lattice, 0
        name = type(vehicle).declaration.speed
        ahead = lattice.lower[lattice.names.index(name)] >= 0 if name in lattice.names else direction(vehicle) > 0
        self.functions: Compiled = compiled(type(vehicle), 1 if ahead else -1)
        self.keys = np.zeros(0, dtype=np.int64)
        self.verdicts = np.zeros(0, dtype=bool)

    def cells(self) -> Places:
        """Return the smallest cells in which a boundary may run."""
        points = (self.lattice.count + 1.0) ** len(self.lattice.names)
        pays = points > SMALL_GRID and self._enclosable()
        found = subdivided(self.lattice, self.open_by_enclosure) if pays else None
        return differing(self.lattice, self.judged) if found is None else found

    def judged(self, axes: Mapping[str, Array]) -> npt.NDArray[np.bool_]:
        """Tell of a grid where the vehicle is stable."""
        found = decide(self.vehicle, axes, "auto")
        self.evaluations += found.size
        return found

    def sides(self) -> StabilityMap:
        """Return a coarse map of the whole plane."""
        step = max(1, self.lattice.count // SIDES)
        axes = {name: x[::step] for name, x in self.lattice.axes().items()}
        return StabilityMap(self.vehicle.with_(**axes), axes, self.judged(axes))

    def _enclosable(self) -> bool:
        """Whether the model's functions have enclosures."""
        names = set(re.findall(r"numpy\.(\w+)", self.functions.source))
        return names <= {name for name in dir(EnclosureFunctions) if not name.startswith("_")}

    def open_by_enclosure(self, cells: Places, width: int) -> npt.NDArray[np.bool_]:
        """Tell in which cells a boundary may run."""
        blocks = [self._enclosed(cells[k : k + BLOCK // 16], width) for k in range(0, len(cells), BLOCK // 16)]
        return np.concatenate([np.zeros(0, dtype=bool), *blocks])

    def _enclosed(self, cells: Places, width: int) -> npt.NDArray[np.bool_]:
        self.evaluations += len(cells)
        ends = [np.stack(list(self.lattice.columns(cells + step).values())) for step in (0, width)]
        centre, half = (ends[0] + ends[1]) / 2, (ends[1] - ends[0]) / 2
        values: dict[str, Any] = dict(self.vehicle.values)
        for axis, name in enumerate(self.lattice.names):
            values[name] = Enclosure.variable(axis, centre, half)
        run = build(self.functions.source, "coefficients", functions=EnclosureFunctions)
        with np.errstate(all="ignore"):
            a = deciding(self.functions, run(list(values.values())))
            return ~excluded(a, len(cells))

    def stable(self, keys: Places) -> npt.NDArray[np.bool_]:
        """Tell of places whether the vehicle is stable there."""
        new = np.setdiff1d(keys, self.keys)
        if new.size:
            self.evaluations += new.size
            found = settle(self.vehicle, self.lattice.columns(self.lattice.places(new)))
            joined = np.concatenate([self.keys, new])
            order = np.argsort(joined, kind="stable")
            self.keys, self.verdicts = joined[order], np.concatenate([self.verdicts, found])[order]
        return np.asarray(self.verdicts[np.searchsorted(self.keys, keys)])

    def margins(self, places: Array) -> tuple[Array, Array]:
        """Return the conditions for stability, shape (conditions, points), and the coefficients' signs."""
        self.evaluations += len(places)
        a = judged_points(self.vehicle, self.lattice.columns(places)).coefficients
        with np.errstate(all="ignore"):
            sign = np.where(a[-1] < 0, -1.0, 1.0)
            return np.stack([np.broadcast_to(c, sign.shape) for c in conditions(list(sign * a))]), np.sign(a)

    def refined(self, edges: Places) -> tuple[Array, npt.NDArray[Any]]:
        """Return the places at which edges, stable corner first, are cut, and what happens there."""
        if not len(edges):
            return np.zeros((0, len(self.lattice.names))), np.zeros(0, dtype="U10")
        ends = [self.lattice.places(edges[:, k]).astype(float) for k in (0, 1)]
        keys, where = np.unique(edges, return_inverse=True)
        c, signs = self.margins(self.lattice.places(keys).astype(float))
        left, right = (np.asarray(where).reshape(edges.shape)[:, k] for k in (0, 1))
        scale = np.fmax(np.abs(c[:, left]), np.abs(c[:, right]))
        scale[~(scale > 0)] = 1.0
        share = self._roots(ends, scale, c[:, left], c[:, right])
        kinds = np.full(len(edges), "flutter", dtype="U10")
        kinds[signs[-1, left] != signs[-1, right]] = "order"
        kinds[signs[0, left] * signs[-1, left] != signs[0, right] * signs[-1, right]] = "divergence"
        return ends[0] + share[:, None] * (ends[1] - ends[0]), kinds

    def _roots(self, ends: list[Array], scale: Array, first: Array, last: Array) -> Array:
        """Shares of the edges at which the least of the scaled conditions vanishes: secants that keep a bracket."""
        low, high = np.zeros(len(ends[0])), np.ones(len(ends[0]))
        f_low, f_high = (np.nan_to_num(np.min(c / scale, axis=0), nan=-1.0) for c in (first, last))
        f_low, f_high = np.maximum(f_low, 0.0), np.minimum(f_high, 0.0)
        side = np.zeros(len(low))
        active = np.flatnonzero((f_low > 0) & (f_high < 0))
        low[f_high == 0] = high[f_high == 0]
        high[f_low == 0] = low[f_low == 0]
        for round_ in range(80):
            if not active.size:
                break
            a, b, fa, fb = low[active], high[active], f_low[active], f_high[active]
            middle = (a + b) / 2 if round_ % 8 == 7 else np.clip(b - fb * (b - a) / (fb - fa), a, b)
            place = ends[0][active] + middle[:, None] * (ends[1][active] - ends[0][active])
            f = np.nan_to_num(np.min(self.margins(place)[0] / scale[:, active], axis=0), nan=-1.0)
            good = f > 0
            f_high[active] = np.where(good, np.where(side[active] > 0, fb / 2, fb), f)
            f_low[active] = np.where(good, f, np.where(side[active] < 0, fa / 2, fa))
            side[active] = np.where(good, 1, -1)
            low[active], high[active] = np.where(good, middle, a), np.where(good, b, middle)
            moved = np.where(good, middle - a, b - middle)
            tiny = (moved < WITHIN) | (high[active] - low[active] < WITHIN) | (np.abs(f) < 1e-14)
            low[active[tiny]] = high[active[tiny]] = middle[tiny]
            active = active[~tiny]
        return (low + high) / 2
