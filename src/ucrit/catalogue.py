"""The catalogue: every model file and every vehicle file that is shipped, found by looking into their folders."""

from __future__ import annotations

import importlib
import importlib.util
import json
import os
import pkgutil
from collections.abc import Mapping
from functools import cache, partial
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any

from .core.errors import ModelError, UcritError, near_match
from .core.files import Find, parse_vehicle, read_text
from .core.model import Model
from .core.part import Part

if TYPE_CHECKING:
    from .control import Controller

HERE = Path(__file__).resolve().parent
VEHICLES = HERE / "data" / "vehicles"
BONDS = ".bonds"
"""Ending of files that hold a bond graph as text."""
PUBLISHED = HERE / "data" / "published"
TIRES = HERE / "data" / "tires"


@cache
def model_names() -> tuple[str, ...]:
    """Names of all models in the catalogue.

    >>> "trailer" in model_names()
    True
    """
    stems = (e.name[:-3] for e in os.scandir(HERE / "models") if e.name.endswith(".py"))
    return tuple(sorted(stem.replace("_", "-") for stem in stems if not stem.startswith("_")))


@cache
def vehicle_names() -> tuple[str, ...]:
    """Names of all vehicles that are shipped.

    >>> "caravan" in vehicle_names()
    True
    """
    return tuple(sorted(e.name[:-5] for e in os.scandir(VEHICLES) if e.name.endswith(".toml")))


