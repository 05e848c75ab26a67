"""Control: a vehicle and a controller are a vehicle again."""

from collections.abc import Callable

from .actuators import delay, lag, rate_limit, saturation
from .closed import close, closed
from .controller import Controller
from .cut import broken, driven
from .design import kalman, lqr, observer, place
from .feedback import estimated_feedback, observing, state_feedback
from .sliding import sliding
from .surfaces import reaching_time, slide, sliding_eigenvalues

MAKERS: dict[str, Callable[..., type[Controller]]] = {
    "lag": lag,
    "rate-limit": rate_limit,
    "saturation": saturation,
    "delay": delay,
    "state-feedback": state_feedback,
    "estimated-state-feedback": estimated_feedback,
    "observer": observing,
    "sliding-mode": sliding,
}
"""Controllers made for a model, by the names that vehicle files have for them."""

__all__ = [
    "MAKERS",
    "Controller",
    "broken",
    "close",
    "closed",
    "delay",
    "driven",
    "kalman",
    "lag",
    "lqr",
    "observer",
    "observing",
    "place",
    "rate_limit",
    "reaching_time",
    "saturation",
    "slide",
    "sliding",
    "sliding_eigenvalues",
    "state_feedback",
]
