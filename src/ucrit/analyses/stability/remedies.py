"""Remedies: the smallest change of one parameter alone that makes a vehicle stable up to a given speed."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any, Self

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ...core.contract.possible import allowed
from ...core.errors import UcritError
from ...core.numeric.compiled import compiled, deciding_coefficients, direction
from ...core.units import to_si
from ...numerics.hurwitz import stable
from ..results.convert import Series, Table, Tabular
from ..results.digits import decimal_text, rounded
from .critical import critical
from .judge import judge

Array = npt.NDArray[Any]

SPEEDS = 129
"""Speeds at which a changed vehicle is tried."""

EXACT_ORDER = 8
"""Order up to which the result is checked for all speeds exactly; above, at `FINE_SPEEDS` speeds."""

FINE_SPEEDS = 2001

MAGNITUDES = np.logspace(-3, 3, 121)
"""Changes that are tried, relative to the present value."""

BEYOND = 1e-9
"""A remedy lies this far, relatively, inside the stable side, so that applying it works."""


@dataclass(frozen=True)
class Remedy:
    """What to do to one parameter.

    Attributes
    ----------
    parameter, unit, meaning
        Which parameter.
    present
        Its value now [SI].
    value
        The value at which the vehicle becomes stable, ``None`` if changing this parameter alone never does.
    relative
        ``(value - present)/|present|``; infinite where the present value is zero.
    """

    parameter: str
    unit: str
    meaning: str
    present: float
    value: float | None
    relative: float

    def told(self) -> tuple[str, str]:
        """Return ``"at least"`` or ``"at most"``, and six digits of the value, rounded to the side that helps."""
        if self.value is None:
            return "no value helps", ""
        rising = self.value > self.present
        return "at least" if rising else "at most", decimal_text(rounded(self.value, 6, 1 if rising else -1))

    def __str__(self) -> str:
        if self.value is None:
            return f"{self.parameter}: no value helps"
        word, value = self.told()
        share = f" ({self.relative:+.1%})" if math.isfinite(self.relative) else ""
        unit = "" if self.unit == "1" else f" {self.unit}"
        return f"{self.parameter}: {word} {value}{unit} instead of {self.present:.6g}{share}"

    def _repr_html_(self) -> str:
        from ..results import notebook

        return notebook.remedies([self])


class Remedies(tuple[Remedy, ...], Tabular):
    """The remedies for one vehicle: a tuple that a notebook shows as a table.

    Attributes
    ----------
    vehicle
        The vehicle as it is.
    """

    vehicle: Model

    def __new__(cls, vehicle: Model, found: Iterable[Remedy] = ()) -> Self:
        """Return the remedies that were found for a vehicle."""
        made = super().__new__(cls, found)
        made.vehicle = vehicle
        return made

    def __reduce__(self) -> Any:
        return Remedies, (self.vehicle, tuple(self))

    def table(self) -> Table:
        """Return one row for each parameter, with its unit; a value that does not exist is nan."""
        rows = ("parameter",)
        texts = {
            name: np.array([getattr(r, name) for r in self], dtype=str) for name in ("parameter", "unit", "meaning")
        }
        value = np.array([math.nan if r.value is None else r.value for r in self], dtype=float)
        data = (
            Series("present", rows, np.array([r.present for r in self], dtype=float)),
            Series("value", rows, value),
            Series("relative", rows, np.array([r.relative for r in self], dtype=float), "1"),
            Series("unit", rows, texts["unit"]),
            Series("meaning", rows, texts["meaning"]),
        )
        return Table("remedies", self.vehicle, (Series("parameter", rows, texts["parameter"]),), data, rows)

    def __str__(self) -> str:
        return "\n".join(map(str, self)) or "nothing to remedy"

    def _repr_html_(self) -> str:
        from ..results import notebook

        return notebook.remedies(self)


def remedies(vehicle: Model, upto: float | str | None = None, since: float | str = 0.0) -> Remedies:
    """Find, for each parameter, the smallest change of it alone that makes the vehicle stable at all speeds up to one.

    Parameters
    ----------
    vehicle
        With scalar parameters.
    upto
        Speed [m/s, or text with a unit] up to which it shall be stable; its own speed by default.
    since
        Speed [m/s, or text with a unit] from which it shall be; for vehicles such as two-wheelers that cannot be at a
        standstill.

    Returns
    -------
    Remedies
        A tuple of `Remedy`. The smallest relative change first; parameters that cannot help last. Empty if the vehicle
        is stable already.
        Without a speed, stability at the one operating point is meant.

    Notes
    -----
    Each parameter is varied from a thousandth to a thousand times its value. The boundary is found to 1e-9 relative
    on a grid of speeds, and moved on where the exact critical speeds of the changed vehicle say so (above order 8,
    where 2,001 speeds do).
    """
    if vehicle.dims:
        raise UcritError("remedies are for one vehicle: give scalar parameters")
    declared = type(vehicle).declaration
    name = declared.speed
    speeds = None if name is None else _speeds(vehicle, name, upto, since)
    if _stable(vehicle, speeds):
        return Remedies(vehicle)
    found = [_remedy(vehicle, key, speeds) for key in declared.parameters if key != name]
    return Remedies(vehicle, sorted(found, key=lambda r: (r.value is None, abs(r.relative))))


def _speeds(vehicle: Model, name: str, upto: float | str | None, since: float | str) -> Array:
    top = float(vehicle.values[name]) if upto is None else to_si(upto, "m/s", "upto")
    since = to_si(since, "m/s", "since")
    type(vehicle).declaration.parameters[name].check(top, type(vehicle).model_id())
    if not abs(since) < abs(top):
        raise UcritError(f"the speeds from {since:g} to {top:g} m/s are an empty range")
    return np.asarray(since + (top - since) * np.linspace(0, 1, SPEEDS + 1)[1:])


def _grid_stable(vehicle: Model, key: str, values: Array, speeds: Array | None) -> Array:
    """Return which values of a parameter make the vehicle stable at all given speeds; impossible values do not."""
    possible = allowed(vehicle, key).allows(values)
    changes: dict[str, Any] = {key: np.where(possible, values, vehicle.values[key])}
    name = type(vehicle).declaration.speed
    if speeds is not None and name is not None:
        changes[name] = speeds
    changed = vehicle.with_(**changes)
    with np.errstate(all="ignore"):
        found = stable(deciding_coefficients(changed))  # only searches: what is told is judged by `_stable`
    good = np.broadcast_to(found, [len(d) for d in changed.dims.values()])
    axis = list(changed.dims).index(key)
    return np.asarray(good.all(axis=tuple(i for i in range(good.ndim) if i != axis)) & possible)


def _stable(vehicle: Model, speeds: Array | None) -> bool:
    """Tell whether a vehicle is stable at every speed of a range, by its exact critical speeds."""
    name = type(vehicle).declaration.speed
    if speeds is None or name is None:
        return _stable_now(vehicle)
    tested = vehicle.with_(**{name: speeds[-1]})
    if compiled(type(vehicle), direction(tested)).order > EXACT_ORDER:
        fine = speeds[0] + (speeds[-1] - speeds[0]) * np.linspace(0, 1, FINE_SPEEDS)
        return bool(judge(vehicle.with_(**{name: fine})).all())
    lo, hi = sorted((2 * speeds[0] - speeds[1], speeds[-1]))
    changes = critical(tested, name, lo, hi)
    return not len(changes) and changes.stable_at_lower and _stable_now(tested)


def _stable_now(vehicle: Model) -> bool:
    return bool(judge(vehicle).all())


def _remedy(vehicle: Model, key: str, speeds: Array | None) -> Remedy:
    parameter = type(vehicle).declaration.parameters[key]
    present = float(vehicle.values[key])
    blank = Remedy(key, parameter.unit, parameter.meaning, present, None, math.inf)
    scale = abs(present) or _scale(vehicle, key, speeds)
    if not scale:
        return blank
    options = []
    for sense in (1.0, -1.0):
        value = _nearest(vehicle, key, present, sense * scale, speeds)
        if value is not None:
            options.append(value)
    if not options:
        return blank
    value = min(options, key=lambda v: abs(v - present))
    relative = (value - present) / abs(present) if present else math.inf
    return replace(blank, value=value, relative=relative)


def _scale(vehicle: Model, key: str, speeds: Array | None) -> float:
    """Size of a parameter that is zero now: that of its smallest critical value at the highest speed."""
    name = type(vehicle).declaration.speed
    at = vehicle if speeds is None or name is None else vehicle.with_(**{name: float(speeds[-1])})
    return min((abs(c.value) for c in critical(at, key) if c.value), default=0.0)


def _nearest(vehicle: Model, key: str, present: float, step: float, speeds: Array | None) -> float | None:
    """Return the stable value nearest to the present one in one direction, or None."""
    with np.errstate(all="ignore"):  # values that are not finite are not allowed
        values = present + step * _offsets(vehicle, key, present, step)
    good = _grid_stable(vehicle, key, values, speeds)
    for first in np.flatnonzero(good & ~np.r_[False, good[:-1]]):
        edge = _bisect(vehicle, key, values[first - 1] if first else present, values[first], speeds)
        for margin in (BEYOND, 1e-6, 1e-4, 1e-2):
            value = edge + margin * (edge - present)
            if _allowed(vehicle, key, value) and _stable(vehicle.with_(**{key: value}), speeds):
                return float(value)
    return None


def _offsets(vehicle: Model, key: str, present: float, step: float) -> Array:
    """Relative changes to try; those of a positive parameter that shrinks end just above zero."""
    lower = allowed(vehicle, key).lower
    if step < 0 and math.isfinite(lower) and present > lower:
        room = (present - lower) / -step
        return np.asarray(room * (1 - np.logspace(0, -3, 122)[1:]))
    return MAGNITUDES


def _bisect(vehicle: Model, key: str, bad: float, good: float, speeds: Array | None) -> float:
    """Return the boundary between an unstable and a stable value, on the stable side, by 32-fold section."""
    for _ in range(9):
        points = np.linspace(bad, good, 33)[1:]
        fine = _grid_stable(vehicle, key, points, speeds)
        first = int(np.argmax(fine))
        bad, good = (points[first - 1] if first else bad), points[first]
    return float(good)


def _allowed(vehicle: Model, key: str, value: float) -> bool:
    return bool(allowed(vehicle, key).allows(value))
