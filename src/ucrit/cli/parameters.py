"""Arguments and options that several commands share, and their tab completion."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import click
from click.shell_completion import CompletionItem


class Name(click.ParamType):  # type: ignore[type-arg]
    """Name of a shipped vehicle or model, or a file; completes both."""

    def __init__(self, *kinds: str, suffix: str) -> None:
        self.kinds, self.suffix = kinds, suffix
        self.name = " or ".join([*kinds, "file"])

    def shell_complete(self, ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
        """Return names that begin with what is typed, then files and folders."""
        from .. import catalogue

        names: list[str] = []
        names += catalogue.vehicle_names() if "vehicle" in self.kinds else ()
        names += catalogue.model_names() if "model" in self.kinds else ()
        names += catalogue.controller_names() if "controller" in self.kinds else ()

        names += catalogue.tire_names() if "tire" in self.kinds else ()
        found = [CompletionItem(name) for name in names if name.startswith(incomplete)]
        return [*found, *(CompletionItem(path) for path in _files(incomplete, self.suffix))]


def _files(incomplete: str, suffix: str) -> list[str]:
    start, _, stem = incomplete.rpartition("/")
    folder = Path(start or ("/" if incomplete.startswith("/") else "."))
    try:
        entries = sorted(folder.iterdir())
    except OSError:
        return []
    kept = [e for e in entries if e.name.startswith(stem) and (e.is_dir() or e.suffix == suffix) and e.name[0] != "."]
    lead = f"{start}/" if "/" in incomplete else ""
    return [lead + e.name + ("/" if e.is_dir() else "") for e in kept]


def complete_parameters(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Complete ``name=`` with the parameters of the vehicle that stands before it."""
    from ..catalogue import load
    from ..core.errors import UcritError

    words = [ctx.params.get("vehicle"), *ctx.args]  # an option still without value leaves the words unread
    name = next((word for word in words if word and not word.startswith("-")), None)
    if "=" in incomplete or name is None:
        return []
    try:
        vehicle = load(name)
    except UcritError:
        return []
    declared = type(vehicle).declaration.parameters.values()
    return [
        CompletionItem(f"{p.name}=", help=f"{p.meaning} [{p.unit}], now {vehicle.values[p.name]:.6g}")
        for p in declared
        if p.name.startswith(incomplete)
    ]


def assignments(texts: Iterable[str], example: str, thing: str = "parameter") -> dict[str, Any]:
    """Read ``name=value`` texts; raise `UcritError` for one that is not or that comes twice."""
    from ..core.errors import UcritError

    read: dict[str, Any] = {}
    for text in texts:
        name, sign, value = (part.strip() for part in text.partition("="))
        if not (sign and name and value):
            article = "an" if thing[0] in "aeiou" else "a"
            raise UcritError(f"{article} {thing} is given as NAME=VALUE, such as {example}, got {text!r}")
        if name in read:
            raise UcritError(f"{thing} {name} is given twice, as {read[name]!r} and as {value!r}")
        read[name] = value
    return read


def load_vehicle(name: str, changes: dict[str, Any] | None = None, at_speed: str | None = None) -> Any:
    """Return a vehicle; a model's name in its place gets told how to make a vehicle of it."""
    from ..catalogue import load, model_names, vehicle_names
    from ..core.errors import UcritError

    known = name not in vehicle_names() and name.replace("_", "-") in model_names() and not Path(name).exists()
    if known or re.search(r"\.py(:\w+)?$", name):
        raise UcritError(f"'{name}' is a model, not a vehicle; 'ucrit new {name} > mine.toml' gives a file to fill in")
    vehicle = load(name, changes, at_speed)
    speed = type(vehicle).declaration.speed
    if at_speed is not None and speed in (changes or {}):
        given = f"as --upto {at_speed!r} and as {speed}={(changes or {})[speed]!r}"
        raise UcritError(f"the speed is given twice, {given}")
    return vehicle
