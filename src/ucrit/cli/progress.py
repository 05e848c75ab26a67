"""A bar on stderr for what takes longer than a second."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any


@contextmanager
def progress_bar(what: str) -> Iterator[Callable[[int, int], None]]:
    """Yield a function that shows a bar on stderr once the work has taken a second, if that is a terminal."""
    start = time.monotonic()
    bars: list[Any] = []

    def advance(done: int, total: int) -> None:
        if not bars and time.monotonic() - start > 1 and done < total:
            from rich.progress import Progress

            from .terminal import terminal

            bar = Progress(console=terminal(stderr=True), transient=True)
            bars.append((bar, bar.add_task(what, total=total)))
            bar.start()
        for bar, task in bars:
            bar.update(task, completed=done, total=total)

    try:
        yield advance
    finally:
        for bar, _ in bars:
            bar.stop()
