"""Vehicle files: TOML with a model, a name, a source and parameters in SI units or with a unit.

::

    model = "trailer"
    name = "Touring caravan"
    source = "where the numbers come from"

    [parameters]
    m = 1400             # a number is in the parameter's SI unit
    U = "100 km/h"       # a text carries its own

Tolerances stand beside values, see `ucrit.core.contract.tolerances`. With ``graph``, a bond graph as text, ``model`` is
a name for what it states.
"""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Mapping, Set
from pathlib import Path
from typing import Any, NamedTuple

from ..errors import UcritError, near_match
from .model import Model
from .part import Part
from .tolerances import Tolerances, read_tolerances, write_correlations

TEXTS = ("name", "source", "note")
KEYS = ("model", "graph", *TEXTS, "controllers", "parts", "parameters", "correlations")


class Find(NamedTuple):
    """How names in a file are looked up.

    Attributes
    ----------
    model
        Gives the class of a model's name.
    part
        Gives the law of a name, of the kind that a slot takes.
    controlled
        Gives a model under the control of some controllers.
    graph
        Gives the model that a bond graph's text states, for a name and where the text stands.
    changed
        Gives the law of a name among the changes, where that is not looked up as a name in the file is.
    """

    model: Callable[[str], type[Model]]
    part: Callable[[str, type[Part]], type[Part]]
    controlled: Callable[[type[Model], tuple[str, ...]], type[Model]]
    graph: Callable[[str, str, str], type[Model]]
    changed: Callable[[str, type[Part]], type[Part]] | None = None


def read_text(path: Path) -> str:
    """Return a file's text; raise `UcritError` where it is not there, not a file or not text."""
    try:
        return path.read_text(encoding="utf-8-sig")  # editors on Windows begin files with a mark
    except FileNotFoundError:
        raise UcritError(f"there is no file '{path}'") from None
    except IsADirectoryError:
        raise UcritError(f"'{path}' is a folder, not a file") from None
    except (UnicodeDecodeError, ValueError):
        raise UcritError(f"'{path}' is not a text file in UTF-8") from None
    except OSError as error:
        raise UcritError(f"'{path}' cannot be read: {error.strerror or error}") from None


def parse_toml(text: str, where: str) -> dict[str, Any]:
    """Return what a text in TOML holds; raise `UcritError`, naming ``where``, for one that is not valid."""
    try:
        return tomllib.loads(text)
    except RecursionError:
        raise UcritError(f"{where}: not valid TOML: nested too deeply") from None
    except ValueError as error:
        told = str(error) if isinstance(error, tomllib.TOMLDecodeError) else "a number has too many digits"
        raise UcritError(f"{where}: not valid TOML: {told}") from None


def parse_vehicle(
    text: str,
    where: str,
    find: Find,
    changes: Mapping[str, Any] | None = None,
    at_speed: Any = None,
) -> Model:
    """Return the vehicle that a file's text describes, with some parameters changed.

    Parameters
    ----------
    text
        The file's content (TOML).
    where
        The file's name, for messages.
    find
        Gives models, parts and controllers of a name.
    changes
        Parameter values that replace or complete the file's; and names of laws, by the slots that take them. Of the
        file's values for such a slot those stay that the new law has too.
    at_speed
        Value for whichever parameter is the model's speed.

    Raises
    ------
    UcritError
        One sentence about the first thing that is wrong; nothing is ignored.
    """
    content = parse_toml(text, where)
    for key in content:
        if key not in KEYS:
            raise UcritError(f"{where}: there is no entry '{key}'{near_match(key, KEYS)}")
    for key in ("model", "graph", *TEXTS):
        if not isinstance(content.get(key, ""), str):
            raise UcritError(f"{where}: {key} must be a text in quotes, got {content[key]!r}")
    parameters = content.get("parameters")
    if "model" not in content or not isinstance(parameters, dict):
        raise UcritError(f'{where}: a vehicle file needs model = "..." and a [parameters] table')
    try:
        name = content["model"]
        model = find.graph(content["graph"], name, "graph") if "graph" in content else find.model(name)
        given = dict(changes or {})
        fresh = {name: given.pop(name) for name in model.declaration.slots if name in given}
        model = model.fitted(**_laws(model, content.get("parts", {}), find.part))
        refitted = model.fitted(**_laws(model, fresh, find.changed or find.part))
        controllers = _controllers(content.get("controllers", []))
        model, refitted = find.controlled(model, controllers), find.controlled(refitted, controllers)
        parameters, tolerances = read_tolerances(parameters, content.get("correlations", {}), model)
        gone = model.declaration.parameters.keys() - refitted.declaration.parameters.keys()
        if gone:
            parameters, tolerances = _without(gone, parameters, tolerances)
        vehicle = refitted(**{**parameters, **given, **_speed(model, at_speed)})
    except UcritError as error:
        raise type(error)(f"{where}: {error}") from None
    texts = {key: content[key] for key in TEXTS if key in content}
    return vehicle.with_info(**{"name": Path(where).stem, **texts, "file": where, "tolerances": tolerances})