def find_model(name: str, folder: Path | None = None) -> type[Model]:
    """Return a model class by its catalogue name, from a Python file or from a bond graph's (``"my_graph.bonds"``).

    A file may hold several models: ``"my_model.py:Caster"`` picks one. Relative paths start at ``folder``.
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
    from .bondgraph.model import model_from_text

    return model_from_text(text, name, where)


def part_names(kind: type[Part]) -> tuple[str, ...]:
    """Names of all laws in the catalogue that are of a kind."""
    return tuple(sorted(_laws(kind)))


def find_part(name: str, kind: type[Part], folder: Path | None = None) -> type[Part]:
    """Return the law of a name that is of the kind which a slot takes.

    A tire may also be a property file (``"mine.tir"``) or one that is shipped, without the shifts of the one tire that
    was measured, or with them (``"mine.tir:measured"``), and with switches (``"mine.tir:SLIP=angle"``). Relative paths
    start at ``folder``.
    """
    laws = _laws(kind)
    if name in laws:
        return laws[name]
    shipped: tuple[str, ...] = ()
    if kind.__name__ == "Tire":
        shipped, (file, switches) = tire_names(), tire_switches(name)
        if file.lower().endswith(".tir") or file in shipped:
            law: type[Part] = tire_file(file, folder).law(**switches)
            return law
    raise UcritError(f"there is no {kind.__name__.lower()} law '{name}'{near_match(name, [*laws, *shipped])}")


def tire_names() -> tuple[str, ...]:
    """Names of all tires that are shipped as property files.

    >>> "pacejka-205-60r15" in tire_names()
    True
    """
    return tuple(sorted(e.name[:-4] for e in os.scandir(TIRES) if e.name.endswith(".tir")))


def tire_switches(name: str) -> tuple[str, dict[str, Any]]:
    """Split a tire's name into that of its file and the switches behind it, colons between them.

    >>> tire_switches("mine.tir:measured:SLIP=angle")
    ('mine.tir', {'symmetric': False, 'SLIP': 'angle'})
    """
    split: Any = importlib.import_module("ucrit.parts.tires.tir").split_name
    found: tuple[str, dict[str, Any]] = split(name)
    return found


def tire_file(name: str, folder: Path | None = None) -> Any:
    """Read a tire property file, shipped by its name or any by its path: a `ucrit.parts.tires.tir.TirFile`."""
    read_tir: Any = importlib.import_module("ucrit.parts.tires.tir").read_tir
    if name in tire_names():
        return read_tir(TIRES / f"{name}.tir", name)
    return read_tir((folder or Path()) / name, name)


def tire(name: str, **parameters: Any) -> Any:
    """Return a tire: a law of the catalogue with its parameters, or a property file's.

    Parameters
    ----------
    name
        Name of a law (``"brush"``), of a shipped tire (``"pacejka-205-60r15"``), or the path of a ``.tir`` file; with
        ``:measured`` behind it, a file's tire keeps the shifts of the one that was measured, and with ``:SLIP=angle``
        it has a switch of `ucrit.parts.tires.magic_formula` in another place.
    parameters
        Values [SI, or text with a unit] of the law's parameters.

    Returns
    -------
    ucrit.parts.tires.Tire

    Raises
    ------
    UcritError
        If there is no such law or file, or a value is impossible.

    Examples
    --------
    >>> round(float(tire("pacejka-205-60r15:measured").side_force(4000, 0.05)), 3)
    -2084.607
    >>> round(float(tire("brush", C="1 kN/deg", mu=0.3).side_force(4000, 0.05)), 1)
    -1189.9
    """
    if not isinstance(name, str):
        raise UcritError(f"a tire is told by its name or file, got {type(name).__name__}")
    kind: type[Part] = importlib.import_module("ucrit.parts.tires").Tire
    return find_part(name, kind)(**parameters)


def read_vehicle(text: str, where: str, changes: Mapping[str, Any] | None = None) -> Model:
    """Return the vehicle that the text of a vehicle file describes, reading nothing else from the disk.

    Models, laws and tires of the catalogue only: whoever wrote the text need not be who owns the machine.

    Parameters
    ----------
    text
        Content of a vehicle file (TOML).
    where
        Name of the text, for messages.
    changes
        Parameter values [SI, or text with a unit] that replace those of the text.

    Raises
    ------
    UcritError
        If the text is wrong, or names a file: a model of one's own, a bond graph, tire properties.

    Examples
    --------
    >>> read_vehicle('model = "/home/me/mine.py"\\n[parameters]', "pasted text")
    Traceback (most recent call last):
    ucrit.core.errors.UcritError: pasted text: '/home/me/mine.py' is a file; name a model of the catalogue here
    """

    def model(name: str) -> type[Model]:
        if name.replace("_", "-") not in model_names() and ("." in name or "/" in name):
            raise UcritError(f"'{name}' is a file; name a model of the catalogue here")
        return find_model(name)

    def part(name: str, kind: type[Part]) -> type[Part]:
        if ".tir" in name.lower():
            raise UcritError(f"'{name}' is a file; name a law or a tire of the catalogue here")
        return find_part(name, kind)

    return parse_vehicle(text, where, Find(model, part, controlled, graph_model), changes)


def _laws(kind: type[Part]) -> dict[str, type[Part]]:
    """Find the laws of a kind: the module of its base, and the modules beside it in its package."""
    package = importlib.import_module(kind.__module__.rpartition(".")[0])
    modules = (importlib.import_module(f"{package.__name__}.{m.name}") for m in pkgutil.iter_modules(package.__path__))
    found = (value for module in modules for value in vars(module).values() if isinstance(value, type))
    return {law.part_id(): law for law in found if issubclass(law, kind) and law is not kind}


@cache
def controller_names() -> tuple[str, ...]:
    """Names of all controllers in the catalogue.

    >>> "lean-by-front-steering" in controller_names()
    True
    """
    stems = (e.name[:-3] for e in os.scandir(HERE / "control" / "laws") if e.name.endswith(".py"))
    return tuple(sorted(stem.replace("_", "-") for stem in stems if not stem.startswith("_")))


def find_controller(name: str) -> type[Controller]:
    """Return a controller's class by its catalogue name."""
    from .control import Controller

    key = name.replace("_", "-")
    if key not in controller_names():
        raise UcritError(f"there is no controller '{name}'{near_match(name, controller_names())}")
    module = importlib.import_module(f"ucrit.control.laws.{key.replace('-', '_')}")
    found = models_in(module)[-1]
    assert issubclass(found, Controller)
    return found


