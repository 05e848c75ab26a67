"""The three tests by which a car's steady turns are driven up to the limit (ISO 4138): what stays the same in each."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from ...core.contract.model import Model
from ...core.errors import UcritError
from ...core.units import to_si
from ..linear.steady import GRAVITY
from ..stability.wording import speed_text
from .steady_family import SteadyFamily, steady_family

Constant = Literal["speed", "radius", "steer angle"]

BEYOND = 3.0
"""Lateral acceleration [g] up to which the turns would go; no tire goes so far."""

FIRST, FASTEST = 1.0, 100.0
"""Speeds [m/s] at which the tests begin and end in which the speed rises."""


@dataclass(frozen=True)
class Turns:
    """One of the tests: what is constant and its value [SI], the input that steers, and what keeps the speed.

    ``keeps`` has the states that are velocities, by the inputs that are free to hold them.
    """

    constant: Constant
    value: float
    steer: str
    free: tuple[str, ...]
    keeps: Mapping[str, str]

    def follow(self, vehicle: Model, within: Mapping[str, Any], step: float, upto: float | None) -> SteadyFamily:
        """Return the steady turns from straight running, or from walking pace, on."""
        if self.constant == "speed":
            hold = dict.fromkeys(self.keeps.values(), self.value)
            goal, free = BEYOND * GRAVITY, (self.steer, *self.free)
            return steady_family(vehicle, "a_y", goal, free=free, hold=hold, within=within, step=step)
        speed = vehicle.declaration.speed or ""
        fastest = FASTEST if upto is None else upto
        if fastest <= FIRST:
            raise UcritError(
                f"{type(vehicle).model_id()}: the speed must rise beyond {FIRST:g} m/s, got {fastest:g} m/s"
            )
        moved = next(iter(self.keeps.values()), speed)
        held, free = ("curvature", 1 / self.value), (self.steer, *self.free)
        if self.constant == "steer angle":
            held, free = (self.steer, self.value), self.free
        hold = dict([held])
        return steady_family(
            vehicle.with_(**{speed: FIRST}), moved, fastest, free=free, hold=hold, within=within, step=step
        )

    def speeds(self, vehicle: Model, family: SteadyFamily) -> Any:
        """Return the speed of each turn."""
        moved = next(iter(self.keeps.values()), vehicle.declaration.speed or "")
        return np.full(len(family.unstable), self.value) if self.constant == "speed" else family[moved]

    @property
    def words(self) -> str:
        """What is constant: ``"at 25 m/s"``, ``"on a radius of 60 m"``, ``"at a steer angle of 2 deg"``."""
        if self.constant == "speed":
            return f"at {speed_text(self.value)}"
        if self.constant == "radius":
            return f"on a radius of {self.value:.4g} m, the speed rising"
        return f"at a steer angle of {np.rad2deg(self.value):.4g} deg, the speed rising"


def chosen(vehicle: Model, steer: str, free: tuple[str, ...], radius: Any, angle: Any) -> Turns:
    """Return the test that a radius or a steer angle asks for; else that at the vehicle's own speed."""
    if radius is not None and angle is not None:
        raise UcritError("either the radius or the steer angle stays the same, not both")
    keeps: Mapping[str, str] = getattr(type(vehicle), "keeps_speed", {})
    kept = {name: keeps[name] for name in free if name in keeps}
    if radius is not None:
        if "curvature" not in vehicle.declaration.outputs:
            raise UcritError(
                f"{type(vehicle).model_id()}: a constant radius needs an output curvature [1/m], which the model does "
                "not have"
            )
        return Turns("radius", _above_zero(radius, "m", "radius"), steer, free, kept)
    if angle is not None:
        return Turns("steer angle", _above_zero(angle, "rad", "steer angle"), steer, free, kept)
    return Turns("speed", float(vehicle.values[vehicle.declaration.speed or ""]), steer, free, kept)


def _above_zero(value: Any, unit: str, name: str) -> float:
    found = float(to_si(value, unit, name))
    if not 0 < found < np.inf:
        raise UcritError(f"{name} must be above 0 {unit}, got {found:g} {unit}")
    return found
