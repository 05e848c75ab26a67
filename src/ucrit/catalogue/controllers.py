"""Controllers by name, and those that are made for a model."""

from __future__ import annotations

import importlib
import os
from functools import cache
from typing import TYPE_CHECKING

from ..core.contract.model import Model
from ..core.errors import UcritError, near_match
from .models import models_in
from .places import HERE

if TYPE_CHECKING:
    from ..control import Controller


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
    from ..control import Controller

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
    from ..control import closed

    for name in controllers:
        model = closed(model, _controller(name, model))
    return model


def _controller(name: str, model: type[Model]) -> type[Controller]:
    """Return a controller by name, or the one that a maker makes for a model."""
    maker, bracket, rest = name.partition("(")
    if not bracket:
        return find_controller(name)
    from ..control import MAKERS

    key = maker.strip().replace("_", "-")
    if key not in MAKERS or not rest.rstrip().endswith(")"):
        known = ", ".join(f"{each}(...)" for each in MAKERS)
        raise UcritError(f"there is no controller '{name}'{near_match(key, MAKERS)}; made for a model are {known}")
    arguments = [word.strip() for word in rest.rstrip()[:-1].split(",") if word.strip()]
    try:
        return MAKERS[key](model, *arguments)
    except TypeError:
        raise UcritError(f"controller '{name}': {len(arguments)} arguments are not what {key} takes") from None
