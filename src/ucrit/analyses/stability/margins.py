"""How far a control loop is from instability: in gain, phase, delay, and in all at once."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ...control import broken, driven
from ...core.contract.model import Model
from ...core.errors import UcritError
from ...core.numeric.compiled import state_space
from ...numerics.loops import from_roots, loop_margins
from ..results.convert import Series, Table, Tabular, unit_of
from .judge import judge

Array = npt.NDArray[Any]


@dataclass(frozen=True)
class Margins(Tabular):
    """Margins of a loop that is cut where an input enters the vehicle.

    All arrays have the shape of the vehicle's dimensions; they are nan where the closed loop is not stable.

    Attributes
    ----------
    vehicle, input
        The vehicle under control, and the input.
    stable
        Whether the closed loop is stable.
    gain_up, gain_down
        Factors on the loop's gain at which stability ends: the nearest above 1 (infinite where there is none) and the
        nearest below 1 (zero where there is none).
    phase
        Phase [rad] that may be lost or gained.
    delay
        Delay [s] that the loop may have besides.
    disk
        Size alpha of the balanced disk: the loop stands every factor ``(1 + z)/(1 - z)`` with ``|z| < alpha/2``,
        gain and phase changing at once (P. Seiler, A. Packard, P. Gahinet, IEEE Control Systems Magazine 40 (2020)).
    """

    vehicle: Model
    input: str
    stable: Array
    gain_up: Array
    gain_down: Array
    phase: Array
    delay: Array
    disk: Array

    def findings(self) -> dict[str, Any]:
        """Return the input at which the loop is cut, and the margins in words."""
        return {"input": self.input, "sentence": str(self)}

    def table(self) -> Table:
        """Return the margins over the vehicle's array parameters."""
        dims = self.vehicle.dims
        names = tuple(dims)
        coords = tuple(Series(n, (n,), np.asarray(v), unit_of(self.vehicle, n)) for n, v in dims.items())
        units = {"gain_up": "1", "gain_down": "1", "phase": "rad", "delay": "s", "disk": "1"}
        data = (
            Series("stable", names, self.stable),
            *(Series(n, names, getattr(self, n), u) for n, u in units.items()),
        )
        return Table("margins", self.vehicle, coords, data, names)

    def __str__(self) -> str:
        if self.vehicle.dims:
            share = np.mean(self.stable)
            return f"margins at {self.input} for {self.stable.size} vehicles, {share:.0%} of them stable"
        if not self.stable:
            return f"no margins at {self.input}: the closed loop is unstable"
        up = "no limit" if np.isinf(self.gain_up) else f"{self.gain_up:.4g}"
        delay = "any delay" if np.isinf(self.delay) else f"delay {self.delay:.4g} s"
        phase = "any phase" if np.isinf(self.phase) else f"phase {np.degrees(self.phase):.4g} degrees"
        return f"at {self.input}: gain times {self.gain_down:.4g} to {up}, {phase}, {delay}, disk {self.disk:.4g}"


def driven_inputs(model: type[Model]) -> list[str]:
    """Return the inputs of the vehicle itself that controllers drive; refuse a vehicle without control."""
    found = driven(model)
    if not found:
        raise UcritError(
            f"{model.model_id()}: no controller drives an input; name controllers in the vehicle's file, or close "
            "the loop in Python"
        )
    return found


def margins(vehicle: Model, input: str | None = None) -> Margins:
    """Return gain, phase, delay and disk margins of a vehicle under control.

    Parameters
    ----------
    vehicle
        Under control; its array parameters (speeds, gains) span dimensions.
    input
        Input of the vehicle, driven by a controller, at which the loop is cut; need not be named if only one is.

    Returns
    -------
    Margins
        From the roots of polynomials in the squared frequency, not from a grid of frequencies.

    Raises
    ------
    UcritError
        If no controller drives the input, or several are driven and none is named.

    Examples
    --------
    >>> from ucrit import load
    >>> print(margins(load("motorcycle-steered-to-lean"), "delta_f"))
    at delta_f: gain times 0.1777 to no limit, phase 14.48 degrees, delay 0.03376 s, disk 0.2511
    """
    if input is None:
        names = driven_inputs(type(vehicle))
        if len(names) > 1:
            raise UcritError(f"{type(vehicle).model_id()}: say where the loop is cut: {', '.join(names)}")
        input = names[0]
    cut = broken(type(vehicle), input)
    subject = cut(**{name: vehicle.values[name] for name in cut.declaration.parameters})
    subject.__dict__["_shared"] = vehicle._shared
    declared = cut.declaration
    A, B, C, D = state_space(subject)
    column = list(declared.inputs).index(f"{input}_cut")
    row = list(declared.outputs).index(f"{input}_return")
    b, c, direct = B[..., :, column], -C[..., row, :], -D[..., row, column]
    closed = A - b[..., :, None] * c[..., None, :] / (1 + direct)[..., None, None]
    open_roots, roots = np.linalg.eigvals(A).astype(complex), np.linalg.eigvals(closed).astype(complex)
    size = np.maximum(np.abs(open_roots).max(axis=-1), np.abs(roots).max(axis=-1))
    size = np.where(size > 0, size, 1.0)
    d = from_roots(open_roots / size[..., None])
    n = (1 + direct)[..., None] * from_roots(roots / size[..., None]) - d
    n = np.where(np.abs(n) > 1e-13 * np.abs(d).max(axis=-1, keepdims=True), n, 0.0)
    found = loop_margins(n, d)
    shape = tuple(len(v) for v in vehicle.dims.values())
    good = judge(vehicle)
    values = [np.where(good, np.broadcast_to(v, shape), np.nan) for v in found._replace(delay=found.delay / size)]
    return Margins(vehicle, input, good, *values)
