"""Whole processes, from the start of Python to its end, beside one that only imports NumPy."""

from __future__ import annotations

import subprocess
import sys
import time
from pathlib import Path

from benchmarks.timing import Row, compared, interleaved

ROUNDS = 11
UCRIT = str(Path(sys.executable).with_name("ucrit"))

LIMITS = {
    "import ucrit": ([sys.executable, "-c", "import ucrit"], 1.5),
    "ucrit --help": ([UCRIT, "--help"], 1.5),
    "ucrit analyze caravan, derived before": ([UCRIT, "analyze", "caravan"], 4.0),
}


def processes() -> list[Row]:
    """Time the commands; one that fails is reported with what it said last, and counts as missed."""
    commands = {"import numpy": [sys.executable, "-c", "import numpy"]}
    rows = [Row("\nWhole processes, by the clock")]
    broken = []
    for name, (command, _) in LIMITS.items():
        if reason := _failure(command):
            broken.append(Row(f"  {name} fails: {reason}", ok=False))
        else:
            commands[name] = command
    median = interleaved(
        {name: lambda command=command: _run(command) for name, command in commands.items()},
        ROUNDS,
        time.perf_counter,
    )
    base = median.pop("import numpy")
    rows.append(Row("python -c 'import numpy'", base, 1.0))
    rows += [compared(name, seconds, base, LIMITS[name][1]) for name, seconds in median.items()]
    return rows + broken


def _failure(command: list[str]) -> str:
    """Return why a command cannot be timed; an exit status of 1 is an answer (unstable), not a failure."""
    try:
        done = _run(command)
    except OSError as error:
        return str(error)
    if done.returncode in (0, 1) and "Traceback" not in done.stderr:
        return ""
    said = (done.stderr.strip() or "nothing").splitlines()[-1]
    return f"exit status {done.returncode}, {said}"


def _run(command: list[str]) -> subprocess.CompletedProcess[str]:
    return subprocess.run(command, capture_output=True, text=True, check=False)
