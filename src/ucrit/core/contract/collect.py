"""What a class and its bases declare, put together in the order of their lines."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import Any

from ..errors import ModelError
from .declare import Input, Output, Parameter, Quantity, Variable
from .part import Slot


@dataclass(frozen=True)
class Declaration:
    """What a model class declares, in the order of its lines."""

    parameters: Mapping[str, Parameter]
    variables: Mapping[str, Variable]
    inputs: Mapping[str, Input]
    outputs: Mapping[str, Output]
    slots: Mapping[str, Slot] = field(default_factory=dict)

    @property
    def speed(self) -> str | None:
        """Name of the speed parameter, if the model has one."""
        return next((name for name, p in self.parameters.items() if p.is_speed), None)


@dataclass
class _Found:
    by_name: dict[str, Any] = field(default_factory=dict)

    def of(self, kind: type[Quantity]) -> Any:
        return MappingProxyType({k: v for k, v in self.by_name.items() if isinstance(v, kind)})


def declared(cls: type, root: type) -> Declaration:
    """Collect what a class and its bases declare; names that ``root``, the base of all, has are taken."""
    found = _Found()
    for base in reversed(cls.__mro__):
        for name, value in vars(base).items():
            if isinstance(value, Quantity):
                if hasattr(root, name) or name.startswith("_"):
                    raise ModelError(f"{cls.__name__}: a quantity cannot be called '{name}', that name is taken")
                found.by_name.pop(name, None)
                found.by_name[name] = replace(value, name=name)
            elif isinstance(value, Slot):
                found.by_name[name] = replace(value, name=name)
            elif name in found.by_name:
                found.by_name.pop(name)  # a base's parameter fixed to a number, or a variable removed
    slots = MappingProxyType({k: v for k, v in found.by_name.items() if isinstance(v, Slot)})
    for slot in slots.values():
        setattr(cls, slot.name, slot)
    found = _Found(_with_parts(cls, found.by_name))
    declaration = Declaration(found.of(Parameter), found.of(Variable), found.of(Input), found.of(Output), slots)
    if sum(p.is_speed for p in declaration.parameters.values()) > 1:
        raise ModelError(f"{cls.__name__}: only one parameter can be the speed")
    return declaration


def _with_parts(cls: type, declared: Mapping[str, Any]) -> dict[str, Any]:
    """Put the parameters of each slot's law in the slot's place."""
    flat: dict[str, Any] = {}
    for name, value in declared.items():
        for key, quantity in (value.declared if isinstance(value, Slot) else {name: value}).items():
            if key in flat or (isinstance(value, Slot) and key in declared):
                raise ModelError(f"{cls.__name__}: '{key}' is declared twice, once as a parameter of '{name}'")
            flat[key] = quantity
    return flat
