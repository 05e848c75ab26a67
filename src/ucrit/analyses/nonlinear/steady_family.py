"""Families of steady motions: all states at rest but for positions that matter to nothing, one quantity moved.

Solutions are followed round folds by pseudo-arclength (`ucrit.numerics.continuation`) with the exact slopes of the
model's non-linear equations; the same slopes give the eigenvalues at every point.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ...core.errors import UcritError
from ...numerics.continuation import Curve, NoConvergenceError, follow
from ...numerics.signs import real_parts
from ..results.convert import Series, Table, Tabular, complex_series
from .steady_problem import Problem

Array = npt.NDArray[Any]

FARTHEST = 1e12
"""Largest value [SI] that the moving quantity can be sent to: steps are shares of the way."""

STANDING = 1e-6
"""A quantity that moves by less than this share of its way, per length of the curve, does not turn back."""

ROUNDING = 1e-12
"""Share of an entry of the state matrix, or of the same entry where the family begins, by which it may be wrong."""

OSCILLATING = 1e-6
"""Imaginary parts above this share of the largest eigenvalue belong to an oscillation."""


@dataclass(frozen=True)
class Change:
    """Where the number of unstable eigenvalues changes along a family.

    Attributes
    ----------
    kind
        ``"divergence"``: a real eigenvalue passes through zero (a fold, or a branch point); ``"flutter"``: a pair
        passes through the imaginary axis (a Hopf point).
    value
        The moving quantity there [SI].
    frequency_hz
        Of a flutter, else 0.
    after
        Index of the family's point before.
    values
        Everything there, by name [SI].
    """

    kind: str
    value: float
    frequency_hz: float
    after: int
    values: Mapping[str, float] = field(repr=False)


@dataclass(frozen=True)
class SteadyFamily(Tabular):
    """Steady motions in the order in which they follow each other, past folds too.

    Attributes
    ----------
    vehicle, along, free
        The vehicle, the quantity that moves, and the inputs and parameters that are free to make the motion steady.
    values, rates
        Every state, input, output and free parameter by name, shape (N,) [SI]; and its change per length of the curve.
    units
        Their units.
    eigenvalues
        Shape (N, states) [1/s], the least stable first; positions that matter to nothing are left out.
    unstable
        Shape (N,): number of eigenvalues in the right half plane, by more than rounding can do.
    changes
        Where an eigenvalue goes from one side of the imaginary axis to the other, and rounding leaves no doubt of
        either.
    folds, branches
        Values of the moving quantity at its extremes, and where other families cross this one.
    end
        Why the family ends, in words.
    """

    vehicle: Model
    along: str
    free: tuple[str, ...]
    values: Mapping[str, Array] = field(repr=False)
    rates: Mapping[str, Array] = field(repr=False)
    units: Mapping[str, str] = field(repr=False)
    eigenvalues: Array = field(repr=False)
    unstable: Array = field(repr=False)
    changes: tuple[Change, ...]
    folds: tuple[float, ...]
    branches: tuple[float, ...]
    end: str

    def __getitem__(self, name: str) -> Array:
        """Return a quantity along the family, shape (N,)."""
        if name not in self.values:
            from ...core.errors import near_match

            raise UcritError(f"the family of steady motions has no '{name}'{near_match(name, self.values)}")
        return self.values[name]

    def slope(self, name: str, by: str) -> Array:
        """Return the change of one quantity per change of another along the family, shape (N,)."""
        self[name], self[by]
        with np.errstate(all="ignore"):
            return np.asarray(self.rates[name] / self.rates[by])

    @property
    def stable(self) -> Array:
        """Whether each motion is stable, shape (N,)."""
        return np.asarray(self.unstable == 0)

    def table(self) -> Table:
        """Return all quantities and eigenvalues along the family."""
        points, modes = np.arange(len(self.unstable)), np.arange(1, self.eigenvalues.shape[1] + 1)
        data = [Series(name, ("point",), values, self.units[name]) for name, values in self.values.items()]
        data += [Series("stable", ("point",), self.stable), Series("unstable", ("point",), self.unstable, "1")]
        data += complex_series("eigenvalue", ("point", "mode"), self.eigenvalues, "1/s")
        coords = Series("point", ("point",), points), Series("mode", ("mode",), modes)
        return Table("steady motions", self.vehicle, coords, tuple(data), ("point",))

    def __str__(self) -> str:
        name = self.vehicle.info.name or type(self.vehicle).model_id()
        moved, unit = self[self.along], self.units[self.along]
        unit = "" if unit == "1" else f" {unit}"
        first, last = (0.0 if abs(v) < 1e-8 * np.abs(moved).max() else v for v in (moved[0], moved[-1]))
        lines = [f"{name}: {len(moved)} steady motions, {self.along} from {first:.5g} to {last:.5g}{unit}"]
        lines += [f"    {self.along} turns back at {value:.6g}{unit}" for value in self.folds]
        lines += [f"    another family crosses at {self.along} = {value:.6g}{unit}" for value in self.branches]
        for change in self.changes:
            after = "stable" if self.unstable[min(change.after + 1, len(moved) - 1)] == 0 else "unstable"
            at = f" at {change.frequency_hz:.4g} Hz" if change.kind == "flutter" else ""
            lines.append(f"    {change.kind}{at}, {self.along} = {change.value:.6g}{unit}; {after} after it")
        if not self.changes:
            lines.append("    all stable" if self.stable.all() else "    all unstable" if not self.stable.any() else "")
        return "\n".join([*lines, f"    ends: {self.end}"])


def steady_family(
    vehicle: Model,
    along: str,
    to: float | str,
    *,
    free: str | Iterable[str] = (),
    hold: Mapping[str, float | str] | None = None,
    within: Mapping[str, tuple[Any, Any]] | None = None,
    step: float = 0.03,
) -> SteadyFamily:
    """Follow the steady motions of a vehicle from its basic motion on, as one quantity moves.

    Parameters
    ----------
    vehicle
        With scalar parameters.
    along
        What moves: an input, a parameter, a state or an output. From its value on the basic motion, or the
        vehicle's value of it, the family goes on to ``to``, past folds.
    to
        Value [SI, or text with a unit] at which it ends.
    free
        Inputs or parameters that adjust themselves: one for every state or output held, and one more if a state or
        an output moves.
    hold
        States, outputs or inputs that keep a value [SI, or text with a unit]: a speed, the curvature of a turn, a
        steer angle.
    within
        Lowest and highest value of quantities, by name; the family ends where one is reached. The ranges in which
        the model's equations are good (its ``valid``) need not be given.
    step
        Largest step, as a share of the way that the linear equations predict for each unknown.

    Returns
    -------
    SteadyFamily
        The whole family that could be followed; ``end`` tells why it ends.

    Raises
    ------
    UcritError
        If a name or value is wrong, unknowns and conditions differ in number, or there is no steady motion to start
        from.

    Examples
    --------
    >>> from ucrit import load
    >>> turns = steady_family(load("spinning-car"), "a_y", 9, free="delta_f")
    >>> turns.changes[0].kind, round(turns.changes[0].value, 3), bool(turns.stable[0])
    ('divergence', 6.841, True)
    """
    if vehicle.dims:
        raise UcritError("a family of steady motions is that of one vehicle: give scalar parameters")
    if not 0 < step <= 1:
        raise UcritError(f"step must be above 0 and at most 1, got {step!r}")
    freed = (free,) if isinstance(free, str) else tuple(free)
    problem = Problem(vehicle, along, freed, hold or {})
    goal = problem.number(along, to)
    if not abs(goal) <= FARTHEST:
        raise UcritError(
            f"{type(vehicle).model_id()}: {along} must be a finite value to move to, at most {FARTHEST:g} either way, "
            f"got {goal:g}"
        )
    limits = _limits(problem, within or {})
    start = problem.start()
    first = problem.value(along, start)
    if goal == first:
        raise UcritError(f"{type(vehicle).model_id()}: {along} is to move, but starts at {first:g} and ends there")
    towards, scale = problem.setting_out(start, goal - first)
    sides = _Sides(problem, start)
    tests: dict[str, Any] = {f"eigenvalue {k}": partial(sides.side, k) for k in range(problem.states)}
    tests["fold"] = partial(_rate, problem, abs(goal - first), STANDING)
    try:
        curve = follow(
            problem.equations,
            start,
            towards,
            scale=scale,
            tests=tests,
            stops=problem.stops(first, goal, limits),
            moves=partial(_rate, problem, abs(goal - first), 0.0),
            step=step / 4,
            largest=step,
        )
    except NoConvergenceError as error:
        raise UcritError(f"{type(vehicle).model_id()}: no family of steady motions sets out: {error}") from None
    return _result(problem, curve, sides)


def _limits(problem: Problem, within: Mapping[str, tuple[Any, Any]]) -> dict[str, tuple[float, float]]:
    """Return lowest and highest values of quantities, those of the model and those that were asked for."""
    limits: dict[str, tuple[float, float]] = {}
    for bounds in (getattr(type(problem.vehicle), "valid", {}), within):
        for name, sides in bounds.items():
            if not isinstance(sides, tuple | list | np.ndarray) or len(sides) != 2:
                raise UcritError(
                    f"{problem.model}: within needs the lowest and the highest value of {name}, such as (-1, 1), "
                    f"got {sides!r}"
                )
            low, high = limits.get(name, (-np.inf, np.inf))
            one, other = (problem.number(name, side) for side in sides)
            if not one < other:
                raise UcritError(f"{problem.model}: within has no room for {name} between {one:g} and {other:g}")
            limits[name] = max(low, one), min(high, other)
    return limits


def _rate(problem: Problem, way: float, least: float, point: Any) -> float:
    """Return how fast the moving quantity goes, as a share of its way; 0 where that is less than the least."""
    rate = float(problem.gradient(problem.along, point.y) @ point.tangent) / way
    return rate if abs(rate) > least else 0.0


class _Sides:
    """On which side of the imaginary axis the eigenvalues of steady motions are, as far as rounding lets it be told."""

    def __init__(self, problem: Problem, start: Array) -> None:
        self.states = problem.states
        self.first = np.abs(problem.equations(start)[1][: self.states, : self.states])

    def sides(self, A: Array) -> Array:
        """Return real parts, the largest first, and 0 where the sign may be rounding."""
        values, wrong = real_parts(A, ROUNDING * np.maximum(np.abs(A), self.first))
        return np.where(np.abs(values) > wrong, values, 0.0)

    def side(self, k: int, point: Any) -> float:
        """Return the (k+1)-th of these at a point."""
        return float(self.sides(point.jacobian[: self.states, : self.states])[k])


def _result(problem: Problem, curve: Curve, sides: _Sides) -> SteadyFamily:
    values, rates, A = problem.along_curve(curve.points, curve.tangents)
    eigenvalues = np.linalg.eigvals(A).astype(complex)
    order = np.lexsort((eigenvalues.imag, -eigenvalues.real), axis=-1)
    eigenvalues = np.take_along_axis(eigenvalues, order, axis=-1)
    unstable = (sides.sides(A) > 0).sum(axis=-1)
    found: dict[str, list[float]] = {"fold": [], "branch": []}
    changes: list[Change] = []
    for crossing in curve.crossings:
        if crossing.name in found:
            found[crossing.name].append(problem.value(problem.along, crossing.point.y))
        else:
            change = _change(problem, crossing)
            if not (changes and changes[-1].kind == change.kind == "flutter" and changes[-1].after == change.after):
                changes.append(change)
    turns = tuple(v for v in found["fold"]), tuple(found["branch"])
    end = problem.words(curve)
    return SteadyFamily(
        problem.vehicle, problem.along, problem.free, values, rates, problem.units, eigenvalues, unstable,
        tuple(changes), *turns, end,
    )  # fmt: skip


def _change(problem: Problem, crossing: Any) -> Change:
    y, k = crossing.point.y, int(crossing.name.rpartition(" ")[2])
    eigenvalues = np.linalg.eigvals(problem.equations(y)[1][: problem.states, : problem.states])
    chosen = eigenvalues[np.argsort(-eigenvalues.real)][k]
    oscillates = abs(chosen.imag) > OSCILLATING * np.abs(eigenvalues).max()
    kind, frequency = ("flutter", abs(chosen.imag) / (2 * np.pi)) if oscillates else ("divergence", 0.0)
    values = {name: float(v[0]) for name, v in problem.along_curve(y[None], 0 * y[None])[0].items()}
    return Change(kind, values[problem.along], float(frequency), crossing.after, values)
