"""What a controller is: a declaration like a vehicle's, and a law for some of the vehicle's inputs."""

from __future__ import annotations

from types import MappingProxyType
from typing import ClassVar

from ..core.contract.methods import ARGUMENTS
from ..core.contract.model import Model

SEEN = ("x", "dx", "ddx", "u", "y", "x0", "u0")
"""What a law may ask for: variables and derivatives of vehicle and controller, inputs that are left, outputs of the
vehicle, and variables and inputs on its basic motion."""


class Controller(Model):
    """Base of feedback laws, observers, actuators and reference models.

    A subclass declares parameters (gains), states and inputs (desired values) of its own, names the inputs of the
    vehicle that it ``drives``, and returns their values from ``law``. States of its own need ``equations``, which may
    ask for the same groups as ``law``. A parameter that the vehicle has too, by name and unit, is the vehicle's.

    Examples
    --------
    >>> from ucrit import load, param
    >>> from ucrit.control import close
    >>> class YawDamper(Controller):
    ...     drives = ("delta_f",)
    ...     G = param("s", "front steer angle per yaw rate")
    ...
    ...     def law(self, x):
    ...         return {"delta_f": -self.G * x.r}
    >>> close(load("bmw-320i"), YawDamper, G=0.1).G
    0.1

    A class with ``through = True`` leaves the inputs that it drives to be prescribed from outside, as demands:
    ``u.delta_f`` is then what is demanded, what the law returns reaches the vehicle, and is its output
    ``delta_f_actual``. Actuators and laws that add to the driver's steering are of this kind. A class that drives
    nothing must have states or outputs: an observer.
    """

    drives: ClassVar[tuple[str, ...]] = ()
    through: ClassVar[bool] = False
    _arguments = MappingProxyType({**ARGUMENTS, "law": SEEN, "equations": SEEN, "outputs": SEEN, "events": SEEN})

    @classmethod
    def model_id(cls) -> str:
        """Name of the controller as users type it: its file's name in the catalogue, the class's name elsewhere."""
        package, _, stem = cls.__module__.rpartition(".")
        return stem.replace("_", "-") if package.startswith("ucrit.control") else cls.__name__
