"""The vehicle in motion: in one of its modes, or after a disturbance."""

from __future__ import annotations

import math
import time
from typing import TYPE_CHECKING, Any

from ..analyses.linear.modes import Mode, modes
from ..analyses.motion.scene import mode_scene, refuse_without_drawing, scene
from ..analyses.motion.simulate import simulate
from ..core.errors import UcritError
from ..plots.animation_page import film
from ..plots.camera import caption, frame_times

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from ..core.contract.model import Model

SHORTEST, LONGEST = 0.5, 20.0
"""How long [s] a motion after a disturbance is followed."""

SIZES = {"rad": math.radians(2), "rad/s": 0.1, "m": 0.05, "m/s": 0.5}
"""A disturbance that can be seen, by the unit of the state."""

TOLERANCE = 1e-6

PATIENCE = 15.0
"""Seconds of computing after which a motion is given up."""


def motion(vehicle: Model, body: Mapping[str, Any]) -> dict[str, Any]:
    """Return a film of the vehicle in the mode of a number, or after a disturbance of a state."""
    refuse_without_drawing(vehicle)
    if body.get("disturb") is not None:
        return disturbed(vehicle, body["disturb"])
    found, number = modes(vehicle).list(), body.get("mode", 0)
    if isinstance(number, bool) or not isinstance(number, int) or not 0 <= number < len(found):
        raise UcritError(f"this vehicle has modes 0 to {len(found) - 1}, got {str(number)[:30]}")
    mode = found[number]
    shown = mode_scene(vehicle, mode)
    told = f"{mode.name}, {_going(mode)}, drawn larger than it would be"
    return {"film": film(shown), "caption": f"{caption(shown)}: {told}"}


def _going(mode: Mode) -> str:
    if math.isfinite(mode.time_to_double):
        return f"doubling in {mode.time_to_double:.3g} s"
    return f"halving in {mode.time_to_half:.3g} s" if math.isfinite(mode.time_to_half) else "neither growing nor dying"


def disturbed(vehicle: Model, name: Any) -> dict[str, Any]:
    """Return a film of the non-linear motion from a small value of one state."""
    variables = type(vehicle).declaration.variables
    base = name.rstrip("'") if isinstance(name, str) else ""
    if base not in variables:
        raise UcritError(f"this vehicle has no state '{str(name)[:30]}' to disturb")
    unit = variables[base].state_unit(name.count("'"))
    size = SIZES.get(unit, 0.1)
    last = duration(modes(vehicle).list())
    run = simulate(vehicle, last, {name: size}, tolerance=TOLERANCE, progress=_patience())
    end = float(run.times[-1])
    shown = scene(run, frame_times(0.0, end))
    ended = f", which ends at {end:.3g} s: {run.ended}" if run.ended else ""
    told = f"non-linear motion after {name} = {size:.3g} {unit}{ended}"
    return {"film": film(shown), "caption": f"{caption(shown)}: {told}"}


def _patience() -> Callable[[float, float], None]:
    """Return what gives a simulation up that goes on for too long: a thread cannot be stopped from outside."""
    start = time.monotonic()

    def check(reached: float, last: float) -> None:
        if time.monotonic() - start > PATIENCE:
            raise UcritError(
                f"the motion takes longer than a page can wait: {reached:.3g} s of {last:.3g} s were followed in time; "
                "ucrit simulate has no such limit"
            )

    return check


def duration(found: list[Mode]) -> float:
    """Return how long a motion is worth watching: some periods, some halvings or doublings of its slowest mode."""
    spans = []
    for mode in found:
        value = mode.eigenvalue
        if value.imag:
            spans.append(4 * 2 * math.pi / value.imag)
        if value.real:
            spans.append(4 / abs(value.real))
    return min(max([SHORTEST, *spans]), LONGEST)
