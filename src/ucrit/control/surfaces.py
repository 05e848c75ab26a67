"""Sliding mode in numbers: vehicles closed by it, what is left of the motion, and when the surface is reached."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from ..core.contract.model import Model
from ..core.errors import UcritError
from ..core.numeric.compiled import state_space
from .closed import close
from .copies import DESIRED, KNOWN, checked_states, parameter_values, plain_name, state_names
from .gains import in_words, named
from .sliding import bare_model, sliding

Array = npt.NDArray[Any]


def slide(
    vehicle: Model,
    input: str,
    surface: str | Mapping[str, float],
    *,
    alpha: float,
    phi: float | None,
    q: float = 0.0,
    reference: Model | None = None,
    own: Sequence[str] = (),
    estimated: Sequence[str] = (),
) -> Model:
    """Return the vehicle under a sliding-mode controller.

    Parameters
    ----------
    vehicle
        With scalar parameters, which the law knows as they are now.
    input
        Name of the input that is driven.
    surface
        The state that shall be as desired, or weights by state.
    alpha
        Least rate at which S shrinks [unit of S/s]: above all that the law does not know.
    phi
        Width of the boundary layer [unit of S]; ``None`` for a law that jumps.
    q
        Rate [1/s] at which a large S shrinks.
    reference
        Vehicle to be followed, which gets the driver's demand; without one, desired values are inputs.
    own
        Parameters whose present values the law keeps when the vehicle's change.
    estimated
        States for which an observer's estimates are taken.

    Returns
    -------
    Model
        With the parameters ``q_S``, ``alpha_S`` and ``phi_S``, and the output ``S``.

    Raises
    ------
    UcritError
        If what is left of the motion while S is zero would grow: it is named.

    Examples
    --------
    >>> from ucrit import load, modes
    >>> from ucrit.control import slide
    >>> car = slide(load("oversteering-car"), "delta_f", "r", alpha=1, phi=0.1, reference=load("neutral-car"))
    >>> -10.0 in modes(car).eigenvalues.real.round(6)
    True
    """
    weights = {surface: 1.0} if isinstance(surface, str) else dict(surface)
    if vehicle.dims:
        raise UcritError(f"the law is that of one vehicle: give one value each for {', '.join(vehicle.dims)}")
    refer = None if reference is None else type(reference)
    law = sliding(vehicle, input, *weights, reference=refer, own=own, estimated=estimated, signum=phi is None)
    first = next(iter(weights.values()))
    if not first:
        raise UcritError("the first weight of the sliding variable must differ from 0")
    left = sliding_eigenvalues(vehicle, input, weights)
    growing = [p for p in left if p.real > 1e-9 * max(1.0, np.abs(left).max())]
    if growing:
        labels = list(state_names(type(_plain_vehicle(vehicle))))
        reduced = _reduced(vehicle, input, weights)
        raise UcritError(
            f"{type(vehicle).model_id()}: keeping {' and '.join(weights)} as desired by {input} leaves "
            f"{named(reduced, growing[0], labels, left=False)}, which grows: from {input} to the sliding variable "
            f"there is a zero at {in_words(growing[0])} 1/s, in the right half plane"
        )
    values: dict[str, Any] = {"alpha_S": alpha, "q_S": q} | ({} if phi is None else {"phi_S": phi})
    values |= {f"c_{plain_name(n)}": w / first for n, w in list(weights.items())[1:]}
    values |= parameter_values(vehicle, law._own, KNOWN)
    if reference is not None:
        values |= parameter_values(reference, law._reference_own, DESIRED)
    return close(vehicle, law, **values)


def _plain_vehicle(vehicle: Model) -> Model:
    cls = bare_model(type(vehicle))
    return cls(**{name: vehicle.values[name] for name in cls.declaration.parameters})


def _reduced(vehicle: Model, input: str, surface: Mapping[str, float]) -> Array:
    """Return ``A - b (c'b)^-1 c'A``."""
    plain = _plain_vehicle(vehicle)
    A, B, _, _ = state_space(plain)
    labels = list(state_names(type(plain)))
    c = np.zeros(len(labels))
    for name, label in zip(surface, checked_states(type(plain), list(surface)), strict=True):
        c[labels.index(label)] = surface[name]
    b = B[:, list(type(plain).declaration.inputs).index(input)]
    return np.asarray(A - np.outer(b, c @ A) / (c @ b))


def sliding_eigenvalues(vehicle: Model, input: str, surface: Mapping[str, float]) -> Array:
    """Return the eigenvalues [1/s] of the motion under the linear part of the law alone, ``A - b (c'b)^-1 c'A``.

    Parameters
    ----------
    vehicle
        With scalar parameters.
    input
        Name of the input that is driven.
    surface
        Weights by state.

    Returns
    -------
    array
        One of them is zero: S stays as it is. The others belong to the motion while it slides.

    Examples
    --------
    >>> from ucrit import load
    >>> from ucrit.control import sliding_eigenvalues
    >>> bool(abs(sliding_eigenvalues(load("bmw-320i"), "delta_f", {"r": 1})).min() < 1e-12)
    True
    """
    return np.asarray(np.sort_complex(np.linalg.eigvals(_reduced(vehicle, input, surface)).astype(complex)))


def reaching_time(S: float, alpha: float, q: float = 0.0, disturbance: float = 0.0) -> float:
    """Return the time [s] until the sliding variable is zero.

    Parameters
    ----------
    S
        Its value at the start.
    alpha
        Least rate [unit of S/s].
    q
        Rate [1/s].
    disturbance
        What pushes S away from zero all the time [unit of S/s].

    Returns
    -------
    float
        ``ln(1 + q |S|/(alpha - disturbance))/q``; infinite where alpha is not above the disturbance.

    Raises
    ------
    UcritError
        If a number is not finite, or alpha or q is below 0.

    Examples
    --------
    >>> reaching_time(0.5, alpha=2)
    0.25
    """
    for name, value, least in (
        ("S", S, -np.inf),
        ("alpha", alpha, 0),
        ("q", q, 0),
        ("disturbance", disturbance, -np.inf),
    ):
        if not (isinstance(value, int | float | np.number) and np.isfinite(value) and value >= least):
            raise UcritError(f"{name} must be a finite number{' of at least 0' if least == 0 else ''}, got {value!r}")
    rate, size = alpha - disturbance, abs(S)
    if not size:
        return 0.0
    if rate <= 0:
        return float("inf")
    return float(size / rate if not q else np.log1p(q * size / rate) / q)
