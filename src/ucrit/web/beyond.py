"""Beyond the linear verdict: a car's turns up to the limit, and the limit cycles of what begins to oscillate."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from ..analyses.nonlinear.cycle_words import describe, expectation, leading_state
from ..analyses.nonlinear.cycles import limit_cycles
from ..analyses.nonlinear.handling import handling_diagram
from ..analyses.nonlinear.handling_words import facts
from ..core.errors import UcritError
from ..plots.cycles import pieces, shown, straight, window
from .answers import Answer, say_speed

if TYPE_CHECKING:
    from ..core.contract.model import Model

PATIENCE = 45.0
"""Seconds of computing after which limit cycles are given up."""


def handling(vehicle: Model, body: Mapping[str, Any]) -> Answer:
    """Return the turns of a car from straight running to the limit, to be drawn, and what they tell."""
    say, found = say_speed(body), handling_diagram(vehicle)
    first, *others, end = [" ".join(line.split()) for line in facts(found)]
    others += [] if found.limit else [end]
    columns = ("a_y", "front", "rear", "difference", "curvature", "delta")
    speed = float(vehicle.values[type(vehicle).declaration.speed or ""])
    return {
        "told": [f"Steady turns at {say(speed)}: {'the car ' if found.limit else ''}{first}", *others],
        **{name: getattr(found, name).tolist() for name in columns},
        "stable": found.stable.tolist(),
        "ranges": [{"kind": r.kind, "curvature": sorted(r.curvature)} for r in found.ranges],
        "largest": found.largest,
    }


def cycles(vehicle: Model, body: Mapping[str, Any]) -> Answer:
    """Return the amplitude of limit cycles over the speed, to be drawn, and what they tell."""
    say = say_speed(body)
    found = limit_cycles(vehicle, progress=_patience())
    if not found.branches:
        return {"told": list(describe(found, say)), "branches": []}
    name, unit = leading_state(found.branches[0])
    column = found.branches[0].states.index(name)
    sizes = [branch.amplitudes[:, column] for branch in found.branches]
    factor, text = shown(unit, max(size.max() for size in sizes))
    left, right = window(found)
    now = float(vehicle.values[found.parameter])
    told = list(describe(found, say))
    if found.lower <= now <= found.upper:
        told.append(expectation(found, now, say))
    told.append(f"{name} is the {type(vehicle).declaration.variables[name].meaning}.")
    return {
        "told": told,
        "parameter": found.parameter,
        "range": [left, right],
        "state": name,
        "unit": text,
        "straight": [{"x": [a, b], "stable": stable} for a, b, stable in straight(found, left, right)],
        "branches": [
            {
                "critical": branch.critical.value if branch.critical else None,
                "pieces": [
                    {"x": x.tolist(), "y": (factor * y).tolist(), "stable": stable}
                    for x, y, stable in pieces(branch, size)
                ],
                "folds": [
                    [cycle.value, float(factor * height)]
                    for cycle, height in zip(branch.cycles, size, strict=True)
                    if cycle.fold
                ],
            }
            for branch, size in zip(found.branches, sizes, strict=True)
        ],
        "top": float(factor * max(np.max(size) for size in sizes)),
    }


def _patience() -> Callable[[int, int], None]:
    """Return what gives limit cycles up that take too long: a thread cannot be stopped from outside."""
    start = time.monotonic()

    def check(done: int, most: int) -> None:
        if time.monotonic() - start > PATIENCE:
            raise UcritError(
                "following the limit cycles takes longer than a page can wait; ucrit cycles has no such limit"
            )

    return check
