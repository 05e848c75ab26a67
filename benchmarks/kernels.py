"""Eigenvalues along speeds, and stability over a plane of parameters, beside NumPy and python-control."""

from __future__ import annotations

import numpy as np

from benchmarks.timing import Row, compared, interleaved
from ucrit import find_model, load, modes
from ucrit.analyses.linear.modes import eigenvalues
from ucrit.analyses.regions.stability_map import stability_map
from ucrit.analyses.regions.sweep import sweep
from ucrit.analyses.stability.locus import locus
from ucrit.core.numeric.compiled import coefficients, state_space

SPEEDS = 100_000
SAMPLE = 500
SIDE = 1000
ROUNDS = 5
MAP_LIMIT = 1 / 150


def bandwidth() -> list[Row]:
    """Measure how fast this machine copies memory."""
    source = np.ones(2**24)
    target = np.empty_like(source)
    seconds = interleaved({"copy": lambda: np.copyto(target, source)}, 9)["copy"]
    rate = 2 * source.nbytes / seconds / 1e9
    return [Row(f"Copy bandwidth of this machine (read and write): {rate:.1f} GB/s")]


def speeds() -> list[Row]:
    """Compare ways to the eigenvalues of a fourth-order trailer at 100,000 speeds."""
    import control

    caravan = load("caravan")
    U = np.linspace(1, 45, SPEEDS)
    fleet = caravan.with_(U=U)
    A, B, C, D = state_space(caravan.with_(U=U[:: SPEEDS // SAMPLE]))
    B, D = np.zeros((4, 1)), np.zeros((4, 1))
    C = np.eye(4)

    def loop() -> None:
        for one in A:
            control.ss(one, B, C, D).poles()

    whole = state_space(fleet).A
    median = interleaved(
        {
            "numpy": lambda: np.linalg.eigvals(whole),
            "control": loop,
            "eigenvalues": lambda: eigenvalues(fleet),
            "modes": lambda: modes(fleet),
            "sweep": lambda: sweep(caravan, U=U),
            "locus": lambda: locus(caravan, "U", 1, 45, points=SPEEDS),
        },
        ROUNDS,
    )
    base = median["numpy"]
    scaled = median["control"] * SPEEDS / len(A)
    return [
        Row(f"\nEigenvalues of a fourth-order trailer at {SPEEDS:,} speeds (CPU time)"),
        Row("numpy.linalg.eigvals, batched, matrices given", base, 1.0),
        compared("python-control, one system a speed", scaled, base, note=f"measured at {len(A)}, scaled"),
        compared("ucrit eigenvalues, sorted", median["eigenvalues"], base),
        compared("ucrit modes: with vectors and participation", median["modes"], base),
        compared("ucrit sweep: with verdicts, damping, growth", median["sweep"], base),
        compared("ucrit locus: tracked, named branches", median["locus"], base),
    ]


def plane() -> list[Row]:
    """Compare ways to a stability map of 1000 x 1000 points."""
    trailer = find_model("trailer-undamped-hitch")(m=1000, a=1.5, I_c=1800, U=25, C=5e4, b=1, k=1e4)
    b, k = np.linspace(0, 2, SIDE), np.geomspace(1e3, 1e6, SIDE)
    grid = trailer.with_(b=b, k=k)
    strip = state_space(trailer.with_(b=b[::10], k=k)).A
    median = interleaved(
        {
            "eigvals": lambda: np.linalg.eigvals(strip),
            "plain": lambda: _plain(coefficients(grid)),
            "blocked": lambda: stability_map(trailer, b=b, k=k),
        },
        9,
    )
    eigvals = median["eigvals"] * 10
    result = stability_map(trailer, b=b, k=k)
    agree = sum(
        int(np.count_nonzero(row == (np.linalg.eigvals(state_space(grid.with_(b=[x])).A).real.max(axis=-1) < 0)))
        for x, row in zip(b, result.stable[:, None, :], strict=True)
    )
    return [
        Row(f"\nStability of an undamped trailer at {SIDE} x {SIDE} points (CPU time)"),
        Row("numpy.linalg.eigvals, batched, matrices given", eigvals, 1.0, note="measured at a tenth, scaled"),
        compared("coefficients and Lienard-Chipart, whole arrays", median["plain"], eigvals),
        compared("ucrit stability_map", median["blocked"], eigvals, MAP_LIMIT),
        Row(
            f"  agrees with eigenvalues at {agree:,} of {result.stable.size:,} points",
            ok=agree == result.stable.size,
        ),
        Row(f"  stable share {100 * result.share:.2f} %", ok=round(100 * result.share) == 62),
    ]


def _plain(a: tuple[np.ndarray, ...]) -> np.ndarray:
    """The conditions of Lienard and Chipart for a quartic, on whole arrays."""
    third = a[1] * (a[2] * a[3] - a[4] * a[1]) - a[0] * a[3] ** 2
    return (a[0] > 0) & (a[1] > 0) & (a[3] > 0) & (a[4] > 0) & (third > 0)
