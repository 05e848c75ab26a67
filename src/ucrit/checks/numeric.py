"""Do the compiled functions say the same as the symbols they were made from?"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..core.numeric.compiled import compiled
from .precise import matrix, numeric
from .report import FailedCheckError
from .sample import Array
from .states import differs
from .subject import Subject

COUNT = 32
STEP = 1e-4


def functions(subject: Subject) -> str:
    """Compiled coefficients and matrices equal the symbolic ones; A has the roots of the polynomial."""
    for direction in subject.directions:
        system, made = subject.system(direction), compiled(subject.model, direction)
        symbols = list(system.traced.parameters.values())
        exact = numeric(system.polynomial.expressions, symbols)
        e = system.explicit
        blocks = [matrix(block, symbols) for block in (e.L, e.R, e.Q, e.Cw, e.Cz, e.D)]
        for point in subject.points("numeric", direction):
            coefficients = np.array([[float(a)] for a in exact(point)])
            if differs(np.array([[float(a)] for a in made.coefficients(point)]), coefficients):
                raise FailedCheckError("compiled and symbolic characteristic coefficients differ")
            for expected, got in zip(blocks, made.blocks(point), strict=True):
                if differs(_floats(expected(point), got.shape).reshape(-1, 1), got.reshape(-1, 1)):
                    raise FailedCheckError("compiled and symbolic matrices differ")
        _roots(subject, direction)
    return "compiled functions equal the symbolic ones, and A has the roots of the polynomial"


def _floats(exact: Any, shape: tuple[int, ...]) -> Array:
    rows, columns = shape
    return np.array([[float(exact[i, j]) for j in range(columns)] for i in range(rows)]).reshape(shape)


def _roots(subject: Subject, direction: int) -> None:
    made, sets = compiled(subject.model, direction), subject.parameter_sets("roots", COUNT, direction)
    A = made.state_space(sets).A
    a = np.array(np.broadcast_arrays(*made.coefficients(sets), np.zeros(COUNT))[:-1])
    if not _same_polynomial(A, a, 1e-8):
        raise FailedCheckError("the eigenvalues of A are not the roots of the characteristic polynomial")


def _same_polynomial(A: Array, a: Array, tolerance: float) -> bool:
    """Tell whether ``det(s I - A)`` has coefficients proportional to ``a``, and zeros for further states."""
    n, extra = A.shape[-1], A.shape[-1] - (len(a) - 1)
    size = np.maximum(np.abs(np.linalg.eigvals(A)).max(axis=-1), 1e-12)
    for k in range(n + 1):
        s = size * (1 + k / 7) * np.exp(1j * (np.sqrt(2) + k))
        determinant = np.linalg.det(s[:, None, None] * np.eye(n) - A)
        expected = s**extra * sum(c * s**i for i, c in enumerate(a)) / a[-1]
        if np.any(np.abs(determinant - expected) > tolerance * np.abs(s) ** n):
            return False
    return True


def linearisation(subject: Subject) -> str:
    """Finite differences of the non-linear motion give the linear one, zeros for constraints aside."""
    motion, found = subject.motion, ""
    for direction in subject.directions:
        made, sets = compiled(subject.model, direction), subject.parameter_sets("slopes", COUNT, direction)
        slopes = _slopes(subject, sets)
        if motion.labels == made.labels:
            A, found = made.state_space(sets).A, "finite differences of the motion give A"
            floor = 1e-3 * np.abs(A).max(axis=-1, keepdims=True) * np.ones_like(A)
            if differs(_rows(slopes), _rows(A), 1e-6, _rows(floor)):
                raise FailedCheckError("finite differences of the non-linear motion do not give A")
        else:
            a = np.array(np.broadcast_arrays(*made.coefficients(sets), np.zeros(COUNT))[:-1])
            found = "finite differences of the motion have the polynomial's roots and zeros for the constraints"
            if not _same_polynomial(slopes, a, 1e-6):
                raise FailedCheckError("finite differences of the non-linear motion have other eigenvalues than A")
    return found


def _rows(matrices: Array) -> Array:
    return matrices.reshape(len(matrices), -1).T


def _slopes(subject: Subject, sets: list[Array]) -> Array:
    """Return the Jacobian of the motion about the basic one.

    Central differences at three steps, extrapolated so that errors of first order in the step, which
    ``abs(v) * v`` makes, and of second order vanish.
    """
    coarse, middle, fine = (_central(subject, sets, STEP / division) for division in (1, 2, 4))
    first, second = 2 * middle - coarse, 2 * fine - middle
    return (4 * second - first) / 3


def _central(subject: Subject, sets: list[Array], step: float) -> Array:
    w, u = (np.broadcast_to(v.T, (COUNT, v.shape[0])).T for v in subject.motion.basic(sets))
    columns = []
    for j in range(len(w)):
        change = np.zeros_like(w)
        change[j] = step
        ahead, back = (subject.motion.rhs(w + sign * change, u, sets) for sign in (1, -1))
        columns.append((ahead - back) / (2 * step))
    return np.moveaxis(np.array(columns), (0, 1, 2), (2, 1, 0))
