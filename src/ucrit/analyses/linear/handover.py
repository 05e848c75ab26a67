"""Transfer functions handed over to python-control and SciPy."""

from __future__ import annotations

import re
from typing import Any

from ...core.contract.model import Model
from ...core.errors import UcritError
from ..results.convert import needed


class HandOver:
    """What a transfer function in numbers can be turned into; ``coefficients`` are ascending."""

    input: str
    output: str

    def coefficients(self) -> tuple[tuple[Any, ...], tuple[Any, ...]]:
        """Return numerator and denominator in numbers, ascending."""
        raise NotImplementedError

    def _numbers(self) -> Model:
        raise NotImplementedError

    def to_control(self) -> Any:
        """Return the `control.TransferFunction`, with its input and output named.

        Raises
        ------
        UcritError
            If there is no vehicle to take numbers from, or one of its parameters is an array.
        MissingExtraError
            If python-control is not installed.

        Examples
        --------
        >>> from ucrit import load, transfer
        >>> yaw = transfer(load("understeering-car"), "delta_f", "r")
        >>> bool(abs(yaw.to_control()(2j) - yaw(2j)) < 1e-12)
        True
        """
        above, below = self._descending()
        control = needed("control", "control", "a control system")
        name = re.sub(r"[^A-Za-z0-9_-]+", " ", self._numbers().info.name or type(self._numbers()).model_id()).strip()
        return control.tf(above, below, inputs=[self.input], outputs=[self.output], name=name)

    def to_scipy(self) -> Any:
        """Return the `scipy.signal.TransferFunction`; its ``to_zpk`` gives zeros, poles and gain.

        Raises
        ------
        UcritError
            If there is no vehicle to take numbers from, or one of its parameters is an array.

        Examples
        --------
        >>> from ucrit import load, transfer
        >>> transfer(load("understeering-car"), "delta_f", "r").to_scipy().den.size
        3
        """
        from scipy.signal import TransferFunction

        return TransferFunction(*self._descending())

    def _descending(self) -> tuple[list[float], list[float]]:
        """Return numerator and denominator, highest power first, the latter's first coefficient being 1."""
        arrays = ", ".join(self._numbers().dims)
        if arrays:
            raise UcritError(f"a transfer function in numbers is that of one vehicle: give one value each for {arrays}")
        above, below = ([float(c) for c in reversed(part)] for part in self.coefficients())
        above, below = _without_leading_zeros(above), _without_leading_zeros(below)
        return [c / below[0] for c in above], [c / below[0] for c in below]


def _without_leading_zeros(coefficients: list[float]) -> list[float]:
    first = next((i for i, c in enumerate(coefficients) if c), len(coefficients) - 1)
    return coefficients[first:]
