"""What the page chooses by itself: ranges around the design, and the two parameters of the map."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ..core.contract.possible import allowed
from ..core.errors import UcritError, near_match

if TYPE_CHECKING:
    from ..analyses.stability.analyze import Analysis
    from ..analyses.stability.locus import Locus
    from ..core.contract.model import Model

Array = npt.NDArray[np.float64]

WIDE = 8.0
"""Ranges that span more than this factor are divided by equal ratios."""


def map_parameters(analysis: Analysis, asked: Sequence[str] | None) -> tuple[str, str] | None:
    """Return the map's parameters: those asked for, or speed and the most effective one, or the two of these.

    ``None`` where fewer than two parameters are worth a map.
    """
    declared = type(analysis.vehicle).declaration
    if asked is not None:
        return _checked(analysis.vehicle, asked)
    effective = [r.parameter for r in analysis.remedies if r.value is not None]
    if analysis.stable:
        effective = _sensitive(analysis)
    candidates = [*([declared.speed] if declared.speed else []), *effective, *declared.parameters]
    chosen = list(dict.fromkeys(candidates))
    return (chosen[0], chosen[1]) if len(chosen) > 1 else None


def _checked(vehicle: Model, asked: Sequence[str]) -> tuple[str, str]:
    known = type(vehicle).declaration.parameters
    if isinstance(asked, str) or len(asked) != 2 or asked[0] == asked[1]:
        raise UcritError(f"a map needs two different parameters, got {asked!r}")
    for name in asked:
        if name not in known:
            raise UcritError(f"{type(vehicle).model_id()}: there is no parameter '{name}'{near_match(name, known)}")
    return asked[0], asked[1]


def _sensitive(analysis: Analysis) -> list[str]:
    """Parameters of a stable vehicle, first those that move its next critical speed most, or its damping."""
    from ..analyses.stability.sensitivity import sensitivity

    vehicle = analysis.vehicle
    found = sensitivity(vehicle)
    beyond = [c for c in found.critical if abs(c.critical.value) > abs(analysis.speed or 0)]
    if beyond:
        effects = min(beyond, key=lambda c: abs(c.critical.value)).normalised
    else:
        effects = {name: float(slope * vehicle.values[name]) for name, slope in found.growth.items()}
    known = {name: abs(effect) for name, effect in effects.items() if effect and math.isfinite(effect)}
    return sorted(known, key=lambda name: -known[name])


def map_range(
    analysis: Analysis, name: str, count: int, path: Locus | None = None, beside: Model | None = None
) -> Array:
    """Return values of a parameter around the design, reaching beyond its remedy, inside its bounds.

    A parameter that a root locus is drawn along takes the range of that drawing; ``beside`` is the vehicle with the
    ends of another parameter's range, all of which must be possible together with this one's.
    """
    declared = allowed(beside or analysis.vehicle, name)
    if path is not None and path.parameter == name:
        return np.asarray(np.linspace(path.values[0], path.values[-1], count))
    present = float(analysis.vehicle.values[name])
    remedy = next((r.value for r in analysis.remedies if r.parameter == name and r.value is not None), None)
    if not present:
        reach = 2 * remedy if remedy is not None else 1.0
        lower, upper = sorted((0.0, reach))
    elif remedy is None or remedy * present <= 0:
        ends = [0.4 * present, 1.8 * present, *([] if remedy is None else [1.3 * remedy])]
        lower, upper = min(ends), max(ends)
    else:
        ends = [0.5 * present, 1.6 * present, 0.75 * remedy, 1.35 * remedy]
        lower, upper = min(ends), max(ends)
    return _inside(declared, lower, upper, count)


def _inside(declared: Any, lower: float, upper: float, count: int) -> Array:
    """Space values between two ends moved inside the parameter's bounds."""
    margin = 1e-3 * (upper - lower)
    lower = max(lower, declared.at_least, declared.above + margin)
    upper = min(upper, declared.at_most, declared.below - margin)
    if lower > 0 and upper / lower > WIDE:
        return np.asarray(np.geomspace(lower, upper, count))
    return np.asarray(np.linspace(lower, upper, count))
