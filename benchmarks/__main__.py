"""How fast is it beside the usual way? Run ``python -m benchmarks``; exit status 1 where a limit is missed.

Everything is measured side by side in one run, the candidates in turn (A B A B ...), so that a machine that
slows down slows all of them; ratios of medians count. Kernels are timed in CPU time, processes by the clock.
"""

from __future__ import annotations

import sys

from benchmarks import explorer, kernels, startup
from benchmarks.timing import Row


def main() -> int:
    """Measure, print a table, and return 0 if every limit is kept."""
    rows: list[Row] = []
    for measure in (kernels.bandwidth, kernels.speeds, kernels.plane, startup.processes, explorer.latency):
        found = measure()
        rows += found
        for row in found:
            print(row, flush=True)
    missed = [row for row in rows if row.ok is False]
    print(f"\n{len(missed)} limit{'s' if len(missed) != 1 else ''} missed" if missed else "\nall limits kept")
    for row in missed:
        print(f"  {row.what}")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
