"""Sliding mode that jumps, followed exactly: which side of S = 0 counts is set by events."""

from __future__ import annotations

from typing import Any

from ..core.contract.events import Event, event
from ..core.formulas.functions import sign, where
from .copies import DESIRED, plain_name, symbol_of
from .feedback import HAT

HALF = 0.25
"""Square of the side, and the side itself, between those that are meant: -1, 0 and 1."""

ON = {"u": {"side_S": 0}}
"""What is set where S is reached."""


class Jumping:
    """What a law that jumps has besides: the side of S that it counts on, which events set.

    While S is kept at zero the jump takes the value between its two that does so, the equivalent control (A. F.
    Filippov, Differential Equations with Discontinuous Righthand Sides (1988), section 4), as long as there is one.
    """

    def _reach(self, S: Any, x: Any, u: Any) -> Any:
        return x.jump_S

    def equations(self: Any, x: Any, dx: Any, ddx: Any, u: Any) -> Any:
        own = super().equations(x, dx, u) if self._reference is not None else ()  # type: ignore[misc]
        kept = self._rate(x, dx, ddx) + self.__dict__["q_S"] * self._error(x, dx, u)
        return (*own, where(u.side_S**2 > HALF, (x.jump_S - u.side_S) * self.__dict__["alpha_S"], kept))

    def _rate(self: Any, x: Any, dx: Any, ddx: Any) -> Any:
        """Return the rate of S."""

        def rate(label: str) -> Any:
            if label in self._estimated:
                return getattr(dx, f"{plain_name(label)}_{HAT}")
            return symbol_of(self._model, label, dx, ddx)

        found = sum(self._weight(label) * rate(label) for label in self._surface)
        if self._reference is not None:
            found -= sum(self._weight(n) * getattr(dx, f"{plain_name(n)}_{DESIRED}") for n in self._surface)
        return found

    def events(self: Any, x: Any, dx: Any, u: Any) -> dict[str, Event]:
        S, slides = self._error(x, dx, u), u.side_S**2 < HALF
        return {
            "is off S = 0": event(S**2, when="rising", from_start=True, after={"u": {"side_S": sign(S)}}),
            "reaches S = 0 from above": event(S, when="falling", during=u.side_S > HALF, after=ON),
            "reaches S = 0 from below": event(S, when="rising", during=u.side_S < -HALF, after=ON),
            "leaves S = 0": event(
                where(slides, x.jump_S**2 - 1, -1), when="rising", after={"u": {"side_S": sign(x.jump_S)}}
            ),
        }
