"""Vehicles: those that are shipped, by name, and those of files and texts."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from functools import cache, partial
from pathlib import Path
from typing import Any

from ..core.contract.files import Find, parse_vehicle, read_text
from ..core.contract.model import Model
from ..core.contract.part import Part
from ..core.errors import UcritError, near_match
from .controllers import controlled
from .laws import find_part
from .models import find_model, graph_model, model_names
from .places import BONDS, VEHICLES


@cache
def vehicle_names() -> tuple[str, ...]:
    """Names of all vehicles that are shipped.

    >>> "caravan" in vehicle_names()
    True
    """
    return tuple(sorted(e.name[:-5] for e in os.scandir(VEHICLES) if e.name.endswith(".toml")))


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
