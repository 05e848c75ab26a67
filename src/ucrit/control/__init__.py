"""Control: a vehicle and a controller are a vehicle again."""

from .actuators import delay, lag, rate_limit, saturation
from .closed import broken, close, closed
from .controller import Controller
from .design import kalman, lqr, observer, place
from .feedback import observing, state_feedback

__all__ = [
    "Controller",
    "broken",
    "close",
    "closed",
    "delay",
    "kalman",
    "lag",
    "lqr",
    "observer",
    "observing",
    "place",
    "rate_limit",
    "saturation",
    "state_feedback",
]
