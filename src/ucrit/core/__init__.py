"""What a model is: declarations, equations, basic motion, and everything derived from them.

Knows no vehicle and no analysis.
"""

from .declare import algebraic, coordinate, input, output, param, speed, state
from .errors import MissingExtraError, ModelError, UcritError
from .functions import asin, atan, atan2, cos, exp, log, sign, sin, sqrt, tan, tanh
from .model import Model

__all__ = [
    "MissingExtraError",
    "Model",
    "ModelError",
    "UcritError",
    "algebraic",
    "asin",
    "atan",
    "atan2",
    "coordinate",
    "cos",
    "exp",
    "input",
    "log",
    "output",
    "param",
    "sign",
    "sin",
    "speed",
    "sqrt",
    "state",
    "tan",
    "tanh",
]
