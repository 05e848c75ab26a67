"""Classes made from other classes while the program runs: the same class for the same ingredients, and picklable."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Any


@dataclass(frozen=True)
class Reference:
    """How a class was made: what pickle keeps in its place."""

    maker: Callable[..., type]
    ingredients: tuple[Any, ...]


def made(maker: Callable[..., type], *ingredients: Any) -> Any:
    """Return ``maker(*ingredients)``, a class, which is made once for the same ingredients.

    Ingredients are classes, texts, numbers and tuples of them; the maker is a function of a module.
    """
    return _made(maker, ingredients)


def _make(maker: Callable[..., type], ingredients: tuple[Any, ...]) -> type:
    cls: Any = maker(*ingredients)
    cls._made_by = Reference(maker, ingredients)
    return cls  # type: ignore[no-any-return]


_made: Any = cache(_make)


def reference(value: Any) -> Any:
    """Return what pickle can keep: classes made here are replaced by how they were made."""
    if isinstance(value, tuple):
        return tuple(reference(item) for item in value)
    if isinstance(value, type) and "_made_by" in vars(value):
        made_by: Reference = vars(value)["_made_by"]
        return Reference(made_by.maker, reference(made_by.ingredients))
    return value


def resolve(value: Any) -> Any:
    """Return what `reference` was given."""
    if isinstance(value, tuple):
        return tuple(resolve(item) for item in value)
    if isinstance(value, Reference):
        return made(value.maker, *resolve(value.ingredients))
    return value
