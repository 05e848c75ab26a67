"""The equations of a family of steady motions: n + 1 unknowns, n conditions, with exact slopes.

Unknowns are the states that matter, then the free inputs and parameters; conditions are that these states' rates
vanish, then that what is held has its value.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ...core.errors import UcritError, near_match
from ...core.numeric.motion import Slopes, motion
from ...core.units import to_si
from ...numerics.continuation import Curve, NoConvergenceError, follow
from ..stability.wording import speed_text

Array = npt.NDArray[Any]

BACK = 1e-9
"""The family is back at its start when the moving quantity is this share of its way beyond it."""

MOVING = 0.1
"""An unknown whose share of change is this part of the largest one goes on where the moving quantity stands still."""

CANNOT = "it cannot be followed further"
"""How the end of a family begins that broke off."""


class Problem:
    """Conditions for steady motions of one vehicle; `UcritError` where names or numbers of conditions are wrong."""

    def __init__(self, vehicle: Model, along: str, free: tuple[str, ...], hold: Mapping[str, Any]) -> None:
        self.vehicle, self.along = vehicle, along
        self.model = type(vehicle).model_id()
        declared = type(vehicle).declaration
        self.moving = motion(type(vehicle))
        self.labels, self.inputs = self.moving.labels, tuple(declared.inputs)
        self.outputs, self.parameters = tuple(declared.outputs), tuple(declared.parameters)
        self.used = [i for i, cyclic in enumerate(self.moving.cyclic) if not cyclic]
        self.states = len(self.used)
        if not self.states:
            raise UcritError(f"{self.model}: no state can be steady or not: nothing depends on any of them")
        self._check_names(free, hold)
        movable = along in self.inputs or along in self.parameters
        held = tuple(name for name in hold if name in self.inputs)
        self.freed = (*((along, *free) if movable else free), *held)
        self.free = self.freed[: len(self.freed) - len(held)]
        self.hold = {name: self.number(name, value) for name, value in hold.items()}
        needed = len(self.hold) + 1
        if len(self.freed) != needed:
            extra = needed - movable - len(held)
            s = "s" * (extra != 1)
            raise UcritError(
                f"{self.model}: {extra} input{s} or parameter{s} must be free to move "
                f"{along}{' and hold ' + ', '.join(self.hold) if self.hold else ''}, got {', '.join(free) or 'none'}"
            )
        self._kept: tuple[bytes, tuple[Array, Array, Slopes]] | None = None
        self.arguments = np.array(vehicle.arguments(), dtype=float)
        self.basic_w, self.basic_u = self.moving.basic(tuple(self.arguments))

    def _check_names(self, free: tuple[str, ...], hold: Mapping[str, Any]) -> None:
        movable = (*self.inputs, *self.parameters)
        fixed = (*(self.labels[i] for i in self.used), *self.outputs, *self.inputs)
        for name in free:
            if name not in movable:
                raise UcritError(f"{self.model}: there is no input or parameter '{name}'{near_match(name, movable)}")
            if name == self.along or free.count(name) > 1 or name in hold:
                raise UcritError(f"{self.model}: {name} is named twice, as free and as moved, held or free")
        for name in hold:
            if name not in fixed:
                raise UcritError(f"{self.model}: there is no state, input or output '{name}'{near_match(name, fixed)}")
        if self.along not in (*movable, *fixed):
            known = (*movable, *fixed)
            raise UcritError(f"{self.model}: there is no quantity '{self.along}'{near_match(self.along, known)}")
        if self.along in hold:
            raise UcritError(f"{self.model}: {self.along} cannot be moved and held")

    @cached_property
    def units(self) -> dict[str, str]:
        """Units of all states, inputs, outputs and free parameters."""
        declared = type(self.vehicle).declaration
        states = {s: declared.variables[s.rstrip("'")].state_unit(s.count("'")) for s in self.labels}
        rest = {name: q.unit for name, q in (*declared.inputs.items(), *declared.outputs.items())}
        return {**states, **rest, **{p: declared.parameters[p].unit for p in self.freed if p in self.parameters}}

    def number(self, name: str, value: Any) -> float:
        """Return a value of a quantity [SI]."""
        declared = type(self.vehicle).declaration
        unit = self.units.get(name)
        if unit is None:
            if name not in declared.parameters:
                raise UcritError(f"{self.model}: there is no quantity '{name}'{near_match(name, self.units)}")
            unit = declared.parameters[name].unit
        found = to_si(value.item() if hasattr(value, "item") else value, unit, f"{self.model}: {name}")
        if name in declared.parameters and np.isfinite(found):
            declared.parameters[name].check(found, self.model)
        return found

    def split(self, y: Array) -> tuple[Array, Array, list[Array]]:
        """Return states, inputs and parameters for unknowns (..., n + 1)."""
        lead = y.shape[:-1]
        w, u = (np.broadcast_to(v.reshape(-1, *[1] * len(lead)), (len(v), *lead)).copy() for v in
                (self.basic_w, self.basic_u))  # fmt: skip
        p = [np.full(lead, value) for value in self.arguments]
        w[self.used] = np.moveaxis(y[..., : self.states], -1, 0)
        for k, name in enumerate(self.freed, self.states):
            if name in self.inputs:
                u[self.inputs.index(name)] = y[..., k]
            else:
                p[self.parameters.index(name)] = y[..., k]
        return w, u, p

    def _slopes(self, y: Array) -> tuple[Array, Array, Slopes]:
        """Return rates, outputs and slopes; those of the last unknowns are kept, all tests of a point ask for them."""
        key = y.tobytes() + bytes(y.ndim)
        if self._kept is None or self._kept[0] != key:
            w, u, p = self.split(y)
            with np.errstate(all="ignore"):
                found = self.moving.rhs(w, u, p), self.moving.outputs(w, u, p), self.moving.slopes(w, u, p)
            self._kept = key, found
        return self._kept[1]

    def _columns(self, by_state: Array, by_input: Array, by_parameter: Array) -> Array:
        """Pick the columns of the unknowns."""
        freed = [
            by_input[..., self.inputs.index(n)] if n in self.inputs else by_parameter[..., self.parameters.index(n)]
            for n in self.freed
        ]
        return np.concatenate([by_state[..., self.used], np.stack(freed, axis=-1)], axis=-1)

    def equations(self, y: Array) -> tuple[Array, Array]:
        """Return the conditions' values (n,) and their Jacobian (n, n + 1)."""
        try:
            rates, outputs, s = self._slopes(y)
        except np.linalg.LinAlgError:
            n = len(y) - 1
            return np.full(n, np.nan), np.full((n, n + 1), np.nan)
        by_output = self._columns(s.C, s.D, s.F)
        values, rows = [rates[self.used]], [self._columns(s.A, s.B, s.E)[self.used]]
        for name, target in self.hold.items():
            value, row = self._quantity(name, y, outputs, by_output)
            values.append(np.array([value - target]))
            rows.append(row[None])
        return np.concatenate(values), np.concatenate(rows)

    def _quantity(self, name: str, y: Array, outputs: Array, by_output: Array) -> tuple[Any, Array]:
        """Return value and gradient (in the unknowns) of any quantity; an output goes before an unknown."""
        if name in self.outputs:
            k = self.outputs.index(name)
            return outputs[k], by_output[..., k, :]
        unknowns = [self.labels[i] for i in self.used] + list(self.freed)
        k = unknowns.index(name)
        return y[..., k], np.broadcast_to(np.eye(len(unknowns))[k], y.shape)

    def value(self, name: str, y: Array) -> float:
        """Return any moving quantity at one point."""
        if name in self.outputs:
            return float(self._slopes(y)[1][self.outputs.index(name)])
        return float(self._quantity(name, y, np.empty(0), np.empty(0))[0])

    def gradient(self, name: str, y: Array) -> Array:
        """Return the gradient of any moving quantity in the unknowns at one point."""
        if name not in self.outputs:
            return np.asarray(self._quantity(name, y, np.empty(0), np.empty(0))[1])
        _, outputs, s = self._slopes(y)
        return np.asarray(self._quantity(name, y, outputs, self._columns(s.C, s.D, s.F))[1])

    def along_curve(self, points: Array, tangents: Array) -> tuple[dict[str, Array], dict[str, Array], Array]:
        """Return all quantities along a curve, their rates along it, and the state matrices."""
        w, u, _ = self.split(points)
        _, outputs, s = self._slopes(points)
        by_output = self._columns(s.C, s.D, s.F)
        values = dict(zip((*self.labels, *self.inputs, *self.outputs), (*w, *u, *outputs), strict=True))
        rates = {name: np.zeros(len(points)) for name in values}
        for k, name in enumerate([*(self.labels[i] for i in self.used), *self.freed]):
            values[name], rates[name] = points[:, k], tangents[:, k]
        for k, name in enumerate(self.outputs):
            rates[name] = np.einsum("ij,ij->i", by_output[:, k], tangents)
        return values, rates, s.A[:, self.used][:, :, self.used]

    def start(self) -> Array:
        """Return the unknowns of the steady motion from which the family sets out.

        Where the basic motion does not have the values held, these are moved there first.
        """
        freed = [
            self.basic_u[self.inputs.index(n)] if n in self.inputs else self.arguments[self.parameters.index(n)]
            for n in self.freed
        ]
        y = np.array([*self.basic_w[self.used], *freed], dtype=float)
        missed, _ = self.equations(y)
        here = missed[self.states :]
        if not np.isfinite(missed).all():
            raise UcritError(f"{self.model}: the basic motion is a singular point, from which no family sets out")
        if not np.any(here):
            return y
        first = self.value(self.along, y)

        def moved(z: Array) -> tuple[Array, Array]:
            values, rows = self.equations(z[:-1])
            values[self.states :] -= here * (1 - z[-1])
            column = np.zeros((len(values), 1))
            column[self.states :, 0] = here
            kept = np.append(self.gradient(self.along, z[:-1]), 0)
            return (
                np.append(values, self.value(self.along, z[:-1]) - first),
                np.vstack([np.hstack([rows, column]), kept]),
            )

        z = np.append(y, 0.0)
        towards = np.zeros(len(z))
        towards[-1] = 1.0
        scale = np.append(_sizes(_null_vector(moved(z)[1]), 1.0, y, len(y)), 1.0)
        try:
            stops = {"there": lambda v: 1 - v[-1], "back": lambda v: v[-1] + BACK}
            curve = follow(moved, z, towards, scale=scale, stops=stops)
        except NoConvergenceError as error:
            raise UcritError(f"{self.model}: no steady motion with {self._held()} was found: {error}") from None
        if curve.end != "there":
            farthest = curve.points[np.argmax(curve.points[:, -1]), :-1]
            reached = ", ".join(f"{name} = {self.value(name, farthest):.4g}" for name in self.hold)
            raise UcritError(
                f"{self.model}: no steady motion with {self._held()} was found at {self.along} = {first:g}: "
                f"those found go no farther than {reached}"
            )
        return np.asarray(curve.points[-1, :-1])

    def _held(self) -> str:
        return ", ".join(f"{name} = {value:g}" for name, value in self.hold.items())

    def setting_out(self, start: Array, way: float) -> tuple[Array, Array]:
        """Return the direction in which to go from the start, and the usual sizes of the unknowns."""
        direction = _null_vector(self.equations(start)[1])
        terms = self.gradient(self.along, start) * direction
        gain = float(terms.sum())
        if abs(gain) <= BACK * np.abs(terms).sum():
            raise UcritError(
                f"{self.model}: {self.along} stays as it is whatever {', '.join(self.freed)} "
                f"{'do' if len(self.freed) > 1 else 'does'}, at the motion from which the family would set out"
            )
        return direction * np.sign(way * gain), _sizes(direction, way / gain, start, len(start))

    def stops(
        self, first: float, goal: float, limits: Mapping[str, tuple[float, ...]]
    ) -> dict[str, Callable[[Array], float]]:
        """Return what ends the family: the goal, its start, bounds of parameters and limits that were asked for."""
        sense = 1 if goal > first else -1
        found = {
            "goal": lambda y: sense * (goal - self.value(self.along, y)),
            "start": lambda y: sense * (self.value(self.along, y) - first) + BACK * abs(goal - first),
        }
        bounds = {
            name: (p.lower, p.upper)
            for name in self.freed
            if (p := type(self.vehicle).declaration.parameters.get(name)) is not None
        }
        for name, (low, high) in (*bounds.items(), *limits.items()):
            if np.isfinite(low):
                found[f"{name} is at its least, {self.told(name, low)}"] = self._beyond(name, low, 1)
            if np.isfinite(high):
                found[f"{name} is at its most, {self.told(name, high)}"] = self._beyond(name, high, -1)
        return found

    def _beyond(self, name: str, value: float, sense: int) -> Callable[[Array], float]:
        return lambda y: sense * (self.value(name, y) - value)

    def told(self, name: str, value: float) -> str:
        """Return a value of a quantity with its unit, a forward speed in km/h and an angle in degrees too."""
        unit, moves = self.units.get(name, "1"), getattr(type(self.vehicle), "keeps_speed", {})
        if name == type(self.vehicle).declaration.speed or name in moves.values():
            return speed_text(value)
        also = f" ({np.rad2deg(value):.3g} deg)" if unit == "rad" else ""
        return f"{value:.4g}{'' if unit == '1' else ' ' + unit}{also}"

    def words(self, curve: Curve) -> str:
        """Say why a curve ends."""
        known = {
            "goal": f"{self.along} is where it was to go",
            "start": f"{self.along} is back where it began",
            "closed": "the family closes",
            "still": self._standing(curve),
            "points": f"after {len(curve.points)} points",
            "failed": f"{CANNOT}: {curve.reason}",
        }
        return known.get(curve.end, curve.end)

    def _standing(self, curve: Curve) -> str:
        """Say that the moving quantity moves no more, and what does instead."""
        unknowns = [self.labels[i] for i in self.used] + list(self.freed)
        gone = np.abs(curve.tangents[-1]) / np.maximum(np.abs(curve.points[-1]), np.finfo(float).tiny)
        moving = [name for name, share in zip(unknowns, gone, strict=True) if share > MOVING * gone.max()]
        value = self.told(self.along, self.value(self.along, curve.points[-1]))
        *some, last = moving
        others = f"{', '.join(some)} and {last} go" if some else f"{last} goes"
        return f"{self.along} stays at {value} while {others} on"


def _null_vector(jacobian: Array) -> Array:
    """Return the direction in which nothing changes, rows and columns brought to one size first."""
    columns = np.linalg.norm(jacobian, axis=0)
    columns = np.where(columns > 0, columns, 1)
    rows = np.linalg.norm(jacobian / columns, axis=1, keepdims=True)
    _, _, V = np.linalg.svd(jacobian / columns / np.where(rows > 0, rows, 1))
    return np.asarray(V[-1] / columns)


def _sizes(direction: Array, way: float, start: Array, count: int) -> Array:
    """Sizes of the unknowns: what the linear equations predict; where that is nothing, what they are, or 1."""
    predicted = np.abs(direction[:count] * way)
    small = predicted <= 1e-9 * np.abs(predicted).max()
    return np.where(small, np.maximum(np.abs(start), 1.0), predicted)
