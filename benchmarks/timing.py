"""Interleaved timing and the lines of the table."""

from __future__ import annotations

import gc
import os
import statistics
import textwrap
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

WIDTH = 79
NAME = 40
"""Columns of a line, and of what it tells of."""


@dataclass(frozen=True)
class Row:
    """One line: what, seconds, ratio to what it is compared with, limit of that ratio, whether kept; a note below."""

    what: str
    seconds: float | None = None
    ratio: float | None = None
    limit: float | None = None
    ok: bool | None = None
    note: str = ""

    def __str__(self) -> str:
        mark = {True: "ok", False: "MISSED", None: ""}[self.ok]
        notes = [_wrapped(self.note, 4)] if self.note else []
        if self.seconds is None and self.ratio is None:
            return "\n".join([_wrapped(f"{self.what} {mark}".rstrip(), 0), *notes])
        seconds = "" if self.seconds is None else f"{self.seconds * 1e3:.2f} ms"
        ratio = "" if self.ratio is None else _ratio(self.ratio)
        limit = "" if self.limit is None else f"({_ratio(self.limit)})"
        numbers = f"{seconds:>13}{ratio:>9}{limit:>9} {mark}".rstrip()
        *above, last = _wrapped(self.what, 2, NAME).split("\n")
        return "\n".join([*above, f"{last:<{NAME}}{numbers}", *notes])


def _wrapped(text: str, indent: int, width: int = WIDTH) -> str:
    """Indent a text, and break it where it gets too long, further lines by two more; a first empty line is kept."""
    blank, text = ("\n", text[1:]) if text.startswith("\n") else ("", text)
    indent += len(text) - len(text.lstrip())
    return blank + textwrap.fill(text.strip(), width, initial_indent=" " * indent, subsequent_indent=" " * (indent + 2))


def _ratio(value: float) -> str:
    return f"1/{1 / value:.0f}" if value < 0.2 else f"{value:.2f} x"


def load() -> str:
    """Return how busy this machine is, with others' work too."""
    if not hasattr(os, "getloadavg"):
        return ""
    return f"load average {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores"


def compared(what: str, seconds: float, base: float, limit: float | None = None, note: str = "") -> Row:
    """Return a line with the ratio to a base, and whether it is at most the limit."""
    ratio = seconds / base
    return Row(what, seconds, ratio, limit, None if limit is None else ratio <= limit, note)


def interleaved(
    candidates: Mapping[str, Callable[[], Any]], rounds: int, clock: Callable[[], float] = time.process_time
) -> dict[str, float]:
    """Return the median time of each candidate, all of them called in turn, after one unmeasured round."""
    times: dict[str, list[float]] = {name: [] for name in candidates}
    for round_ in range(rounds + 1):
        for name, call in candidates.items():
            gc.collect()
            start = clock()
            call()
            if round_:
                times[name].append(clock() - start)
    return {name: statistics.median(values) for name, values in times.items()}
