"""Measured inputs: columns with units from a CSV file."""

from __future__ import annotations

import csv
import math
import os
import re
from pathlib import Path

from ...core.contract.files import read_text
from ...core.errors import UcritError, near_match
from ...core.units import to_si

_HEAD = re.compile(r"^(.+?)\s*\[\s*(.+?)\s*\]$")


def read_columns(path: str | os.PathLike[str], name: str, unit: str) -> tuple[list[float], list[float]]:
    """Return times [s] and the values of one column [``unit``, SI] of a CSV file.

    Parameters
    ----------
    path
        A file whose first line heads columns by ``name [unit]``, one of them ``time [s]``; empty lines and lines that
        begin with ``#`` are skipped.
    name
        The column.
    unit
        Unit that its values shall have.

    Raises
    ------
    UcritError
        One sentence about the first thing that is wrong.
    """
    where = f"'{path}'"
    numbered = list(enumerate(csv.reader(read_text(Path(path)).lstrip("\ufeff").splitlines()), 1))
    kept = [(n, row) for n, row in numbered if any(map(str.strip, row)) and not row[0].lstrip().startswith("#")]
    if len(kept) < 3:
        raise UcritError(f"{where} needs a line of names and at least two lines of numbers, got {len(kept)} lines")
    lines, rows = [n for n, _ in kept[1:]], [row for _, row in kept]
    heads = [_head(cell, where) for cell in rows[0]]
    names = [head for head, _ in heads]
    if len(set(names)) < len(names):
        raise UcritError(f"{where} heads two columns alike: {', '.join(names)}")
    if len(names) == 1 and ";" in kept[0][1][0]:
        raise UcritError(f"{where} must have columns parted by commas and decimal points, got semicolons")
    for wanted in ("time", name):
        if wanted not in names:
            raise UcritError(f"{where} has no column '{wanted}'{near_match(wanted, names)}")
    for number, row in zip(lines, rows[1:], strict=True):
        if len(row) != len(names):
            raise UcritError(f"{where}, line {number}: {len(names)} columns are headed, got {len(row)}")
    at, column = names.index("time"), names.index(name)
    times = _values({n: row[at] for n, row in kept[1:]}, heads[at][1], "s", f"{where}, time")
    values = _values({n: row[column] for n, row in kept[1:]}, heads[column][1], unit, f"{where}, {name}")
    late = next((i for i in range(1, len(times)) if times[i] <= times[i - 1]), None)
    if late is not None:
        raise UcritError(
            f"{where}, line {lines[late]}: times must ascend, got {times[late]:g} s after {times[late - 1]:g} s"
        )
    return times, values


def _head(cell: str, where: str) -> tuple[str, str]:
    match = _HEAD.match(cell.strip())
    if match is None:
        raise UcritError(f"{where}: a column is headed by its name and unit, such as 'time [s]', got {cell.strip()!r}")
    return match[1], match[2]


def _values(cells: dict[int, str], given: str, unit: str, thing: str) -> list[float]:
    """Return a column in SI units; units are converted by two points, so that degrees Celsius would do too."""
    text = "" if given == "1" else f" {given}"
    zero, one = (to_si(f"{n}{text}", unit, thing) for n in (0, 1))
    numbers = []
    for line, cell in cells.items():
        try:
            number = float(cell)
        except ValueError:
            number = math.nan
        if not math.isfinite(number):
            raise UcritError(f"{thing}, line {line}: a finite number is needed, got {cell.strip()!r}")
        numbers.append(zero + (one - zero) * number)
    return numbers
