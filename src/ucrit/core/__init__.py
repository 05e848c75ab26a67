"""What a model is: declarations, equations, basic motion, and everything derived from them.

Knows no vehicle and no analysis.
"""

from .declare import algebraic, coordinate, input, output, param, speed, state
from .drawing import Body, Drawing
from .errors import MissingExtraError, ModelError, UcritError
from .events import event
from .functions import asin, atan, atan2, cos, exp, log, maximum, minimum, sign, sin, sqrt, tan, tanh, where
from .model import Model
from .part import Part, slot

__all__ = [
    "Body",
    "Drawing",
    "MissingExtraError",
    "Model",
    "ModelError",
    "Part",
    "UcritError",
    "algebraic",
    "asin",
    "atan",
    "atan2",
    "coordinate",
    "cos",
    "event",
    "exp",
    "input",
    "log",
    "maximum",
    "minimum",
    "output",
    "param",
    "sign",
    "sin",
    "slot",
    "speed",
    "sqrt",
    "state",
    "tan",
    "tanh",
    "where",
]
