"""One self-contained page about one vehicle."""

from .write import render, write_report

__all__ = ["render", "write_report"]
