"""Centre of percussion: the point that a blow at an input leaves at rest (Karnopp 2004, Problem 11.2)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ...core.errors import UcritError, near_match
from ...core.html import Rich
from ...core.numeric.cache import cached
from ...core.numeric.compiled import direction, labels, state_space

Array = npt.NDArray[Any]

PAIRS = (("V", "r"), ("v_y", "r"), ("v", "r"))
"""Names that models have for lateral velocity and yaw rate."""


@dataclass(frozen=True)
class Percussion(Rich):
    """Where the body turns about at first when an input acts as an impulse.

    Attributes
    ----------
    vehicle, input
        The vehicle, and the input: ``delta_f`` is a blow at the front axle.
    lateral, yaw
        States that are the lateral velocity of the centre of mass and the yaw rate.
    place
        Distance [m] of the point ahead of the centre of mass, shape of the vehicle's dimensions; negative behind it.
        Infinite where the blow does not turn the body.
    formula
        The same in symbols.
    per_impulse
        Lateral velocity [m/s] and yaw rate [rad/s] just after a unit impulse, shape (..., 2).
    """

    vehicle: Model
    input: str
    lateral: str
    yaw: str
    place: Array
    formula: str
    per_impulse: Array

    def velocity(self, x: Any) -> Array:
        """Return the lateral velocity [m/s] just after a unit impulse at a distance [m] ahead of the centre of mass."""
        V, r = np.moveaxis(self.per_impulse, -1, 0)
        return np.asarray(V + np.asarray(x, dtype=float) * r)

    def __str__(self) -> str:
        name = self.vehicle.info.name or type(self.vehicle).model_id()
        if self.place.ndim:
            where = f"{self.place.min():.4g} m to {self.place.max():.4g} m"
        elif np.isinf(self.place):
            where = "nowhere, it does not turn the body"
        else:
            where = f"{abs(self.place):.4g} m {'ahead of' if self.place > 0 else 'behind'} the centre of mass"
        return f"{name}: centre of percussion of {self.input}: {where}, x = {self.formula}"


def percussion(vehicle: Model, input: str, *, lateral: str | None = None, yaw: str | None = None) -> Percussion:
    """Return the centre of percussion of an input: the point of the body that its impulse does not move sideways.

    Parameters
    ----------
    vehicle
        Its array parameters span dimensions.
    input
        Input whose impulse is the blow: a steer angle, a side force.
    lateral, yaw
        States that are the lateral velocity of the centre of mass and the yaw rate; by default ``V`` or ``v_y`` or
        ``v``, and ``r``.

    Returns
    -------
    Percussion
        From the rates that the input causes at once, ``-V'/r'``; finite forces, such as the other axle's, do nothing in
        the time of a blow.

    Raises
    ------
    UcritError
        If there is no such input or state, or the input does not act on either at once.

    Examples
    --------
    >>> from ucrit import load
    >>> print(percussion(load("oversteering-car"), "delta_f"))
    Oversteering car: centre of percussion of delta_f: 1.333 m behind the centre of mass, x = -I_z/(a*m)
    """
    cls, known = type(vehicle), labels(vehicle)
    where, inputs = cls.model_id(), list(cls.declaration.inputs)
    if input not in inputs:
        raise UcritError(f"{where}: there is no input '{input}'{near_match(input, inputs)}")
    found = next((pair for pair in PAIRS if set(pair) <= set(known)), (None, None))
    lateral, yaw = lateral or found[0], yaw or found[1]
    if lateral is None or yaw is None:
        raise UcritError(f"{where}: say which states are the lateral velocity and the yaw rate: {', '.join(known)}")
    for name in (lateral, yaw):
        if name not in known:
            raise UcritError(f"{where}: there is no state '{name}'{near_match(name, known)}")
    blow = state_space(vehicle).B[..., [list(known).index(lateral), list(known).index(yaw)], inputs.index(input)]
    if not blow.any():
        raise UcritError(f"{where}: {input} changes neither {lateral} nor {yaw} at once: it acts through other states")
    key = f"percussion{direction(vehicle):+d}-{input}-{lateral}-{yaw}"
    formula = cached(cls, key, lambda: {"formula": _formula(cls, direction(vehicle), input, lateral, yaw)})["formula"]
    with np.errstate(divide="ignore", invalid="ignore"):
        place = -blow[..., 0] / blow[..., 1]
    return Percussion(vehicle, input, lateral, yaw, np.asarray(place), str(formula), blow)


def _formula(model: type[Model], sense: int, input: str, lateral: str, yaw: str) -> str:
    """Return minus the ratio of the two rates that the input causes."""
    import sympy as sp

    from ...core.derivation.derive import symbolic
    from ...core.formulas import typeset as to

    system = symbolic(model, sense)
    e, names = system.explicit, [chain[0].name for chain in system.traced.q]
    column = e.Q[:, list(model.declaration.inputs).index(input)]
    z = e.L.LUsolve(column)
    above, below = (z[names.index(name.rstrip("'"))] for name in (lateral, yaw))
    return "infinite" if sp.cancel(below) == 0 else to.text(sp.factor(-above / below))
