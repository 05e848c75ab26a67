"""Control: a vehicle and a controller are a vehicle again."""

from .closed import close, closed
from .controller import Controller

__all__ = ["Controller", "close", "closed"]
