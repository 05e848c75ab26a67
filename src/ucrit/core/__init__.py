"""What a model is: declarations, equations, basic motion, and everything derived from them.

Knows no vehicle and no analysis.
"""

from .contract.declare import algebraic, coordinate, input, output, param, speed, state
from .contract.drawing import Body, Drawing
from .contract.events import event
from .contract.model import Model
from .contract.part import Part, slot
from .errors import MissingExtraError, ModelError, UcritError
from .formulas.functions import asin, atan, atan2, cos, exp, log, maximum, minimum, sign, sin, sqrt, tan, tanh, where

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
