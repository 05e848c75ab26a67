"""How well parameters are known: what a vehicle file says beside their values, kept out of every other analysis' way.

::

    [parameters]
    m = { value = 1500, sd = 20 }                           # normal, standard deviation
    a = { value = "1.2 m", min = "1.1 m", max = "1.4 m" }   # anything between, equally likely

    [correlations]
    m = { I_z = 0.8 }
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from ..errors import UcritError, near_match
from ..units import to_si
from .declare import Parameter

ENTRIES = ("value", "sd", "min", "max")


@dataclass(frozen=True)
class Tolerance:
    """How well one parameter is known, in SI units.

    Attributes
    ----------
    name
        The parameter.
    sd
        Standard deviation of a normal distribution around the value, 0 where there is none.
    low, high
        Ends of the values that are possible. Without a standard deviation all between are equally likely.
    """

    name: str
    sd: float = 0.0
    low: float = -math.inf
    high: float = math.inf

    def __str__(self) -> str:
        parts = [f"sd {self.sd:.6g}"] if self.sd else []
        ends = [math.isfinite(self.low), math.isfinite(self.high)]
        if all(ends):
            parts.append(f"from {self.low:.6g} to {self.high:.6g}")
        elif any(ends):
            parts.append(f"at least {self.low:.6g}" if ends[0] else f"at most {self.high:.6g}")
        return ", ".join(parts)

    def entry(self, value: float) -> str:
        """Return the parameter's entry in a vehicle file."""
        parts = [f"value = {value!r}"]
        parts += [f"sd = {self.sd!r}"] if self.sd else []
        parts += [f"min = {self.low!r}"] if math.isfinite(self.low) else []
        parts += [f"max = {self.high!r}"] if math.isfinite(self.high) else []
        return "{ " + ", ".join(parts) + " }"


@dataclass(frozen=True)
class Tolerances:
    """Tolerances of some parameters, and correlations of pairs of them (name, name, coefficient)."""

    entries: tuple[Tolerance, ...] = ()
    correlations: tuple[tuple[str, str, float], ...] = ()

    def __iter__(self) -> Iterator[Tolerance]:
        return iter(self.entries)

    def __len__(self) -> int:
        return len(self.entries)

    @property
    def names(self) -> tuple[str, ...]:
        """Parameters that have a tolerance, in declared order."""
        return tuple(t.name for t in self.entries)

    def of(self, name: str) -> Tolerance | None:
        """Return the tolerance of a parameter, ``None`` where it has none."""
        return next((t for t in self.entries if t.name == name), None)

    def to_dict(self) -> dict[str, Any]:
        """Return ``tolerances`` and ``correlations`` as plain data, without what is not given."""
        given = {t.name: {"sd": t.sd or None, "min": t.low, "max": t.high} for t in self.entries}
        return {
            "tolerances": {
                name: {k: v for k, v in ends.items() if v is not None and math.isfinite(v)}
                for name, ends in given.items()
            },
            "correlations": [list(pair) for pair in self.correlations],
        }

    def around(self, values: Mapping[str, Any]) -> Tolerances:
        """Return the tolerances whose range holds the parameter's value, which may have been changed since."""
        entries = tuple(t for t in self.entries if t.low <= values[t.name] <= t.high)
        names = {t.name for t in entries}
        return Tolerances(entries, tuple(c for c in self.correlations if {c[0], c[1]} <= names))

    def groups(self) -> list[tuple[str, ...]]:
        """Return the parameters in groups that are independent of one another."""
        group = {name: {name} for name in self.names}
        for one, other, _ in self.correlations:
            joined = group[one] | group[other]
            group.update(dict.fromkeys(joined, joined))
        found: list[tuple[str, ...]] = []
        for name in self.names:
            members = tuple(key for key in self.names if key in group[name])
            if members not in found:
                found.append(members)
        return found


