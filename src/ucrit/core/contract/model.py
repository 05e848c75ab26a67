"""The model contract: a class declares a vehicle; everything else is derived from the declaration.

A subclass of `Model` declares parameters, variables, inputs and outputs, and states its equations of motion in
one of three ways (argument names choose what is passed; ``x`` values, ``dx`` and ``ddx`` derivatives, ``u`` inputs):

* ``equations(self, x, dx, ddx, u)`` returns residuals, each of them zero;
* ``kinetic_energy(self, x, dx)``, ``potential_energy(self, x)`` and ``forces(self, x, dx, u)``, the latter as pairs
  (force, velocity of the point it acts on, in its direction), from which Lagrange's equations follow;
  ``constraints(self, x, dx)`` adds velocities that must be zero;
* ``matrices(self)`` returns linear ``(P_0, P_1, P_2)`` with ``P_0 q + P_1 q' + P_2 q'' = 0``.

``outputs(self, x, dx, ddx, u)`` returns a dictionary, ``basic_motion(self)`` one with the keys ``x``, ``dx`` and ``u``.
``possible(self)`` says what values of several parameters may be together (see `ucrit.core.contract.possible`).
``events(self, x, dx, ddx, u)`` returns what shall be noticed along the motion (see `ucrit.core.contract.events`),
``drawing(self, x, u)`` what the vehicle looks like (see `ucrit.core.contract.drawing`).
Two further class attributes say what modes are called: ``mode_names`` and ``one_mode_each`` (see `Modes`).
Any method named ``equations_<how>`` is a further derivation of the same vehicle, compared with the first; a bond graph,
``bond_graph(self, u)``, is one by `ucrit.bondgraph.equations_bond_graph`.
"""

from __future__ import annotations

import inspect
from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any, ClassVar, Self, dataclass_transform

import numpy as np

from ..errors import UcritError, near_match
from ..made import made, reference, resolve
from .collect import Declaration, declared
from .declare import param, speed
from .methods import ARGUMENTS, check_methods
from .mode_names import check_mode_names
from .part import Part
from .possible import check_together
from .tolerances import Tolerances


@dataclass(frozen=True)
class Info:
    """Who a vehicle is: its name, where its numbers come from, the file it was read from, a remark, tolerances."""

    name: str = ""
    source: str = ""
    file: str = ""
    note: str = ""
    tolerances: Tolerances = Tolerances()


