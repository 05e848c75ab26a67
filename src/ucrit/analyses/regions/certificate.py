"""What is proved about a region of parameters, and how it is told."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ...core.numeric.compiled import compiled
from ..results.convert import Series, Table, Tabular, unit_of

Array = npt.NDArray[Any]


@dataclass(frozen=True)
class Counterexample:
    """A vehicle of the region that is not stable, for sure.

    Attributes
    ----------
    vehicle
        With the values of the counter-example put in.
    values
        The parameters of the region and their values [SI], doubles that lie in it.
    eigenvalues
        Eigenvalues [1/s] there, the least stable first.
    """

    vehicle: Model
    values: Mapping[str, float]
    eigenvalues: tuple[complex, ...]

    def __str__(self) -> str:
        first = self.eigenvalues[0]
        imag = f" ± {abs(first.imag):.4g}j" if first.imag else ""
        at = ", ".join(_value(self.vehicle, name, x) for name, x in self.values.items())
        return f"not stable at {at}: eigenvalue {first.real:.4g}{imag} 1/s"


@dataclass(frozen=True, eq=False)
class Certificate(Tabular):
    """What is proved about a box of parameters.

    Attributes
    ----------
    vehicle
        The vehicle; its other parameters hold as written.
    ranges
        Ends of each parameter's range [SI], exactly.
    counterexample
        A vehicle in the region that is not stable, where one was found.
    proved_share
        Share of the volume that is proved stable, 0 to 1; 1 exactly where all of it is.
    undecided
        Boxes left open, shape (boxes, parameters, 2) [SI]; none where there is a proof.
    boxes
        How many boxes were looked at.
    """

    vehicle: Model
    ranges: Mapping[str, tuple[Fraction, Fraction]]
    counterexample: Counterexample | None
    proved_share: float
    undecided: Array
    boxes: int

    @property
    def state(self) -> str:
        """``"proved"``, ``"refuted"`` (by the counter-example) or ``"undecided"``."""
        if self.counterexample is not None:
            return "refuted"
        return "undecided" if len(self.undecided) else "proved"

    @property
    def proved(self) -> bool:
        """Whether every vehicle of the region is proved stable."""
        return self.state == "proved"

    def __bool__(self) -> bool:
        return self.proved

    @property
    def sentence(self) -> str:
        """The finding in words."""
        if self.counterexample is not None:
            return str(self.counterexample)
        neutral = compiled(type(self.vehicle), sense_of(self.vehicle, self.ranges)).undamped
        word = "nothing grows (neutral)" if neutral else "stable"
        where = " and ".join(_range(self.vehicle, name, *ends) for name, ends in self.ranges.items())
        if self.proved:
            return f"{word} for {where}: proved with {self.boxes} box{'es' if self.boxes > 1 else ''}"
        volume = min(100 * self.proved_share, 99.9999)  # never told as all of it
        return (
            f"not decided for {where}: {volume:.6g} % of the volume is proved stable, no "
            f"counter-example was found, {len(self.undecided)} of the boxes are left after {self.boxes}; "
            "allow more boxes or take a smaller region"
        )

    def findings(self) -> dict[str, Any]:
        """Return the state, in words too, and a counter-example: its values and eigenvalues."""
        found = self.counterexample
        against = (
            None
            if found is None
            else {
                "values": dict(found.values),
                "eigenvalues": [{"re": z.real, "im": z.imag} for z in found.eigenvalues],
            }
        )
        return {
            "ranges": {name: [float(end) for end in ends] for name, ends in self.ranges.items()},
            "state": self.state, "sentence": self.sentence, "proved_share": self.proved_share, "boxes": self.boxes,
            "counterexample": against,
        }  # fmt: skip

    def table(self) -> Table:
        """Return one row for each box left undecided."""
        rows = ("box",)
        numbers = Series("box", rows, np.arange(1, len(self.undecided) + 1))
        data = [
            Series(f"{name}_{end}", rows, self.undecided[:, i, j], unit_of(self.vehicle, name))
            for i, name in enumerate(self.ranges)
            for j, end in enumerate(("lower", "upper"))
        ]
        return Table("undecided boxes", self.vehicle, (numbers,), tuple(data), rows)

    def __str__(self) -> str:
        return self.sentence


def _value(vehicle: Model, name: str, x: float) -> str:
    unit = unit_of(vehicle, name)
    return f"{name} = {x:.8g}" + ("" if unit == "1" else f" {unit}")


def _range(vehicle: Model, name: str, low: Fraction, high: Fraction) -> str:
    unit = unit_of(vehicle, name)
    if name == type(vehicle).declaration.speed:
        ends = float(low), float(high)
        km_h = " to ".join(f"{3.6 * x:.6g}" for x in ends)
        return f"every {name} from {ends[0]:.6g} to {ends[1]:.6g} m/s ({km_h} km/h)"
    return f"every {name} from {float(low):.10g} to {float(high):.10g}" + ("" if unit == "1" else f" {unit}")


def sense_of(vehicle: Model, ranges: Mapping[str, tuple[Fraction, Fraction]]) -> int:
    """Return the sign of the speed in a region."""
    speed = type(vehicle).declaration.speed
    if speed is None:
        return 1
    return 1 if (ranges[speed][1] if speed in ranges else vehicle.values[speed]) > 0 else -1
