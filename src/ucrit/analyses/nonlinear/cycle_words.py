"""Limit cycles in words: what happens at the critical value, from where on a disturbed vehicle may oscillate."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ..stability.wording import speed_text

if TYPE_CHECKING:
    from collections.abc import Callable

    from .cycle import Cycle, CycleBranch
    from .cycles import LimitCycles

EVENTS = {
    "period doubling": "a multiplier passes through -1, where cycles of twice the period branch off",
    "torus": "a pair of multipliers leaves the unit circle, where the amplitude begins to beat",
    "branching": "a multiplier passes through 1, where other cycles branch off",
}
ENDS = {
    "range": "",
    "equilibrium": "the branch ends in another critical value",
    "closed": "the branch comes back to where it began",
    "large": "the branch is not followed to angles beyond 90 degrees",
    "endless": "the branch goes on to ever larger cycles at the same value",
    "slides": "the branch is not followed further: the motion would slide along a jump of a law",
    "stuck": "the branch cannot be followed further",
    "count": "the branch is not followed further",
}

EDGES = {
    "range": "the end of the range",
    "equilibrium": "where the cycles shrink to nothing",
    "large": "angles pass 90 degrees beyond",
    "endless": "ever larger cycles at the same value",
    "slides": "the motion would slide along a jump of a law beyond",
    "stuck": "where it cannot be followed further",
    "count": "where it is followed no further",
}
"""Ends of a branch that was begun from a motion."""


def describe(found: LimitCycles, say: Callable[[float], str] = speed_text) -> tuple[str, ...]:
    """Return what happens beyond the critical values, one or more sentences for each branch; ``say`` writes a speed."""
    if not found.branches:
        return (f"No oscillation begins at any {found.parameter} in the range; there are no limit cycles to follow.",)
    return tuple(sentence for branch in found.branches for sentence in _branch(branch, say))


def value_text(
    branch_or_found: CycleBranch | LimitCycles, value: float, say: Callable[[float], str] = speed_text
) -> str:
    """Return a value of the parameter with its unit; speeds as ``say`` writes them, in km/h too."""
    declared = type(branch_or_found.vehicle).declaration
    if declared.speed == branch_or_found.parameter:
        return say(abs(value)) + (" backing up" if value < 0 else "")
    unit = "" if branch_or_found.unit == "1" else f" {branch_or_found.unit}"
    return f"{branch_or_found.parameter} = {value:.4g}{unit}"


def amplitude_text(value: float, unit: str) -> str:
    """Return an amplitude with its unit; angles in degrees, short lengths in millimetres.

    >>> amplitude_text(0.4247, "rad"), amplitude_text(0.0081, "m"), amplitude_text(0.9, "m")
    ('24.33 deg', '8.1 mm', '0.9 m')
    """
    if unit == "rad":
        return f"{math.degrees(value):.4g} deg"
    if unit == "m" and abs(value) < 0.1:
        return f"{1e3 * value:.4g} mm"
    return f"{value:.4g} {unit}"


def leading_state(branch: CycleBranch) -> tuple[str, str]:
    """Return the name and unit of the state that a branch is told by: an angle of some degrees, or else a length."""
    declared, peaks = type(branch.vehicle).declaration.variables, branch.amplitudes.max(axis=0)
    own = [(s, declared[s].unit, peak) for s, peak in zip(branch.states, peaks, strict=True) if s in declared and peak]
    angles = [(s, unit) for s, unit, peak in own if unit == "rad" and peak > math.radians(2)]
    lengths = [(s, unit) for s, unit, _ in own if unit == "m"]
    return (*angles, *lengths, *((s, unit) for s, unit, _ in own), (branch.states[0], "1"))[0]


def _branch(branch: CycleBranch, say: Callable[[float], str]) -> list[str]:
    event = branch.critical
    if event is None:
        return _from_motion(branch, say)
    side = "below" if (event.stable == "below") == (event.value > 0) else "above"
    said = [
        f"Straight running is stable {side} {value_text(branch, event.value, say)}; beyond, the {event.mode} "
        f"grows at {event.frequency_hz:.3g} Hz."
    ]
    said += [_kind(branch)]
    onset = branch.onset
    if branch.kind == "subcritical" or onset is not None:
        said += [_onset(branch, onset, say)]
    said += [f"Near {value_text(branch, at, say)} {EVENTS[what]}." for what, at in branch.events]
    if ENDS[branch.end]:
        said += [f"{ENDS[branch.end][0].upper()}{ENDS[branch.end][1:]} ({value_text(branch, branch.values[-1], say)})."]
    return said + _accuracy(branch)


def _from_motion(branch: CycleBranch, say: Callable[[float], str]) -> list[str]:
    """Tell a branch that was begun from a motion: its first cycle, how far it goes, where its cycles are stable."""
    start, declared = branch.start, type(branch.vehicle).declaration.variables
    assert start is not None
    name, _ = leading_state(branch)
    size = amplitude_text(start.amplitude[name], declared[name.rstrip("'")].state_unit(name.count("'")))
    said = [
        f"At {value_text(branch, start.value, say)} the simulated motion comes to a limit cycle with an amplitude of "
        f"{name} of {size} at {start.frequency_hz:.3g} Hz."
    ]
    sides = (branch.begin, branch.values[0]), (branch.end, branch.values[-1])
    if branch.end == "closed":
        said += ["Its branch is closed: it comes back to this cycle."]
    else:
        (why, one), (reason, other) = sorted(sides, key=lambda side: side[1])
        first, last = value_text(branch, one, say), value_text(branch, other, say)
        said += [f"Its branch ends at {first} ({EDGES[why]}) and at {last} ({EDGES[reason]})."]
    if branch.stable.any():
        held = [c.value for c in branch.cycles if c.stable or c.fold]
        low, high = value_text(branch, min(held), say), value_text(branch, max(held), say)
        said += [f"Stable limit cycles are found from {low} to {high}."]
    said += [f"Two cycles meet and vanish at {value_text(branch, c.value, say)}." for c in branch.folds]
    said += [f"Near {value_text(branch, at, say)} {EVENTS[what]}." for what, at in branch.events]
    return said + _accuracy(branch)


def _accuracy(branch: CycleBranch) -> list[str]:
    worst = max(cycle.error for cycle in branch.cycles)
    return [f"The states of the least accurate cycle are off by about {worst:.1%}."] if worst > 1e-3 else []


def _kind(branch: CycleBranch) -> str:
    if branch.kind == "supercritical":
        return (
            "Supercritical: just beyond it the vehicle swings in a small stable limit cycle, which grows with the "
            "distance from it."
        )
    if branch.kind == "subcritical":
        return (
            "Subcritical: the limit cycles next to it are unstable and lie where straight running is stable; a "
            "disturbance larger than they are does not die out, and beyond it the vehicle swings widely at once."
        )
    return "The first limit cycles are at the critical value itself: what bounds the motion acts on larger ones only."


def _onset(branch: CycleBranch, onset: Cycle | None, say: Callable[[float], str]) -> str:
    assert branch.critical is not None
    if onset is None or not np.isfinite(onset.value):
        side, end = ("down", np.min) if branch.critical.stable == "below" else ("up", np.max)
        return f"No stable limit cycle is found {side} to {value_text(branch, float(end(branch.values)), say)}."
    share = abs(onset.value / branch.critical.value - 1)
    name, unit = leading_state(branch)
    size = amplitude_text(onset.amplitude[name], unit)
    at = value_text(branch, onset.value, say)
    how = f"with an amplitude of {name} of {size} there"
    word = "from" if branch.critical.stable == "below" else "up to"
    side = "below" if branch.critical.stable == "below" else "above"
    return (
        f"A disturbed vehicle may keep oscillating {word} {at} on, the non-linear critical value, "
        f"{100 * share:.2g} % {side} the linear one, {how}."
    )


def expectation(found: LimitCycles, value: float, say: Callable[[float], str] = speed_text) -> str:
    """Return what to expect at one value of the parameter, in a sentence or two."""
    cycles = found.at(value)
    at = value_text(found, value, say)
    inside = any(low < value < high for low, high in found.critical.stable_ranges())
    said = [f"At {at} straight running is {'stable' if inside else 'unstable'}"]
    if not found.branches or not cycles:
        return f"{said[0]}; no limit cycle was found there."
    name, unit = leading_state(found.branches[0])
    for cycle in sorted(cycles, key=lambda c: c.amplitude[name]):
        word = "stable" if cycle.stable else "unstable"
        size = amplitude_text(cycle.amplitude[name], unit)
        said.append(f"{word} limit cycle: amplitude of {name} {size}, {cycle.frequency_hz:.4g} Hz")
    return "; ".join(said) + "."