@dataclass_transform(kw_only_default=True, frozen_default=True, field_specifiers=(param, speed))
class Model:
    """Base of all vehicle models; an instance is one vehicle: frozen, validated, copied with `with_`.

    A parameter given as a one-dimensional array spans a dimension of its own, named after it; `along` lets
    several arrays share one.
    """

    declaration: Declaration = Declaration({}, {}, {}, {})
    info: Info = Info()
    mode_names: ClassVar[Mapping[str, str]] = MappingProxyType({})
    one_mode_each: ClassVar[bool] = False
    _values: Mapping[str, float | np.ndarray[Any, Any]]
    _shared: Mapping[str, str]
    _arguments: Mapping[str, tuple[str, ...]] = MappingProxyType(ARGUMENTS)
    _unfitted: type[Model] | None = None
    _laws: Mapping[str, type[Part]] = MappingProxyType({})

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        cls.declaration = declared(cls, Model)
        check_methods(cls)
        if "mode_names" in vars(cls):
            check_mode_names(cls.__name__, cls.mode_names, cls.declaration.variables.values())
        cls.__signature__ = inspect.Signature(  # type: ignore[attr-defined]
            [
                inspect.Parameter(
                    name,
                    inspect.Parameter.KEYWORD_ONLY,
                    default=inspect.Parameter.empty if p.default is None else p.default,
                    annotation=float,
                )
                for name, p in cls.declaration.parameters.items()
            ]
        )

    def __init__(self, /, **values: Any) -> None:
        self._fill(values, {})

    def _fill(self, values: Mapping[str, Any], shared: Mapping[str, str]) -> None:
        """Check values, each and together, and keep them; ``shared`` maps some to a common dimension."""
        declared = type(self).declaration.parameters
        model = type(self).model_id()
        for name in values:
            if name not in declared:
                raise UcritError(f"{model}: there is no parameter '{name}'{near_match(name, declared)}")
        checked: dict[str, float | np.ndarray[Any, Any]] = {}
        for name, parameter in declared.items():
            value = values.get(name, parameter.default)
            if value is None:
                raise UcritError(f"{model}: {parameter.meaning} {name} is missing; it must be {parameter.allowed}")
            checked[name] = parameter.check(value, model)
        self.__dict__.update(checked, _values=MappingProxyType(checked), _shared=MappingProxyType(dict(shared)))
        check_together(self)

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError(f"a vehicle does not change: use with_({name}=...) to get a changed copy")

    def __reduce__(self) -> Any:
        return _restore, (reference(type(self)), dict(self._values), dict(self._shared), self.info)

    def __eq__(self, other: object) -> bool:
        if type(self) is not type(other):
            return NotImplemented
        assert isinstance(other, Model)
        same = all(np.array_equal(self._values[name], other._values[name]) for name in self._values)
        return same and self._shared == other._shared and self.info == other.info

    def __hash__(self) -> int:
        return hash((type(self), self.info, *(np.asarray(v).tobytes() for v in self._values.values())))

    @classmethod
    def model_id(cls) -> str:
        """Name of the model as users type it: the file's name in the catalogue, the class's name elsewhere."""
        package, _, stem = cls.__module__.rpartition(".")
        return stem.replace("_", "-") if package == "ucrit.models" else cls.__name__

    @classmethod
    def fitted(cls, **laws: type[Part]) -> type[Self]:
        """Return this model with other force laws in its slots, whose parameters replace those of the former laws.

        Parameters
        ----------
        laws
            Classes derived from `Part`, by the slot's name.

        Raises
        ------
        UcritError
            If there is no such slot or the law is of another kind than the slot takes.
        """
        slots = cls.declaration.slots
        for name, law in laws.items():
            if name not in slots:
                raise UcritError(f"{cls.model_id()}: there is no slot '{name}' for a part{near_match(name, slots)}")
            slots[name].fitted(law, cls.model_id())
        changed = {**cls._laws, **laws}
        base = cls._unfitted or cls
        fitting = tuple((n, law) for n, law in sorted(changed.items()) if base.declaration.slots[n].law is not law)
        found: type[Self] = made(_with_laws, base, fitting) if fitting else base  # type: ignore[assignment]
        return found

    @classmethod
    def ingredients(cls) -> dict[str, Any]:
        """Return what the model is made of as vehicle files name it: ``model``, ``parts`` and ``controllers``."""
        parts = {name: slot.law.part_id() for name, slot in cls.declaration.slots.items()}
        return {"model": cls.model_id(), **({"parts": parts} if parts else {})}

    @classmethod
    def title(cls) -> str:
        """First line of the class's description."""
        return (inspect.getdoc(cls) or cls.__name__).splitlines()[0]

    @property
    def values(self) -> Mapping[str, float | np.ndarray[Any, Any]]:
        """Parameter values [SI] by name, floats or one-dimensional arrays."""
        return self._values

    @property
    def dims(self) -> dict[str, np.ndarray[Any, Any]]:
        """Dimensions that array parameters span: name and coordinate values, in order of declaration."""
        dims: dict[str, np.ndarray[Any, Any]] = {}
        for name, value in self._values.items():
            if isinstance(value, np.ndarray):
                shared = self._shared.get(name)
                dims.setdefault(shared or name, np.arange(value.size) if shared else value)
        return dims

    def arguments(self) -> tuple[float | np.ndarray[Any, Any], ...]:
        """Parameter values in declared order, arrays shaped to broadcast over `dims`."""
        dims = list(self.dims)
        shaped: list[float | np.ndarray[Any, Any]] = []
        for name, value in self._values.items():
            if isinstance(value, np.ndarray):
                axis = dims.index(self._shared.get(name, name))
                value = value.reshape([-1 if i == axis else 1 for i in range(len(dims))])
            shaped.append(value)
        return tuple(shaped)

    def with_(self, /, **changes: Any) -> Self:
        """Return a copy with some parameters changed; misspelt names and impossible values are refused."""
        return self._copy(changes, {name: dim for name, dim in self._shared.items() if name not in changes})

    def along(self, dim: str, **changes: Any) -> Self:
        """Return a copy whose given array parameters, all of one length, vary together along one dimension."""
        sizes = {name: np.size(value) for name, value in changes.items()}
        if len(set(sizes.values())) > 1 or any(np.ndim(value) == 0 for value in changes.values()):
            raise UcritError(f"parameters along '{dim}' must be arrays of one length, got lengths {sizes}")
        return self._copy(changes, {**self._shared, **dict.fromkeys(changes, dim)})

    def _copy(self, changes: Mapping[str, Any], shared: Mapping[str, str]) -> Self:
        copy = object.__new__(type(self))
        copy._fill({**self._values, **changes}, shared)
        copy.__dict__["info"] = self.info
        return copy

    def with_info(self, **info: Any) -> Self:
        """Return a copy with another name, source, file, note or tolerances."""
        copy = self.with_()
        copy.__dict__["info"] = replace(self.info, **info)
        return copy

    def __repr__(self) -> str:
        values = ", ".join(f"{name}={_short(value)}" for name, value in self._values.items())
        return f"{type(self).__name__}({values})"

    def _repr_html_(self) -> str:
        from .. import html

        declared = type(self).declaration.parameters.items()
        known = {t.name: str(t) for t in self.info.tolerances}
        rows = []
        for name, p in declared:
            value = self._values[name]
            shown = value if np.ndim(value) == 0 else _short(value)
            rows.append(
                [name, shown, "" if p.unit == "1" else p.unit, p.meaning, *([known.get(name, "")] * bool(known))]
            )
        caption = f"{self.info.name or type(self).__name__} ({type(self).model_id()})"
        head = ("parameter", "value", "unit", "meaning", *(["tolerance"] * bool(known)))
        return html.table(rows, head, caption)


def _with_laws(cls: type[Model], laws: tuple[tuple[str, type[Part]], ...]) -> type[Model]:
    slots = {name: cls.declaration.slots[name].fitted(law, cls.model_id()) for name, law in laws}
    body = {"__module__": cls.__module__, "__doc__": cls.__doc__, "__qualname__": cls.__qualname__}
    return type(cls.__name__, (cls,), {**body, **slots, "_unfitted": cls, "_laws": MappingProxyType(dict(laws))})


def _restore(cls: Any, values: dict[str, Any], shared: dict[str, str], info: Info) -> Model:
    found: type[Model] = resolve(cls)
    model = object.__new__(found)
    model._fill(values, shared)
    model.__dict__["info"] = info
    return model


def _short(value: float | np.ndarray[Any, Any]) -> str:
    if isinstance(value, np.ndarray):
        return f"[{value[0]:.6g} ... {value[-1]:.6g}, {value.size} values]"
    return f"{value:.6g}"
