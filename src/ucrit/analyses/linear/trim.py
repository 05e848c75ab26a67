"""Trim: states, inputs and outputs on the basic motion, such as the elevator angle of level flight."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ...core.errors import UcritError, near_match
from ...core.numeric.motion import motion
from ..results.convert import Series, Table, Tabular, unit_of

Array = npt.NDArray[Any]


@dataclass(frozen=True)
class Trim(Tabular):
    """The basic motion of a vehicle; array parameters make arrays.

    Attributes
    ----------
    values
        States, inputs and outputs by name [SI], each of the shape of ``vehicle.dims``.
    units
        Their units.
    """

    vehicle: Model
    values: Mapping[str, Array]
    units: Mapping[str, str]

    def __getitem__(self, name: str) -> Any:
        if name not in self.values:
            raise UcritError(
                f"{type(self.vehicle).model_id()}: the basic motion has no '{name}'{near_match(name, self.values)}"
            )
        value = self.values[name]
        return value if value.ndim else float(value)

    def table(self) -> Table:
        """Return the basic motion as named arrays with units."""
        dims = tuple(self.vehicle.dims)
        coords = tuple(Series(n, (n,), x, unit_of(self.vehicle, n)) for n, x in self.vehicle.dims.items())
        data = tuple(Series(name, dims, value, self.units[name]) for name, value in self.values.items())
        return Table("trim", self.vehicle, coords, data, dims)

    def __str__(self) -> str:
        name = self.vehicle.info.name or type(self.vehicle).model_id()
        arrays = f" for arrays of {', '.join(self.vehicle.dims)}" if self.vehicle.dims else ""
        lines = []
        for key, value in self.values.items():
            unit = "" if self.units[key] == "1" else f" {self.units[key]}"
            degrees = f" ({_span(np.rad2deg(value), 4)} deg)" if self.units[key] == "rad" and value.any() else ""
            lines.append(f"    {key} = {_span(value, 6)}{unit}{degrees}")
        return "\n".join([f"{name}: basic motion{arrays}", *lines])


def _span(value: Array, digits: int) -> str:
    low, high = f"{value.min():.{digits}g}", f"{value.max():.{digits}g}"
    return low if low == high else f"{low} to {high}"


def trim(vehicle: Model) -> Trim:
    """Return the basic motion of a vehicle: the states, inputs and outputs about which it is judged.

    Parameters
    ----------
    vehicle
        Its array parameters span dimensions of the result: speeds, places of the centre of mass.

    Returns
    -------
    Trim
        Indexed by name.

    Examples
    --------
    >>> from ucrit import load, trim
    >>> flight = trim(load("navion-from-geometry").with_(U=[40, 50, 60]))
    >>> [round(float(angle), 3) for angle in flight["delta_e"]]
    [-0.135, -0.088, -0.063]
    """
    cls, moving = type(vehicle), motion(type(vehicle))
    arguments = vehicle.arguments()
    shape = tuple(x.size for x in vehicle.dims.values())
    w, u = moving.basic(arguments)
    w = np.broadcast_to(w.reshape(*w.shape, *[1] * (len(shape) + 1 - w.ndim)), (len(w), *shape))
    u = np.broadcast_to(u.reshape(*u.shape, *[1] * (len(shape) + 1 - u.ndim)), (len(u), *shape))
    y = moving.outputs(w, u, arguments)
    declared = cls.declaration
    units = {label: _state_unit(cls, label) for label in moving.labels}
    units |= {name: quantity.unit for name, quantity in {**declared.inputs, **declared.outputs}.items()}
    return Trim(vehicle, dict(zip(units, [*w, *u, *y], strict=True)), units)


def _state_unit(cls: type[Model], label: str) -> str:
    base = label.rstrip("'")
    return cls.declaration.variables[base].state_unit(len(label) - len(base))
