"""Where results go: tables and pictures, by the ending of a file's name."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

PICTURES = (".png", ".svg", ".pdf")


def table_or_picture(output: str | None) -> Callable[[Any], None] | None:
    """Return what writes a result to a file, ``None`` where none is named; an unknown ending is refused."""
    from .commands.sweep import writer

    if output is None:
        return None
    return _picture(output) if output.endswith(PICTURES) else writer(output, PICTURES)


def _picture(path: str) -> Callable[[Any], None]:
    def write(result: Any) -> None:
        import io

        from ..analyses.convert import write_whole
        from ..plots import plot

        buffer = io.BytesIO()
        plot(result).savefig(buffer, format=path.rpartition(".")[2])
        write_whole(path, buffer.getvalue())

    return write
