"""Limit cycles: what happens beyond the critical speed, and how far below it a vehicle may keep oscillating."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ...core.errors import UcritError
from ...core.numeric.compiled import compiled, direction
from ...core.numeric.motion import motion
from ...core.units import to_si
from ...numerics.collocation import Field
from ...numerics.cycle_branch import follow, follow_both_ways
from ...numerics.cycle_points import Branch, Hopf
from ...numerics.orbit import Orbit
from ..results.convert import Table, Tabular
from ..stability.critical import Critical, CriticalValues, critical, parameter_name
from .cycle import Cycle, CycleBranch, of_point, table_of
from .cycle_field import field_of
from .cycle_start import settled_motion

Array = npt.NDArray[Any]

TOLERANCE = 1e-6


@dataclass(frozen=True)
class LimitCycles(Tabular):
    """All limit cycles that were followed from a vehicle's critical values of one parameter, or from a motion.

    Attributes
    ----------
    vehicle, parameter, unit
        The vehicle, what is varied and its unit.
    lower, upper
        Range in which cycles were followed [SI].
    critical
        Critical values of straight running in the range.
    branches
        One for each critical value of flutter from which cycles leave, or the one of the cycle that a motion came to.
    """

    vehicle: Model
    parameter: str
    unit: str
    lower: float
    upper: float
    critical: CriticalValues
    branches: tuple[CycleBranch, ...]

    def at(self, value: float | str) -> tuple[Cycle, ...]:
        """Return the cycles of all branches at a value of the parameter [SI, or text with a unit].

        Raises `UcritError` for a value outside the range in which cycles were followed.
        """
        wanted = to_si(value, self.unit, self.parameter)
        if not self.lower <= wanted <= self.upper:
            raise UcritError(
                f"{type(self.vehicle).model_id()}: {self.parameter} must be within {self.lower:.6g} and "
                f"{self.upper:.6g} {self.unit}, where limit cycles were followed, got {wanted:.6g}"
            )
        return tuple(cycle for branch in self.branches for cycle in branch.at(wanted))

    @property
    def sentences(self) -> tuple[str, ...]:
        """What happens, in words: one or more sentences for each branch."""
        from .cycle_words import describe

        return describe(self)

    def findings(self) -> dict[str, Any]:
        """Return what happens, in words."""
        return {"sentences": list(self.sentences)}

    def table(self) -> Table:
        """Return one row for each cycle, with the number of its branch."""
        return table_of(self.vehicle, self.parameter, self.branches)

    def __str__(self) -> str:
        return "\n".join(self.sentences)


def limit_cycles(
    vehicle: Model,
    along: str | None = None,
    lower: float | str | None = None,
    upper: float | str | None = None,
    *,
    start: Mapping[str, float | str] | None = None,
    tolerance: float = TOLERANCE,
    progress: Callable[[int, int], None] | None = None,
) -> LimitCycles:
    """Follow the limit cycles of a vehicle from each critical value of flutter, or from a motion, through folds.

    Parameters
    ----------
    vehicle
        With scalar parameters and non-linear equations.
    along
        Parameter that is varied; the speed by default.
    lower, upper
        Range of the parameter [SI, or text with a unit]; by default from a fifth to three times the smallest
        critical value of flutter, or with ``start`` of the vehicle's own value.
    start
        Values of states, by name, from which the motion is simulated until it repeats; the cycle that it comes to is
        followed both ways instead. So begin branches that no critical value in the range leads to: of dry friction,
        of relays, between two folds.
    tolerance
        Relative error of the states that is asked for; each cycle tells what its estimate is.
    progress
        Called with the number of cycles found and the most there can be.

    Returns
    -------
    LimitCycles
        By collocation and pseudo-arclength continuation (E. J. Doedel, H. B. Keller and J. P. Kernevez,
        International Journal of Bifurcation and Chaos 1 (1991)), with Floquet multipliers.

    Raises
    ------
    UcritError
        If a name or range is wrong, a position is free, the equations are linear, no limit cycle is found beside a
        critical value, or the motion from ``start`` dies out, runs away or does not repeat.

    Examples
    --------
    >>> from ucrit import limit_cycles, load
    >>> gear = limit_cycles(load("nose-gear", {"k": -10}), upper=30)
    >>> gear.branches[0].kind, [round(c.amplitude["psi"], 4) for c in gear.at(25)]
    ('supercritical', [0.4247])
    >>> swaying = limit_cycles(load("caravan-with-stabiliser"), start={"theta": "20 deg"})
    >>> swaying.branches[0].start.stable, swaying.branches[0].begin, swaying.branches[0].end
    (True, 'equilibrium', 'range')
    """
    name = parameter_name(vehicle, along)
    declared = type(vehicle).declaration.parameters[name]
    low, high = (None if v is None else to_si(v, declared.unit, name) for v in (lower, upper))
    if start is not None:
        low, high = _around(vehicle, name, low, high)
    values = critical(vehicle, name, low, high)
    flutter = [c for c in values if c.kind == "flutter"]
    if not tolerance > 0:
        raise UcritError(f"tolerance must be above 0, got {tolerance}")
    free = compiled(type(vehicle), direction(vehicle)).structural_zeros
    if free:
        raise UcritError(f"{type(vehicle).model_id()}: {free} positions are free, so that no limit cycle stands alone")
    if start is None:
        low, high = _span(values, flutter, low, high)
    assert low is not None
    assert high is not None
    flutter = [c for c in flutter if low < c.value < high]
    found: list[CycleBranch] = []
    moving = field_of(vehicle, name)
    if (flutter or start) and _linear(vehicle, moving, name):
        raise UcritError(f"{type(vehicle).model_id()}: the equations are linear, so that there are no limit cycles")
    if start is not None:
        both: Any = {"tolerance": tolerance, "beyond": _sideways(vehicle), "progress": progress}
        found, flutter = [_from_motion(vehicle, moving, name, start, (low, high), both)], []
    for number, event in enumerate(flutter):
        if any(_ends_at(branch, event.value) for branch in found):
            continue

        def advance(done: int, most: int, number: int = number) -> None:
            if progress is not None:
                progress(number * most + done, len(flutter) * most)

        begun = _hopf(vehicle, moving, event)
        if _jumps(moving, begun):
            raise UcritError(
                f"{type(vehicle).model_id()}: a law jumps on the basic motion itself, as dry friction does, so that no "
                f"small oscillation begins at {event.parameter} = {event.value:.6g} from which cycles could be followed"
            )
        options: Any = {"tolerance": tolerance, "beyond": _sideways(vehicle), "progress": advance}
        branch = follow(moving, begun, low, high, **options)
        found.append(_result(vehicle, event, moving, branch))
    if progress is not None:
        progress(1, 1)
    return LimitCycles(vehicle, name, declared.unit, low, high, values, tuple(found))


def _linear(vehicle: Model, moving: Field, name: str) -> bool:
    """Whether the slopes are the same wherever the vehicle is, near the basic motion and far away."""
    rest, _ = motion(type(vehicle)).basic(vehicle.arguments())
    ways = np.random.default_rng(0).normal(size=(len(rest), 4)) * [0, 1e-2, 0.1, 1]
    value = float(vehicle.values[name])
    if moving.switches is not None and len(moving.switches(rest[:, None] + ways, value)):
        return False
    A, _ = moving.slopes(rest[:, None] + ways, value)
    return bool(np.abs(A - A[:1]).max() <= 1e-9 * np.abs(A[0]).max())


def _span(
    values: CriticalValues, flutter: list[Critical], lower: float | None, upper: float | None
) -> tuple[float, float]:
    """Return the range in which cycles are followed."""
    if not flutter:
        return values.lower, values.upper
    first = min((c.value for c in flutter), key=abs)
    sides = sorted((0.2 * first, 3 * first))
    low = max(values.lower, sides[0]) if lower is None else values.lower
    high = min(values.upper, sides[1]) if upper is None else values.upper
    declared = type(values.vehicle).declaration.parameters[values.parameter]
    margin = 1e-9 * (high - low)  # a parameter's own bounds may not be allowed, such as standing still
    return max(low, declared.lower + margin), min(high, declared.upper - margin)


def _sideways(vehicle: Model) -> Callable[[Orbit], bool]:
    """Return what tells whether an angle of an orbit passes 90 degrees, where no vehicle runs on."""
    declared = type(vehicle).declaration.variables
    labels = motion(type(vehicle)).labels
    angles = [i for i, label in enumerate(labels) if label in declared and declared[label].unit == "rad"]
    return lambda orbit: bool(np.any(np.abs(orbit.dense()[angles]) > np.pi / 2))


def _ends_at(branch: CycleBranch, value: float) -> bool:
    return branch.end == "equilibrium" and abs(branch.cycles[-1].value - value) < 0.02 * abs(value)


def _hopf(vehicle: Model, moving: Field, event: Critical) -> Hopf:
    """Return state, frequency and eigenvector at a critical value of flutter."""
    changed = vehicle.with_(**{event.parameter: event.value})
    rest, _ = motion(type(vehicle)).basic(changed.arguments())
    A = moving.slopes(rest[:, None], event.value)[0][0]
    eigenvalues, vectors = np.linalg.eig(A)
    nearest = int(np.argmin(np.abs(eigenvalues - 2j * np.pi * event.frequency_hz)))
    return Hopf(event.value, rest, float(eigenvalues[nearest].imag), vectors[:, nearest])


def _jumps(moving: Field, begun: Hopf) -> bool:
    """Tell whether the rates jump where a branch begins: they then differ on its sides however small the motion is."""
    angles = np.exp(2j * np.pi * np.arange(8) / 8)
    wave = np.real(begun.vector[:, None] * angles)
    across = [
        np.abs(moving.rates(begun.state[:, None] + s * wave, begun.parameter)
               - moving.rates(begun.state[:, None] - s * wave, begun.parameter)).max()
        for s in (1e-4, 1e-7)
    ]  # fmt: skip
    return bool(across[1] > 0.1 * across[0])


def _result(vehicle: Model, event: Critical, moving: Field, branch: Branch | None) -> CycleBranch:
    if branch is None:
        raise UcritError(
            f"{type(vehicle).model_id()}: no limit cycle is found beside {event.parameter} = {event.value:.6g}; "
            "the equations must be non-linear"
        )
    cycles = tuple(of_point(vehicle, event.parameter, point) for point in branch.points)
    labels = motion(type(vehicle)).labels
    return CycleBranch(vehicle, event, event.parameter, event.unit, labels, cycles, branch.end, branch.points)


def _from_motion(
    vehicle: Model, moving: Field, name: str, start: Mapping[str, Any], span: tuple[float, float], options: Any
) -> CycleBranch:
    """Return the branch of the cycle that the motion from a disturbance comes to."""
    first = settled_motion(vehicle, moving, name, start, *span)
    branch, place = follow_both_ways(moving, first, *span, **options)
    cycles = tuple(of_point(vehicle, name, point) for point in branch.points)
    unit, labels = type(vehicle).declaration.parameters[name].unit, motion(type(vehicle)).labels
    return CycleBranch(
        vehicle, None, name, unit, labels, cycles, branch.end, branch.points, branch.begin, cycles[place]
    )


def _around(vehicle: Model, name: str, lower: float | None, upper: float | None) -> tuple[float, float]:
    """Return a range about the vehicle's own value of a parameter, where the given ends leave it open."""
    value, declared = float(vehicle.values[name]), type(vehicle).declaration.parameters[name]
    low, high = sorted((0.2 * value, 3 * value))
    margin = 1e-9 * (high - low)  # a parameter's own bounds may not be allowed, such as standing still
    low, high = low if lower is None else lower, high if upper is None else upper
    low, high = max(low, declared.lower + margin), min(high, declared.upper - margin)
    if not low < value < high:
        raise UcritError(
            f"{type(vehicle).model_id()}: the motion is that at {name} = {value:g} {declared.unit}, which must be "
            f"between {low:g} and {high:g}, where its limit cycle is to be followed"
        )
    return low, high
