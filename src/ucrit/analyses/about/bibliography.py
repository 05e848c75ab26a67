"""The works that sources name, as data, and as BibTeX."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

from ...catalogue import HERE
from ...core.contract.files import read_text

FILE = HERE / "data" / "bibliography.toml"
SOFTWARE = "ucrit"
"""Key of the package itself."""

KINDS = {
    "article": "article",
    "book": "book",
    "inproceedings": "inproceedings",
    "report": "techreport",
    "software": "misc",
}
"""BibTeX's names for the types of works."""

FIELDS = (
    *("journal", "booktitle", "edition", "publisher", "volume", "number", "pages"),
    *("version", "license", "year", "doi"),
)
SPECIAL = str.maketrans({c: f"\\{c}" for c in "&%#_$"})


@dataclass(frozen=True)
class Work:
    """A publication or a program that others name as a source.

    Attributes
    ----------
    key
        Its name in the bibliography and in BibTeX.
    kind
        ``"article"``, ``"book"``, ``"inproceedings"``, ``"report"`` or ``"software"``.
    author
        Names of all authors.
    title
        As on its title page.
    fields
        Journal, volume, pages, year, DOI and so on, as far as they are known.
    checked
        Whether all that agrees with references to the work in public documents; otherwise it is as commonly cited.
    """

    key: str
    kind: str
    author: tuple[str, ...]
    title: str
    fields: Mapping[str, str]
    checked: bool = False

    def bibtex(self) -> str:
        """Return the work as a BibTeX entry."""
        entries = {"author": " and ".join(map(_whole, self.author)), "title": f"{{{self.title}}}", **self.fields}
        entries |= {"institution": entries.pop("number")} if self.kind == "report" and "number" in entries else {}
        if self.kind == "software":
            extra = [f"{name} {entries.pop(name)}" for name in ("version", "license") if name in entries]
            entries |= {"note": ", ".join(["Computer program", *extra])}
        lines = [f"  {name} = {{{value.translate(SPECIAL)}}}," for name, value in entries.items()]
        return "\n".join([f"@{KINDS[self.kind]}{{{self.key},", *lines, "}"])

    def __str__(self) -> str:
        names = [name for name in FIELDS if name in self.fields and name not in ("version", "license")]
        words = {"edition": "{} edition", "number": "no. {}" if self.kind == "article" else "{}", "doi": "doi:{}"}
        told = [words.get(name, "{}").format(self.fields[name]) for name in names]
        if "version" in self.fields:
            told.append(f"version {self.fields['version']}")
        unsure = "" if self.checked or self.key == SOFTWARE else " (as commonly cited)"
        return f"{', '.join([*self.author, self.title, *told])}{unsure}"


def _whole(author: str) -> str:
    """Keep BibTeX from taking the words of a group's name for first and last names."""
    return f"{{{author}}}" if author.startswith("The ") else author


@cache
def works() -> Mapping[str, Work]:
    """Return all works of the bibliography by key.

    >>> print(works()["karnopp-2004"])
    D. Karnopp, Vehicle Stability, 2004 (as commonly cited)
    """
    return {key: _work(key, entry) for key, entry in _content().items()}


def works_in(source: str) -> tuple[str, ...]:
    """Return the keys of the works that a source names.

    >>> works_in("Karnopp 2004, eq. (5.38)")
    ('karnopp-2004',)
    """
    found = (key for key, entry in _content().items() if any(_names(words, source) for words in entry.get("match", ())))
    return tuple(found)


def _names(words: str, source: str) -> bool:
    return all(word in source for word in words.split())


@cache
def _content() -> Mapping[str, Any]:
    return tomllib.loads(read_text(FILE))


def _work(key: str, entry: Mapping[str, Any]) -> Work:
    fields = {name: str(entry[name]) for name in FIELDS if name in entry}
    if key == SOFTWARE:
        from importlib import import_module

        fields["version"] = import_module("ucrit").__version__
    return Work(key, entry["type"], tuple(entry["author"]), entry["title"], fields, bool(entry.get("checked")))
