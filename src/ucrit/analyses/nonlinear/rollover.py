"""Rolling over: the lateral acceleration at which the wheels on the inside of a turn carry nothing any more.

Forces and moments in a steady turn give the loads of both sides; the inner one vanishes at ``a_y = g t/(2 h)`` for a
track t and a centre of mass at the height h (Karnopp 2004, Problem 6.8). The body is taken as rigid: roll on the
suspension and the give of the tires lower the threshold of a real car.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ...core.contract.model import Model
from ...core.errors import UcritError
from ...core.html import Rich
from ..linear.steady import GRAVITY
from .handling_words import acceleration
from .steady_family import steady_family

SMALL = 1e-3
"""Lateral acceleration [g] of the steady turn that shows how loads change; they do so in proportion to it."""


@dataclass(frozen=True)
class Rollover(Rich):
    """When a car rolls over in a steady turn.

    Attributes
    ----------
    threshold
        Lateral acceleration [m/s^2] at which all load is on the outer wheels; infinite for a car without height.
    lifts
        Lateral acceleration [m/s^2] at which each wheel of the inner side lifts, were nothing to happen before, by
        the name of its load.
    """

    vehicle: Model
    threshold: float
    lifts: Mapping[str, float]

    @property
    def first(self) -> str:
        """Name of the load that vanishes first; empty where none does."""
        return min(self.lifts, key=lambda name: self.lifts[name], default="")

    def __str__(self) -> str:
        name = self.vehicle.info.name or type(self.vehicle).model_id()
        if not np.isfinite(self.threshold):
            return f"{name}: does not roll over: its centre of mass has no height"
        lines = [f"{name}: rolls over at a lateral acceleration of {acceleration(self.threshold)}"]
        lines += [f"    {load} is zero from {acceleration(a_y)} on" for load, a_y in self.lifts.items()]
        return "\n".join(lines)


def rollover(vehicle: Model, *, steer: str = "delta_f") -> Rollover:
    """Return the threshold at which a car rolls over, and the lateral accelerations at which its wheels lift.

    Parameters
    ----------
    vehicle
        With scalar parameters; its model names the outputs that are its wheels' loads in ``wheel_loads``, and has the
        outputs ``load_transfer`` [1], the difference of both sides' loads over their sum, and ``a_y`` [m/s^2].
    steer
        The input [rad] that steers.

    Returns
    -------
    Rollover
        Of the loads that grow and fall in proportion to the lateral acceleration.

    Raises
    ------
    UcritError
        If the model lacks what is needed.

    Examples
    --------
    >>> from ucrit import load
    >>> car = load("four-wheel-car")
    >>> round(rollover(car).threshold / car.g, 4), car.t_f / (2 * car.h)
    (1.3636, 1.3636363636363635)
    """
    cls = type(vehicle)
    outputs, loads = cls.declaration.outputs, tuple(getattr(cls, "wheel_loads", ()))
    missing = [name for name in ("a_y", "load_transfer") if name not in outputs]
    if missing or not loads or steer not in cls.declaration.inputs or cls.declaration.speed is None:
        raise UcritError(
            f"{cls.model_id()}: rolling over needs the outputs a_y and load_transfer, wheel_loads, the input {steer} "
            "and a speed, not all of which the model has"
        )
    keeps: dict[str, str] = getattr(cls, "keeps_speed", {})
    speed = float(vehicle.values[cls.declaration.speed])
    turns = steady_family(
        vehicle, "a_y", SMALL * GRAVITY, free=(steer, *keeps), hold=dict.fromkeys(keeps.values(), speed)
    )
    slope = float(turns.slope("load_transfer", "a_y")[0])
    lifts = {}
    for name in loads:
        falls = float(turns.slope(name, "a_y")[0])
        if falls < 0 and abs(falls * GRAVITY) > 1e-9 * abs(turns[name][0]):
            lifts[name] = float(turns[name][0] / -falls)
    return Rollover(vehicle, 1 / abs(slope) if slope else np.inf, lifts)
