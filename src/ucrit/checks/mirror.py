"""Does the mirrored vehicle move as the mirror image?"""

from __future__ import annotations

import numpy as np

from ..core.errors import near_match
from .report import FailedCheckError, NotApplicableError
from .states import differs, random_states
from .subject import Subject


def mirror(subject: Subject) -> str:
    """Left and right are alike: reversing every lateral quantity reverses its rate.

    A model names the quantities that have no side (forward velocity, pitch) in ``even = ("u", "theta")``, and
    says ``mirror = False`` where it is not symmetric at all.
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

    w_sign = signs([name for name, v in declared.variables.items() for _ in range(v.order)])
    w, u = states.w * w_sign, states.u * signs(list(declared.inputs))
    rates = subject.motion.rhs(states.w, states.u, states.parameters) * w_sign
    mirrored = subject.motion.rhs(w, u, states.parameters)
    for label, left, right in zip(subject.motion.labels, mirrored, rates, strict=True):
        if differs(left[None], right[None]):
            raise FailedCheckError(f"the rate of {label} differs between the two sides")
    if declared.outputs:
        right_side = subject.motion.outputs(states.w, states.u, states.parameters) * signs(list(declared.outputs))
        left_side = subject.motion.outputs(w, u, states.parameters)
        for name, left, right in zip(declared.outputs, left_side, right_side, strict=True):
            if differs(left[None], right[None]):
                raise FailedCheckError(f"the output {name} differs between the two sides")
    return "both sides move alike"
