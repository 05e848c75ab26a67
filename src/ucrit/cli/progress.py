"""A bar on stderr for work that takes longer than a second, on a terminal only."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any


@contextmanager
def progress(name: str) -> Iterator[Callable[[float, float], None]]:
    """Yield a function that is told how much is done of how much, and shows a bar once a second has passed."""
    start = time.monotonic()
    bars: list[Any] = []

    def advance(done: float, total: float) -> None:
        if not bars and time.monotonic() - start > 1 and done < total and sys.stderr.isatty():
            from rich.progress import Progress

            from .terminal import terminal

            bar = Progress(console=terminal(stderr=True), transient=True)
            bars.append((bar, bar.add_task(name, total=total)))
            bar.start()
        for bar, task in bars:
            bar.update(task, completed=done, total=total)

    try:
        yield advance
    finally:
        for bar, _ in bars:
            bar.stop()
