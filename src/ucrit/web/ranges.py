"""How far sliders reach, and with them the drawings that go along a parameter."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from ..core.contract.possible import allowed

if TYPE_CHECKING:
    from ..analyses.stability.analyze import Analysis
    from ..core.contract.declare import Parameter
    from ..core.contract.model import Model

REACH = 3.0
"""End of a slider as a multiple of the value it starts with."""

FAR = 8.0
"""A remedy or critical speed beyond this multiple does not stretch a slider."""

START = 0.01
"""Start of a slider whose parameter must be above zero, as a share of its end."""


def slider_range(found: Analysis, name: str) -> tuple[float, float]:
    """Return the ends of a parameter's slider: round numbers inside its bounds, with the vehicle between them."""
    vehicle = found.vehicle
    declared, now = allowed(vehicle, name), float(vehicle.values[name])
    if declared.is_speed:
        near = [abs(c.value) for c in found.critical or () if abs(c.value) < FAR * abs(now)]
        low, high = 0.0, round_up(1.5 * max(abs(now), *near, 0.0))
        if now < 0:
            low, high = -high, -low
    elif math.isfinite(declared.lower) and math.isfinite(declared.upper) and declared.lower <= now <= declared.upper:
        low, high = declared.lower, declared.upper
    else:
        low, high = _around(found, declared, now)
    return clipped(declared, low, high)


def _around(found: Analysis, declared: Parameter, now: float) -> tuple[float, float]:
    """Return a range about a value that no two bounds enclose."""
    remedy = next((r.value for r in found.remedies if r.parameter == declared.name and r.value is not None), None)
    size = abs(now) or abs(remedy or 0) or 1.0
    high = REACH * size
    if remedy is not None and abs(remedy) < FAR * size:
        high = max(high, 1.2 * abs(remedy))
    high = round_up(high)
    if declared.sign is None:
        low = -high if not now or (remedy or now) * now < 0 else -round_up(size)
        return (low, high) if now >= 0 else (-high, -low)
    return (0.0, high) if declared.sign >= 0 else (-high, 0.0)


def clipped(declared: Parameter, low: float, high: float) -> tuple[float, float]:
    """Move ends inside a parameter's bounds; beside a bound that is not allowed itself, a little away from it."""
    margin = START * (high - low)
    if low <= declared.above or (declared.is_speed and low == 0):
        low = max(declared.above, 0.0 if declared.is_speed and low == 0 else -math.inf) + margin
    if high >= declared.below or (declared.is_speed and high == 0):
        high = min(declared.below, 0.0 if declared.is_speed and high == 0 else math.inf) - margin
    return max(low, declared.at_least), min(high, declared.at_most)


def drawn_range(vehicle: Model, name: str, low: float, high: float) -> tuple[float, float]:
    """Return the part of a range that is possible for a vehicle; all of it where that is empty, to be refused."""
    inside = clipped(allowed(vehicle, name), low, high)
    return inside if inside[0] < inside[1] else (low, high)


def round_up(value: float) -> float:
    """Return the smallest round number that is not below a value.

    >>> round_up(41.7), round_up(0.0023), round_up(100)
    (50.0, 0.0025, 100.0)
    """
    if not value > 0:
        return 1.0
    power = 10.0 ** math.floor(math.log10(value))
    steps = (1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10, 20)
    return float(f"{next(step for step in steps if step * power >= value * (1 - 1e-12)) * power:.6g}")
