"""A handling diagram in words."""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING

import numpy as np

from ..linear.steady import GRAVITY
from ..stability.wording import speed_text
from .steady_problem import CANNOT

if TYPE_CHECKING:
    from .handling import Handling

LIMITS = {
    "plough-out": "ploughs out: the front axle saturates first",
    "spin": "spins: the rear axle saturates first",
    "drift": "slides on both axles at once",
}

ROUNDING = 1e-9
"""Share of the front axle's own slip per lateral acceleration below which their difference is rounding."""

NOT_YET = "no axle saturates within the slip angles looked at"


def acceleration(a_y: float) -> str:
    """Return a lateral acceleration in both of its units.

    >>> acceleration(4.903325)
    '4.903 m/s^2 (0.5 g)'
    """
    return f"{a_y:.4g} m/s^2 ({a_y / GRAVITY:.3g} g)"


def facts(found: Handling) -> list[str]:
    """Return what a handling diagram tells, a line each: limit, gradient, ranges, end."""
    limit = LIMITS.get(found.limit)
    if not limit:
        lost = found.family.end.startswith(CANNOT)
        limit = "the limit is not known: the turns could not be followed to it" if lost else NOT_YET
    lines = [limit, f"largest lateral acceleration {acceleration(found.largest)}"]
    K, degrees = found.gradient[0], found.gradient_deg_per_g[0]
    if abs(K) < ROUNDING * abs(found.family.rates["alpha_f"][0] / found.family.rates["a_y"][0]):
        K = degrees = 0.0
    lines.append(f"understeer gradient at first {K:.4g} rad/(m/s^2) = {degrees:.4g} deg/g")
    for part in found.ranges:
        a, b = (0.0 if abs(v) < 1e-9 * found.largest else v for v in part.a_y)
        lines.append(f"{part.kind:<11}{acceleration(a) if a else '0'} to {acceleration(b)}")
    if np.isfinite(found.unstable_from):
        change = found.family.changes[0]
        at = f" at {change.frequency_hz:.3g} Hz" if change.kind == "flutter" else ""
        from_ = acceleration(found.unstable_from)
        lines.append(f"with the steering held, unstable from {from_} on: {change.kind}{at}")
    if found.turns.constant != "speed":
        lines.append(f"speed from {speed_text(found.speed[0])} to {speed_text(float(found.speed.max()))}")
    return [*lines, f"ends: {found.family.end}"]


def sentences(found: Handling) -> list[str]:
    """Return the lines that a handling diagram prints: the car, then the facts, indented."""
    vehicle = found.vehicle
    head = f"{vehicle.info.name or type(vehicle).model_id()}: steady turns {found.turns.words}"
    *lines, end = facts(found)
    return [head, *(f"    {line}" for line in lines), *wrapped(end)]


def wrapped(text: str) -> list[str]:
    """Return a sentence as lines of a report, indented and at most eighty columns wide."""
    return textwrap.wrap(text, 80, initial_indent="    ", subsequent_indent="      ")
