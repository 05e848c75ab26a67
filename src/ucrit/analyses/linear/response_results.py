"""What responses are: complex over frequencies, real over times, with vehicle, names and units."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ...core.errors import UcritError, near_match
from ..results.convert import Series, Table, Tabular, complex_series, needed, unit_of

Array = npt.NDArray[Any]


@dataclass(frozen=True, repr=False)
class _Response(Tabular):
    """What all responses have; dimensions of ``values`` are the vehicle's, then the axis, then outputs."""

    vehicle: Model
    input: str
    outputs: tuple[str, ...]
    units: tuple[str, ...]

    def __repr__(self) -> str:
        from_to = f"{self._axis.values[0]:.4g} to {self._axis.values[-1]:.4g} {self._axis.unit}"
        return f"{type(self).__name__}({self._title}: {', '.join(self.outputs)}; {from_to})"

    @property
    def _axis(self) -> Series:
        raise NotImplementedError

    def _series(self) -> tuple[Series, ...]:
        raise NotImplementedError

    def _place(self, output: str) -> int:
        if output not in self.outputs:
            raise UcritError(f"the response has no output '{output}'{near_match(output, self.outputs)}")
        return self.outputs.index(output)

    def table(self) -> Table:
        """Return the response of each output over the axis, with units."""
        coords = [Series(name, (name,), x, unit_of(self.vehicle, name)) for name, x in self.vehicle.dims.items()]
        axis = self._axis
        return Table(self._title, self.vehicle, (*coords, axis), self._series(), (*self.vehicle.dims, axis.name))

    @property
    def _title(self) -> str:
        return "response"


@dataclass(frozen=True, repr=False)
class FrequencyResponse(_Response):
    """Steady response to sines of one input.

    Attributes
    ----------
    frequencies
        [Hz], shape (F,).
    values
        Complex amplitude of each output per unit of the input, shape (..., F, outputs).
    stable
        Whether the vehicle is stable, shape (...): only then does a steady response set in.
    """

    frequencies: Array
    values: Array
    stable: Array

    def __getitem__(self, output: str) -> Array:
        """Return the complex response of one output, shape (..., F)."""
        return np.asarray(self.values[..., self._place(output)])

    def gain(self, output: str) -> Array:
        """Return the amplitude of an output per unit of the input, shape (..., F)."""
        return np.asarray(np.abs(self[output]))

    def gain_db(self, output: str) -> Array:
        """Return the amplitude in decibels (20 log10 of the gain in SI units), shape (..., F)."""
        with np.errstate(divide="ignore"):
            return np.asarray(20 * np.log10(self.gain(output)))

    def phase_deg(self, output: str) -> Array:
        """Return the phase [deg] without jumps along the frequencies, shape (..., F)."""
        return np.asarray(np.rad2deg(np.unwrap(np.angle(self[output]), axis=-1)))

    def peak(self, output: str) -> tuple[Array, Array]:
        """Return frequency [Hz] and size of the largest gain among the given frequencies, shapes (...)."""
        gain = self.gain(output)
        at = gain.argmax(axis=-1)
        return self.frequencies[at], np.take_along_axis(gain, at[..., None], axis=-1)[..., 0]

    def to_control(self) -> Any:
        """Return a `control.FrequencyResponseData` over angular frequencies, input and outputs named.

        Raises
        ------
        UcritError
            If a parameter of the vehicle is an array.
        MissingExtraError
            If python-control is not installed.
        """
        if self.vehicle.dims:
            arrays = ", ".join(self.vehicle.dims)
            raise UcritError(
                f"a frequency response to hand over is that of one vehicle: give one value each for {arrays}"
            )
        control = needed("control", "control", "a frequency response there")
        values = np.moveaxis(self.values, -1, 0)[:, None, :]
        omega = 2 * np.pi * self.frequencies
        return control.frd(values, omega, inputs=[self.input], outputs=list(self.outputs))

    @property
    def _axis(self) -> Series:
        return Series("frequency", ("frequency",), self.frequencies, "Hz")

    def _series(self) -> tuple[Series, ...]:
        dims = (*self.vehicle.dims, "frequency")
        per = type(self.vehicle).declaration.inputs[self.input].unit
        pairs = (
            complex_series(name, dims, self[name], unit if per == "1" else f"({unit})/({per})")
            for name, unit in zip(self.outputs, self.units, strict=True)
        )
        return tuple(series for pair in pairs for series in pair)

    @property
    def _title(self) -> str:
        return f"frequency response to {self.input}"


@dataclass(frozen=True, repr=False)
class TimeResponse(_Response):
    """Response in time to a step or an impulse of one input, from the basic motion.

    Attributes
    ----------
    kind
        ``"step"`` or ``"impulse"``.
    times
        [s], shape (T,).
    values
        Outputs, shape (..., T, outputs), for an input of size ``size``.
    direct
        For an impulse, the weight of the impulse that passes straight to each output and is left out of
        ``values``, shape (..., outputs); for a step zeros.
    final
        What the outputs of a stable vehicle tend to, nan for others, shape (..., outputs).
    """

    kind: str
    size: float
    times: Array
    values: Array
    direct: Array
    final: Array

    def __getitem__(self, output: str) -> Array:
        """Return one output over time, shape (..., T)."""
        return np.asarray(self.values[..., self._place(output)])

    def overshoot(self, output: str) -> Array:
        """Return the largest excess of a step response, as a share of its final value, shape (...)."""
        final = self.final[..., self._place(output)]
        with np.errstate(all="ignore"):
            return np.asarray(np.maximum((self[output] / final[..., None]).max(axis=-1) - 1, 0))

    def starts_opposite(self, output: str) -> Array:
        """Return whether a response first goes against its final value, shape (...)."""
        values, final = self[output], self.final[..., self._place(output)]
        moved = np.abs(values) > 1e-9 * np.abs(values).max(axis=-1, keepdims=True)
        first = np.take_along_axis(values, moved.argmax(axis=-1)[..., None], axis=-1)[..., 0]
        return np.asarray(first * final < 0)

    @property
    def _axis(self) -> Series:
        return Series("time", ("time",), self.times, "s")

    def _series(self) -> tuple[Series, ...]:
        dims = (*self.vehicle.dims, "time")
        return tuple(Series(name, dims, self[name], unit) for name, unit in zip(self.outputs, self.units, strict=True))

    @property
    def _title(self) -> str:
        return f"{self.kind} response to {self.input}"
