"""Maps and sweeps larger than memory, streamed to a Zarr store chunk by chunk, on one machine or many.

A chunk is written whole, then marked as done in an array beside the results; both are files of their own. Whatever is
killed, a chunk that is marked is complete and is never computed again, and one that is not is computed anew.
"""

from __future__ import annotations

import errno
import json
import os
import re
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import CancelledError
from contextlib import contextmanager, nullcontext
from hashlib import sha256
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ...core.errors import UcritError
from ...core.numeric.compiled import compiled, direction
from ..results.convert import needed
from .chunks import Job, Place, job

Array = npt.NDArray[Any]
Progress = Callable[[int, int], None]

DONE = "chunk_done"
"""Name of the array that marks chunks, one byte each."""

MAKING = "ucrit, being made"
"""Title of a store whose arrays are not all there yet."""

LAYOUT = 1
"""Version of the layout of a store."""

ADDRESS = re.compile(r"((tcp|tls|ucx|wss?|inproc)://)?(\[[^\]]+\]|[^/:\[\]\s]+)(:\d+|/.+)")
"""What is handed to Dask: of another address it makes a client that nobody can close."""

TIMEOUT = 10
"""Seconds to wait for a scheduler."""

AHEAD = 4
"""Tasks handed out for each thread of a cluster: enough to keep it busy, few enough to stay small."""


def stream(
    vehicle: Model,
    store: str | os.PathLike[str],
    /,
    *,
    kind: str = "map",
    chunk: int | None = None,
    client: Any = None,
    progress: Progress | None = None,
    **ranges: Sequence[float] | Array | str,
) -> Any:
    """Compute a stability map or a sweep of any size into a Zarr store; go on where a former call was stopped.

    Parameters
    ----------
    vehicle
        With scalar parameters.
    store
        Folder of the Zarr store, which all machines must see. A store of the same job is completed, one of another
        job is refused.
    kind
        ``"map"`` (stable or not) or ``"sweep"`` (eigenvalues, growth and damping too).
    chunk
        Most points of a chunk, which is computed and written at once; 4 million of a map, 65536 of a sweep by default.
    client
        A `dask.distributed.Client`, or the address of a scheduler such as ``"tcp://10.0.0.1:8786"``; by default
        chunks are computed here, one after another.
    progress
        Called with the number of chunks done and of all.
    **ranges
        Values of each parameter [SI]: a one-dimensional array, or text such as ``"20:130:12 km/h"``.

    Returns
    -------
    xarray.Dataset
        The store's content, read when it is used.

    Raises
    ------
    UcritError
        If a range is wrong, the store holds another job or cannot be written, or the scheduler is not there or has
        lost its workers; chunks that are done stay done.
    MissingExtraError
        If Zarr, xarray or Dask is not installed (extra ``scale``).

    Examples
    --------
    >>> import tempfile
    >>> from ucrit import load, stream
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     dataset = stream(load("caravan"), f"{folder}/map.zarr", U=[10, 20, 30], c=[0, 4000], chunk=2)
    ...     dataset.stable.values.tolist()
    [[False, True], [False, True], [False, False]]
    """
    zarr = needed("zarr", "scale", "a Zarr store")
    xarray = needed("xarray", "scale", "a labelled array")
    found = job(vehicle, kind, chunk, ranges)
    path = str(Path(store).absolute())
    if not Path(path).parent.is_dir():
        raise UcritError(f"the store '{path}' cannot be written: {os.strerror(errno.ENOENT)}")
    with nullcontext() if client is None else _connected(client) as cluster, _writing(path):
        group = _opened(zarr, path, found)
        done = np.asarray(group[DONE][...]) != 0
        total, count = done.size, int(done.sum())
        todo = (place for place in found.places() if not done[place])
        if progress is not None:
            progress(count, total)
        for _ in _computed(found, path, todo, cluster):
            count += 1
            if progress is not None:
                progress(count, total)
    return xarray.open_zarr(path, consolidated=False, chunks=None).drop_vars(DONE)


def write_chunk(part: Job, path: str, place: Place, region: tuple[slice, ...]) -> bool:
    """Compute one chunk and write it, unless it is marked as done; return whether there was something to do."""
    zarr = needed("zarr", "scale", "a Zarr store")
    group = zarr.open_group(path, mode="r+")
    if group[DONE][place]:
        return False
    for name, values in part.compute().items():
        group[name][region] = values
    group[DONE][place] = 1
    return True


@contextmanager
def _writing(path: str) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        raise UcritError(f"the store '{path}' cannot be written: {error.strerror or error}") from None


def _opened(zarr: Any, path: str, found: Job) -> Any:
    """Open the store of a job, or make it; its description is written last, so that half a store counts as none."""
    told = _described(found)
    if not Path(path).exists():
        return _made(zarr, path, found, told)
    if not Path(path).is_dir():
        raise UcritError(f"'{path}' is a file, not a Zarr store")
    try:
        group = zarr.open_group(path, mode="r+")
    except (FileNotFoundError, ValueError, KeyError):
        group = None
    if group is None or "ucrit" not in group.attrs:
        if any(Path(path).iterdir()) and (group is None or group.attrs.get("title") != MAKING):
            raise UcritError(f"'{path}' is a folder that holds something else than a map or sweep; name a new one")
        return _made(zarr, path, found, told)
    before = json.loads(group.attrs["ucrit"])
    if before != told:
        differing = ", ".join(key for key in told if before.get(key) != told[key])
        raise UcritError(f"the store '{path}' holds another job: it differs in {differing}; name a new store")
    return group


