"""Events: what a model wants to be told of along its motion, such as a wheel that locks or a roll-over.

A model states them in ``events(self, x, dx, ddx, u)``: a dictionary of names, in words that complete "it ... at 3 s"
("rolls over"), and values whose zero crossings are the events. A value is plain or an `event`, which may end the
motion or set states and inputs anew. A mode that comes and goes (locked, rolling) is an input of 0 or 1 that
events set.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from ..errors import ModelError, near_match

WAYS = {"either": 0, "rising": 1, "falling": -1}


@dataclass(frozen=True)
class Event:
    """A value whose zero crossings matter, made by `event`."""

    value: Any
    ends: bool = False
    when: str = "either"
    after: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    during: Any = True
    from_start: bool = False


def event(
    value: Any,
    *,
    ends: bool = False,
    when: str = "either",
    after: Mapping[str, Mapping[str, Any]] | None = None,
    during: Any = True,
    from_start: bool = False,
) -> Event:
    """Describe an event of a model.

    Parameters
    ----------
    value
        Expression of states, their rates, inputs and parameters that crosses zero at the event.
    ends
        Whether the motion ends there, because the equations do not hold beyond.
    when
        ``"rising"`` or ``"falling"`` for crossings in one direction only.
    after
        New values, as in a basic motion: ``{"dx": {"x": -self.e * dx.x}}`` bounces; ``{"u": {"locked": 1}}`` sets an
        input that stands for a mode.

    during
        Condition without which it does not happen: ``u.locked < 0.5``.
    from_start
        Whether it also happens at time 0 where the value is beyond zero already, in the direction that counts.

    Raises
    ------
    ModelError
        If ``when`` is none of the three words, or if an event both ends the motion and sets values.

    Examples
    --------
    >>> event(1.5, when="falling").when
    'falling'
    """
    if when not in WAYS:
        raise ModelError(f"an event is told when '{when}'{near_match(when, WAYS)}")
    if ends and after:
        raise ModelError("an event either ends the motion or sets values after it, not both")
    return Event(value, ends, when, after or {}, during, from_start)