def _without(gone: Set[str], parameters: Mapping[str, Any], tolerances: Tolerances) -> tuple[Any, Tolerances]:
    """Return values and tolerances but for those of parameters that a slot's new law does not have."""
    kept = tuple(t for t in tolerances if t.name not in gone)
    correlated = tuple(pair for pair in tolerances.correlations if gone.isdisjoint(pair[:2]))
    return {name: v for name, v in parameters.items() if name not in gone}, Tolerances(kept, correlated)


def _controllers(names: Any) -> tuple[str, ...]:
    if not isinstance(names, list) or not all(isinstance(name, str) for name in names):
        raise UcritError(f"controllers must be a list of names in quotes, got {names!r}")
    return tuple(names)


def _laws(model: type[Model], parts: Any, find_part: Callable[[str, type[Part]], type[Part]]) -> dict[str, type[Part]]:
    """Return the laws that a file's [parts] table puts into the model's slots."""
    slots = model.declaration.slots
    if not isinstance(parts, dict):
        raise UcritError(f"parts must be a table, got {parts!r}")
    for name, law in parts.items():
        if name not in slots:
            raise UcritError(f"{model.model_id()}: there is no slot '{name}' for a part{near_match(name, slots)}")
        if not isinstance(law, str):
            raise UcritError(f"{model.model_id()}: part {name} must be the name of a law in quotes, got {law!r}")
    return {name: find_part(law, slots[name].kind) for name, law in parts.items()}


def _speed(model: type[Model], value: Any) -> dict[str, Any]:
    if value is None:
        return {}
    if model.declaration.speed is None:
        raise UcritError(f"{model.model_id()} has no speed, so none can be asked for, got {value}")
    return {model.declaration.speed: value}


def write_vehicle(vehicle: Model, model: str | None = None) -> str:
    """Return a vehicle as the text of a vehicle file, every parameter with its unit and meaning.

    Reading the text back gives an equal vehicle: numbers are written in full.
    """
    return vehicle_template(type(vehicle), model, vehicle)


def vehicle_template(model: type[Model], name: str | None = None, vehicle: Model | None = None) -> str:
    """Return the text of a vehicle file for ``model``; without a vehicle its values are left to fill in."""
    info = vehicle.info if vehicle else None
    if vehicle and vehicle.dims:
        raise UcritError(f"a file holds one vehicle: give one value each for {', '.join(vehicle.dims)}")
    made_of = model.ingredients()
    if name and name != made_of["model"]:
        made_of = {key: value for key, value in made_of.items() if key != "graph"} | {"model": name}
    lines = [
        f"# {model.title()}",
        f"model = {_quoted(made_of['model'])}",
        f"name = {_quoted(info.name if info and info.name else 'my vehicle')}",
        f"source = {_quoted(info.source if info and info.source else 'where the numbers come from')}",
    ]
    if info and info.note:
        lines.append(f"note = {_quoted(info.note)}")
    if "graph" in made_of:
        lines.append(f"graph = {_block(made_of['graph'])}")
    if "controllers" in made_of:
        lines.append(f"controllers = [{', '.join(map(_quoted, made_of['controllers']))}]")
    if "parts" in made_of:
        lines += ["", "[parts]", *(f"{key} = {_quoted(law)}" for key, law in made_of["parts"].items())]
    lines += ["", '[parameters]   # a number is in the SI unit shown; a text carries its own: "110 km/h"']
    known = info.tolerances.around(vehicle.values) if info and vehicle else Tolerances()
    for key, parameter in model.declaration.parameters.items():
        comment = f"{parameter.meaning} [{parameter.unit}], {parameter.allowed}"
        value = vehicle.values[key] if vehicle else parameter.default
        tolerance, former = known.of(key), info.tolerances.of(key) if info else None
        if former and not tolerance:
            comment += f"; its value lies outside {former.low!r} to {former.high!r}, where it was known to be"
        left = f"# {key} = "
        if value is not None:
            left = f"{key} = {tolerance.entry(float(value)) if tolerance else repr(float(value))}"
        lines.append(f"{left:<28} # {comment}")
    lines += write_correlations(known)
    return "\n".join(lines) + "\n"


def _block(text: str) -> str:
    """Return a text of several lines as TOML, a line each."""
    lines = [_quoted(line)[1:-1].replace("\\u0009", "\t") for line in text.strip("\n").split("\n")]
    return '"""\n' + "\n".join(lines) + '\n"""'


def _quoted(text: str) -> str:
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    escaped = "".join(c if c.isprintable() else f"\\u{ord(c):04x}" for c in escaped)
    return f'"{escaped}"'
