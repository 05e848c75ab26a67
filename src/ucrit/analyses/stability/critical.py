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
from typing import Any

import numpy as np

from ...core.contract.model import Model
from ...core.contract.possible import allowed
from ...core.errors import UcritError, near_match
from ...core.numeric.compiled import compiled, direction
from ...core.units import to_si
from ..linear.modes import Mode, mode_name, modes
from ..results.convert import Series, Table, Tabular
from .criteria import Boundary, criteria
from .exact import exact_search
from .scan import scan
from .wording import caveat, moving

NEAR = 1e-9
"""Share of a critical value by which a root through infinity is looked at beside it."""
LIGHT = 299_792_458.0
"""Speed of light [m/s]."""
GOING = {"flutter": "oscillation", "divergence": "divergence"}
"""How the mode goes that becomes unstable, by the kind of change."""
Edge = tuple[float, set[str]]


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

    @property
    def motion(self) -> str:
        """What flutters or diverges: ``sway``, ``yaw oscillation``, ``spin motion``."""
        return moving(self.mode)

    def __str__(self) -> str:
        at = f" at {self.frequency_hz:.4g} Hz" if self.frequency_hz else ""
        value = f"{self.parameter} = {self.value:.12g}{'' if self.unit == '1' else ' ' + self.unit}"
        kind = "root through infinity" if self.kind == "order" else self.kind
        return f"{value}: {kind} of the {self.motion}{at}, stable {self.stable}"

    def _repr_html_(self) -> str:
        from ..results import notebook

        return notebook.critical([self])


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

    def findings(self) -> dict[str, Any]:
        """Return whether none can be missing, and what the equations leave out where a law jumps or has a kink."""
        return {"exact": self.exact, "caveat": caveat(self.vehicle)}

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
        told = "\n".join(map(str, self.values)) or f"no critical value of {self.parameter} in the range"
        return told + (f"\n{left_out}" if (left_out := caveat(self.vehicle)) else "")

    def _repr_html_(self) -> str:
        from ..results import notebook

        return notebook.critical_values(self)


def critical(
    vehicle: Model, parameter: str | None = None, lower: float | str | None = None, upper: float | str | None = None
) -> CriticalValues:
    """Find every value of a parameter at which a vehicle's stability changes.

    Parameters
    ----------
    vehicle
        With scalar parameters.
    parameter
        The speed by default.
    lower, upper
        Range [SI, or text with a unit]; by default all that the parameter's bounds allow (for a speed, all of its
        present sign).

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
    found = exact_search(vehicle, name, lo, hi)
    exact = found is not None
    if found is None:
        found = scan(vehicle, name, lo, hi)
    edges, stable = found
    if type(vehicle).declaration.parameters[name].is_speed:
        edges, stable = _slower_than_light(edges, stable)
    values = tuple(
        _describe(vehicle, name, value, kinds, "below" if before else "above")
        for (value, kinds), before, after in zip(edges, stable, stable[1:], strict=False)
        if before != after
    )
    return CriticalValues(vehicle, name, lo, hi, values, stable[0], exact)


def _slower_than_light(edges: Sequence[Edge], stable: Sequence[bool]) -> tuple[Sequence[Edge], Sequence[bool]]:
    """Leave out speeds that no vehicle has: they come from terms that cancel but for the rounding of given numbers."""
    kept = [i for i, (value, _) in enumerate(edges) if abs(value) < LIGHT]
    first = kept[0] if kept else len(edges) if edges and edges[0][0] < 0 else 0
    return [edges[i] for i in kept], stable[first : first + len(kept) + 1]


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


def _range(vehicle: Model, name: str, lower: float | str | None, upper: float | str | None) -> tuple[float, float]:
    declared = allowed(vehicle, name)
    least, most = declared.lower, declared.upper
    if declared.is_speed:
        least, most = (max(least, 0.0), most) if direction(vehicle) > 0 else (least, min(most, 0.0))
    lo = least if lower is None else max(to_si(lower, declared.unit, name), least)
    hi = most if upper is None else min(to_si(upper, declared.unit, name), most)
    if not lo < hi:
        raise UcritError(
            f"{name}: the range from {lo:g} to {hi:g} {declared.unit} is empty; {name} must be {declared.allowed}"
        )
    return lo, hi


def _describe(vehicle: Model, name: str, value: float, kinds: set[str], stable: str) -> Critical:
    mode = _fastest_beside(vehicle, name, value, stable) if kinds == {"order"} else None
    mode = mode or crossing_mode(vehicle.with_(**{name: value}))
    kind = next(iter(kinds)) if len(kinds) == 1 else "flutter" if mode.oscillates else "divergence"
    closed = _closed_form(vehicle, name, value, kind)
    frequency = mode.frequency_hz if kind == "flutter" else 0.0
    unit = type(vehicle).declaration.parameters[name].unit
    called = mode_name(type(vehicle), mode.motion, GOING.get(kind, "motion"))
    return Critical(name, value, unit, kind, frequency, stable, called, closed)


def _fastest_beside(vehicle: Model, name: str, value: float, stable: str) -> Mode:
    """Return the mode that has run off to infinity at a value, as it is just beyond, on the unstable side."""
    beyond = NEAR * (abs(value) or 1.0)
    beside = vehicle.with_(**{name: value + beyond if stable == "below" else value - beyond})
    return max(modes(beside), key=lambda mode: abs(mode.eigenvalue))


def _closed_form(vehicle: Model, name: str, value: float, kind: str) -> Boundary | None:
    """Return the closed form that gives this value; a model of high order has none."""
    try:
        conditions = criteria(type(vehicle), direction=direction(vehicle)).conditions
    except UcritError:
        return None
    found = [b for c in conditions if c.failure == kind for b in c.boundaries if b.parameter == name]
    return next((b for b in found if _matches(b, vehicle, value)), None)


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
