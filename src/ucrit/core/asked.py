"""Arguments of the public functions: a wrong one is refused in a sentence, by what the function's signature says.

One place for all of them: `ucrit` hands out each of its functions wrapped by `asked`. Inside the package the functions
themselves are called.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from functools import cache, wraps
from numbers import Integral, Real
from typing import TYPE_CHECKING, Any, NamedTuple

from .errors import UcritError, near_match

if TYPE_CHECKING:
    from inspect import Parameter

LONGEST = 60
"""Values are told with so many characters at most."""

VEHICLE = "a vehicle, as load() gives"


class Kind(NamedTuple):
    """One alternative of an annotation: how it is called, and whether a value is of it."""

    words: str
    fits: Callable[[Any], bool]


def asked(function: Callable[..., Any], name: str) -> Callable[..., Any]:
    """Return a public function that refuses wrong arguments; ``name`` is what it is called in `ucrit`.

    Raises `TypeError` for arguments that the function does not have or lacks, `UcritError` for values of a kind that
    its annotations do not name, and for numbers that are not one.

    >>> def half(speed: float | str, twice: bool = False): return speed / 2
    >>> asked(half, "half")(speeed=3)
    Traceback (most recent call last):
    TypeError: half() has no argument 'speeed'; did you mean 'speed'?
    >>> asked(half, "half")([3])
    Traceback (most recent call last):
    ucrit.core.errors.UcritError: half: speed must be a number or a text, got [3]
    """

    @wraps(function)
    def ask(*args: Any, **named: Any) -> Any:
        args, named = _checked(function, name, args, named)
        try:
            return function(*args, **named)
        except ValueError as error:  # numerics, below this layer, has no error of its own
            if isinstance(error, UcritError) or not function.__module__.startswith("ucrit.numerics"):
                raise
            raise UcritError(f"{name}: {error}") from None

    ask.__module__, ask.__qualname__ = "ucrit", name  # found again there by pickle
    return ask


def asked_class(cls: type, name: str) -> type:
    """Let a public class refuse names of arguments that it does not have, as `asked` does; its values it checks itself.

    >>> from dataclasses import dataclass
    >>> @dataclass
    ... class Push: size: float
    >>> asked_class(Push, "Push")(sise=3)
    Traceback (most recent call last):
    TypeError: Push() has no argument 'sise'; did you mean 'size'?
    """
    make = cls.__init__  # type: ignore[misc]

    @wraps(make)
    def init(self: Any, *args: Any, **named: Any) -> None:
        if type(self) is cls:
            _refuse_names(cls, name, args, named)
        make(self, *args, **named)

    cls.__init__ = init  # type: ignore[misc]
    return cls


def _checked(
    function: Callable[..., Any], name: str, args: tuple[Any, ...], named: dict[str, Any]
) -> tuple[tuple[Any, ...], dict[str, Any]]:
    _refuse_names(function, name, args, named)
    declared, several, rest = _parameters(function)
    by_name = {p.name: p for p in declared if p.kind is not p.POSITIONAL_ONLY}
    places = [p for p in declared if p.kind is not p.KEYWORD_ONLY]
    one_by_one = tuple(_read(name, places[i] if i < len(places) else several, value) for i, value in enumerate(args))
    return one_by_one, {key: _read(name, by_name.get(key, rest), value, key) for key, value in named.items()}


def _refuse_names(function: Callable[..., Any], name: str, args: tuple[Any, ...], named: dict[str, Any]) -> None:
    """Refuse arguments that are too many, unknown or lacking."""
    declared, several, rest = _parameters(function)
    if len(args) > len(declared) and several is None:
        most = sum(p.kind is not p.KEYWORD_ONLY for p in declared)
        raise TypeError(f"{name}() takes {most} arguments without a name at most, got {len(args)}")
    for key in named:
        if rest is None and key not in {p.name for p in declared}:
            raise TypeError(f"{name}() has no argument '{key}'{near_match(key, [p.name for p in declared])}")
    places = [p for p in declared if p.kind is not p.KEYWORD_ONLY]
    lacking = [
        p.name
        for i, p in enumerate(declared)
        if p.default is p.empty and p.name not in named and not (p in places and i < len(args))
    ]
    if lacking:
        raise TypeError(f"{name}() lacks the argument '{lacking[0]}'")


@cache
def _parameters(function: Callable[..., Any]) -> tuple[list[Parameter], Parameter | None, Parameter | None]:
    """Return the parameters of a function: those with a name, that of ``*several`` and that of ``**rest``."""
    from inspect import signature

    everything = list(signature(function).parameters.values())
    several = next((p for p in everything if p.kind is p.VAR_POSITIONAL), None)
    rest = next((p for p in everything if p.kind is p.VAR_KEYWORD), None)
    return [p for p in everything if p is not several and p is not rest], several, rest


def _read(function: str, parameter: Parameter | None, value: Any, key: str = "") -> Any:
    """Return a value as a function takes it, or refuse it."""
    if parameter is None or value is parameter.default:
        return value
    kinds = _kinds(str(parameter.annotation))
    if kinds is None:
        return value
    if getattr(value, "shape", None) == () and hasattr(value, "item"):
        value = value.item()  # an array of no dimension is a number
    if any(kind.fits(value) for kind in kinds):
        return value
    known = " or ".join(dict.fromkeys(kind.words for kind in kinds if kind.words))
    raise UcritError(f"{function}: {key or parameter.name} must be {known}, got {_short(value)}{_hint(value, kinds)}")


def _short(value: Any) -> str:
    if isinstance(value, type):
        return f"the class {value.__name__}"
    try:
        told = " ".join(repr(value).split())
    except ValueError:  # whole numbers of more than 4300 digits
        told = "a number beyond 1.8e308"
    return told if len(told) <= LONGEST else f"{told[: LONGEST - 4]} ..."


def _hint(value: Any, kinds: Iterable[Kind]) -> str:
    wants_vehicle = any(kind.words == VEHICLE for kind in kinds)
    return f"; load({value!r}) reads one" if wants_vehicle and isinstance(value, str) and len(value) < LONGEST else ""


@cache
def _kinds(annotation: str) -> tuple[Kind, ...] | None:
    """Return the alternatives of an annotation, ``None`` where one of them takes anything."""
    found = [_kind(part) for part in _alternatives(annotation)]
    return None if None in found else tuple(kind for kind in found if kind is not None)


def _alternatives(annotation: str) -> list[str]:
    """Split at each ``|`` outside brackets.

    >>> _alternatives("Mapping[str, float | str] | None")
    ['Mapping[str, float | str]', 'None']
    """
    parts, depth = [""], 0
    for character in annotation:
        depth += {"[": 1, "]": -1}.get(character, 0)
        if character == "|" and not depth:
            parts.append("")
        else:
            parts[-1] += character
    return [part.strip() for part in parts]


def _kind(part: str) -> Kind | None:
    if part in PLAIN:
        return PLAIN[part]
    head, _, inner = part.partition("[")
    if head in ("Sequence", "Iterable") and inner == "str]":
        return Kind("texts in a list", _are_texts)
    if head == "type":
        return Kind(
            f"a class derived from {inner[:-1]}", lambda value: isinstance(value, type) and _is(value, inner[:-1])
        )
    if head in ("Mapping", "Callable"):
        return PLAIN[head]
    if part.isidentifier() and part[0].isupper() and part not in ALIASES:
        return Kind(f"a {part}", lambda value: _is(type(value), part))
    return None


def _is(cls: type, name: str) -> bool:
    return any(base.__name__ == name for base in cls.__mro__)


def _is_number(value: Any) -> bool:
    if isinstance(value, bool) or not isinstance(value, Real):
        return False
    try:
        return not math.isnan(float(value))
    except OverflowError:
        return False


def _is_whole(value: Any) -> bool:
    return isinstance(value, Integral) and not isinstance(value, bool)


def _are_numbers(value: Any) -> bool:
    """Tell whether a value makes an array of numbers, at least one, none of them missing."""
    import numpy as np

    if isinstance(value, (str, bytes, Mapping, set, frozenset)) or not (_is_number(value) or hasattr(value, "__len__")):
        return False
    try:
        array = np.asarray(value)
        if array.dtype.kind not in "iuf" and not all(_is_number(x) for x in array.ravel()):
            return False
        array = array.astype(float)
    except (TypeError, ValueError, OverflowError):
        return False
    return bool(array.size) and not np.isnan(array).any()


def _are_two_numbers(value: Any) -> bool:
    return hasattr(value, "__len__") and len(value) == 2 and all(map(_is_number, value))


def _is_path(value: Any) -> bool:
    return hasattr(value, "__fspath__") and isinstance(value.__fspath__(), str)


def _are_texts(value: Any) -> bool:
    return hasattr(value, "__len__") and not isinstance(value, bytes) and all(isinstance(x, str) for x in value)


PLAIN = {
    "None": Kind("", lambda value: value is None),
    "bool": Kind("True or False", lambda value: isinstance(value, bool)),
    "int": Kind("a whole number", _is_whole),
    "float": Kind("a number", _is_number),
    "str": Kind("a text", lambda value: isinstance(value, str)),
    "os.PathLike[str]": Kind("a path", _is_path),
    "Path": Kind("a path", _is_path),
    "Sequence[float]": Kind("a list of numbers", _are_numbers),
    "Array": Kind("a list of numbers", _are_numbers),
    "ArrayLike": Kind("a list of numbers", _are_numbers),
    "npt.NDArray[Any]": Kind("a list of numbers", _are_numbers),
    "tuple[float, float]": Kind("two numbers", _are_two_numbers),
    "Mapping": Kind(
        "a dictionary of names and values",
        lambda value: isinstance(value, Mapping) and all(isinstance(key, str) for key in value),
    ),
    "Callable": Kind("a function", callable),
    "Progress": Kind("a function", callable),
    "Model": Kind(VEHICLE, lambda value: _is(type(value), "Model")),
    "Graph": Kind("a bond graph", lambda value: _is(type(value), "Graph")),
}
"""What annotations name, in words, and how it is recognised."""

ALIASES = ("Any", "Given", "Value", "Shape")
"""Annotations that stand for more than one kind."""
