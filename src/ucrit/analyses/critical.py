"""Critical values of a parameter: where stability is gained or lost, how, and at what frequency.

At a change of stability either a_0 vanishes (a real root passes through zero: divergence), or the last but one
Hurwitz determinant (a pair passes through the imaginary axis: flutter), or a_n (a root passes through infinity).
Where the characteristic polynomial is a polynomial in the parameter, so are these, with rational coefficients for the
given numbers; all their roots are isolated and counted exactly.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import zip_longest
from typing import Any

import numpy as np

from ..core.compiled import compiled, direction
from ..core.errors import UcritError, near_match
from ..core.model import Model
from ..numerics.determinants import hurwitz_polynomial
from ..numerics.exact import interpolate
from ..numerics.real_roots import real_roots
from ..numerics.routh import routh
from .convert import Series, Table, Tabular
from .criteria import Boundary, criteria
from .modes import Mode, modes
from .scan import scan

Polynomial = list[Fraction]


@dataclass(frozen=True)
class Critical:
    """One value of a parameter at which a vehicle becomes stable or unstable.

    Attributes
    ----------
    parameter, value, unit
        Which parameter, its critical value in SI units, and the unit.
    kind
        ``"divergence"`` (a real root through zero), ``"flutter"`` (a pair through the imaginary axis) or ``"order"``
        (a root through infinity).
    frequency_hz
        Frequency [Hz] of the motion on the boundary; 0 for a divergence.
    stable
        ``"below"`` or ``"above"`` the value.
    mode
        Name of the motion that becomes unstable.
    closed_form
        The value as an expression, where the criterion has one.
    """

    parameter: str
    value: float
    unit: str
    kind: str
    frequency_hz: float
    stable: str
    mode: str
    closed_form: Boundary | None = None

    def __float__(self) -> float:
        return self.value

    def __str__(self) -> str:
        at = f" at {self.frequency_hz:.4g} Hz" if self.frequency_hz else ""
        return f"{self.parameter} = {self.value:.12g} {self.unit}: {self.kind} of the {self.mode}{at}, stable {self.stable}"


@dataclass(frozen=True)
class CriticalValues(Tabular):
    """All critical values of one parameter in a range, ascending.

    ``exact`` tells whether they were counted exactly, so that none can be missing, or searched for numerically.
    """

    vehicle: Model
    parameter: str
    lower: float
    upper: float
    values: tuple[Critical, ...]
    stable_at_lower: bool
    exact: bool

    def __iter__(self) -> Iterator[Critical]:
        return iter(self.values)

    def __len__(self) -> int:
        return len(self.values)

    def __getitem__(self, index: int) -> Critical:
        return self.values[index]

    def stable_ranges(self) -> list[tuple[float, float]]:
        """Return the open intervals of the parameter on which the vehicle is stable."""
        edges = [self.lower, *(c.value for c in self.values), self.upper]
        stable = [self.stable_at_lower]
        for _ in self.values:
            stable.append(not stable[-1])
        return [(a, b) for a, b, good in zip(edges, edges[1:], stable, strict=False) if good]

    def table(self) -> Table:
        """Return one row for each critical value: value, kind, frequency, the stable side and the mode."""
        numbers = np.arange(1, len(self.values) + 1)
        unit = type(self.vehicle).declaration.parameters[self.parameter].unit
        rows = ("number",)
        data = (
            Series(self.parameter, rows, np.array([c.value for c in self.values], dtype=float), unit),
            Series("kind", rows, np.array([c.kind for c in self.values], dtype=str)),
            Series("frequency", rows, np.array([c.frequency_hz for c in self.values], dtype=float), "Hz"),
            Series("stable", rows, np.array([c.stable for c in self.values], dtype=str)),
            Series("mode", rows, np.array([c.mode for c in self.values], dtype=str)),
        )
        return Table("critical values", self.vehicle, (Series("number", rows, numbers),), data, rows)

    def __str__(self) -> str:
        return "\n".join(map(str, self.values)) or f"no critical value of {self.parameter} in the range"

    def _repr_html_(self) -> str:
        return "<ul>" + "".join(f"<li>{c}</li>" for c in self.values) + "</ul>" if self.values else str(self)


def critical(
    vehicle: Model, parameter: str | None = None, lower: float | None = None, upper: float | None = None
) -> CriticalValues:
    """Find every value of a parameter at which a vehicle's stability changes.

    Parameters
    ----------
    vehicle
        With scalar parameters.
    parameter
        The speed by default.
    lower, upper
        Range [SI]; by default all that the parameter's bounds allow (for a speed, all of its present sign).

    Returns
    -------
    CriticalValues
        Values correct to 12 significant digits for the given numbers (exactly rounded where ``exact``).

    Raises
    ------
    UcritError
        If there is no such parameter or the range is empty.

    Examples
    --------
    >>> from ucrit import critical, load
    >>> [c.kind for c in critical(load("caravan"))]
    ['flutter']
    """
    name = parameter_name(vehicle, parameter)
    if vehicle.dims:
        raise UcritError("critical values are found for one vehicle at a time: give scalar parameters, or use sweep")
    lo, hi = _range(vehicle, name, lower, upper)
    found = _exact(vehicle, name, lo, hi)
    exact = found is not None
    if found is None:
        found = scan(vehicle, name, lo, hi)
    edges, stable = found
    values = tuple(
        _describe(vehicle, name, value, kinds, "below" if before else "above")
        for (value, kinds), before, after in zip(edges, stable, stable[1:], strict=False)
        if before != after
    )
    return CriticalValues(vehicle, name, lo, hi, values, stable[0], exact)


def parameter_name(vehicle: Model, parameter: str | None) -> str:
    """Return the name of a parameter, the speed by default; one that is not declared is refused."""
    declared = type(vehicle).declaration
    name = parameter or declared.speed
    if name is None:
        raise UcritError(f"{type(vehicle).model_id()} has no speed: name the parameter whose critical values are asked")
    if name not in declared.parameters:
        raise UcritError(
            f"{type(vehicle).model_id()}: there is no parameter '{name}'{near_match(name, declared.parameters)}"
        )
    return name


def _range(vehicle: Model, name: str, lower: float | None, upper: float | None) -> tuple[float, float]:
    declared = type(vehicle).declaration.parameters[name]
    least, most = declared.lower, declared.upper
    if declared.is_speed:
        least, most = (max(least, 0.0), most) if direction(vehicle) > 0 else (least, min(most, 0.0))
    lo = least if lower is None else max(float(lower), least)
    hi = most if upper is None else min(float(upper), most)
    if not lo < hi:
        raise UcritError(
            f"{name}: the range from {lo:g} to {hi:g} {declared.unit} is empty; {name} must be {declared.allowed}"
        )
    return lo, hi


def coefficient_polynomials(vehicle: Model, name: str) -> list[Polynomial] | None:
    """Return the characteristic coefficients as exact polynomials in one parameter, without structural zeros.

    ``None`` where they are no polynomials in it.
    """
    functions = compiled(type(vehicle), direction(vehicle))
    degrees = functions.degrees(name)
    if degrees is None:
        return None
    arguments = {key: Fraction(float(value)) for key, value in vehicle.values.items()}
    nodes = [Fraction(k) for k in range(max(degrees) + 1)]
    rows = [functions.exact_coefficients([*{**arguments, name: node}.values()]) for node in nodes]
    columns = list(zip(*rows, strict=True))[functions.structural_zeros :]
    return [interpolate(nodes, [Fraction(v) for v in column]) for column in columns]


def _exact(vehicle: Model, name: str, lo: float, hi: float) -> Any:
    """Return boundary values with the kinds that meet there, and the stability of the intervals between."""
    a = coefficient_polynomials(vehicle, name)
    if a is None:
        return None
    if len(a) > 2 and not any(any(p) for p in a[1::2]):
        a = _undamped(a)
    boundaries = {"divergence": a[0], "order": a[-1]}
    if len(a) > 2:
        boundaries["flutter"] = hurwitz_polynomial(a)
    if not all(any(p) for p in boundaries.values()):
        return None
    edges: dict[float, set[str]] = {}
    for kind, p in boundaries.items():
        for value, _ in real_roots(p, lo, hi) if len(p) > 1 else ():
            if lo < value < hi:
                edges.setdefault(value, set()).add(kind)
    values = sorted(edges)
    samples = [_between(x, y) for x, y in zip([lo, *values], [*values, hi], strict=True)]
    return [(v, edges[v]) for v in values], [_is_stable(a, sample) for sample in samples]


def _undamped(a: list[Polynomial]) -> list[Polynomial]:
    """Return p + p' for an even p: stable if and only if p has simple roots on the imaginary axis only."""
    slopes: list[Polynomial] = [*([(k + 1) * c for c in p] for k, p in enumerate(a[1:])), []]
    return [[x + y for x, y in zip_longest(p, q, fillvalue=Fraction(0))] for p, q in zip(a, slopes, strict=True)]


