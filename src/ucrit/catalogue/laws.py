"""Laws that models take into slots, by name; tires also from property files."""

from __future__ import annotations

import importlib
import os
import pkgutil
from pathlib import Path
from typing import Any

from ..core.contract.part import Part
from ..core.errors import UcritError, near_match
from .places import TIRES

FEW = 3
"""Parameters of a law that are named where all are missing."""


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


def _laws(kind: type[Part]) -> dict[str, type[Part]]:
    """Find the laws of a kind: the module of its base, and the modules beside it in its package."""
    package = importlib.import_module(kind.__module__.rpartition(".")[0])
    modules = (importlib.import_module(f"{package.__name__}.{m.name}") for m in pkgutil.iter_modules(package.__path__))
    found = (value for module in modules for value in vars(module).values() if isinstance(value, type))
    return {law.part_id(): law for law in found if issubclass(law, kind) and law is not kind}


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
    kind: type[Part] = importlib.import_module("ucrit.parts.tires").Tire
    law = find_part(name, kind)
    asked = [key for key, parameter in law.parameters.items() if parameter.default is None]
    if asked and not parameters:
        first = ", ".join(asked[:FEW]) + (f" and {len(asked) - FEW} more" if len(asked) > FEW else "")
        raise UcritError(
            f"'{name}' is a law, which needs a tire's numbers ({first}): give them, or name a .tir file or a tire that "
            f"is shipped: {', '.join(tire_names())}"
        )
    return law(**parameters)
