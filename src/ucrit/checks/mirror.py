"""Does the mirrored vehicle move as the mirror image?"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ..core.errors import near_match
from .report import FailedCheckError, NotApplicableError
from .states import differs, random_states
from .subject import Subject


def mirror(subject: Subject) -> str:
    """Left and right are alike: reversing every lateral quantity reverses its rate.

    A model names the quantities that have no side (forward velocity, pitch) in ``even = ("u", "theta")``, and
    says ``mirror = False`` where it is not symmetric at all. Quantities that come in pairs, one for each side, are
    named in ``sides = (("omega_l", "omega_r"),)`` and change places.
    """
    model = subject.model
    if not getattr(model, "mirror", True):
        raise NotApplicableError("the model says that it has no left and right (mirror = False)")
    declared, states = model.declaration, random_states(subject, "mirror")
    even = getattr(model, "even", ())
    allowed = {**declared.variables, **declared.inputs, **declared.outputs}
    for name in even:
        if name not in allowed:
            raise FailedCheckError(f"even names '{name}'{near_match(name, allowed)}")

    def signs(names: list[str]) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
        return np.array([1.0 if name in even else -1.0 for name in names]).reshape(-1, 1)

    sides = _sides(model, allowed)
    labels = [name + "'" * k for name, v in declared.variables.items() for k in range(v.order)]
    inputs, outputs = list(declared.inputs), list(declared.outputs)
    w_sign, w_place, u_place = signs([n.rstrip("'") for n in labels]), _places(labels, sides), _places(inputs, sides)
    w, u = (states.w * w_sign)[w_place], (states.u * signs(inputs))[u_place]
    rates = (subject.motion.rhs(states.w, states.u, states.parameters) * w_sign)[w_place]
    mirrored = subject.motion.rhs(w, u, states.parameters)
    for label, left, right in zip(subject.motion.labels, mirrored, rates, strict=True):
        if differs(left[None], right[None]):
            raise FailedCheckError(f"the rate of {label} differs between the two sides")
    if declared.outputs:
        right_side = subject.motion.outputs(states.w, states.u, states.parameters) * signs(outputs)
        right_side = right_side[_places(outputs, sides)]
        left_side = subject.motion.outputs(w, u, states.parameters)
        for name, left, right in zip(declared.outputs, left_side, right_side, strict=True):
            if differs(left[None], right[None]):
                raise FailedCheckError(f"the output {name} differs between the two sides")
    return "both sides move alike"


def _sides(model: Any, allowed: Mapping[str, Any]) -> dict[str, str]:
    """Return the other side's quantity for each that comes in a pair."""
    pairs = getattr(model, "sides", ())
    for name in (name for pair in pairs for name in pair):
        if name not in allowed:
            raise FailedCheckError(f"sides names '{name}'{near_match(name, allowed)}")
    return {one: other for a, b in pairs for one, other in ((a, b), (b, a))}


def _places(names: list[str], sides: Mapping[str, str]) -> list[int]:
    """Return for each quantity the place of the one that it becomes in the mirror."""
    return [names.index(sides.get(name.rstrip("'"), name.rstrip("'")) + "'" * name.count("'")) for name in names]
