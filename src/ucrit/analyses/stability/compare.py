"""Vehicles side by side: verdicts, critical speeds, modes, and the parameters in which they differ."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ...core.contract.model import Model
from ...core.errors import UcritError
from ...core.numeric.compiled import direction
from ...core.record import Record
from ..linear.modes import Mode, modes
from .critical import CriticalValues, critical
from .static_term import static_term
from .verdict import Verdict, verdict

WIDTH = 80


@dataclass(frozen=True)
class Subject:
    """What is compared of one vehicle; ``speeds`` is ``None`` where its model has no speed.

    ``static_term`` tells how the sign of its model's static term depends on speed; see `static_term`.
    """

    vehicle: Model
    name: str
    verdict: Verdict
    speeds: CriticalValues | None
    modes: tuple[Mode, ...]
    static_term: str


@dataclass(frozen=True)
class Comparison(Record):
    """Facts about several vehicles, in the order they were given.

    Attributes
    ----------
    subjects
        One for each vehicle.
    differing
        Parameters that not all of them have with the same value: unit, and the value of each vehicle [SI],
        ``None`` where its model has no such parameter.
    """

    subjects: tuple[Subject, ...]
    differing: dict[str, tuple[str, tuple[float | None, ...]]]

    def rows(self) -> list[tuple[str, tuple[str, ...]]]:
        """Return label and one text for each vehicle, as for a table."""
        subjects = self.subjects
        rows: list[tuple[str, tuple[str, ...]]] = []
        if len({type(s.vehicle) for s in subjects}) > 1:
            rows.append(("model", tuple(type(s.vehicle).model_id() for s in subjects)))
        rows.append(("speed [m/s]", tuple(_speed(s.vehicle) for s in subjects)))
        rows.append(("verdict", tuple(s.verdict.state.removeprefix("asymptotically ") for s in subjects)))
        rows.append(("stable speeds [m/s]", tuple(_ranges(s.speeds) for s in subjects)))
        most = max((len(s.speeds) for s in subjects if s.speeds is not None), default=0)
        for i in range(most):
            found = [s.speeds[i] if s.speeds is not None and i < len(s.speeds) else None for s in subjects]
            rows.append(("critical speed [m/s]", tuple(f"{c.value:.5g}" if c else "-" for c in found)))
            rows.append(("  of", tuple(c.mode if c else "-" for c in found)))
        if len({s.static_term for s in subjects}) > 1:
            rows.append(("static term a_0", tuple(s.static_term or "-" for s in subjects)))
        for name in self.mode_names():
            found_modes = [next((m for m in s.modes if m.name == name), None) for s in subjects]
            rows.append((name, tuple(_mode(m) for m in found_modes)))
        for name, (unit, values) in self.differing.items():
            label = name if unit == "1" else f"{name} [{unit}]"
            rows.append((label, tuple("-" if v is None else f"{v:.6g}" for v in values)))
        return rows

    def mode_names(self) -> list[str]:
        """Return the names of all modes, the least stable ones first, each once."""
        found: dict[str, float] = {}
        for subject in self.subjects:
            for mode in subject.modes:
                found[mode.name] = max(found.get(mode.name, -math.inf), mode.eigenvalue.real)
        return sorted(found, key=lambda name: -found[name])

    def __str__(self) -> str:
        rows = [("", tuple(s.name for s in self.subjects)), *self.rows()]
        first = max(len(label) for label, _ in rows)
        column = max((WIDTH - first) // len(self.subjects) - 2, 8)
        lines: list[str] = []
        for label, texts in rows:
            cells = [_wrapped(text, column) for text in texts]
            for i in range(max(map(len, cells))):
                parts = [(cell[i] if i < len(cell) else "").ljust(column) for cell in cells]
                lines.append("  ".join([(label if i == 0 else "").ljust(first), *parts]).rstrip())
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        from ...core import html

        rows = [(label, *texts) for label, texts in self.rows()]
        return html.table(rows, ["", *(s.name for s in self.subjects)])


def compare(*vehicles: Model) -> Comparison:
    """Compare vehicles, of one model or of several.

    Parameters
    ----------
    *vehicles
        Two or more, with scalar parameters.

    Returns
    -------
    Comparison
        Prints as a table of 80 columns for up to three vehicles.

    Raises
    ------
    UcritError
        If fewer than two vehicles are given, or one has array parameters.

    Examples
    --------
    >>> from ucrit import load
    >>> both = compare(load("understeering-car"), load("oversteering-car"))
    >>> list(both.differing)
    ['C_f', 'C_r']
    """
    if len(vehicles) < 2:
        raise UcritError(f"a comparison needs two vehicles or more, got {len(vehicles)}")
    for vehicle in vehicles:
        if not isinstance(vehicle, Model):
            raise UcritError(f"a comparison is of vehicles, got {vehicle!r}")
        if vehicle.dims:
            raise UcritError(f"a comparison needs scalar parameters, got arrays for {', '.join(vehicle.dims)}")
    return Comparison(tuple(map(_subject, vehicles, _names(vehicles))), _differing(vehicles))


def _subject(vehicle: Model, name: str) -> Subject:
    speeds = critical(vehicle) if type(vehicle).declaration.speed else None
    term = static_term(type(vehicle), direction(vehicle))
    return Subject(vehicle, name, verdict(vehicle), speeds, tuple(modes(vehicle)), term)


def _names(vehicles: tuple[Model, ...]) -> list[str]:
    """Names of the vehicles, numbered where two are the same."""
    names = [vehicle.info.name or type(vehicle).model_id() for vehicle in vehicles]
    return [f"{name} ({names[: i + 1].count(name)})" if names.count(name) > 1 else name for i, name in enumerate(names)]


def _differing(vehicles: tuple[Model, ...]) -> dict[str, tuple[str, tuple[float | None, ...]]]:
    found: dict[str, tuple[str, tuple[float | None, ...]]] = {}
    for vehicle in vehicles:
        for name, parameter in type(vehicle).declaration.parameters.items():
            values = tuple(float(v.values[name]) if name in v.values else None for v in vehicles)
            if name not in found and len(set(values)) > 1:
                found[name] = (parameter.unit, values)
    return found


def _speed(vehicle: Model) -> str:
    name = type(vehicle).declaration.speed
    return f"{float(vehicle.values[name]):.5g}" if name else "-"


def _ranges(speeds: CriticalValues | None) -> str:
    if speeds is None:
        return "-"
    found = speeds.stable_ranges()
    if not found:
        return "none"
    if found == [(speeds.lower, speeds.upper)]:
        return "all"
    return " and ".join(
        f"above {a:.5g}" if math.isinf(b) else f"below {b:.5g}" if a in (0, -math.inf) else f"{a:.5g} to {b:.5g}"
        for a, b in found
    )


def _mode(mode: Mode | None) -> str:
    if mode is None:
        return "-"
    if mode.oscillates:
        return f"{mode.frequency_hz:.3g} Hz, damping {mode.damping_ratio + 0.0:.3g}"
    return f"{mode.eigenvalue.real:+.3g} 1/s"


def _wrapped(text: str, width: int) -> list[str]:
    from textwrap import wrap

    return wrap(text, width) or [""]
