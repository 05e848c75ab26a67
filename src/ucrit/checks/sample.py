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
from ..core.declare import Parameter
from ..core.model import Model

Array = npt.NDArray[np.float64]

SPREAD = 3.0
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
) -> list[Array]:
    """Return ``count`` values of every parameter, in declared order and within the declared bounds.

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
        Vehicles whose values are the centres; a value spreads by a factor 3 both ways.
    """
    chosen = rng.integers(max(len(around), 1), size=count)
    signs = rng.choice([-1, 1], size=count) if direction == 0 else np.full(count, direction)
    sets = []
    for name, parameter in model.declaration.parameters.items():
        known = [_centre(vehicle.values, name, parameter) for vehicle in around]
        centre = np.array(known or [_usual(parameter)])[chosen]
        values = _draw(parameter, centre, rng)
        reversible = parameter.is_speed and parameter.sign is None
        sets.append(np.abs(values) * signs if reversible else values)
    return sets


def _centre(values: Mapping[str, Any], name: str, parameter: Parameter) -> float:
    return float(np.median(values[name])) or _usual(parameter)


def _usual(parameter: Parameter) -> float:
    return USUAL.get(parameter.unit, 1.0) * (-1 if parameter.sign == -1 else 1)


def _draw(parameter: Parameter, centre: Array, rng: np.random.Generator) -> Array:
    factors = SPREAD ** rng.uniform(-1, 1, centre.size)
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
