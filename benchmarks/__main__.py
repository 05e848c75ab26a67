"""How fast is it beside the usual way? Run ``python -m benchmarks``; exit status 1 where a limit is missed.

Everything is measured side by side in one run, the candidates in turn (A B A B ...), so that a machine that
slows down slows all of them; ratios of medians count. Kernels are timed in CPU time, processes by the clock.
Columns: time, ratio to the first line of a part, the limit of that ratio in brackets. Name some of the parts to measure
only those; ``--device`` adds the GPU, and says so in a line where there is none.
"""

from __future__ import annotations

import sys

from benchmarks import bicycle, device, explorer, kernels, maps, startup
from benchmarks.timing import Row, load

PARTS = {
    "bandwidth": kernels.bandwidth,
    "speeds": kernels.speeds,
    "plane": kernels.plane,
    "maps": maps.large,
    "generic": maps.generic,
    "boundary": maps.curves,
    "bicycle": bicycle.speeds,
    "startup": startup.processes,
    "explorer": explorer.latency,
}


def main() -> int:
    """Measure, print a table, and return 0 if every limit is kept."""
    asked = [part for part in sys.argv[1:] if part != "--device"]
    if unknown := set(asked) - PARTS.keys():
        print(f"there is no part {', '.join(sorted(unknown))}; allowed: --device, {', '.join(PARTS)}", file=sys.stderr)
        return 2
    print(f"ucrit benchmarks, {load()}")
    rows: list[Row] = []
    measures = [PARTS[part] for part in asked or PARTS]
    for measure in (*measures, *([device.measured, device.counted] if "--device" in sys.argv[1:] else [])):
        found = measure()
        rows += found
        for row in found:
            print(row, flush=True)
    missed = [row for row in rows if row.ok is False]
    print(f"\nAt the end: {load()}")
    print(f"{len(missed)} limit{'s' if len(missed) != 1 else ''} missed" if missed else "all limits kept")
    for row in missed:
        print(f"  {row.what.strip()}")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