def _between(lo: float, hi: float) -> Fraction:
    if math.isinf(lo) and math.isinf(hi):
        return Fraction(0)
    if math.isinf(lo):
        return Fraction(hi) - 1 - abs(Fraction(hi))
    if math.isinf(hi):
        return Fraction(lo) + 1 + abs(Fraction(lo))
    return (Fraction(lo) + Fraction(hi)) / 2


def _is_stable(a: Sequence[Polynomial], at: Fraction) -> bool:
    numbers = [sum((c * at**k for k, c in enumerate(p)), Fraction(0)) for p in a]
    if not numbers[-1]:
        return False
    array = routh(numbers)
    return array.right_half_plane == 0 and array.imaginary_axis == 0


def _describe(vehicle: Model, name: str, value: float, kinds: set[str], stable: str) -> Critical:
    mode = crossing_mode(vehicle.with_(**{name: value}))
    kind = next(iter(kinds)) if len(kinds) == 1 else "flutter" if mode.oscillates else "divergence"
    closed = _closed_form(vehicle, name, value, kind)
    frequency = mode.frequency_hz if kind == "flutter" else 0.0
    unit = type(vehicle).declaration.parameters[name].unit
    return Critical(name, value, unit, kind, frequency, stable, mode.name.rpartition(" ")[0] + _going(kind), closed)