def _described(found: Job) -> dict[str, Any]:
    """What decides the content of a store, as plain data."""
    functions = compiled(type(found.vehicle), direction(found.vehicle))
    described = {
        "layout": LAYOUT,
        "kind": found.kind,
        "model": type(found.vehicle).model_id(),
        "equations": sha256(functions.source.encode()).hexdigest()[:24],
        "parameters": {k: float(v) for k, v in found.vehicle.values.items() if k not in found.coords},
        "ranges": {name: x.tolist() for name, x in found.coords.items()},
        "chunks": list(found.chunk),
    }
    found_again: dict[str, Any] = json.loads(json.dumps(described))
    return found_again


def _made(zarr: Any, path: str, found: Job, told: dict[str, Any]) -> Any:
    group = zarr.open_group(path, mode="w", attributes={"title": MAKING})
    further, units = found.further(), found.units()
    for name, values in {**found.coords, **further}.items():
        group.create_array(name, data=np.asarray(values), dimension_names=[name], attributes=units[name])
    for name, (dtype, unit, more) in found.variables().items():
        widths = [further[key].size for key in more]
        array = group.create_array(
            name,
            shape=(*found.shape, *widths),
            chunks=(*found.chunk, *widths),
            dtype=dtype,
            dimension_names=[*found.dims, *more],
        )
        if unit:
            array.attrs["units"] = unit
    steps = [f"chunk_{name}" for name in found.dims]
    group.create_array(
        DONE, shape=found.grid, chunks=(1,) * len(found.grid), dtype="uint8", fill_value=0, dimension_names=steps
    )
    group.attrs.update({"title": found.kind, "vehicle": found.vehicle.info.name, "model": told["model"]})
    group.attrs["ucrit"] = json.dumps(told)
    return group


def _computed(found: Job, path: str, todo: Iterator[Place], cluster: Any) -> Iterator[None]:
    """Yield chunks as they are done: here, or by the workers of a cluster."""
    if cluster is None:
        for place in todo:
            write_chunk(found.part(place), path, place, found.slices(place))
            yield
    else:
        yield from _by_workers(found, path, todo, cluster)


@contextmanager
def _connected(client: Any) -> Iterator[Any]:
    """Give a client: the one that is given, or one for a scheduler's address, closed afterwards."""
    distributed = needed("distributed", "scale", "a cluster")
    if not isinstance(client, str):
        if not isinstance(client, distributed.Client):
            raise UcritError(f"client must be a dask.distributed.Client or an address, got {client!r}")
        if client.status != "running":
            raise UcritError(f"the client is not connected to its scheduler: it is {client.status}")
        yield client
        return
    if not ADDRESS.fullmatch(client):
        raise UcritError(f"a scheduler's address is written such as tcp://10.0.0.1:8786, got {client!r}")
    try:
        made = distributed.Client(client, timeout=TIMEOUT, set_as_default=False)
    except (OSError, TimeoutError, ValueError) as error:
        told = str(error).partition("\n")[0] or type(error).__name__
        raise UcritError(f"no scheduler answers at '{client}': {told}") from None
    with made:
        yield made


def _by_workers(found: Job, path: str, todo: Iterator[Place], cluster: Any) -> Iterator[None]:
    """Hand out chunks, a few for each thread at a time, and take in what is done."""
    distributed = needed("distributed", "scale", "a cluster")
    ahead = AHEAD * max(1, _threads(cluster))
    waiting: set[Any] = set()
    for place in islice(todo, ahead):
        waiting.add(_submitted(cluster, found, path, place))
    while waiting:
        try:
            with cluster.as_current():
                finished, _ = distributed.wait(waiting, timeout=TIMEOUT, return_when="FIRST_COMPLETED")
        except TimeoutError:  # chunks may take their time, but somebody must be at work
            if cluster.status != "running" or not _threads(cluster):
                raise _lost("nobody is at work any more") from None
            continue
        except CancelledError as error:
            raise _lost(str(error)) from None
        for future in finished:
            waiting.discard(future)
            try:
                future.result()
            except (distributed.scheduler.KilledWorker, CancelledError) as error:
                raise _lost(str(error)) from None
            yield
            for place in islice(todo, 1):
                waiting.add(_submitted(cluster, found, path, place))


def _submitted(cluster: Any, found: Job, path: str, place: Place) -> Any:
    return cluster.submit(write_chunk, found.part(place), path, place, found.slices(place), pure=False)


def _threads(cluster: Any) -> int:
    return sum(worker["nthreads"] for worker in cluster.scheduler_info(n_workers=-1)["workers"].values())


def _lost(why: str) -> UcritError:
    told = why.partition("\n")[0].rstrip(":. ")
    return UcritError(f"the cluster was lost ({told}); chunks that are done stay done, call again to go on")
