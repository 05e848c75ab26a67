"""What is checked: a model with its derived equations, random parameter sets and published data at hand."""

from __future__ import annotations

import zlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from ..catalogue import PUBLISHED
from ..core.contract.methods import Names, is_current
from ..core.contract.model import Model
from ..core.derivation.derive import symbolic
from ..core.derivation.linear import LinearSystem
from ..core.derivation.trace import Traced, trace
from ..core.numeric.motion import Motion, motion
from .published import Entry, read_published
from .report import NotApplicableError
from .sample import SPREAD, Array, parameter_sets, vehicles_of


@dataclass(frozen=True)
class Subject:
    """A model class under check, and the vehicles about which random parameters are drawn."""

    model: type[Model]
    vehicles: tuple[Model, ...]
    seed: int = 0
    published_file: Path | None = None

    @classmethod
    def of(cls, model: type[Model] | Model, seed: int, published: Path | None) -> Subject:
        """Return the subject for a class or for a vehicle."""
        if isinstance(model, Model):
            return cls(type(model), (model,), seed, published)
        names = model.declaration.parameters.keys()
        alike = (vehicle for vehicle in vehicles_of(model.model_id()) if names <= vehicle.values.keys())
        return cls(model, tuple(alike), seed, published)

    @property
    def directions(self) -> tuple[int, ...]:
        """Signs of the speed for which the model is made."""
        speed = self.model.declaration.speed
        reverse = speed is not None and self.model.declaration.parameters[speed].sign is None
        return (1, -1) if reverse else (1,)

    @property
    def either(self) -> int:
        """Direction that stands for all that the model is made for."""
        return 0 if len(self.directions) > 1 else 1

    def system(self, direction: int = 1) -> LinearSystem:
        """Linear equations in symbols."""
        return symbolic(self.model, direction)

    @cached_property
    def traced(self) -> Traced:
        """Non-linear equations in symbols, for either direction of speed."""
        return trace(self.model, direction=None)

    @cached_property
    def motion(self) -> Motion:
        """Compiled non-linear motion."""
        return motion(self.model)

    @property
    def derivations(self) -> list[str]:
        """Names of the methods that derive the equations again."""
        found = (
            name for name in dir(self.model) if name.startswith("equations_") and callable(getattr(self.model, name))
        )
        return sorted(name for name in found if self.is_current(name))

    def is_current(self, method: str) -> bool:
        """Tell whether a method is no older in the line of classes than the statement of motion in use."""
        return is_current(self.model, method)

    def groups(self, traced: Traced) -> dict[str, Names]:
        """Symbols of variables, rates and inputs as a model's methods take them."""
        names = list(self.model.declaration.variables)
        values = [
            {name: chain[k] for name, chain in zip(names, traced.q, strict=False) if k < len(chain)} for k in range(3)
        ]
        groups = {group: Names(group, values[k]) for k, group in enumerate(("x", "dx", "ddx"))}
        inputs = dict(zip(self.model.declaration.inputs, traced.u, strict=True))
        return {**groups, "u": Names("u", inputs)}

    def rng(self, purpose: str) -> np.random.Generator:
        """Return a generator of its own for every purpose, the same in every run."""
        return np.random.default_rng([self.seed, zlib.crc32(purpose.encode())])

    def parameter_sets(self, purpose: str, count: int, direction: int = 1, spread: float = SPREAD) -> list[Array]:
        """Return random values of every parameter."""
        return parameter_sets(self.model, self.rng(purpose), count, direction, self.vehicles, spread)

    def points(self, purpose: str, direction: int = 1, count: int = 3) -> list[Sequence[float]]:
        """Return a few random parameter sets, one a row."""
        sets = self.parameter_sets(purpose, count, direction)
        return [tuple(float(values[i]) for values in sets) for i in range(count)]

    @property
    def _refitted(self) -> bool:
        """Whether the model has other parts than its file in the catalogue, for which nothing is published."""
        return self.model._unfitted is not None

    @cached_property
    def _published(self) -> Mapping[str, list[Entry]]:
        path = self.published_file or PUBLISHED / f"{self.model.model_id().replace('-', '_')}.toml"
        found = self.published_file is not None or (path.is_file() and not self._refitted)
        return read_published(path) if found else {}

    def published(self, table: str) -> list[Entry]:
        """Return the published entries of a table, of which there is at least one."""
        entries = self._published.get(table, [])
        if not entries and self._refitted and not self.published_file:
            laws = ", ".join(f"{name} {slot.law.part_id()}" for name, slot in self.model.declaration.slots.items())
            raise NotApplicableError(f"nothing is published for these parts: {laws}")
        if not entries:
            raise NotApplicableError(f"nothing is published as [[{table}]]")
        return entries

    def parameter_names(self, traced: Traced) -> dict[str, Any]:
        """Meaning of the parameters' names in published formulas."""
        return dict(traced.parameters)

    def motion_names(self, traced: Traced) -> dict[str, Any]:
        """Meaning of all names in published equations of motion: ``m``, ``dx.theta``, ``u.delta_f``."""
        groups = self.groups(traced)
        dotted = {
            f"{group}.{name}": symbol
            for group, names in groups.items()
            for name, symbol in vars(names).items()
            if not name.startswith("_")
        }
        return {**self.parameter_names(traced), **dotted}
