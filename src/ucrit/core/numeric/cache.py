"""Derived facts of a model kept on disk, so that a second start does not derive them again.

A file is named by a fingerprint of everything the result depends on: the model's declarations, the code its
methods reach, and this package's own deriving code. Set ``UCRIT_CACHE`` to choose the folder, or to ``off``.
"""

from __future__ import annotations

import hashlib
import json
import os
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping
from functools import cache
from pathlib import Path
from types import CodeType, FunctionType, ModuleType
from typing import Any

from ..contract.declare import Quantity
from ..contract.model import Model
from ..contract.part import Slot

PACKAGE = Path(__file__).resolve().parents[2]
DERIVING = ("core", "numerics", "bondgraph", "analyses")
_memory: dict[tuple[type[Model], str], Any] = {}


def cached(model: type[Model], piece: str, compute: Callable[[], Any]) -> Any:
    """Return the JSON-like value of ``compute()``, from memory or disk where it was computed before.

    An unreadable or unwritable folder costs time only, never the answer.
    """
    key = (model, piece)
    if key not in _memory:
        path = _file(model, piece)
        value = _read(path)
        if value is None:
            value = json.loads(json.dumps(compute()))
            _write(path, value)
        _memory[key] = value
    return _memory[key]


def folder() -> Path | None:
    """Folder of the cache, ``None`` when it is switched off."""
    chosen = os.environ.get("UCRIT_CACHE", "")
    if chosen == "off":
        return None
    if chosen:
        return Path(chosen)
    from platformdirs import user_cache_path

    return user_cache_path("ucrit", appauthor=False)


def _file(model: type[Model], piece: str) -> Path | None:
    base = folder()
    return base and base / f"{model.__name__}-{piece}-{fingerprint(model)[:24]}.json"


def _read(path: Path | None) -> Any:
    try:
        return None if path is None else json.loads(path.read_bytes())
    except (OSError, ValueError):
        return None


def _write(path: Path | None, value: Any) -> None:
    if path is None:
        return
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.NamedTemporaryFile("w", dir=path.parent, delete=False, suffix=".tmp") as file:
            json.dump(value, file)
        os.replace(file.name, path)
    except OSError:
        return


def fingerprint(model: type[Model]) -> str:
    """Return a hash of all that the derived facts of a model depend on."""
    found: str = _fingerprint(model)
    return found


def _hash_of(model: type[Model]) -> str:
    digest = hashlib.sha256(repr((sys.version_info[:2], model.__qualname__)).encode())
    for stamp in _package_stamps():
        digest.update(repr(stamp).encode())
    for piece in _class_pieces(model, set()):
        digest.update(piece.encode())
    return digest.hexdigest()


_fingerprint: Any = cache(_hash_of)


@cache
def _package_stamps() -> list[tuple[str, int, int]]:
    files = (e for part in DERIVING for e in _files(os.fspath(PACKAGE / part)))
    stats = [(os.path.relpath(e.path, PACKAGE), e.stat()) for e in files if e.name.endswith(".py")]
    return sorted((name, stat.st_size, stat.st_mtime_ns) for name, stat in stats)


def _files(folder: str) -> Iterator[os.DirEntry[str]]:
    """Return the files of a folder and of those in it."""
    for entry in os.scandir(folder):
        if entry.is_dir():
            yield from _files(entry.path)
        else:
            yield entry


def _class_pieces(cls: type, seen: set[int]) -> Iterator[str]:
    for base in cls.__mro__:
        if base in (Model, object):
            continue
        for name, value in vars(base).items():
            if not (name.startswith("__") and name.endswith("__")) or name in ("__init__", "__call__"):
                yield name
                yield from _pieces(value, seen)


def _pieces(value: Any, seen: set[int]) -> Iterator[str]:
    value = getattr(value, "__func__", getattr(value, "fget", value))
    if isinstance(value, Quantity | int | float | str | bool | tuple | None):
        yield repr(value)
    elif isinstance(value, Slot):
        yield repr((value.name, value.meaning))
        yield from _pieces(value.law, seen)
    elif isinstance(value, Mapping):
        yield repr(sorted(value.items(), key=repr))
    elif id(value) in seen or _is_stamped(value):
        return
    elif isinstance(value, FunctionType):
        seen.add(id(value))
        yield from _code_pieces(value.__code__)
        yield repr(value.__defaults__)
        for cell in value.__closure__ or ():
            yield from _pieces(cell.cell_contents, seen)
        yield from _global_pieces(value, seen)
    elif isinstance(value, type):
        seen.add(id(value))
        yield from _class_pieces(value, seen)
    else:
        yield type(value).__name__


def _is_stamped(value: Any) -> bool:
    """Tell whether the code of a function or class is part of the package's own that is stamped as a whole."""
    place = (getattr(value, "__module__", None) or "").split(".")
    return place[0] == __name__.partition(".")[0] and len(place) > 1 and place[1] in DERIVING


def _global_pieces(function: FunctionType, seen: set[int]) -> Iterator[str]:
    names = set(_names(function.__code__))
    for name in sorted(names & function.__globals__.keys()):
        value = function.__globals__[name]
        if isinstance(value, ModuleType):
            for inner in sorted(names & vars(value).keys()):
                if isinstance(vars(value)[inner], FunctionType | type | int | float):
                    yield from _pieces(vars(value)[inner], seen)
        else:
            yield from _pieces(value, seen)


def _names(code: CodeType) -> Iterator[str]:
    yield from code.co_names
    for const in code.co_consts:
        if isinstance(const, CodeType):
            yield from _names(const)


def _code_pieces(code: CodeType) -> Iterator[str]:
    yield code.co_code.hex()
    yield repr((code.co_names, code.co_varnames))
    for const in code.co_consts:
        if isinstance(const, CodeType):
            yield from _code_pieces(const)
        else:
            yield repr(const)
