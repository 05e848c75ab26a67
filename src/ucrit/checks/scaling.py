"""Do results follow a change of the units of mass, length and time?"""

from __future__ import annotations

import numpy as np

from ..core.numeric.compiled import compiled
from ..core.units import Dimension
from .report import FailedCheckError
from .sample import Array
from .states import differs, random_states
from .subject import Subject

COUNT = 200


def scaling(subject: Subject) -> str:
    """Eigenvalues scale with one over time and the motion with its units: no hidden numbers with a unit."""
    for direction in subject.directions:
        _eigenvalues(subject, direction)
    _motion(subject)
    return f"eigenvalues and motion follow the units at {COUNT} parameter sets"


def _factors(subject: Subject, count: int) -> Array:
    return np.exp(subject.rng("units").uniform(-1, 1, (3, count)))


def _scale(dimension: Dimension, factors: Array) -> Array:
    scale: Array = np.prod([f**e for f, e in zip(factors, dimension, strict=True)], axis=0)
    return scale


def _scaled(subject: Subject, sets: list[Array], factors: Array) -> list[Array]:
    declared = subject.model.declaration.parameters.values()
    return [v * _scale(p.dimension, factors) for v, p in zip(sets, declared, strict=True)]


def _eigenvalues(subject: Subject, direction: int) -> None:
    """Compare characteristic coefficients a_k/a_n, which scale as time^(k - n)."""
    sets, factors = subject.parameter_sets("scaling", COUNT, direction), _factors(subject, COUNT)
    function = compiled(subject.model, direction).coefficients
    before = np.array(np.broadcast_arrays(*function(sets), np.zeros(COUNT))[:-1])
    after = np.array(np.broadcast_arrays(*function(_scaled(subject, sets, factors)), np.zeros(COUNT))[:-1])
    powers = factors[2] ** (np.arange(len(before))[:, None] - (len(before) - 1))
    if differs(after / after[-1], before / before[-1] * powers):
        raise FailedCheckError("eigenvalues do not scale with one over time when the units change")


def _motion(subject: Subject) -> None:
    declared, traced, motion = subject.model.declaration, subject.traced, subject.motion
    states = random_states(subject, "scaling")
    factors = _factors(subject, states.w.shape[-1])
    per_second = Dimension(0, 0, -1)
    units = [
        variable.dimension.times(per_second, k)
        for variable in declared.variables.values()
        for k in range(variable.order)
    ]
    w_scale = np.array([_scale(unit, factors) for unit in units])
    u_scale = np.array([_scale(i.dimension, factors) for i in declared.inputs.values()]).reshape(states.u.shape)
    y_scale = np.array([_scale(o.dimension, factors) for o in declared.outputs.values()])
    parameters = _scaled(subject, states.parameters, factors)
    after, before = (
        motion.rhs(states.w * w_scale, states.u * u_scale, parameters),
        motion.rhs(states.w, states.u, states.parameters) * w_scale / factors[2],
    )
    if differs(after, before):
        raise FailedCheckError("the non-linear motion changes when the units change")
    if traced.outputs:
        outputs = motion.outputs(states.w, states.u, states.parameters) * y_scale
        if differs(motion.outputs(states.w * w_scale, states.u * u_scale, parameters), outputs):
            raise FailedCheckError("the outputs change when the units change")
