"""Interleaved timing and the lines of the table."""

from __future__ import annotations

import gc
import statistics
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Row:
    """One line: what, seconds, ratio to what it is compared with, limit of that ratio, whether kept."""

    what: str
    seconds: float | None = None
    ratio: float | None = None
    limit: float | None = None
    ok: bool | None = None
    note: str = ""

    def __str__(self) -> str:
        if self.seconds is None and self.ratio is None:
            mark = {True: "ok", False: "MISSED", None: ""}[self.ok]
            return f"{self.what:<66}{self.note} {mark}".rstrip()
        seconds = "" if self.seconds is None else f"{self.seconds * 1e3:10.2f} ms"
        ratio = "" if self.ratio is None else f"{_ratio(self.ratio):>10}"
        limit = "" if self.limit is None else f"  (limit {_ratio(self.limit)})"
        mark = {True: "  ok", False: "  MISSED", None: ""}[self.ok]
        return f"  {self.what:<62}{seconds}{ratio}{limit}{mark}  {self.note}".rstrip()


def _ratio(value: float) -> str:
    return f"1/{1 / value:.0f}" if value < 0.2 else f"{value:.2f} x"


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
