"""Who says so: the sources of vehicles, models, laws and analyses, from their files and descriptions."""

from __future__ import annotations

import ast
import importlib
import inspect
import os
import re
import sys
import tomllib
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from ...catalogue import (
    HERE,
    PUBLISHED,
    controller_names,
    find_controller,
    find_part,
    model_names,
    part_names,
    tire_names,
    vehicle_names,
)
from ...core.contract.model import Model
from ...core.contract.part import Part
from ...core.errors import UcritError, near_match
from ...core.record import Record
from .bibliography import SOFTWARE, Work, works, works_in
from .show import resolve

BRACKETS = re.compile(r"\(([A-Z](?:[^()]|\([^()]*\))*)\)")
"""What stands in brackets and begins with a name; in it there may be brackets once more."""

DATED = re.compile(r"\b(?:18|19|20)\d\d\b|\bSAE (?:paper )?\d{6}\b")
"""A year, or a paper's number: that is what makes it a source."""

NONE = "its description names none"

FOLLOWED = ("ucrit.analyses.", "ucrit.numerics.")
"""Modules whose own sources are those of an analysis that imports them."""


@dataclass(frozen=True)
class Citation:
    """One source.

    Attributes
    ----------
    of
        What rests on it: ``"vehicle caravan"``, ``"model trailer"``, ``"published numbers of trailer"``.
    source
        The source as it is stated there.
    works
        Keys of the works in the bibliography that it names; none for measurements, assumptions, own derivations.
    """

    of: str
    source: str
    works: tuple[str, ...]


@dataclass(frozen=True)
class Citations(Record):
    """What `cite` finds.

    Attributes
    ----------
    citations
        Every source with what rests on it, each once.
    works
        The works that these name, and the package itself.
    """

    citations: tuple[Citation, ...]
    works: tuple[Work, ...]

    def bibtex(self) -> str:
        """Return all works as BibTeX."""
        return "\n\n".join(work.bibtex() for work in self.works) + "\n"

    def to_dict(self) -> dict[str, Any]:
        """Return sources and works as plain data."""
        return {
            "schema": 1,
            "sources": [{"of": c.of, "source": c.source, "works": list(c.works)} for c in self.citations],
            "works": [
                {
                    "key": w.key,
                    "type": w.kind,
                    "author": list(w.author),
                    "title": w.title,
                    **w.fields,
                    "checked": w.checked,
                }
                for w in self.works
            ],
        }

    def __iter__(self) -> Iterator[Citation]:
        return iter(self.citations)

    def __len__(self) -> int:
        return len(self.citations)

    def __str__(self) -> str:
        lines = []
        for of in dict.fromkeys(c.of for c in self.citations):
            lines += [of, *(f"    {c.source}" for c in self.citations if c.of == of)]
        return "\n".join([*lines, "works", *(f"    {work}" for work in self.works)])

    def _repr_html_(self) -> str:
        from ...core import html

        return html.table([(c.of, c.source) for c in self.citations], ("what", "source"), "Sources") + html.table(
            [(w.key, str(w)) for w in self.works], ("work", ""), "Works"
        )


def cite(*subjects: Any) -> Citations:
    """Return the sources of what was used.

    Parameters
    ----------
    *subjects
        Vehicles, models, laws of tires and controllers, or their names, files of vehicles and models; and functions
        of the package or their names (``"critical"``). Without any, the package alone is to be cited.

    Returns
    -------
    Citations
        Of a vehicle its own source, then its model's: its description, the published equations and numbers that it
        is checked against, the laws that it is made of. Of an analysis the sources of its methods.

    Raises
    ------
    UcritError
        If there is nothing of a name.

    Examples
    --------
    >>> found = cite("trailer-undamped-hitch")
    >>> found.citations[0].source
    'Karnopp 2004, section 5.III'
    >>> [work.key for work in found.works]
    ['karnopp-2004', 'ucrit']
    """
    pairs = dict.fromkeys(pair for subject in subjects for pair in _sources(subject))
    found = tuple(Citation(of, source, works_in(source)) for of, source in pairs)
    keys = dict.fromkeys([key for citation in found for key in citation.works] + [SOFTWARE])
    return Citations(found, tuple(works()[key] for key in keys))


def _sources(subject: Any) -> Iterator[tuple[str, str]]:
    """Yield what rests on a source, and the source."""
    found = _found(subject)
    if isinstance(found, Model):
        info = found.info
        yield f"vehicle {Path(info.file).stem or info.name or found.model_id()}", info.source or NONE
        found = type(found)
    if isinstance(found, type) and issubclass(found, Model):
        what, pairs = f"model {found.model_id()}", list(_of_model(found))
    elif isinstance(found, type) and issubclass(found, Part):
        what, pairs = f"law {found.part_id()}", list(_of_law(found))
    else:
        what, pairs = f"analysis {found.__name__}", list(_of_analysis(found))
    yield from pairs or [(what, NONE)]


def _found(subject: Any) -> Any:
    """Return the object that is meant."""
    if isinstance(subject, Part):
        return type(subject)
    subject = os.fspath(subject) if isinstance(subject, os.PathLike) else subject
    if not isinstance(subject, str):
        return _known(subject)
    tire = importlib.import_module("ucrit.parts.tires").Tire
    root = importlib.import_module("ucrit")
    if subject in root._PUBLIC and inspect.isfunction(getattr(root, subject)):
        return inspect.unwrap(getattr(root, subject))
    if subject in controller_names():
        return find_controller(subject)
    if subject in (*part_names(tire), *tire_names()) or subject.lower().endswith(".tir"):
        return find_part(subject, tire)
    known = [*root._PUBLIC, *model_names(), *vehicle_names(), *controller_names(), *part_names(tire), *tire_names()]
    if subject.replace("_", "-") not in known and not re.search(r"[./\\]", subject):
        raise UcritError(f"there is nothing called '{subject}' to cite{near_match(subject, known)}")
    model, vehicle = resolve(subject)
    return model if vehicle is None else vehicle


