"""Maps and sweeps in chunks: the same numbers, whoever computes them and however often they are stopped."""

import os
import signal
import subprocess
import sys
import textwrap
from pathlib import Path

import numpy as np
import pytest

from ucrit import UcritError, lazy, load, stability_map, stream, sweep

for _package in ("dask", "distributed", "zarr", "xarray"):
    pytest.importorskip(_package, reason="needs the extra 'scale'")

CARAVAN = load("caravan")
RANGES = {"U": np.linspace(5, 40, 37), "c": np.linspace(0, 5000, 11)}


def expected(kind):
    return (stability_map if kind == "map" else sweep)(CARAVAN, **RANGES).to_xarray()


def assert_same(dataset, reference):
    assert set(dataset.data_vars) == set(reference.data_vars)
    for name, values in reference.variables.items():
        np.testing.assert_array_equal(dataset[name].values, values.values)
        assert (dataset[name].dims, dataset[name].dtype) == (values.dims, values.dtype)
        assert dataset[name].attrs == values.attrs


def stamps(store, name):
    """When each file of an array was written; also what its neighbours' names are."""
    return {p: p.stat().st_mtime_ns for p in (Path(store) / name / "c").rglob("*") if p.is_file()}


@pytest.mark.parametrize("kind", ["map", "sweep"])
def test_chunks_give_what_one_piece_gives(kind, tmp_path):
    reference, seen = expected(kind), []
    assert_same(lazy(CARAVAN, kind=kind, chunk=50, **RANGES).compute(scheduler="sync"), reference)
    store = tmp_path / "x.zarr"
    dataset = stream(CARAVAN, store, kind=kind, chunk=50, progress=lambda *x: seen.append(x), **RANGES)
    assert_same(dataset, reference)
    assert seen == [(k, 10) for k in range(11)]
    before = stamps(store, "stable")
    again = stream(CARAVAN, str(store), kind=kind, chunk=50, progress=lambda *x: seen.append(x), **RANGES)
    assert seen[11:] == [(10, 10)]
    assert stamps(store, "stable") == before
    assert_same(again, reference)


@pytest.mark.parametrize("chunk", [1, 3, 11, 25, 10**6])
def test_the_size_of_chunks_changes_nothing(chunk, tmp_path):
    small = {"U": np.linspace(5, 40, 7), "c": "0:5000:5", "m": [1000, 1200]}
    found = stream(CARAVAN, tmp_path / "x", chunk=chunk, **small)
    assert_same(found, stability_map(CARAVAN, **small).to_xarray())
    lazily = lazy(CARAVAN, chunk=chunk, **small)
    assert max(np.prod(c) for c in [lazily.stable.data.chunksize]) <= chunk


def test_a_process_that_is_killed_loses_nothing_and_does_nothing_twice(tmp_path):
    """Kill a real process in the middle of its work, then finish here."""
    store = tmp_path / "x.zarr"
    code = f"""
        import numpy as np, time
        from ucrit import load, stream
        def slowly(done, total):
            print(done, flush=True)
            time.sleep(0.05)
        stream(load("caravan"), {str(store)!r}, kind="sweep", chunk=22, progress=slowly,
               U=np.linspace(5, 40, 37), c=np.linspace(0, 5000, 11))
    """
    process = subprocess.Popen([sys.executable, "-c", textwrap.dedent(code)], stdout=subprocess.PIPE, text=True)
    for line in process.stdout:
        if int(line) >= 4:
            break
    process.kill()
    process.wait()
    process.stdout.close()
    done, data = stamps(store, "chunk_done"), stamps(store, "growth")
    assert 4 <= len(done) < 19
    found = stream(CARAVAN, store, kind="sweep", chunk=22, **RANGES)
    assert_same(found, expected("sweep"))
    marks, written = stamps(store, "chunk_done"), stamps(store, "growth")
    assert len(marks) == len(written) == 19
    assert done.items() <= marks.items()
    finished = {p.relative_to(store / "chunk_done") for p in done}
    for path, stamp in data.items():
        if path.relative_to(store / "growth") in finished:
            assert written[path] == stamp


@pytest.fixture(scope="module")
def cluster():
    from distributed import LocalCluster

    with LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=":0", silence_logs=50
    ) as local:
        yield local


def test_a_cluster_that_loses_a_process_in_the_middle_gives_everything(cluster, tmp_path):
    store, killed, seen = tmp_path / "x.zarr", [], []

    def watch(done, total):
        seen.append(done)
        if done >= 6 and not killed:
            pid = next(iter(cluster.workers.values())).pid
            killed.append((pid, stamps(store, "chunk_done")))
            os.kill(pid, signal.SIGKILL)

    found = stream(CARAVAN, store, kind="sweep", chunk=11, client=cluster.scheduler_address, progress=watch, **RANGES)
    assert killed
    assert seen == list(range(38))
    assert_same(found, expected("sweep"))
    marks = stamps(store, "chunk_done")
    assert len(marks) == 37
    assert killed[0][1].items() <= marks.items()


def test_lazy_results_are_computed_by_a_client():
    from distributed import Client

    with Client(
        processes=False, n_workers=1, threads_per_worker=2, dashboard_address=":0", set_as_default=False
    ) as client:
        found = client.compute(lazy(CARAVAN, kind="sweep", chunk=100, **RANGES).growth.data).result()
    np.testing.assert_array_equal(found, expected("sweep").growth)