def _closed_form(vehicle: Model, name: str, value: float, kind: str) -> Boundary | None:
    """Return the closed form that gives this value; a model of high order has none."""
    try:
        conditions = criteria(type(vehicle), direction=direction(vehicle)).conditions
    except UcritError:
        return None
    found = [c.boundary(name) for c in conditions if c.failure == kind]
    return next((b for b in reversed(found) if b and _matches(b, vehicle, value)), None)


def _going(kind: str) -> str:
    return {"flutter": " oscillation", "divergence": " divergence"}.get(kind, " motion")


def crossing_mode(vehicle: Model) -> Mode:
    """Return the mode nearest to the imaginary axis, rigid positions left out."""
    zeros = compiled(type(vehicle), direction(vehicle)).structural_zeros
    found = sorted(modes(vehicle), key=lambda mode: abs(mode.eigenvalue))
    return min(found[zeros:] or found, key=lambda mode: abs(mode.eigenvalue.real))


def _matches(boundary: Boundary, vehicle: Model, value: float) -> bool:
    """Tell whether a closed form gives this value; a criterion may have one for each of its factors."""
    code = compile(boundary.expression, "<closed form>", "eval")
    names = {k: float(v) for k, v in vehicle.values.items()}
    with np.errstate(all="ignore"):
        try:
            result = eval(
                code,
                {"__builtins__": {}, "sqrt": math.sqrt, "cos": math.cos, "sin": math.sin, "tan": math.tan},
                names,
            )
        except (ZeroDivisionError, ValueError):
            return False
    return math.isclose(result, value**boundary.power, rel_tol=1e-9)
