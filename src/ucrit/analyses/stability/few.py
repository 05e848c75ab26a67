"""Criteria in the few parameters that matter most, where those in all of them are too long to be read."""

from __future__ import annotations

import math
from collections.abc import Iterator

from ...core.contract.model import Model
from ...core.errors import UcritError
from .criteria import Criteria, criteria
from .sensitivity import sensitivity

READABLE = 300
"""Characters that conditions may have together to count as readable."""

TRIED = 6
"""Parameters that are tried, those that matter most."""


def few_criteria(vehicle: Model) -> Criteria | None:
    """Return the conditions with the speed and what it depends on most as symbols, ``None`` if none can be read.

    The largest readable set counts: speed and two parameters, then pairs, then single ones; a condition that is
    settled tells least.
    """
    settled: Criteria | None = None
    for free in _sets(vehicle):
        try:
            found = criteria(vehicle, free=free)
        except UcritError:
            continue
        if found.settled is not None:
            settled = settled or found
        elif sum(len(c.expression) for c in found) <= READABLE:
            return found
    return settled


def _sets(vehicle: Model) -> Iterator[list[str]]:
    """Return the sets of parameters that are tried, the most telling first."""
    speed = type(vehicle).declaration.speed
    top = [name for name in ranked(vehicle) if name != speed][:TRIED]
    if speed is not None:
        yield [speed, *top[:2]]
        yield from ([speed, name] for name in top)
    yield top[:2]
    yield from ([name] for name in top)
    if speed is not None:
        yield [speed]


def ranked(vehicle: Model) -> list[str]:
    """Return the parameters that matter, by what a percent of each does to the critical speed, else to the growth."""
    found = sensitivity(vehicle)
    first = min(found.critical, key=lambda c: abs(c.critical.value), default=None)
    if first is not None and any(map(math.isfinite, first.normalised.values())):
        effect = {name: abs(slope) for name, slope in first.normalised.items()}
    else:
        effect = {name: abs(float(slope) * float(vehicle.values[name])) for name, slope in found.growth.items()}
    telling = {name: size for name, size in effect.items() if math.isfinite(size) and size > 0}
    return sorted(telling, key=lambda name: -telling[name])