def read_tolerances(parameters: Mapping[str, Any], correlations: Any, model: Any) -> tuple[dict[str, Any], Tolerances]:
    """Split the entries of a vehicle file into values and tolerances.

    Parameters
    ----------
    parameters
        Entries of ``[parameters]``: numbers, texts with a unit, or tables with ``value`` and a tolerance.
    correlations
        The table ``[correlations]``: for some parameters a table of others and coefficients.
    model
        The model's class.

    Raises
    ------
    UcritError
        One sentence about the first thing that is wrong.
    """
    declared: Mapping[str, Parameter] = model.declaration.parameters
    values, entries = dict(parameters), {}
    for name, given in parameters.items():
        if isinstance(given, dict) and name in declared:
            values[name], entries[name] = _entry(given, declared[name], model.model_id())
    ordered = tuple(entries[name] for name in declared if name in entries)
    return values, Tolerances(ordered, _correlations(correlations, [t.name for t in ordered], model.model_id()))


def _entry(given: dict[str, Any], parameter: Parameter, model: str) -> tuple[float, Tolerance]:
    thing = f"{model}: {parameter.meaning} {parameter.name}"
    for key in given:
        if key not in ENTRIES:
            raise UcritError(f"{thing}: there is no entry '{key}'{near_match(key, ENTRIES)}")
    if "value" not in given:
        raise UcritError(f"{thing}: a tolerance stands beside a value: {{ value = ..., sd = ... }}")
    if parameter.is_speed:
        raise UcritError(f"{thing} has no tolerance: stability is judged at every speed")
    if ("min" in given) != ("max" in given) or not given.keys() - {"value"}:
        raise UcritError(f"{thing}: a tolerance is sd = ..., or min = ... and max = ..., or all three")
    value = float(parameter.check(given["value"], model))
    unit = "" if parameter.unit == "1" else f" {parameter.unit}"
    sd = to_si(given["sd"], parameter.unit, f"{thing}: sd") if "sd" in given else 0.0
    if "sd" in given and not (0 < sd < math.inf):
        raise UcritError(f"{thing}: sd must be above 0{unit} and finite, got {sd:g}")
    if "min" not in given:
        return value, Tolerance(parameter.name, sd)
    low, high = (float(parameter.check(given[key], f"{model}, {key}")) for key in ("min", "max"))
    if not low < high:
        raise UcritError(f"{thing}: min must be below max, got {low:g} and {high:g}{unit}")
    if not low <= value <= high:
        raise UcritError(f"{thing}: the value {value:g} lies outside its range from {low:g} to {high:g}{unit}")
    return value, Tolerance(parameter.name, sd, low, high)


def _correlations(given: Any, names: list[str], model: str) -> tuple[tuple[str, str, float], ...]:
    if not isinstance(given, dict) or not all(isinstance(row, dict) for row in given.values()):
        raise UcritError(f"{model}: correlations are written as m = {{ I_z = 0.8 }}, got {given!r}")
    found: dict[frozenset[str], tuple[str, str, float]] = {}
    for one, row in given.items():
        for other, rho in row.items():
            for name in (one, other):
                if name not in names:
                    raise UcritError(f"{model}: '{name}' has no tolerance to be correlated{near_match(name, names)}")
            pair = f"the correlation of {one} and {other}"
            number = isinstance(rho, int | float) and not isinstance(rho, bool)
            if one == other or not number or not -1 < rho < 1:
                raise UcritError(f"{model}: {pair} must be a number between -1 and 1 for two parameters, got {rho!r}")
            if frozenset((one, other)) in found:
                raise UcritError(f"{model}: {pair} is given twice")
            found[frozenset((one, other))] = (one, other, float(rho))
    return tuple(found.values())


def write_correlations(tolerances: Tolerances) -> list[str]:
    """Return the lines of a vehicle file that tell correlations."""
    rows: dict[str, list[str]] = {}
    for one, other, rho in tolerances.correlations:
        rows.setdefault(one, []).append(f"{other} = {rho!r}")
    return ["", "[correlations]", *(f"{one} = {{ {', '.join(row)} }}" for one, row in rows.items())] if rows else []
