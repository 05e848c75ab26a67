"""Gains in numbers: poles placed where they are wanted, and the least quadratic cost.

Whatever cannot be moved or seen is named: the eigenvalue, and the state that takes part in it most.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from ..core.errors import UcritError

Array = npt.NDArray[Any]

HIDDEN = 1e-9
"""Share below which an input counts as not moving a motion."""

SPREAD = 1e-6
"""Relative error up to which placed poles count as those asked for, by the coefficients of their polynomial."""


def hidden_modes(A: Array, B: Array) -> list[complex]:
    """Return the eigenvalues [1/s] of motions that no input moves (M. L. J. Hautus's test).

    Parameters
    ----------
    A, B
        Scaled state equations, shapes (n, n) and (n, m).
    """
    size = max(np.linalg.norm(A, 2), np.finfo(float).tiny)
    widest = max(np.linalg.norm(B, 2), np.finfo(float).tiny)
    found = []
    for pole in np.linalg.eigvals(A):
        both = np.hstack([(A - pole * np.eye(len(A))) / size, B / widest])
        if np.linalg.svd(both, compute_uv=False)[-1] < HIDDEN:
            found.append(complex(pole))
    return found


def named(A: Array, pole: complex, labels: Sequence[str], left: bool = True) -> str:
    """Return a motion in words: its eigenvalue, and the state that takes part in it most."""
    values, vectors = np.linalg.eig(A.T if left else A)
    vector = np.abs(vectors[:, np.argmin(np.abs(values - pole))])
    return f"the motion of eigenvalue {in_words(pole)} 1/s, most of it in {labels[int(np.argmax(vector))]}"


def in_words(pole: complex) -> str:
    """Return an eigenvalue to four digits."""
    if abs(pole.imag) <= 1e-9 * abs(pole):
        return f"{pole.real:.4g}"
    return f"{pole.real:.4g}{pole.imag:+.4g}j"


def checked_poles(poles: Any, states: Sequence[str]) -> Array:
    """Return the poles [1/s] that are wanted, one for each state.

    Raises `UcritError` for a wrong number, and for poles that are not finite or lack their conjugates.
    """
    try:
        found = np.atleast_1d(np.asarray(poles, dtype=complex))
    except (TypeError, ValueError):
        raise UcritError(f"poles must be a list of complex numbers [1/s], got {poles!r}") from None
    if found.ndim != 1 or len(found) != len(states):
        raise UcritError(
            f"there must be as many poles as states, {len(states)} ({', '.join(states)}), got {found.size}: {poles!r}"
        )
    if not np.isfinite(found).all():
        raise UcritError(f"poles must be finite, got {poles!r}")
    for pole in found:
        ours, theirs = np.isclose(found, pole).sum(), np.isclose(found, np.conj(pole)).sum()
        if ours != theirs:
            raise UcritError(f"pole {in_words(pole)} 1/s needs its conjugate beside it")
    return found


def place_gains(A: Array, B: Array, poles: Array, labels: Sequence[str], doing: str, left: bool = True) -> Array:
    """Return K such that the eigenvalues of ``A - B K`` are the poles; what cannot be moved may stay.

    Parameters
    ----------
    A, B
        State equations, shapes (n, n) and (n, m).
    poles
        [1/s], shape (n,).
    labels
        Names of the states, for messages.
    doing
        What cannot be done, for messages: ``"delta_f cannot move"``.
    left
        Whether the states' shares in a motion are read from left eigenvectors.

    Raises
    ------
    UcritError
        If a motion that cannot be moved is not among the poles, or a pole is wanted too often.
    """
    scaled, (scale_x, scale_u) = _scaled(A, B)
    stuck, wanted = hidden_modes(*scaled), list(poles)
    for pole in stuck:
        near = min(wanted, key=lambda p: abs(p - pole))
        if abs(near - pole) > 1e-6 * max(1.0, abs(pole)):
            raise UcritError(f"{doing} {named(A, pole, labels, left)}; it must be among the poles")
        wanted.remove(near)
    basis = _movable(*scaled, len(wanted))
    inner = basis.T @ scaled[0] @ basis, basis.T @ scaled[1]
    K = _placed(*inner, np.array(wanted), doing) @ basis.T if wanted else np.zeros_like(B.T)
    return np.asarray(scale_u[:, None] * K / scale_x[None, :])


def _scaled(A: Array, B: Array) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
    """Scale states and inputs so that units do not matter."""
    from scipy.linalg import matrix_balance

    _, (scale, _) = matrix_balance(A, permute=False, separate=True)
    inputs = np.linalg.norm(B / scale[:, None], axis=0)
    inputs = 1 / np.where(inputs > 0, inputs, 1.0)
    return (A / scale[:, None] * scale[None, :], B / scale[:, None] * inputs[None, :]), (scale, inputs)


def _movable(A: Array, B: Array, size: int) -> Array:
    """Return an orthonormal basis of the states that inputs move."""
    columns, power = [B / max(np.linalg.norm(B), np.finfo(float).tiny)], B
    for _ in range(len(A) - 1):
        power = A @ power / max(np.linalg.norm(A @ power), np.finfo(float).tiny)
        columns.append(power)
    left, _, _ = np.linalg.svd(np.hstack(columns))
    return np.asarray(left[:, :size])


def _placed(A: Array, B: Array, poles: Array, doing: str) -> Array:
    from scipy.signal import place_poles

    rank = int(np.linalg.matrix_rank(B))
    if rank == 1:
        left, sizes, right = np.linalg.svd(B)
        K = right[0][:, None] * _ackermann(A, left[:, :1] * sizes[0], poles)
    else:
        repeated = max(np.isclose(poles, p).sum() for p in poles)
        if repeated > rank:
            pole = max(poles, key=lambda p: np.isclose(poles, p).sum())
            raise UcritError(f"{doing} so much: pole {in_words(pole)} 1/s can be had {rank} times, not {repeated}")
        import warnings

        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            K = place_poles(A, B, poles).gain_matrix
    found, wanted = np.poly(A - B @ K), np.poly(poles)
    size = np.abs(poles).max() or 1.0
    error = np.abs((found - wanted) / size ** np.arange(len(wanted))).max()
    if not error < SPREAD * 2 ** len(poles):
        farthest = in_words(poles[np.argmax(np.abs(poles))])
        raise UcritError(f"{doing} poles as far as {farthest} 1/s: the gains come out too inexact to place them")
    return np.asarray(np.real(K))


def _ackermann(A: Array, b: Array, poles: Array) -> Array:
    """Return the row of gains of one input (J. Ackermann, Regelungstechnik 20 (1972) 297-300)."""
    n = len(A)
    columns = [b]
    for _ in range(n - 1):
        columns.append(A @ columns[-1])
    last = np.linalg.solve(np.hstack(columns).T, np.eye(n)[-1])
    for pole in np.sort_complex(poles):  # one factor after the other: better than powers of A
        last = last @ (A.astype(complex) - pole * np.eye(n))
    return np.asarray(np.real(last))[None, :]


def regulator_gains(A: Array, B: Array, Q: Array, R: Array, labels: Sequence[str], doing: str) -> Array:
    """Return K of the least ``integral of x' Q x + u' R u`` (R. E. Kalman, 1960), by the equation of Riccati.

    Parameters
    ----------
    A, B
        State equations, shapes (n, n) and (n, m).
    Q, R
        Weights, shapes (n, n) and (m, m).
    labels
        Names of the states, for messages.
    doing
        What cannot be done, for messages.

    Raises
    ------
    UcritError
        If an unstable motion cannot be moved, or the weights leave a motion on the imaginary axis unseen.
    """
    from scipy.linalg import solve_continuous_are

    (scaled_A, scaled_B), _ = _scaled(A, B)
    for pole in hidden_modes(scaled_A, scaled_B):
        if pole.real > -HIDDEN * np.linalg.norm(scaled_A):
            raise UcritError(f"{doing} {named(A, pole, labels)}; nothing makes it stable")
    try:
        P = solve_continuous_are(A, B, Q, R)
    except (np.linalg.LinAlgError, ValueError):
        raise UcritError(
            "no least cost exists: a motion that does not decay by itself has no weight; put weight on more states"
        ) from None
    return np.asarray(np.linalg.solve(R, B.T @ P))


def weights(given: Any, names: Sequence[str], thing: str, definite: bool) -> Array:
    """Return a matrix of weights from a matrix, a list of its diagonal, or numbers by name.

    Raises `UcritError` for a wrong size or name, and where the matrix is not symmetric or not positive.
    """
    n = len(names)
    if isinstance(given, dict):
        from ..core.errors import near_match

        plain = {name.replace("_dot", "'"): name for name in names}
        values = dict.fromkeys(names, 0.0)
        for name, value in given.items():
            key = name if name in values else plain.get(name.replace("_dot", "'"), "")
            if key not in values:
                raise UcritError(f"{thing}: there is no '{name}'{near_match(name, names)}")
            try:
                values[key] = float(value)
            except (TypeError, ValueError):
                raise UcritError(f"{thing}: the weight of {key} must be a number, got {value!r}") from None
        matrix = np.diag([values[name] for name in names])
    else:
        try:
            matrix = np.asarray(given, dtype=float)
        except (TypeError, ValueError):
            raise UcritError(f"{thing} must be a matrix or numbers by name, got {given!r}") from None
        matrix = np.diag(np.broadcast_to(matrix, (n,))) if matrix.ndim < 2 and matrix.size in (1, n) else matrix
    if matrix.shape != (n, n):
        raise UcritError(f"{thing} must weigh {', '.join(names)}: {n} numbers or a {n} x {n} matrix")
    for name, value in zip(names, np.diag(matrix), strict=True):
        if not (value > 0 or (value == 0 and not definite)):
            word = "above" if definite else "at least"
            raise UcritError(f"{thing}: the weight of {name} must be {word} 0, got {value:g}")
    least = np.linalg.eigvalsh((matrix + matrix.T) / 2)[0] if np.isfinite(matrix).all() else -np.inf
    if not np.allclose(matrix, matrix.T) or (least <= 0 if definite else least < -1e-12 * np.abs(matrix).max()):
        raise UcritError(f"{thing} must be symmetric and {'above' if definite else 'at least'} 0 in every direction")
    return matrix
