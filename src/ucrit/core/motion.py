"""The compiled non-linear motion of a model, for arrays of states and parameters."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, cached_property
from typing import Any

import numpy as np

from .cache import cached
from .codegen import build
from .compiled import Arguments, Array, derive_facts
from .model import Model


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
        return build(self._facts["motion"], "motion")

    @cached_property
    def _outputs(self) -> Callable[..., tuple[Any, ...]]:
        return build(self._facts["outputs"], "outputs")

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
        n = int(self._facts["size"])
        entries = np.broadcast_arrays(*self._function(w, u, arguments), np.zeros(np.shape(w)[1:]))[:-1]
        flat = np.moveaxis(np.array(entries, dtype=float), 0, -1)
        M = flat[..., : n * n].reshape(*flat.shape[:-1], n, n)
        z = np.linalg.solve(M, flat[..., n * n :, None])[..., 0]
        return np.asarray(np.moveaxis(z, -1, 0))

    def rhs(self, w: Array, u: Array, arguments: Arguments) -> Array:
        """Return ``w'`` for states ``w`` (first axis), inputs ``u`` (first axis) and parameters."""
        w = np.asarray(w, dtype=float)
        z = self.highest(w, u, arguments)
        return np.array([w[i] if kind == "w" else z[i] for kind, i in self._facts["rates"]])

    def outputs(self, w: Array, u: Array, arguments: Arguments) -> Array:
        """Return the model's outputs, one a row."""
        z = self.highest(np.asarray(w, dtype=float), u, arguments)
        values = self._outputs(w, z, u, arguments)
        return np.array(np.broadcast_arrays(*values, np.zeros(np.shape(w)[1:]))[:-1], dtype=float)


_motion: Any = cache(Motion)


def motion(model: type[Model]) -> Motion:
    """Return the compiled non-linear motion of a model class."""
    found: Motion = _motion(model)
    return found
