"""Maps and sweeps as Dask collections: nothing is computed before it is asked for, and then in parallel."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ..results.convert import needed
from .chunks import Job, job

Array = npt.NDArray[Any]


def lazy(
    vehicle: Model, /, *, kind: str = "map", chunk: int | None = None, **ranges: Sequence[float] | Array | str
) -> Any:
    """Return a stability map or a sweep as an `xarray.Dataset` of Dask arrays.

    Parameters
    ----------
    vehicle
        With scalar parameters.
    kind
        ``"map"`` (stable or not) or ``"sweep"`` (eigenvalues, growth and damping too).
    chunk
        Most points of a chunk, which is one task; 4 million of a map, 65536 of a sweep by default.
    **ranges
        Values of each parameter [SI]: a one-dimensional array, or text such as ``"20:130:12 km/h"``.

    Returns
    -------
    xarray.Dataset
        With the names, dimensions and units that `stability_map` and `sweep` give. ``.compute()`` takes whatever
        scheduler Dask has, a cluster after ``dask.distributed.Client(...)``.

    Raises
    ------
    UcritError
        If a name, a range or the size of chunks is wrong.
    MissingExtraError
        If Dask or xarray is not installed (extra ``scale``).

    Examples
    --------
    >>> from ucrit import lazy, load
    >>> dataset = lazy(load("caravan"), U=[10, 20, 30], c=[0, 4000], chunk=2)
    >>> dataset.stable.sum().compute().item()
    2
    """
    xarray = needed("xarray", "scale", "a labelled array")
    found = job(vehicle, kind, chunk, ranges)
    units, coords = found.units(), {**found.coords, **found.further()}
    data = _arrays(found)
    told = found.variables()
    return xarray.Dataset(
        {n: ((*found.dims, *told[n][2]), x, {"units": told[n][1]} if told[n][1] else {}) for n, x in data.items()},
        {n: ((n,), x, units[n]) for n, x in coords.items()},
        {"title": kind, "model": type(vehicle).model_id(), "vehicle": vehicle.info.name},
    )


def _arrays(found: Job) -> dict[str, Any]:
    """Return a Dask array for each result; all results of a chunk are computed by one task."""
    dask_array = needed("dask.array", "scale", "a Dask collection")
    tokenize = needed("dask.base", "scale", "a Dask collection").tokenize
    further, told = found.further(), found.variables()
    widths = [sum(1 if not more else further[more[0]].size for _, _, more in told.values())]
    chunks = [
        tuple(min(c, n - i * c) for i in range(g)) for c, g, n in zip(found.chunk, found.grid, found.shape, strict=True)
    ]

    def block(block_info: Any = None) -> Array:
        place = block_info[None]["chunk-location"][:-1]
        results = found.part(place).compute()
        return np.concatenate([x.reshape(*x.shape[: len(place)], -1).astype(float) for x in results.values()], axis=-1)

    name = f"ucrit-{found.kind}-{tokenize(found.vehicle.values, dict(found.coords), found.chunk, found.kind)}"
    packed = dask_array.map_blocks(
        block, chunks=(*chunks, tuple(widths)), dtype=float, name=name, meta=np.zeros((0,) * (len(chunks) + 1))
    )
    arrays, start = {}, 0
    for key, (dtype, _, more) in told.items():
        size = further[more[0]].size if more else 1
        part = packed[..., start : start + size] if more else packed[..., start]
        arrays[key] = part.astype(dtype)
        start += size
    return arrays
