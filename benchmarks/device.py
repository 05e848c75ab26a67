"""Maps on a GPU: what one takes, and what the kernel's machine code would allow one to take."""

from __future__ import annotations

import re
import time
from collections.abc import Mapping
from typing import Any

import numpy as np

from benchmarks.maps import trailer
from benchmarks.timing import Row, interleaved
from ucrit import UcritError, stability_map
from ucrit.analyses.stability.device import PIECE, Layout, chunks
from ucrit.analyses.stability.grids import Grid
from ucrit.core.numeric.compiled import compiled
from ucrit.core.numeric.kernels import THREADS, needed, source

SIDES = (20_000, 80_000)
"""Rows and columns of the map: small enough for a device's memory, large enough that it works for some milliseconds."""

AXES: Mapping[str, Any] = {"b": np.linspace(0, 2, SIDES[0]), "k": np.geomspace(1e3, 1e6, SIDES[1])}

CLOCK, CORES, ANY, DOUBLE, WRITES = 1.755e9, 132, 128, 64, 3.35e12
"""An H100 SXM's clock rate [Hz] under load, processors, their instructions and double-precision ones in a clock, and
the bytes that its memory takes in a second, by its data sheet and the CUDA C++ Programming Guide."""


def measured() -> list[Row]:
    """Measure the map on a GPU, by the clock: what stays there, and copied back."""
    title = Row("\nGPU, by the clock")
    try:
        cuda = needed("cuda")
    except UcritError as error:
        return [title, Row(f"  not measured: {error}")]
    subject = trailer()

    def kept() -> None:
        grid = Grid(subject, AXES)
        layout = Layout.of(grid)
        whole = [layout.launch(*chunk) for chunk in chunks(grid)]
        cuda.synchronize()
        del whole

    points = SIDES[0] * SIDES[1]
    calls = {"kept": kept, "copied": lambda: stability_map(subject, engine="cuda", **AXES)}
    seconds = interleaved(calls, 5, time.perf_counter)
    rate = points / seconds["kept"]
    return [
        title,
        Row(f"a map of {points:.2g} points, kept on the device", seconds["kept"]),
        Row(f"  points in a second: {rate:.2g} (limit 1e11)", ok=rate >= 1e11),
        Row("the same, copied back", seconds["copied"]),
        Row(f"  points in a second: {points / seconds['copied']:.2g}"),
    ]


def counted() -> list[Row]:
    """Count the instructions of the map's kernel, which takes NVIDIA's compiler but no device: the rate they allow."""
    title = Row("\nGPU, computed from the kernel's instructions (PTX for compute capability 9.0), not measured")
    try:
        once, point = _instructions()
    except (ImportError, OSError, RuntimeError) as error:
        return [title, Row(f"  not counted: {error}")]
    share, second = THREADS / PIECE, CORES * CLOCK
    issued = second * ANY / (point[0] + share * once[0])
    computed = second * DOUBLE / (point[1] + share * once[1])
    return [
        title,
        Row(f"  a point: {point[0]} instructions, {point[1]} of them in double precision"),
        Row(f"  a row: {once[0]}, {once[1]} of them, in each of {THREADS} threads for {PIECE:,} points"),
        Row(f"  an H100 ({CORES} processors, {CLOCK / 1e9:.2f} GHz) could take, in points a second:"),
        Row(
            f"  {computed:.2g} by its double precision, about {issued:.1g} by its instructions, "
            f"{WRITES:.2g} by its memory"
        ),
    ]


def _instructions() -> tuple[tuple[int, int], tuple[int, int]]:
    """Instructions in all and in double precision: before the loop over the points, and in it."""
    import numba
    from numba import cuda

    row, table, whole = numba.float64[::1], numba.float64[:, ::1], numba.int64[::1]
    given: tuple[Any, ...] = (row, numba.float64[:, :, ::1], whole, whole, table, numba.int64[:, ::1], row)
    given += (numba.uint8[:, ::1], numba.uint8[::1])
    subject = trailer()
    names = list(subject.values)
    made: dict[str, Any] = {}
    exec(source(compiled(type(subject)), (names.index("b"),), names.index("k"), "cuda"), made)
    text, _ = cuda.compile_ptx(made["kernel"], given, cc=(9, 0))
    loop = re.search(r"(\$L\w+):((?:(?!\$L\w+:).)*?bra\s+\1;)", text, re.DOTALL)
    if loop is None:
        raise RuntimeError("the loop over points is not found")
    return _counted(text[: loop.start()]), _counted(loop.group(2))


def _counted(text: str) -> tuple[int, int]:
    """Instructions of a piece, a sum, choice or comparison of two words as two, and those in double precision."""
    code = re.findall(r"^\s*(?:@!?%p\d+\s+)?([a-z]+(?:\.\w+)*)\s[^;\n]*;", text, re.MULTILINE)
    wide = [x for x in code if re.fullmatch(r"(add|sub|shl|selp|setp\.\w+)\.(s64|u64|b64)|selp\.f64", x)]
    double = [x for x in code if re.fullmatch(r"(add|sub|mul|fma|min|max|setp|div|rcp|sqrt)\..*f64", x)]
    return len(code) + len(wide), len(double)
