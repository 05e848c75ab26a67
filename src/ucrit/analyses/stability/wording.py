"""Findings in words: the verdict as one sentence."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING

from ...core.numeric.compiled import compiled, direction
from ..results.digits import decimal_text, rounded

if TYPE_CHECKING:
    from collections.abc import Callable

    from ...core.contract.model import Model
    from .analyze import Analysis
    from .critical import Critical


FASTEST = 1000.0
"""Speed [m/s] above which a change of stability is not worth a word: no vehicle on wheels gets there."""


def speed_text(speed: float) -> str:
    """Return a speed in m/s and, for readers on the road, in km/h.

    >>> speed_text(23.41)
    '23.41 m/s (84.3 km/h)'
    """
    on_the_road = speed * 3.6
    return f"{speed:.4g} m/s ({on_the_road:{'.0f' if 1000 <= abs(on_the_road) < 1e6 else '.3g'}} km/h)"


def caveat(vehicle: Model) -> str:
    """Return what a linear verdict leaves out where laws jump or bend on the basic motion; empty where none does."""
    found = compiled(type(vehicle), direction(vehicle)).corners
    jumps, kinks = ([where for kind, where in found if kind == wanted] for wanted in ("jump", "kink"))
    told = []
    if jumps:
        told.append(
            f"a law jumps on the basic motion, at {_zeros(jumps)}, where it has no slope: the verdict leaves the jump "
            "out, and small motions may be held or driven by it"
        )
    if kinks:
        told.append(
            f"a law has a kink on the basic motion, at {_zeros(kinks)}: the verdict takes the slope of one side, of "
            "abs that of neither, and the motion may do otherwise on the other"
        )
    return "; ".join(told)


def _zeros(where: list[str]) -> str:
    return ", ".join(f"{text} = 0" for text in where)


def _two_digits(value: float) -> str:
    """Return a number in two digits, without an exponent where that is short.

    >>> _two_digits(175.2), _two_digits(0.0254)
    ('180', '0.025')
    """
    return decimal_text(rounded(value, 2, 0))


def describe(analysis: Analysis, say: Callable[[float], str] = speed_text) -> str:
    """Return the verdict of an analysis as one sentence; ``say`` writes a speed [m/s]."""
    if analysis.speed is None or analysis.critical is None:
        return _at_a_point(analysis)
    top = abs(analysis.speed)
    ranges = [sorted((abs(a), abs(b))) for a, b in analysis.critical.stable_ranges()]
    inside = [(a, min(b, top)) for a, b in ranges if a < top]
    word = "neutral" if analysis.verdict.state == "neutral" else "stable"
    backing = " backing up" if analysis.speed < 0 else ""
    every = f"{backing} at every speed" + (" to" if backing else " up to")
    if analysis.stable:
        return f"{word}{every} {say(top)}" + _beyond(analysis, top, say) + _position(analysis)
    if not inside:
        return f"unstable{every} {say(top)}: {_growth(analysis)}" + _from(ranges, say)
    a, b = max(inside, key=lambda r: r[1] - r[0])
    edges = {abs(c.value): c for c in analysis.critical}
    text = f"{word}{backing} " + (f"up to {say(b)}" if a == 0 else f"from {say(a)} to {say(b)}")
    below, above = edges.get(a), edges.get(b)
    parts = [f"below it {_grows(below)}" if below else "", f"above it {_grows(above)}" if above else ""]
    told = [part for part in parts if part]
    if len(inside) > 1:
        told.append(f"there are {len(inside)} stable ranges")
    return "; ".join([text, ", ".join(told)]) + _position(analysis)


def moving(name: str) -> str:
    """Return what runs away by the name of a mode that does.

    >>> moving("capsize divergence"), moving("swivel divergence 2")
    ('capsize motion', 'swivel motion 2')
    """
    return re.sub(r" divergence( \d+)?$", r" motion\1", name)


def _grows(c: Critical) -> str:
    if c.kind == "flutter":
        return f"the {c.motion} grows at {c.frequency_hz:.2g} Hz (flutter)"
    if c.kind == "divergence":
        return f"the {c.motion} runs away (divergence)"
    return f"the {c.motion} grows without bound"


def _growth(analysis: Analysis) -> str:
    """Tell how the fastest growing mode goes."""
    growing = [mode for mode in analysis.modes if mode.eigenvalue.real > 0]
    if not growing:
        return "some motion grows at a lower speed"
    mode = growing[0]
    if mode.oscillates:
        how = f"the {mode.name} grows at {mode.frequency_hz:.2g} Hz"
    else:
        how = f"the {moving(mode.name)} runs away"
    return f"{how}, doubling in {_two_digits(mode.time_to_double)} s"


def _beyond(analysis: Analysis, top: float, say: Callable[[float], str]) -> str:
    above = [c for c in analysis.critical or () if top < abs(c.value) < max(FASTEST, 10 * top)]
    if above:
        first = min(above, key=lambda c: abs(c.value))
        return f"; above {say(abs(first.value))} {_grows(first)}"
    return ", and at every higher one" if analysis.verdict.state != "neutral" else ""


def _from(ranges: list[list[float]], say: Callable[[float], str]) -> str:
    later = [a for a, _ in ranges if math.isfinite(a) and a > 0]
    return f"; stable above {say(min(later))}" if later else ""


def _position(analysis: Analysis) -> str:
    count = analysis.verdict.rigid_positions
    if not count:
        return ""
    roots = "a zero root" if count == 1 else f"{count} zero roots"
    staying = [mode.name for mode in analysis.modes if mode.eigenvalue == 0]
    names = " and ".join(filter(None, (", ".join(staying[:-1]), *staying[-1:])))
    return f" ({roots}: {names}, which nothing restores, harmless)"


def _at_a_point(analysis: Analysis) -> str:
    state = analysis.verdict.state
    if state == "unstable":
        return f"unstable: {_growth(analysis)}"
    if state == "neutral":
        on_axis = [mode for mode in analysis.modes if mode.oscillates]
        if on_axis:
            mode = min(on_axis, key=lambda m: abs(m.eigenvalue.real))
            return f"neutral: the {mode.name} at {mode.frequency_hz:.3g} Hz neither grows nor dies out"
        return "neutral: nothing grows, but not everything dies out"
    return "stable: every disturbance dies out" + _position(analysis)
