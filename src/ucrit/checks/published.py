"""Files of published equations and numbers: TOML tables, each entry with its source."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..core.contract.files import parse_toml, read_text
from ..core.errors import UcritError, near_match
from ..core.formulas.expressions import parse

#: Keys of every table: those it must have and those it may have.
TABLES: Mapping[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "polynomial": (("coefficients",), ("direction",)),
    "matrices": (("P_0",), ("P_1", "P_2", "Q", "direction")),
    "state_matrix": (("A",), ("B", "direction")),
    "transfer": (("input", "output", "numerator", "denominator"), ("direction",)),
    "motion": (("equations",), ("outputs",)),
    "critical": (("parameter", "expression"), ("power", "direction")),
    "criterion": (("expression",), ("direction",)),
    "numbers": (("eigenvalues", "tolerance"), ("vehicle", "parameters")),
}
COMMON = ("source", "note", "let")


@dataclass(frozen=True)
class Entry:
    """One published statement about a model; ``where`` names it in messages."""

    where: str
    source: str
    content: Mapping[str, Any]

    @property
    def direction(self) -> int:
        """Sign of the speed that the statement is made for, 0 for either."""
        return int(self.content.get("direction", 1))

    def formulas(self, formulas: Any, names: Mapping[str, Any]) -> Any:
        """Return formulas, in the nested lists they are given in, as expressions."""
        known = dict(names)
        for name, formula in self.content.get("let", {}).items():
            known[name] = parse(formula, known, self.where)
        return self._nested(formulas, known)

    def _nested(self, formulas: Any, names: Mapping[str, Any]) -> Any:
        if isinstance(formulas, list):
            return [self._nested(formula, names) for formula in formulas]
        return parse(formulas, names, self.where)


def agree(entries: Sequence[Any], one: str, many: str = "") -> str:
    """Say how many published things agree.

    >>> agree([1], "criterion", "criteria"), agree([1, 2], "polynomial")
    ('1 published criterion agrees', '2 published polynomials agree')
    """
    if len(entries) == 1:
        return f"1 published {one} agrees"
    return f"{len(entries)} published {many or one + 's'} agree"


def read_published(path: Path) -> dict[str, list[Entry]]:
    """Return the entries of a file of published equations and numbers, by table.

    Raises
    ------
    UcritError
        One sentence about the first thing that is wrong; nothing is ignored.
    """
    content = parse_toml(read_text(path), path.name)
    if not content:
        raise UcritError(f"{path.name}: there is nothing to compare with; write a table such as [[polynomial]]")
    entries: dict[str, list[Entry]] = {}
    for table, items in content.items():
        if table not in TABLES:
            raise UcritError(f"{path.name}: there is no table '{table}'{near_match(table, TABLES)}")
        if not isinstance(items, list):
            raise UcritError(f"{path.name}: write the table as [[{table}]]")
        entries[table] = [_entry(f"{path.name}: {table} {i}", table, item) for i, item in enumerate(items, 1)]
    return entries


def _entry(where: str, table: str, item: Mapping[str, Any]) -> Entry:
    required, optional = TABLES[table]
    for key in item:
        if key not in (*required, *optional, *COMMON):
            raise UcritError(f"{where}: there is no key '{key}'{near_match(key, (*required, *optional, *COMMON))}")
    for key in ("source", *required):
        if key not in item:
            raise UcritError(f"{where}: the key '{key}' is missing")
    if item.get("direction", 1) not in (-1, 0, 1):
        raise UcritError(f"{where}: direction must be 1, -1 or 0 for either, got {item['direction']!r}")
    return Entry(f"{where} ({item['source']})", str(item["source"]), item)
