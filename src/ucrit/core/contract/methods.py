"""The methods in which a model states its motion: what each may ask for, and how it is called."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any

from ..errors import ModelError, near_match

if TYPE_CHECKING:
    from .model import Model

ARGUMENTS = {
    "equations": ("x", "dx", "ddx", "u"),
    "kinetic_energy": ("x", "dx"),
    "potential_energy": ("x",),
    "forces": ("x", "dx", "u"),
    "constraints": ("x", "dx"),
    "matrices": (),
    "outputs": ("x", "dx", "ddx", "u"),
    "events": ("x", "dx", "ddx", "u"),
    "drawing": ("x", "u"),
    "basic_motion": (),
    "bond_graph": ("u",),
}
"""Methods, and what each may ask for by the names of its arguments."""

STATEMENTS = ("equations", "kinetic_energy", "matrices", "closed_loop")
"""Ways to state the motion, one of which a model takes."""


class Names:
    """The values of one group of declared names, read as attributes; an unknown name gets a near match."""

    def __init__(self, group: str, values: Mapping[str, Any]) -> None:
        self._group = group
        self.__dict__.update(values)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        known = [key for key in self.__dict__ if not key.startswith("_")]
        raise ModelError(f"the equations use '{self._group}.{name}', which is not declared{near_match(name, known)}")


def check_methods(cls: type[Model]) -> None:
    """Raise `ModelError` where a class states no motion, or a method asks for an argument that there is not."""
    stated = [name for name in STATEMENTS if hasattr(cls, name)]
    if cls.declaration.variables and not stated:
        raise ModelError(f"{cls.__name__}: state the motion by one of {', '.join(STATEMENTS)}")
    for name in dir(cls):
        key = "equations" if name.startswith("equations_") else name
        if (allowed := cls._arguments.get(key)) and callable(getattr(cls, name)):
            for argument in argument_names(getattr(cls, name)):
                if argument not in allowed:
                    raise ModelError(
                        f"{cls.__name__}.{name}: there is no argument '{argument}'{near_match(argument, allowed)}"
                    )


def is_current(model: type[Model], method: str) -> bool:
    """Tell whether a method is no older in the line of classes than the statement of motion in use.

    One that a base class wrote for its own equations says nothing about a class that states new ones.
    """
    lines = [vars(base) for base in model.__mro__]
    stated = next(i for i, names in enumerate(lines) if any(name in names for name in STATEMENTS))
    return any(method in names for names in lines[: stated + 1])


def argument_names(method: Callable[..., Any]) -> list[str]:
    """Names of a method's arguments without ``self``."""
    return [name for name in inspect.signature(method).parameters if name != "self"]


def call(method: Callable[..., Any], groups: Mapping[str, Names]) -> Any:
    """Call a method of a model with the groups of values that its argument names ask for."""
    return method(**{name: groups[name] for name in argument_names(method)})


def as_tuple(value: Any) -> tuple[Any, ...]:
    """Return equations as a tuple, also when a method returns a single one."""
    return tuple(value) if isinstance(value, Iterable) else (value,)
