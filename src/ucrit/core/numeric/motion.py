"""The compiled non-linear motion of a model, for arrays of states and parameters."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from typing import Any, NamedTuple

import numpy as np

from ..contract.model import Model
from ..formulas.codegen import build, build_for_points
from .cache import cached
from .compiled import Arguments, Array, derive_facts

SAME, MOST = 1e-13, 20
"""Relative change below which Newton's method has found what is implicit, and steps that it may take."""


class Slopes(NamedTuple):
    """Matrices (..., rows, columns): ``w' = A dw + B du + E dp``, ``y = C dw + D du + F dp`` about a point."""

    A: Array
    B: Array
    C: Array
    D: Array
    E: Array
    F: Array


@dataclass(frozen=True)
class Motion:
    """Non-linear right-hand side of a model: ``rhs(w, u, p)`` gives ``w'`` for arrays of states."""

    model: type[Model]

    @cached_property
    def _facts(self) -> Any:
        return cached(self.model, "motion", lambda: derive_facts("motion", self.model))

    @property
    def labels(self) -> tuple[str, ...]:
        """State names; positions that a constraint ties to others are kept, unlike in the linear state."""
        return tuple(self._facts["states"])

    @cached_property
    def _function(self) -> Callable[..., tuple[Any, ...]]:
        return build_for_points(self._facts["motion"], "motion")

    @cached_property
    def _outputs(self) -> Callable[..., tuple[Any, ...]]:
        return build_for_points(self._facts["outputs"], "outputs")

    @cached_property
    def _basic(self) -> Callable[..., tuple[Any, ...]]:
        return build(self._facts["basic"], "basic")

    def basic(self, arguments: Arguments) -> tuple[Array, Array]:
        """Return state and inputs on the basic motion."""
        values = np.array(np.broadcast_arrays(*self._basic(arguments)), dtype=float)
        states = len(self.labels)
        return values[:states], values[states:]

    def highest(self, w: Array, u: Array, arguments: Arguments) -> Array:
        """Return the highest derivatives and algebraic unknowns, states along the first axis of ``w``."""
        shape = np.broadcast_shapes(np.shape(w)[1:], np.shape(u)[1:], *(np.shape(a) for a in arguments))
        z = self._solved(w, u, arguments, np.zeros((int(self._facts["size"]), *shape)))
        for _ in range(MOST if self._facts["implicit"] else 0):
            before, z = z, self._solved(w, u, arguments, z)
            if np.all(np.abs(z - before) <= SAME * (1 + np.abs(z))) or not np.isfinite(z).all():
                break
        return z

    def _solved(self, w: Array, u: Array, arguments: Arguments, z: Array) -> Array:
        """Return the solution of ``M z = f``, both at the given ``z`` where they depend on it."""
        n = int(self._facts["size"])
        with np.errstate(all="ignore"):  # laws with cases compute them all, also where they do not hold
            entries = _stacked(self._function(w, u, arguments, z), np.shape(w)[1:])
        if entries.ndim == 1:  # one motion alone
            return np.linalg.solve(entries[: n * n].reshape(n, n), entries[n * n :])
        flat = np.moveaxis(entries, 0, -1)
        M = flat[..., : n * n].reshape(*flat.shape[:-1], n, n)
        z = np.linalg.solve(M, flat[..., n * n :, None])[..., 0]
        return np.asarray(np.moveaxis(z, -1, 0))

    def rhs(self, w: Array, u: Array, arguments: Arguments) -> Array:
        """Return ``w'`` for states ``w`` (first axis), inputs ``u`` (first axis) and parameters."""
        w = np.asarray(w, dtype=float)
        z = self.highest(w, u, arguments)
        return np.array([w[i] if kind == "w" else z[i] for kind, i in self._facts["rates"]])

    @cached_property
    def _slope_facts(self) -> Any:
        return cached(self.model, "motion-slopes", lambda: derive_facts("motion_slope", self.model))

    @cached_property
    def _slope_functions(self) -> dict[str, Callable[..., tuple[Any, ...]]]:
        return {name: build_for_points(facts["source"], name) for name, facts in self._slope_facts.items()}

    def slopes(self, w: Array, u: Array, arguments: Arguments) -> Slopes:
        """Return the exact linearisation at any state, for arrays of states, inputs and parameters.

        Parameters
        ----------
        w, u
            States (n, ...) and inputs (m, ...).
        arguments
            Parameters in declared order, broadcasting over ``...``.
        """
        w, u = np.asarray(w, dtype=float), np.asarray(u, dtype=float)
        z = self.highest(w, u, arguments)
        lead = np.broadcast_shapes(w.shape[1:], u.shape[1:], *(np.shape(a) for a in arguments))
        n, m = len(self.labels), len(u)
        residual = self._placed("residual", (len(z), n + m + len(arguments)), lead, (w, z, u, arguments))
        M = self._mass(w, u, arguments, z, lead)
        dz = -np.linalg.solve(M, residual)
        rows = []
        for kind, i in self._facts["rates"]:
            row = np.zeros((*lead, n + m + len(arguments)))
            if kind == "w":
                row[..., i] = 1
            else:
                row = dz[..., i, :]
            rows.append(row)
        by_all = np.stack(rows, axis=-2)
        outputs = len(self.model.declaration.outputs)
        direct = self._placed("output", (outputs, n + len(z) + m + len(arguments)), lead, (w, z, u, arguments))
        Cw, Cz, rest = np.split(direct, [n, n + len(z)], axis=-1)
        by_output = np.concatenate([Cw, rest], axis=-1) + Cz @ dz
        (A, B, E), (C, D, F) = (np.split(whole, [n, n + m], axis=-1) for whole in (by_all, by_output))
        return Slopes(A, B, C, D, E, F)

    @property
    def cyclic(self) -> tuple[bool, ...]:
        """Which states no rate depends on, such as the place on the road: they never settle and never matter."""
        used = {j for name in ("residual",) for _, j in self._slope_facts[name]["places"]}
        used |= {i for kind, i in self._facts["rates"] if kind == "w"}
        return tuple(j not in used for j in range(len(self.labels)))

    def _mass(self, w: Array, u: Array, arguments: Arguments, z: Array, lead: tuple[int, ...]) -> Array:
        n = int(self._facts["size"])
        with np.errstate(all="ignore"):
            entries = self._function(w, u, arguments, z)[: n * n]
        return np.stack([np.broadcast_to(e, lead) for e in entries], axis=-1).reshape(*lead, n, n)

    def _placed(self, name: str, shape: tuple[int, int], lead: tuple[int, ...], groups: Any) -> Array:
        """Put slopes in their places of matrices that are zero elsewhere."""
        matrix = np.zeros((*lead, *shape))
        with np.errstate(all="ignore"):
            values = self._slope_functions[name](*groups)
        for (i, j), value in zip(self._slope_facts[name]["places"], values, strict=True):
            matrix[..., i, j] = value
        return matrix

    def broken(self, w: Array, u: Array, arguments: Arguments) -> list[tuple[str, Array, Array]]:
        """Return each constraint as text, what is left of it at a state, and the sum of its terms' sizes."""
        terms = iter(build(self._facts["terms"], "terms")(w, u, arguments))
        found = []
        for text, length in zip(self._facts["conditions"], self._facts["lengths"], strict=True):
            own = np.array(np.broadcast_arrays(*(next(terms) for _ in range(length))), dtype=float)
            found.append((text, own.sum(axis=0), np.abs(own).sum(axis=0)))
        return found

    @cached_property
    def _event_facts(self) -> Any:
        if not hasattr(self.model, "events"):
            return {"names": [], "ends": [], "ways": [], "starts": [], "places": []}
        return cached(self.model, "motion-events", lambda: derive_facts("motion_event", self.model))

    @cached_property
    def _event_functions(self) -> tuple[Callable[..., tuple[Any, ...]], ...]:
        return tuple(build(self._event_facts[name], name) for name in ("values", "settings"))

    @cached_property
    def _switches(self) -> Callable[..., tuple[Any, ...]]:
        facts = cached(self.model, "motion-switches", lambda: derive_facts("motion_switch", self.model))
        return build(facts["values"], "values")

    def switches(self, w: Array, u: Array, arguments: Arguments) -> Array:
        """Return the values that choose between cases of a law, one a row: their sign changes are its kinks."""
        with np.errstate(all="ignore"):
            return _stacked(self._switches(w, u, arguments), np.shape(w)[1:])

    @property
    def event_names(self) -> tuple[str, ...]:
        """Names of the model's events."""
        return tuple(self._event_facts["names"])

    @property
    def event_ends(self) -> tuple[bool, ...]:
        """Whether each event ends the motion."""
        return tuple(self._event_facts["ends"])

    @property
    def event_ways(self) -> tuple[int, ...]:
        """Direction in which each event's value crosses zero: 1 rising, -1 falling, 0 either."""
        return tuple(self._event_facts["ways"])

    @property
    def event_starts(self) -> tuple[bool, ...]:
        """Whether each event also happens at the start, where its value is beyond zero already."""
        return tuple(self._event_facts["starts"])

    def event_values(self, w: Array, u: Array, arguments: Arguments) -> Array:
        """Return the values of the events, one a row, which cross zero where they happen."""
        z = self.highest(w, u, arguments)
        with np.errstate(all="ignore"):
            values = self._event_functions[0](w, z, u, arguments)
        return _stacked(values, np.shape(w)[1:])

    def event_changes(self, which: int) -> bool:
        """Tell whether an event sets states or inputs."""
        return bool(self._event_facts["places"][which])

    def after_event(self, which: int, w: Array, u: Array, arguments: Arguments) -> tuple[Array, dict[int, Array]]:
        """Return the states after an event, and the inputs that it sets, by place."""
        places = self._event_facts["places"]
        first = sum(map(len, places[:which]))
        values = self._event_functions[1](w, self.highest(w, u, arguments), u, arguments)[first:]
        w, held = np.array(w, dtype=float), {}
        for (group, i), value in zip(places[which], values, strict=False):
            if group == "u":
                held[int(i)] = np.asarray(value, dtype=float)
            else:
                w[i] = value
        return w, held

    def outputs(self, w: Array, u: Array, arguments: Arguments) -> Array:
        """Return the model's outputs, one a row."""
        z = self.highest(np.asarray(w, dtype=float), u, arguments)
        with np.errstate(all="ignore"):
            values = self._outputs(w, z, u, arguments)
        return _stacked(values, np.shape(w)[1:])


def _stacked(values: Sequence[Any], lead: tuple[int, ...]) -> Array:
    """Return values that broadcast with each other and a shape as one array, the values along its first axis."""
    if not lead and not any(map(np.ndim, values)):
        return np.array(values, dtype=float)  # one motion alone: some ten times as fast
    return np.array(np.broadcast_arrays(*values, np.zeros(lead))[:-1], dtype=float)


_motion: Any = cache(Motion)


def motion(model: type[Model]) -> Motion:
    """Return the compiled non-linear motion of a model class."""
    found: Motion = _motion(model)
    return found
