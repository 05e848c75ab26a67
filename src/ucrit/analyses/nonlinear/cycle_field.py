"""A vehicle's motion as the field whose periodic solutions are sought."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ...core.numeric.motion import motion
from ...numerics.collocation import Field

Array = npt.NDArray[Any]


def field_of(vehicle: Model, parameter: str) -> Field:
    """Return motion, slopes and switches of a vehicle as functions of states (n, P) and a value of the parameter."""
    made, arguments = motion(type(vehicle)), list(vehicle.arguments())
    place = list(type(vehicle).declaration.parameters).index(parameter)

    def changed(value: float) -> tuple[list[Any], Array]:
        given = [*arguments]
        given[place] = value
        return given, made.basic(given)[1]

    def rates(x: Array, value: float) -> Array:
        given, u = changed(value)
        with np.errstate(all="ignore"):
            try:
                return made.rhs(x, np.broadcast_to(u[:, None], (len(u), x.shape[1])), given)
            except np.linalg.LinAlgError:
                return np.full(x.shape, np.nan)

    def slopes(x: Array, value: float) -> tuple[Array, Array]:
        given, u = changed(value)
        with np.errstate(all="ignore"):
            try:
                found = made.slopes(x, np.broadcast_to(u[:, None], (len(u), x.shape[1])), given)
            except np.linalg.LinAlgError:
                n, count = x.shape
                return np.full((count, n, n), np.nan), np.full((count, n), np.nan)
        return found.A, found.E[..., place]

    def switches(x: Array, value: float) -> Array:
        given, u = changed(value)
        return made.switches(x, np.broadcast_to(u[:, None], (len(u), x.shape[1])), given).reshape(-1, x.shape[1])

    return Field(rates, slopes, switches)
