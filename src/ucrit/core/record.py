"""What all results share: they compare by what they hold, arrays too, print short, and can be pickled and copied."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

MANY = 4
"""Entries above which an array or a collection is told by its ends or its size."""

LONG = 100
"""Characters above which a part of a result is told by its kind."""


class Record:
    """Base of frozen results: `dataclass` leaves alone the methods that it finds in the class, which are these."""

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        if issubclass(cls, tuple):  # which compare and print as tuples do
            return
        for name, method in {"__eq__": _equal, "__hash__": _hash, "__repr__": _told}.items():
            if name not in vars(cls):
                found = getattr(cls, name)
                setattr(cls, name, method if found in (None, getattr(object, name)) else found)

    def __getstate__(self) -> Any:
        """Return what is pickled and copied: the fields, not what was computed from them."""
        if not dataclasses.is_dataclass(self):
            return vars(self)
        fields: Any = _fields(self)
        state = {field.name: getattr(self, field.name) for field in fields}
        return {name: dict(value) if isinstance(value, MappingProxyType) else value for name, value in state.items()}


def _fields(record: Any) -> tuple[dataclasses.Field[Any], ...]:
    return dataclasses.fields(record)


def _equal(self: Any, other: Any) -> Any:
    if type(other) is not type(self):
        return NotImplemented
    names = [field.name for field in dataclasses.fields(self) if field.compare]
    return all(_same(getattr(self, name), getattr(other, name)) for name in names)


def _hash(self: Any) -> int:
    return hash((type(self), getattr(self, "vehicle", None)))


def _told(self: Any) -> str:
    shown = (field.name for field in dataclasses.fields(self) if field.repr)
    return f"{type(self).__qualname__}({', '.join(f'{name}={_brief(getattr(self, name))}' for name in shown)})"


def _same(one: Any, other: Any) -> bool:
    """Tell whether two values are equal, arrays entry by entry and nan to nan."""
    if one is other:
        return True
    if hasattr(one, "dtype") or hasattr(other, "dtype"):
        import numpy as np

        one, other = np.asarray(one), np.asarray(other)
        return np.array_equal(one, other, equal_nan=one.dtype.kind in "fc" and other.dtype.kind in "fc")
    if isinstance(one, Mapping) and isinstance(other, Mapping):
        return one.keys() == other.keys() and all(_same(one[key], other[key]) for key in one)
    if isinstance(one, tuple | list) and isinstance(other, tuple | list):
        return len(one) == len(other) and all(map(_same, one, other))
    if dataclasses.is_dataclass(one) and type(one) is type(other) and not isinstance(one, type):
        return bool(_equal(one, other))
    return bool(one == other or (one != one and other != other))


def _brief(value: Any) -> str:
    """Return a value in a few words."""
    if getattr(value, "shape", None) == ():
        return _number(value)
    if hasattr(value, "dtype"):
        if value.ndim == 1 and len(value) <= MANY:
            return f"[{', '.join(_number(x) for x in value)}]"
        ends = f"[{_number(value[0])} ... {_number(value[-1])}, {len(value)} values]" if value.ndim == 1 else ""
        return ends or f"[{' x '.join(map(str, value.shape))} values]"
    if isinstance(value, Mapping) and type(value).__repr__ in (dict.__repr__, object.__repr__):
        entries = ", ".join(f"{key!r}: {_brief(entry)}" for key, entry in value.items())
        return f"{{{entries}}}" if len(entries) <= LONG else f"{{{len(value)} entries}}"
    if type(value) in (tuple, list):
        entries = ", ".join(map(_brief, value))
        return f"({entries})" if len(entries) <= LONG else f"({len(value)} entries)"
    told = " ".join(repr(value).split()) if not isinstance(value, str) else repr(value)
    if len(told) <= LONG:
        return told
    return f"{type(value).__name__}(...)" if not isinstance(value, str) else f"{told[:LONG]}...'"


def _number(value: Any) -> str:
    return (
        f"{value:.6g}" if hasattr(value, "dtype") and value.dtype.kind in "fc" else repr(getattr(value, "item", str)())
    )