def test_memory_stays_bounded(tmp_path):
    """A map of 12 million points, 12 MB in one piece, in a process that may not grow by half of that."""
    code = f"""
        import resource
        import numpy as np
        from ucrit import load, stream
        caravan = load("caravan")
        stream(caravan, {str(tmp_path / "a")!r}, chunk=2**18, U=np.linspace(5, 40, 64), c=np.linspace(0, 5000, 2**13))
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        stream(caravan, {str(tmp_path / "b")!r}, chunk=2**18, U=np.linspace(5, 40, 1500), c=np.linspace(0, 5000, 2**13))
        print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before)
    """
    done = subprocess.run([sys.executable, "-c", textwrap.dedent(code)], capture_output=True, text=True, check=True)
    kib = int(done.stdout)
    assert kib < 6 * 1024, f"{kib} KiB more for 12 million points"


def test_other_jobs_and_other_folders_are_left_alone(tmp_path):
    store = tmp_path / "x.zarr"
    stream(CARAVAN, store, **RANGES)
    for vehicle, options, what in (
        (CARAVAN.with_(m=1000), {}, "parameters"),
        (CARAVAN, {"kind": "sweep"}, "kind"),
        (CARAVAN, {"chunk": 11}, "chunks"),
        (CARAVAN, {"U": [1, 2]}, "ranges, chunks"),
        (load("caravan-undamped-hitch"), {"c": None, "k": [1e3, 2e3]}, "model, equations, parameters, ranges, chunks"),
    ):
        ranges = {name: x for name, x in {**RANGES, **options}.items() if x is not None}
        with pytest.raises(UcritError, match=f"holds another job: it differs in {what}; name a new store"):
            stream(vehicle, store, **ranges)
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "thesis.txt").write_text("all of it")
    with pytest.raises(UcritError, match="is a folder that holds something else"):
        stream(CARAVAN, tmp_path / "mine", **RANGES)
    with pytest.raises(UcritError, match=r"thesis.txt' is a file, not a Zarr store"):
        stream(CARAVAN, tmp_path / "mine" / "thesis.txt", **RANGES)
    assert (tmp_path / "mine" / "thesis.txt").read_text() == "all of it"


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"kind": "mop"}, "there is no kind 'mop' of results; did you mean 'map'?"),
        ({"chunk": 0}, "chunk must be a whole number of points above 0, got 0"),
        ({"c": []}, "c must be a list of numbers or a text, got []"),
        ({"c": [1, float("nan")]}, "c must be a list of numbers or a text, got [1, nan]"),
        ({"x": [1, 2]}, "there is no parameter 'x'"),
        ({"c": np.arange(2_000_000), "chunk": 1}, "are allowed: take fewer points, or larger chunks"),
        ({"client": "tcp://127.0.0.1:9"}, "no scheduler answers at 'tcp://127.0.0.1:9'"),
        ({"client": 3}, "client must be a dask.distributed.Client or an address, got 3"),
        (
            {"client": "nonsense://x:1"},
            "a scheduler's address is written such as tcp://10.0.0.1:8786, got 'nonsense://x:1'",
        ),
    ],
)
def test_wrong_input_is_refused_in_a_sentence(options, message, tmp_path, monkeypatch):
    monkeypatch.setattr(sys.modules["ucrit.analyses.regions.stream"], "TIMEOUT", 0.5)
    with pytest.raises(UcritError) as caught:
        stream(CARAVAN, tmp_path / "x", **{**RANGES, **options})
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)
    assert not (tmp_path / "x").exists()


def test_a_scheduler_that_dies_leaves_what_is_done(tmp_path, monkeypatch):
    from distributed import LocalCluster

    monkeypatch.setattr(sys.modules["ucrit.analyses.regions.stream"], "TIMEOUT", 1)
    store = tmp_path / "x.zarr"

    with LocalCluster(
        n_workers=1, threads_per_worker=1, processes=False, dashboard_address=":0", silence_logs=50
    ) as own:

        def stop(done, total):
            if done == 5:
                own.close()

        with pytest.raises(UcritError, match="call again to go on"):
            stream(CARAVAN, store, kind="sweep", chunk=11, client=own.scheduler_address, progress=stop, **RANGES)
    before = stamps(store, "chunk_done")
    assert len(before) >= 5
    assert_same(stream(CARAVAN, store, kind="sweep", chunk=11, **RANGES), expected("sweep"))
    assert before.items() <= stamps(store, "chunk_done").items()


def test_a_store_makes_no_folders_on_its_way_like_other_files(tmp_path):
    for write in (
        lambda path: stream(CARAVAN, f"{path}.zarr", U=[10, 20]),
        lambda path: stability_map(CARAVAN, U=[10, 20]).to_csv(f"{path}.csv"),
    ):
        with pytest.raises(UcritError, match="cannot be written: No such file or directory"):
            write(tmp_path / "none" / "x")
    assert not (tmp_path / "none").exists()


def test_an_address_that_dask_cannot_have_is_refused_in_a_sentence(tmp_path):
    with pytest.raises(UcritError, match=r"a scheduler's address is written such as tcp://10.0.0.1:8786, got 'x'"):
        stream(CARAVAN, tmp_path / "x.zarr", client="x", U=[10, 20])
