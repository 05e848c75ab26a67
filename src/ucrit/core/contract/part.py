"""Parts: force laws with parameters of their own, which models take into slots.

A part is a class with declared parameters and methods that run on floats, arrays and symbols alike. It can be used
alone (``Brush(C=80_000, mu=0.9).side_force(0.02, 4000)``) or in a model's slot, whose parameters are then named
after both (``front_C``, ``front_mu``). A law with a table of coefficients is `Part.of` them.
"""

from __future__ import annotations

import inspect
from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any, ClassVar, Self

from ..errors import ModelError, UcritError, near_match
from ..made import made, reference, resolve
from .declare import Parameter

Constant = float | int | str


class Part:
    """Base of all parts; an instance is one part: frozen and validated like a vehicle.

    Attributes
    ----------
    parameters
        What the class declares, by name.
    constants
        Numbers that belong to the law and are no parameters, such as coefficients read from a file.
    """

    parameters: ClassVar[Mapping[str, Parameter]] = MappingProxyType({})
    constants: ClassVar[Mapping[str, Constant]] = MappingProxyType({})
    root: ClassVar[type[Part]]

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        cls.root = cls
        found: dict[str, Parameter] = {}
        for base in reversed(cls.__mro__):
            for name, value in vars(base).items():
                if isinstance(value, Parameter):
                    found[name] = replace(value, name=name)
                else:
                    found.pop(name, None)
        cls.parameters = MappingProxyType(found)

    def __init__(self, **values: Any) -> None:
        name = type(self).part_id()
        for key in values:
            if key not in self.parameters:
                raise UcritError(f"{name}: there is no parameter '{key}'{near_match(key, self.parameters)}")
        for key, parameter in self.parameters.items():
            value = values.get(key, parameter.default)
            if value is None:
                raise UcritError(f"{name}: {parameter.meaning} {key} is missing; it must be {parameter.allowed}")
            self.__dict__[key] = parameter.check(value, name)

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError(f"a part does not change: make another one with {name}=...")

    def __eq__(self, other: object) -> bool:
        return type(self) is type(other) and repr(self.__dict__) == repr(other.__dict__)

    def __hash__(self) -> int:
        return hash((type(self), repr(self.__dict__)))

    def __reduce__(self) -> Any:
        return _restore, (reference(type(self)), dict(self.__dict__))

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(f'{name}={value}' for name, value in self.__dict__.items())})"

    def _repr_html_(self) -> str:
        from .. import html

        rows = [
            (name, self.__dict__[name], "" if p.unit == "1" else p.unit, p.meaning)
            for name, p in self.parameters.items()
        ]
        caption = f"{self.title()} ({self.part_id()})"
        table = html.table(rows, ("parameter", "value", "unit", "meaning"), caption)
        count = len(self.constants)
        return table + (f"<p>and {count} constants, in .constants</p>" if count else "")

    @classmethod
    def part_id(cls) -> str:
        """Name of the law as users type it: that of its file in the catalogue, the class's name elsewhere."""
        package, _, stem = cls.root.__module__.rpartition(".")
        return stem.replace("_", "-") if package.startswith("ucrit.parts") else cls.__name__

    @classmethod
    def title(cls) -> str:
        """First line of the class's description."""
        return (inspect.getdoc(cls.root) or cls.__name__).splitlines()[0]

    @classmethod
    def of(cls, constants: Mapping[str, Constant]) -> type[Self]:
        """Return the law with these constants: a class of its own, the same one for the same constants."""
        found: type[Self] = made(_with_constants, cls.root, tuple(sorted({**cls.constants, **constants}.items())))
        return found

    @classmethod
    def unwritten(cls, slot: str) -> type[Part]:
        """Return the law as equations show it that do not spell it out; ``slot`` is where it is, for the names."""
        return cls

    @classmethod
    def bound(cls, values: Mapping[str, Any]) -> Self:
        """Return a part whose parameters are any values, symbols among them, past the validation of numbers."""
        instance = object.__new__(cls)
        instance.__dict__.update(values)
        return instance


def _with_constants(law: type[Part], constants: tuple[tuple[str, Constant], ...]) -> type[Part]:
    body = {"constants": MappingProxyType(dict(constants)), "__module__": law.__module__, "__doc__": law.__doc__}
    found: Any = type(law.__name__, (law,), body)
    found.root = law
    return found  # type: ignore[no-any-return]


def _restore(law: Any, values: dict[str, Any]) -> Part:
    found: type[Part] = resolve(law)
    return found.bound(values)


@dataclass(frozen=True)
class Slot:
    """Where a model takes a part; read on a vehicle, it is the part with the vehicle's values."""

    law: type[Part]
    meaning: str
    kind: type[Part]
    name: str = ""

    def __get__(self, vehicle: Any, owner: Any = None) -> Any:
        if vehicle is None:
            return self
        values = vehicle.__dict__
        return self.law.bound({key: values[f"{self.name}_{key}"] for key in self.law.parameters})

    @property
    def declared(self) -> dict[str, Parameter]:
        """The law's parameters under the names that they have in the model."""
        return {
            f"{self.name}_{key}": replace(p, name=f"{self.name}_{key}", meaning=f"{self.meaning}: {p.meaning}")
            for key, p in self.law.parameters.items()
        }

    def fitted(self, law: type[Part], model: str) -> Slot:
        """Return the slot with another law in it."""
        if not (isinstance(law, type) and issubclass(law, self.kind)):
            got = getattr(law, "__name__", repr(law))
            raise UcritError(f"{model}: {self.meaning} {self.name} must be a {self.kind.__name__}, got {got}")
        return replace(self, law=law)


def slot(law: type[Part], meaning: str, *, kind: type[Part] | None = None) -> Any:
    """Declare a slot: a place in a model for a force law with parameters of its own.

    Parameters
    ----------
    law
        What is there unless the model is fitted with another one.
    meaning
        What it is, in words that fit into an error message: ``"front tires"``.
    kind
        Base class of all laws that fit; by default the first class above ``law`` that is itself a part.

    Raises
    ------
    ModelError
        If the law is no part.

    Examples
    --------
    >>> class Spring(Part):
    ...     k = Parameter("N/m", "stiffness", above=0)
    >>> slot(Spring, "front spring").meaning
    'front spring'
    """
    if not (isinstance(law, type) and issubclass(law, Part)):
        raise ModelError(f"slot '{meaning}': a class derived from Part is needed, got {law!r}")
    above = [base for base in law.__mro__ if issubclass(base, Part) and base is not Part]
    return Slot(law, meaning, kind or above[-1])
