"""Maps, boundaries and generic matrices beside the eigenvalues that the usual way takes."""

from __future__ import annotations

from collections.abc import Callable
from importlib.util import find_spec
from typing import Any

import numpy as np

from benchmarks.timing import Row, compared, interleaved
from ucrit import boundary, find_model, stability_map, stable_matrices
from ucrit.core.numeric.compiled import state_space

SIDE = 10_000
ORDER = 8
MATRICES = 100_000
STEPS = 4096
OPERATIONS = 10
"""What the kernel's conditions take at a point of the trailer's map: 5 products and sums, 5 comparisons."""


def arithmetic() -> float:
    """Return additions and multiplications of this machine in a second, of one core and compiled code."""
    import numba

    @numba.njit(error_model="numpy")  # type: ignore[untyped-decorator]
    def work(x: Any, rounds: int) -> None:
        for _ in range(rounds):
            for i in range(x.size):
                a, b, c, d = x[i], x[i] + 1.0, x[i] + 2.0, x[i] + 3.0
                e, f, g, h = x[i] + 4.0, x[i] + 5.0, x[i] + 6.0, x[i] + 7.0
                for _ in range(16):
                    a, b, c, d = a * 0.5 + 0.25, b * 0.5 + 0.25, c * 0.5 + 0.25, d * 0.5 + 0.25
                    e, f, g, h = e * 0.5 + 0.25, f * 0.5 + 0.25, g * 0.5 + 0.25, h * 0.5 + 0.25
                x[i] = a + b + c + d + e + f + g + h

    x = np.ones(1024)
    seconds = interleaved({"work": lambda: work(x, 2000)}, 5)["work"]
    return 2000 * x.size * (16 * 16 + 14) / seconds


def written() -> None:
    """Write a map of which nothing is computed."""
    np.empty((SIDE, SIDE), dtype=bool)[:] = True


def trailer() -> Any:
    """Return the fourth-order trailer that all of this is about."""
    return find_model("trailer-undamped-hitch")(m=1000, a=1.5, I_c=1800, U=25, C=5e4, b=1, k=1e4)


def large() -> list[Row]:
    """Compare engines on a map of 1e8 points with eigenvalues, and with what the machine can do."""
    if find_spec("numba") is None:
        return [Row("\nLarge maps: numba is not installed")]
    subject = trailer()
    b, k = np.linspace(0, 2, SIDE), np.geomspace(1e3, 1e6, SIDE)
    few = state_space(subject.with_(b=b[:: SIDE // 100], k=k[:: SIDE // 1000])).A
    part = max(1, SIDE // 1000)
    stability_map(subject, engine="numba", b=b[:2], k=k[:2])
    median = interleaved(
        {
            "eigvals": lambda: np.linalg.eigvals(few),
            "numpy": lambda: stability_map(subject, engine="numpy", b=b[::part], k=k),
            "numba": lambda: stability_map(subject, engine="numba", b=b, k=k),
            "written": written,
        },
        5,
    )
    points = SIDE * SIDE
    base = median["eigvals"] * points / (few.size // 16)
    rate = arithmetic()
    limit = points * OPERATIONS / rate + median["written"]
    share = median["numba"] / limit
    told = f"{OPERATIONS} operations a point at {rate / 1e9:.0f} Gflop/s, and {points:.0e} bytes written"
    return [
        Row(f"\nStability of an undamped trailer at {SIDE} x {SIDE} points (CPU time)"),
        Row("numpy.linalg.eigvals, matrices given", base, 1.0, note="measured at 1e5 points, scaled"),
        compared("ucrit stability_map, numpy", median["numpy"] * part, base, 1 / 150, "measured at a tenth, scaled"),
        compared("ucrit stability_map, numba", median["numba"], base, 1 / 2000),
        Row(
            "  numba beside the machine's limit",
            limit,
            share,
            3.0,
            share <= 3,
            told,
        ),
        Row(f"  points in a second of CPU time: {points / median['numba']:.2g}"),
    ]


def generic() -> list[Row]:
    """Compare the verdict on matrices of eighth order with their eigenvalues."""
    random = np.random.default_rng(0)
    A = random.normal(size=(MATRICES, ORDER, ORDER)) / np.sqrt(ORDER) - 0.9 * np.eye(ORDER)
    some = A[: MATRICES // 5]
    engines = ["numpy", *(["numba"] if find_spec("numba") else [])]
    calls: dict[str, Callable[[], Any]] = {"eigvals": lambda: np.linalg.eigvals(some)}
    for engine in engines:
        calls[engine] = lambda engine=engine: stable_matrices(A, engine)  # type: ignore[misc]
    median = interleaved(calls, 3)
    base = 5 * median["eigvals"]
    agree = int(np.count_nonzero(stable_matrices(some) == (np.linalg.eigvals(some).real.max(axis=-1) < 0)))
    rows = [
        Row(f"\nStability of {MATRICES:,} matrices of order {ORDER} (CPU time)"),
        Row("numpy.linalg.eigvals, batched", base, 1.0, note="measured at a fifth, scaled"),
    ]
    rows += [compared(f"ucrit stable_matrices, {e}", median[e], base, 1 / 8 if e == "numba" else None) for e in engines]
    return [*rows, Row(f"  agrees with eigenvalues at {agree:,} of {len(some):,}", ok=agree == len(some))]


def curves() -> list[Row]:
    """Compare a boundary at 4096 x 4096 with the map of that grid."""
    subject = trailer()
    ends: dict[str, Any] = {"b": (0.0, 2.0), "k": "1e3:1e6:log"}
    grid = {"b": np.linspace(0, 2, STEPS + 1), "k": np.geomspace(1e3, 1e6, STEPS + 1)}
    median = interleaved(
        {
            "map": lambda: stability_map(subject, engine="numpy", **grid),
            "boundary": lambda: boundary(subject, tolerance=1 / STEPS, **ends),
        },
        3,
    )
    found = boundary(subject, tolerance=1 / STEPS, **ends)
    share = found.evaluations / (STEPS + 1) ** 2
    return [
        Row(f"\nBoundary at a resolution of {STEPS} x {STEPS} (CPU time)"),
        Row("ucrit stability_map, numpy: all points", median["map"], 1.0),
        compared("ucrit boundary, to 1e-9 of a step", median["boundary"], median["map"]),
        Row("  evaluations beside those of the grid", None, share, 1 / 40, share <= 1 / 40),
    ]
