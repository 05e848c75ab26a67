"""Vehicles drawn from tolerances: quasi-random points of the unit cube, turned into parameter values.

Each parameter follows its own distribution; correlations are those of a Gaussian copula (R. B. Nelsen, An Introduction
to Copulas, 2nd edition (2006), section 2.3): the coefficient is that of the normal variables behind the parameters,
which for normal parameters is their own.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ...core.errors import UcritError

Array = npt.NDArray[Any]

SAFE = 2.0**-40
"""Probabilities keep this far from 0 and 1, where normal quantiles are infinite."""

MAX_SAMPLES = 2**22


def toleranced(vehicle: Model) -> tuple[str, ...]:
    """Return the parameters with a tolerance; refuse a vehicle without any, or none that fits its values."""
    model, tolerances = type(vehicle).model_id(), vehicle.info.tolerances
    if vehicle.dims:
        raise UcritError(f"uncertainty is that of one vehicle: give one value each for {', '.join(vehicle.dims)}")
    if not tolerances:
        raise UcritError(
            f"{model}: no parameter has a tolerance; write one into the vehicle file, such as "
            f"{next(iter(vehicle.values))} = {{ value = ..., sd = ... }}"
        )
    for t in tolerances:
        value, parameter = float(vehicle.values[t.name]), type(vehicle).declaration.parameters[t.name]
        if not t.low <= value <= t.high:
            unit = "" if parameter.unit == "1" else f" {parameter.unit}"
            raise UcritError(
                f"{model}: {parameter.meaning} {t.name} = {value:g}{unit} lies outside its tolerance, "
                f"{t.low:g} to {t.high:g}{unit}"
            )
    return tolerances.names


def check_count(samples: int) -> None:
    """Refuse numbers of samples that are no power of two: quasi-random points fill the cube evenly at these only."""
    if isinstance(samples, bool) or not isinstance(samples, int) or not 2 <= samples <= MAX_SAMPLES:
        raise UcritError(f"samples must be a whole number from 2 to {MAX_SAMPLES}, got {samples!r}")
    if samples & (samples - 1):
        below = 1 << (samples.bit_length() - 1)
        raise UcritError(f"samples must be a power of two, got {samples}; did you mean {below} or {2 * below}?")


def unit_points(dimensions: int, samples: int, seed: int) -> Array:
    """Return scrambled Sobol points, shape (samples, dimensions)."""
    from scipy.stats import qmc

    engine = qmc.Sobol(dimensions, scramble=True, seed=np.random.default_rng(seed))
    return np.asarray(engine.random_base2(samples.bit_length() - 1))


def drawn(vehicle: Model, points: Array) -> dict[str, Array]:
    """Turn points of the unit cube, one column for each toleranced parameter, into checked parameter values.

    Raises
    ------
    UcritError
        If the correlations contradict one another, or some values are impossible together.
    """
    from scipy.special import ndtr, ndtri

    tolerances, declared = vehicle.info.tolerances, type(vehicle).declaration.parameters
    normal = ndtri(np.clip(points, SAFE, 1 - SAFE)) @ _root(vehicle).T
    columns: dict[str, Array] = {}
    for t, z in zip(tolerances, normal.T, strict=True):
        parameter, value = declared[t.name], float(vehicle.values[t.name])
        low, high = max(t.low, parameter.lower), min(t.high, parameter.upper)
        if not t.sd:
            columns[t.name] = np.clip(low + (high - low) * ndtr(z), low, high)
            continue
        below, above = ndtr((low - value) / t.sd), ndtr((high - value) / t.sd)
        cut = below > 0 or above < 1
        columns[t.name] = value + t.sd * (ndtri(below + (above - below) * ndtr(z)) if cut else z)
    vehicle.along("sample", **columns)
    return columns


def _root(vehicle: Model) -> Array:
    """Return the Cholesky factor of the matrix of correlations."""
    tolerances = vehicle.info.tolerances
    names = tolerances.names
    matrix = np.eye(len(names))
    for one, other, rho in tolerances.correlations:
        i, j = names.index(one), names.index(other)
        matrix[i, j] = matrix[j, i] = rho
    try:
        return np.asarray(np.linalg.cholesky(matrix))
    except np.linalg.LinAlgError:
        told = ", ".join(f"{a} and {b} {rho:g}" for a, b, rho in tolerances.correlations)
        raise UcritError(
            f"{type(vehicle).model_id()}: the correlations contradict one another ({told}): their matrix "
            "must be positive definite"
        ) from None