def controlled(model: type[Model], controllers: tuple[str, ...]) -> type[Model]:
    """Return a model under the control of controllers: names of the catalogue, or makers with arguments.

    Makers are those of `ucrit.control.MAKERS`: ``"lag(delta_f)"``, ``"state-feedback(delta_f, delta_r)"``. Each is made
    for the model and the controllers before it.
    """
    if not controllers:
        return model
    from .control import closed

    for name in controllers:
        model = closed(model, _controller(name, model))
    return model


def _controller(name: str, model: type[Model]) -> type[Controller]:
    """Return a controller by name, or the one that a maker makes for a model."""
    maker, bracket, rest = name.partition("(")
    if not bracket:
        return find_controller(name)
    from .control import MAKERS

    key = maker.strip().replace("_", "-")
    if key not in MAKERS or not rest.rstrip().endswith(")"):
        known = ", ".join(f"{each}(...)" for each in MAKERS)
        raise UcritError(f"there is no controller '{name}'{near_match(key, MAKERS)}; made for a model are {known}")
    arguments = [word.strip() for word in rest.rstrip()[:-1].split(",") if word.strip()]
    try:
        return MAKERS[key](model, *arguments)
    except TypeError:
        raise UcritError(f"controller '{name}': {len(arguments)} arguments are not what {key} takes") from None


def models_in(module: ModuleType) -> list[type[Model]]:
    """Return the model classes that a module itself defines, last one last."""
    found = [
        value
        for value in vars(module).values()
        if isinstance(value, type) and issubclass(value, Model) and value.__module__ == module.__name__
    ]
    if not found:
        raise ModelError(f"'{module.__name__}' defines no model: a class derived from ucrit.Model is needed")
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
    except Exception as error:
        line = getattr(error, "lineno", None) or _line_in(error, path)
        at = f" in line {line}" if line else ""
        raise ModelError(f"'{path}' cannot be run{at}: {type(error).__name__}: {error}") from None
    return models_in(module)


def _line_in(error: BaseException, path: Path) -> int | None:
    lines, trace = [], error.__traceback__
    while trace is not None:
        if trace.tb_frame.f_code.co_filename == str(path):
            lines.append(trace.tb_lineno)
        trace = trace.tb_next
    return lines[-1] if lines else None


def _from_file(path: Path, cls: str) -> type[Model]:
    models = {model.__name__: model for model in models_in_file(path)}
    if not cls:
        return list(models.values())[-1]
    if cls not in models:
        raise UcritError(f"'{path}' has no model '{cls}'{near_match(cls, models)}")
    return models[cls]


def load(vehicle: str | os.PathLike[str], changes: Mapping[str, Any] | None = None, at_speed: Any = None) -> Model:
    """Return a vehicle: one that is shipped, by name, or one from a file.

    Parameters
    ----------
    vehicle
        ``"caravan"``, or the path of a vehicle file (anything ending in ``.toml`` or holding a path separator), or of a
        bond graph (``.bonds``) whose parameters have defaults or are among the changes.
    changes
        Parameter values [SI, or text with a unit] that replace those of the file; and tires by the slots that take
        them, as `tire` names them: ``{"front": "pacejka-205-60r15"}``.
    at_speed
        Value for the parameter that is the model's speed, whatever it is called.

    Raises
    ------
    UcritError
        If there is no such vehicle or its file is wrong.

    Examples
    --------
    >>> load("caravan").values["U"] > 20
    True
    """
    name = os.fspath(vehicle)
    if name in vehicle_names():
        path, where = VEHICLES / f"{name}.toml", name
    elif name.endswith((".toml", BONDS)) or os.sep in name or Path(name).is_file():
        path, where = Path(name), name
    else:
        raise UcritError(f"there is no vehicle '{name}'{near_match(name, vehicle_names())}")
    folder = path.parent
    text = f"model = {json.dumps(path.name)}\n[parameters]" if path.suffix == BONDS else read_text(path)
    find = Find(
        partial(find_model, folder=folder), partial(find_part, folder=folder), controlled, graph_model, find_part
    )
    return parse_vehicle(text, where, find, changes, at_speed)
