"""Models by name, from Python files and from bond graphs."""

from __future__ import annotations

import importlib
import importlib.util
import os
from functools import cache
from pathlib import Path
from types import ModuleType

from ..core.contract.files import read_text
from ..core.contract.model import Model
from ..core.errors import ModelError, UcritError, near_match
from .places import BONDS, HERE


@cache
def model_names() -> tuple[str, ...]:
    """Names of all models in the catalogue.

    >>> "trailer" in model_names()
    True
    """
    stems = (e.name[:-3] for e in os.scandir(HERE / "models") if e.name.endswith(".py"))
    return tuple(sorted(stem.replace("_", "-") for stem in stems if not stem.startswith("_")))


def find_model(name: str, folder: Path | None = None) -> type[Model]:
    """Return a model class by its catalogue name, from a Python file or from a bond graph's (``"my_graph.bonds"``).

    Of several models in a file ``"my_model.py:Caster"`` picks one; without that it is the one that derives from the
    others, if there is such a one. Relative paths start at ``folder``.
    """
    path, _, cls = name.partition(":") if ".py" in name else (name, "", "")
    if path.endswith(BONDS):
        return model_from_file((folder or Path()) / path, path)
    if path.endswith(".py"):
        return _from_file((folder or Path()) / path, cls)
    key = name.replace("_", "-")
    if key not in model_names():
        raise UcritError(f"there is no model '{name}'{near_match(name, model_names())}")
    module = importlib.import_module(f"ucrit.models.{key.replace('-', '_')}")
    return models_in(module)[0]


def model_from_file(path: Path, where: str) -> type[Model]:
    """Return the model that a bond graph's text file describes; ``where`` names it in messages."""
    return graph_model(read_text(path), path.stem, where)


def graph_model(text: str, name: str, where: str) -> type[Model]:
    """Return the model that a bond graph's text describes, under a name."""
    from ..bondgraph.model import model_from_text

    return model_from_text(text, name, where)


def models_in(module: ModuleType, where: str = "") -> list[type[Model]]:
    """Return the model classes that a module itself defines, last one last; ``where`` names it in messages."""
    found = [
        value
        for value in vars(module).values()
        if isinstance(value, type) and issubclass(value, Model) and value.__module__ == module.__name__
    ]
    if not found:
        raise ModelError(f"'{where or module.__name__}' defines no model: a class derived from ucrit.Model is needed")
    return found


def models_in_file(path: Path) -> list[type[Model]]:
    """Return the model classes of a Python file, which is run for it."""
    read_text(path)
    spec = importlib.util.spec_from_file_location(path.stem, path)
    if spec is None or spec.loader is None:
        raise UcritError(f"'{path}' is not a Python file")
    module = importlib.util.module_from_spec(spec)
    try:
        spec.loader.exec_module(module)
    except UcritError:
        raise
    except (Exception, SystemExit) as error:  # a script's sys.exit() is no reason to end
        line = getattr(error, "lineno", None) or _line_in(error, path)
        at = f" in line {line}" if line else ""
        told = f"{type(error).__name__}: {error}"
        if isinstance(error, ImportError) and "relative import" in told:
            told += "; in a file of one's own write 'from ucrit.core import ...'"
        raise ModelError(f"'{path}' cannot be run{at}: {told}") from None
    return models_in(module, str(path))


def _from_file(path: Path, cls: str) -> type[Model]:
    models = {model.__name__: model for model in models_in_file(path)}
    if not cls:
        last = [m for m in models.values() if not any(m in other.__mro__[1:] for other in models.values())]
        if len(last) > 1:
            names = ", ".join(m.__name__ for m in last)
            raise UcritError(f"'{path}' holds {len(last)} models, {names}: pick one, '{path}:{last[-1].__name__}'")
        return last[0]
    if cls not in models:
        raise UcritError(f"'{path}' has no model '{cls}'{near_match(cls, models)}")
    return models[cls]


def _line_in(error: BaseException, path: Path) -> int | None:
    lines, trace = [], error.__traceback__
    while trace is not None:
        if trace.tb_frame.f_code.co_filename == os.path.abspath(path):
            lines.append(trace.tb_lineno)
        trace = trace.tb_next
    return lines[-1] if lines else None
