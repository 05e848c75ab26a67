"""Random parameter sets: near a model's vehicles where there are any, of everyday size elsewhere."""

from __future__ import annotations

import math
import tomllib
from collections.abc import Mapping, Sequence
from functools import cache
from typing import Any

import numpy as np
import numpy.typing as npt

from ..catalogue import VEHICLES, load, vehicle_names
from ..core.contract.declare import Parameter
from ..core.contract.model import Model
from ..core.contract.possible import holds
from ..core.errors import UcritError

Array = npt.NDArray[np.float64]
Indices = npt.NDArray[np.int_]

SPREAD = 3.0
ROUNDS = 150
FLIPPED = 0.25
USUAL = {"kg": 500.0, "kg m^2": 500.0, "m/s": 20.0, "N": 5e3, "N/m": 1e4, "N/rad": 5e4, "Pa": 1e5, "rad": 0.2}


@cache
def vehicles_of(model_id: str) -> tuple[Model, ...]:
    """Return the shipped vehicles of a model.

    >>> "caravan" in [vehicle.info.file for vehicle in vehicles_of("trailer")]
    True
    """
    named = {name: tomllib.loads((VEHICLES / f"{name}.toml").read_text("utf-8")) for name in vehicle_names()}
    return tuple(load(name) for name, text in named.items() if text["model"].replace("_", "-") == model_id)


def parameter_sets(
    model: type[Model],
    rng: np.random.Generator,
    count: int,
    direction: int = 1,
    around: Sequence[Model] = (),
    spread: float = SPREAD,
) -> list[Array]:
    """Return ``count`` values of every parameter, in declared order, within the bounds and possible together.

    Parameters
    ----------
    model
        The model class.
    rng
        Source of chance.
    count
        Number of parameter sets.
    direction
        Sign of the speed where backing up is allowed; 0 for either.
    around
        Vehicles whose values are the centres.
    spread
        Factor by which a value spreads, both ways.
    """
    chosen = rng.integers(max(len(around), 1), size=count)
    signs = rng.choice([-1, 1], size=count) if direction == 0 else np.full(count, direction)
    sets = _sets(model, rng, chosen, signs, around, spread)
    for again in range(ROUNDS):
        wrong = np.flatnonzero(~_possible(model, sets))
        if not wrong.size:
            return sets
        nearer = spread ** (0.9**again)
        redrawn = _sets(model, rng, chosen[wrong], signs[wrong], around, nearer)
        for values, new in zip(sets, redrawn, strict=True):
            values[wrong] = new
    raise UcritError(f"{model.model_id()}: found no values that are possible together; check one of its vehicles")


def _sets(
    model: type[Model], rng: np.random.Generator, chosen: Indices, signs: Array, around: Sequence[Model], spread: float
) -> list[Array]:
    sets = []
    for name, parameter in model.declaration.parameters.items():
        known = [_centre(vehicle.values, name, parameter) for vehicle in around]
        centre = np.array(known or [_usual(parameter)])[chosen]
        values = _draw(parameter, centre, rng, spread)
        reversible = parameter.is_speed and parameter.sign is None
        sets.append(np.abs(values) * signs if reversible else values)
    return sets


def _possible(model: type[Model], sets: list[Array]) -> npt.NDArray[np.bool_]:
    values = dict(zip(model.declaration.parameters, sets, strict=True))
    true = np.ones(sets[0].shape, dtype=bool) if sets else np.ones(1, dtype=bool)
    for statement in holds(model, values).values():
        true &= statement
    return true


def _centre(values: Mapping[str, Any], name: str, parameter: Parameter) -> float:
    return float(np.median(values[name])) or _usual(parameter)


def _usual(parameter: Parameter) -> float:
    return USUAL.get(parameter.unit, 1.0) * (-1 if parameter.sign == -1 else 1)


def _draw(parameter: Parameter, centre: Array, rng: np.random.Generator, spread: float) -> Array:
    factors = spread ** rng.uniform(-1, 1, centre.size)
    values: Array = centre * factors
    if parameter.sign is None and not parameter.is_speed:
        values = np.where(rng.random(centre.size) < FLIPPED, -values, values)
    return np.where(parameter.allows(values), values, _inside(parameter, np.abs(centre) * factors, rng))


def _inside(parameter: Parameter, size: Array, rng: np.random.Generator) -> Array:
    """Return values within the bounds, whichever of them there are."""
    low, high = parameter.lower, parameter.upper
    if math.isfinite(low) and math.isfinite(high):
        return rng.uniform(low, high, size.size)
    return low + size if math.isfinite(low) else high - size if math.isfinite(high) else size