def _known(subject: Any) -> Any:
    subject = inspect.unwrap(subject) if inspect.isfunction(subject) else subject
    kinds = isinstance(subject, Model) or (isinstance(subject, type) and issubclass(subject, Model | Part))
    if kinds or (inspect.isfunction(subject) and subject.__module__.startswith("ucrit.")):
        return subject
    raise UcritError(f"sources are those of vehicles, models, laws and functions of ucrit, not of {subject!r}")


def stated(text: str) -> list[str]:
    """Return the sources that a description states in brackets, or its first sentence if that names a known work.

    >>> stated("Caster (Karnopp 2004, eq. (8.5); Somieski 1997) on a road of 2000 m (2010).")
    ['Karnopp 2004, eq. (8.5)', 'Somieski 1997']
    """
    plain = " ".join(re.split(r"\n\s*Examples\n\s*-+\n", text)[0].split())
    found = [part.strip() for whole in BRACKETS.findall(plain) if DATED.search(whole) for part in whole.split(";")]
    return found or [first for first in re.split(r"(?<=[a-z]\.) (?=[A-Z])", plain)[:1] if works_in(first)]


def _of_model(model: type[Model]) -> Iterator[tuple[str, str]]:
    name = model.model_id()
    plant, controller = getattr(model, "_plant", None), getattr(model, "_controller", None)
    if plant is not None and controller is not None:
        yield from _of_model(plant)
        yield from _of_model(controller)
        return
    kind = "controller" if "drives" in dir(model) else "model"
    module = sys.modules.get(model.__module__)
    for text in (inspect.getdoc(model) or "", (module and module.__doc__) or ""):
        yield from ((f"{kind} {name}", source) for source in stated(text))
    for value in list(vars(module).values()) if module else []:
        if getattr(value, "__module__", "").startswith("ucrit.parts.") and inspect.isfunction(value):
            yield from ((f"law {value.__name__}", source) for source in stated(value.__doc__ or ""))
    for slot in model.declaration.slots.values():
        yield from _of_law(slot.law)
    yield from _published(model)


def _published(model: type[Model]) -> Iterator[tuple[str, str]]:
    """Yield the sources that the model is checked against."""
    path = PUBLISHED / f"{model.__module__.rpartition('.')[2]}.toml"
    if not (model.__module__.startswith("ucrit.models.") and path.is_file()):
        return
    words = {"numbers": "published numbers", "motion": "further derivation"}
    for table, entries in tomllib.loads(path.read_text(encoding="utf-8")).items():
        for entry in entries:
            yield f"{words.get(table, f'published {table}').replace('_', ' ')} of {model.model_id()}", entry["source"]


def _of_law(law: type[Part]) -> Iterator[tuple[str, str]]:
    name = law.part_id()
    module = sys.modules.get(law.root.__module__)
    for text in (inspect.getdoc(law.root) or "", (module and module.__doc__) or ""):
        yield from ((f"law {name}", source) for source in stated(text))
    if name in tire_names():
        from ...catalogue import tire_file

        told = " ".join(tire_file(name).comments).partition("Source: ")[2]
        yield f"tire {name}", told.partition("Copyright")[0].strip()


def _of_analysis(function: Any) -> Iterator[tuple[str, str]]:
    """Yield the sources that the modules of an analysis state, its own first."""
    for name in _modules(function.__module__):
        for text in _descriptions(name):
            yield from ((f"analysis {function.__name__}", source) for source in stated(text))


@cache
def _modules(first: str) -> tuple[str, ...]:
    """Names of a module and of all that it imports, whenever it does, of those that are followed."""
    found, waiting = dict.fromkeys([first]), [first]
    while waiting:
        for name in _imports(waiting.pop()):
            if name not in found and name.startswith(FOLLOWED) and _path(name).is_file():
                found[name] = None
                waiting.append(name)
    return tuple(found)


def _path(module: str) -> Path:
    base = HERE.joinpath(*module.split(".")[1:])
    return base / "__init__.py" if base.is_dir() else base.with_suffix(".py")


def _imports(module: str) -> Iterable[str]:
    package = module.split(".")[:-1]
    for node in _at_run_time(_tree(module)):
        if isinstance(node, ast.ImportFrom) and node.level:
            base = ".".join([*package[: len(package) + 1 - node.level], *([node.module] if node.module else [])])
            yield base
            yield from (f"{base}.{alias.name}" for alias in node.names)


def _at_run_time(node: ast.AST) -> Iterator[ast.AST]:
    """Yield a node and all in it but what only type checkers read."""
    yield node
    for child in ast.iter_child_nodes(node):
        if not (isinstance(child, ast.If) and isinstance(child.test, ast.Name) and child.test.id == "TYPE_CHECKING"):
            yield from _at_run_time(child)


def _descriptions(module: str) -> Iterator[str]:
    for node in ast.walk(_tree(module)):
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef):
            yield ast.get_docstring(node) or ""


@cache
def _tree(module: str) -> ast.Module:
    return ast.parse(_path(module).read_text(encoding="utf-8"))
