"""Files that commands write: tables and pictures, each of them whole or not at all."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from typing import Any

import click

TABLES = {".csv": "to_csv", ".nc": "to_netcdf", ".json": "to_json", ".mat": "to_mat"}
PICTURES = (".png", ".svg", ".pdf")

Write = Callable[[Any], None]

json_option = click.option("--json", "as_json", is_flag=True, help="Print plain data (JSON) and nothing else.")
"""The option of every command that answers; `print_json` is what it does."""


def print_json(answer: Any) -> None:
    """Print a result, or a dictionary, as one object of strict JSON; tables, which may be long, in one line."""
    import json

    content = answer if isinstance(answer, dict) else answer.to_dict()
    indent = None if "variables" in content and "coordinates" in content else 2
    click.echo(json.dumps(content, indent=indent, allow_nan=False, ensure_ascii=False))


def written(path: str) -> None:
    """Say where a result has been written."""
    print(f"Written to {path}")


def writer(path: str, *, pictures: tuple[str, ...] = PICTURES, more: Mapping[str, Write] | None = None) -> Write:
    """Return what writes a result into a file; an ending that is not known is refused before anything is computed.

    ``more`` holds endings beyond tables and pictures, and what writes them.
    """
    from ..core.errors import UcritError

    ending = path[path.rfind(".") :].lower() if "." in path else ""
    if more and ending in more:
        return more[ending]
    if ending in TABLES:
        return lambda result: getattr(result, TABLES[ending])(path)
    if ending in pictures:
        return lambda result: write_picture(result, path)
    known = ", ".join((*TABLES, *pictures, *(more or ())))
    raise UcritError(f"the output '{path}' must end in {known}")


def write_picture(result: Any, path: str) -> None:
    """Draw a result into a file."""
    from ..plots import plot

    save(plot(result), path)


def save(figure: Any, path: str) -> None:
    """Write a figure into a file."""
    import io

    from ..analyses.results.convert import write_whole

    content = io.BytesIO()
    figure.savefig(content, format=path.rpartition(".")[2].lower(), dpi=150)
    write_whole(path, content.getvalue())


def to_stdout(result: Any) -> None:
    """Print a result as CSV."""
    import csv

    columns = list(result.table().columns())
    rows = csv.writer(sys.stdout, lineterminator="\n")
    rows.writerow([f"{name} [{unit}]" if unit else name for name, unit, _ in columns])
    rows.writerows(zip(*(values.tolist() for _, _, values in columns), strict=True))
