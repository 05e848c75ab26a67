"""What there is: models and vehicles that are shipped, and vehicle files to fill in."""

from __future__ import annotations

import inspect
import os
import re
import tomllib
from dataclasses import dataclass

from ...catalogue import BONDS, VEHICLES, controller_names, find_controller, find_model, model_names, vehicle_names
from ...core.contract.files import read_text, vehicle_template, write_vehicle
from ...core.contract.model import Model
from ...core.errors import UcritError, near_match
from .show import resolve

KINDS = ("models", "vehicles", "controllers")


@dataclass(frozen=True)
class Entry:
    """One line of the listing: a name, what it is, and for a vehicle its model."""

    name: str
    title: str
    model: str = ""


@dataclass(frozen=True)
class Listing:
    """Models, vehicles and controllers that are shipped; prints as a list.

    Examples
    --------
    >>> import ucrit
    >>> "caravan" in ucrit.list("vehicles")
    True
    """

    models: tuple[Entry, ...]
    vehicles: tuple[Entry, ...]
    controllers: tuple[Entry, ...] = ()

    @property
    def _all(self) -> tuple[Entry, ...]:
        return (*self.models, *self.vehicles, *self.controllers)

    def __contains__(self, name: object) -> bool:
        return any(entry.name == name for entry in self._all)

    def __len__(self) -> int:
        return len(self._all)

    def __str__(self) -> str:
        width = max((len(entry.name) for entry in self._all), default=0)
        lines = []
        for head, entries in zip(KINDS, (self.models, self.vehicles, self.controllers), strict=True):
            if entries:
                lines += [head, *(f"  {e.name:<{width}}  {e.title}" for e in entries)]
        return "\n".join(lines)

    __repr__ = __str__

    def _repr_html_(self) -> str:
        from ...core import html

        return html.table([(e.name, e.title, e.model) for e in self._all], ("name", "what it is", "model"))


def listing(kind: str | None = None) -> Listing:
    """Return what is shipped: all of it, or only ``"models"``, ``"vehicles"`` or ``"controllers"``.

    Raises `UcritError` for any other kind.
    """
    if kind is not None and kind not in KINDS:
        raise UcritError(f"there are no '{kind}' to list{near_match(kind, KINDS)}")
    wanted = KINDS if kind is None else (kind,)
    models = tuple(_model(name) for name in model_names()) if "models" in wanted else ()
    vehicles = sorted(map(_vehicle, vehicle_names()), key=lambda e: (e.model, e.name)) if "vehicles" in wanted else ()
    controllers = (*map(_controller, controller_names()), *_makers()) if "controllers" in wanted else ()
    return Listing(models, tuple(vehicles), controllers)


def _makers() -> list[Entry]:
    """Controllers that are made for a model, with arguments."""
    from ...control import MAKERS

    lines = {name: (inspect.getdoc(maker) or "").splitlines()[0] for name, maker in MAKERS.items()}
    return [Entry(f"{name}(...)", line.removeprefix("Return ").replace("`", "")) for name, line in lines.items()]


def _controller(name: str) -> Entry:
    return Entry(name, re.sub(r"\s*\(.*?\)\.?$", "", find_controller(name).title()))


def _model(name: str) -> Entry:
    return Entry(name, re.sub(r"\s*\(.*?\)\.?$", "", find_model(name).title()))


def _vehicle(name: str) -> Entry:
    content = tomllib.loads(read_text(VEHICLES / f"{name}.toml"))
    return Entry(name, content.get("name", name), content["model"].replace("_", "-"))


def template(subject: type[Model] | Model | str | os.PathLike[str], like: Model | str | None = None) -> str:
    """Return the text of a vehicle file: for a model to be filled in, for a vehicle with its values.

    Parameters
    ----------
    subject
        A model, or a vehicle to copy; or the name of one.
    like
        A vehicle whose values are taken; it must have every parameter of the model, in the same unit.

    Raises
    ------
    UcritError
        If there is no such model or vehicle, or ``like`` lacks a parameter.

    Examples
    --------
    >>> import ucrit
    >>> print(ucrit.new("trailer-kinematic").splitlines()[1])
    model = "trailer-kinematic"
    """
    model, vehicle = resolve(subject)
    is_file = isinstance(subject, str) and (".py" in subject or subject.endswith(BONDS))
    name = str(subject) if is_file else model.model_id()
    if like is not None:
        vehicle = _like(model, resolve(like)[1], like)
    elif vehicle is not None and not isinstance(subject, Model):
        name = _model_entry(str(os.fspath(subject)), name) if not isinstance(subject, type) else name
    return vehicle_template(model, name) if vehicle is None else write_vehicle(vehicle, name)


def _model_entry(path: str, name: str) -> str:
    """Name of the model as the vehicle's own file gives it: it may be a Python file beside it."""
    if path in vehicle_names() or path.endswith(BONDS):
        return name
    content = tomllib.loads(read_text(type(VEHICLES)(path)))
    return name if "graph" in content else str(content["model"].replace("_", "-"))


def _like(model: type[Model], other: Model | None, name: Model | str) -> Model:
    if other is None:
        raise UcritError(
            f"'{name}' is a model; only a vehicle has values to take{near_match(str(name), vehicle_names())}"
        )
    theirs = type(other).declaration.parameters
    ours = model.declaration.parameters
    missing = [k for k, p in ours.items() if (k not in theirs or theirs[k].unit != p.unit) and p.default is None]
    if missing:
        raise UcritError(f"{other.info.name} does not give {', '.join(missing)} of the model {model.model_id()}")
    info = other.info
    values = {k: other.values[k] for k, p in ours.items() if k in theirs and theirs[k].unit == p.unit}
    return model(**values).with_info(name=info.name, source=info.source, note=info.note)
