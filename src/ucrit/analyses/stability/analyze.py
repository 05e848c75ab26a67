"""The main job: everything about one vehicle up to one speed, in one result and one sentence."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ...catalogue import load
from ...core.contract.model import Model
from ...core.errors import UcritError
from ...core.numeric.compiled import direction
from ...core.record import Record
from ..linear.modes import Mode, modes
from .criteria import Criteria, Criterion, criteria
from .critical import Critical, CriticalValues, critical
from .few import few_criteria
from .remedies import Remedy, remedies
from .verdict import Verdict, verdict
from .wording import caveat, describe

if TYPE_CHECKING:
    from ..motion.audit import Audit

SCHEMA = 1
"""Version of the dictionary that `Analysis.to_dict` returns; it grows when an entry changes its meaning."""


@dataclass(frozen=True)
class Analysis(Record):
    """What `analyze` finds.

    Attributes
    ----------
    vehicle
        With its speed set to the asked one.
    speed
        Asked speed [m/s], negative backing up; ``None`` for a model without speed.
    verdict
        Of the vehicle at the asked speed.
    stable
        Whether it is stable at every speed up to the asked one.
    modes
        At the asked speed, least stable first.
    critical
        Every critical speed, also beyond the asked one.
    criteria
        The conditions for stability in symbols; ``None`` where they would be too long to read.
    why_no_criteria
        Why these are not the conditions in all parameters; empty where they are.
    failing
        Those of them that fail at the asked speed.
    remedies
        The smallest change of each parameter alone that makes it stable up to the asked speed.
    audit
        The verdict at the asked speed checked by the non-linear equations, where that was asked for.
    """

    vehicle: Model
    speed: float | None
    verdict: Verdict
    stable: bool
    modes: tuple[Mode, ...]
    critical: CriticalValues | None
    criteria: Criteria | None
    why_no_criteria: str
    failing: tuple[Criterion, ...]
    remedies: tuple[Remedy, ...]
    audit: Audit | None = None

    @property
    def sentence(self) -> str:
        """The verdict in words."""
        return describe(self)

    @property
    def caveat(self) -> str:
        """What the verdict leaves out where a law jumps or has a kink on the basic motion; empty where none does."""
        return caveat(self.vehicle)

    def to_dict(self) -> dict[str, Any]:
        """Return the facts as plain data, in the documented schema; infinite and undefined numbers are ``None``."""
        info, model = self.vehicle.info, type(self.vehicle)
        checked = {} if self.audit is None else {"audit": self.audit.to_dict()}
        return {
            "schema": SCHEMA,
            "vehicle": {
                "name": info.name,
                "source": info.source,
                "file": info.file,
                "parameters": {name: float(value) for name, value in self.vehicle.values.items()},
            },
            "model": {"name": model.model_id(), "title": model.title()},
            "verdict": {
                "sentence": self.sentence,
                "caveat": self.caveat,
                "stable": self.stable,
                "state": self.verdict.state,
                "static": self.verdict.static,
                "rigid_positions": self.verdict.rigid_positions,
            },
            "speed": None if self.speed is None else {"value": self.speed, "unit": "m/s"},
            "modes": [_mode(mode) for mode in self.modes],
            "critical": [_critical(c) for c in self.critical or ()],
            "criteria": [_criterion(c, c in self.failing) for c in self.criteria or ()],
            "criteria_in": list(self.criteria.free) if self.criteria and self.criteria.free is not None else None,
            "remedies": [_remedy(r) for r in self.remedies],
            **checked,
        }

    def __str__(self) -> str:
        return f"{self.vehicle.info.name or type(self.vehicle).__name__}: {self.sentence}" + (
            f"; {self.caveat}" if self.caveat else ""
        )

    def _repr_html_(self) -> str:
        from ..results import notebook
        from .advice import advice

        return notebook.analysis(self, [advice(r, self) for r in self.remedies if r.value is not None])


def analyze(
    vehicle: Model | str | os.PathLike[str],
    upto: float | str | None = None,
    changes: Mapping[str, Any] | None = None,
    *,
    audit: bool = False,
    advise: bool = True,
    free: Sequence[str] | str | None = None,
) -> Analysis:
    """Judge a vehicle up to a speed: verdict, modes, critical speeds, criteria and remedies.

    Parameters
    ----------
    vehicle
        A vehicle, the name of one that is shipped, or a vehicle file.
    upto
        Speed [m/s, or text with a unit] up to which it is judged; the vehicle's own by default.
    changes
        Parameter values that replace the vehicle's.
    audit
        Whether the verdict at the asked speed is checked by the non-linear equations too, see `audit`.
    advise
        Whether remedies are sought, which takes longer than all the rest; without them there are none in the result.
    free
        Parameters that the criteria keep as symbols, the vehicle's numbers standing for the rest; all by default.
        ``"few"`` takes all too, but where that is too long the few that matter most, see `criteria`.

    Raises
    ------
    UcritError
        If something is misspelt, impossible, or varies (array parameters: use `sweep`).

    Examples
    --------
    >>> from ucrit import analyze
    >>> print(analyze("bmw-320i", upto="80 km/h").sentence)
    stable at every speed up to 22.22 m/s (80 km/h), and at every higher one
    """
    subject = _subject(vehicle, upto, changes)
    if subject.dims:
        raise UcritError("analyze judges one vehicle: give scalar parameters, or use sweep")
    name = type(subject).declaration.speed
    found_verdict = verdict(subject)
    found_critical = None if name is None else critical(subject)
    found_criteria, why = criteria_or_why(type(subject), subject, direction(subject), free)
    speed = None if name is None else float(subject.values[name])
    stable = _stable(found_verdict, found_critical, speed)
    return Analysis(
        vehicle=subject,
        speed=speed,
        verdict=found_verdict,
        stable=stable,
        modes=tuple(modes(subject)),
        critical=found_critical,
        criteria=found_criteria,
        why_no_criteria=why,
        failing=found_criteria.failing(subject) if found_criteria else (),
        remedies=remedies(subject) if advise and not stable else (),
        audit=_audit(subject) if audit else None,
    )


def _audit(vehicle: Model) -> Audit:
    from ..motion.audit import audit

    return audit(vehicle)


def _subject(vehicle: Model | str | os.PathLike[str], upto: Any, changes: Mapping[str, Any] | None) -> Model:
    if not isinstance(vehicle, Model):
        return load(vehicle, changes, upto)
    changed = vehicle.with_(**(changes or {}))
    if upto is None:
        return changed
    name = type(vehicle).declaration.speed
    if name is None:
        raise UcritError(f"{type(vehicle).model_id()} has no speed, so none can be asked for, got {upto}")
    return changed.with_(**{name: upto})


def _stable(found: Verdict, speeds: CriticalValues | None, speed: float | None) -> bool:
    """Tell whether nothing grows at any speed from a standstill to the asked one."""
    if speeds is None or speed is None:
        return not found.growing
    start = speeds.stable_at_lower if speed > 0 else not speeds.stable_at_lower ^ bool(len(speeds) % 2 == 0)
    return not found.growing and start and not any(abs(c.value) < abs(speed) for c in speeds)


def criteria_or_why(
    model: type[Model], vehicle: Model | None, sense: int, free: Sequence[str] | str | None
) -> tuple[Criteria | None, str]:
    """Return the criteria of a model or of one vehicle, and why they are none or not those in all parameters."""
    if vehicle is not None and free not in (None, "few"):
        return criteria(vehicle, direction=sense, free=free), ""
    try:
        return criteria(model, direction=sense), ""
    except UcritError as error:
        too_long = str(error)
    found = few_criteria(vehicle) if vehicle is not None and free == "few" else None
    return found, too_long if found is None else too_long.removeprefix(f"{model.model_id()}: ").partition(";")[0]


def _number(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None


def _mode(mode: Mode) -> dict[str, Any]:
    return {
        "name": mode.name,
        "re": mode.eigenvalue.real,
        "im": mode.eigenvalue.imag,
        "frequency_hz": mode.frequency_hz,
        "damping_ratio": _number(mode.damping_ratio),
        "time_to_half": _number(mode.time_to_half),
        "time_to_double": _number(mode.time_to_double),
        "participation": mode.participation,
    }


def _critical(c: Critical) -> dict[str, Any]:
    return {
        "parameter": c.parameter,
        "value": c.value,
        "unit": c.unit,
        "kind": c.kind,
        "frequency_hz": c.frequency_hz,
        "stable": c.stable,
        "mode": c.mode,
        "closed_form": str(c.closed_form) if c.closed_form else None,
    }


def _criterion(c: Criterion, fails: bool) -> dict[str, Any]:
    return {"name": c.name, "condition": str(c), "failure": c.failure, "latex": c.latex, "fails": fails}


def _remedy(r: Remedy) -> dict[str, Any]:
    return {
        "parameter": r.parameter,
        "unit": r.unit,
        "present": r.present,
        "value": r.value,
        "relative": _number(r.relative),
    }
