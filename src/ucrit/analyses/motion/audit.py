"""The linear verdict checked by the non-linear equations: small perturbations are followed, their growth is fitted.

Every mode is started by itself, in both directions along its eigenvector, which is that of differences of the
non-linear equations; half the difference of the two motions is free of their quadratic part.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ...core.errors import UcritError
from ...core.html import Rich
from ...core.numeric.motion import Motion, motion
from ...numerics.prony import fit_exponents
from ..linear.modes import Mode, modes, rigid_positions
from .follow import Drive, Follower
from .manoeuvres import constant

Array = npt.NDArray[Any]

SIZES = 1e-4, 1e-6
"""Largest change of an angle, length or velocity [SI] in a perturbation, and the one that is tried after it."""

WITHIN = 1e-3
"""Share of an eigenvalue's modulus by which the fitted one may differ."""

SAMPLES = 81
SPAN, GROWTH = 3.0, 12.0
"""A mode is followed until its exponent, or that of the fastest growth, has reached these."""

LINEAR = 1e-9
"""Share of the rates by which they may depart from linear ones."""

TWIN = 0.02
"""Share of their modulus by which the two of an almost double root differ at most."""


@dataclass(frozen=True)
class Finding:
    """One mode in both descriptions.

    Attributes
    ----------
    mode
        Its name.
    linear, fitted
        Eigenvalue [1/s] of the linear equations, and what fits the non-linear motion; of a pair the one with the
        positive imaginary part.
    agrees
        Whether they differ by less than the tolerance.
    """

    mode: str
    linear: complex
    fitted: complex
    agrees: bool


@dataclass(frozen=True)
class Audit(Rich):
    """What `audit` finds.

    Attributes
    ----------
    findings
        Least stable mode first; empty where the equations are linear.
    rigid_positions
        Number of roots that are zero whatever the parameters; nothing restores them in either description.
    linear
        Whether the equations of motion are linear themselves, so that there is nothing to audit.
    size, within
        Size of the perturbations [SI] and the share by which eigenvalues may differ.
    """

    vehicle: Model
    findings: tuple[Finding, ...]
    rigid_positions: int
    linear: bool
    size: float
    within: float

    @property
    def agrees(self) -> bool:
        """Whether the non-linear motion does what the linear equations say, in every mode."""
        return all(finding.agrees for finding in self.findings)

    @property
    def sentence(self) -> str:
        """The outcome in words."""
        if self.linear:
            return "the equations of motion are linear: there is nothing to audit"
        if not self.findings:
            return "nothing but rigid positions: there is no growth to audit"
        wrong = [f for f in self.findings if not f.agrees]
        if wrong:
            told = "; ".join(f"{f.mode}: {_both(f)}" for f in wrong)
            return f"the non-linear motion DISAGREES with the linear verdict in {len(wrong)} of {_count(self)}: {told}"
        return f"{_both(self.findings[0])} ({_count(self)} agree{'s' if len(self.findings) == 1 else ''})"

    def to_dict(self) -> dict[str, Any]:
        """Return the facts as plain data."""
        return {
            "sentence": self.sentence,
            "linear_equations": self.linear,
            "agrees": None if self.linear else self.agrees,
            "size": self.size,
            "within": self.within,
            "modes": [
                {
                    "name": f.mode,
                    "linear": {"re": f.linear.real, "im": f.linear.imag},
                    "nonlinear": {"re": _plain(f.fitted.real), "im": _plain(f.fitted.imag)},
                    "agrees": f.agrees,
                }
                for f in self.findings
            ],
        }

    def __str__(self) -> str:
        return f"{self.vehicle.info.name or type(self.vehicle).__name__}: {self.sentence}"


def audit(vehicle: Model, *, size: float | None = None, within: float = WITHIN) -> Audit:
    """Check a vehicle's linear verdict by its non-linear equations.

    Parameters
    ----------
    vehicle
        With scalar parameters, judged at its own speed.
    size
        Largest change of an angle [rad], length [m] or velocity [m/s, rad/s] that starts a motion; by default 1e-4, and
        a hundredth of that where a mode then disagrees: laws that bend at zero, like abs(x) x, err in proportion.
    within
        Share of an eigenvalue's modulus by which the fitted one may differ.

    Returns
    -------
    Audit
        Every mode with its linear and its fitted eigenvalue, and one sentence.

    Raises
    ------
    UcritError
        If a parameter is an array, an argument is not above 0, or a motion cannot be followed.

    Examples
    --------
    >>> from ucrit import audit, load
    >>> print(audit(load("caravan")).sentence)  # doctest: +ELLIPSIS
    the non-linear motion grows at 0.1173 1/s and 0.7545 Hz, the linear verdict says growth at 0.1173 1/s and ...
    """
    if vehicle.dims:
        raise UcritError("audit judges one vehicle: give scalar parameters")
    sizes = SIZES if size is None else (size,)
    for name, value in (("size", sizes[0]), ("within", within)):
        if not (math.isfinite(value) and value > 0):
            raise UcritError(f"audit: {name} must be above 0, got {value!r}")
    shown = modes(vehicle)
    rigid = rigid_positions(vehicle, shown.eigenvalues)
    made, arguments = motion(type(vehicle)), vehicle.arguments()
    w, u = made.basic(arguments)
    if _is_linear(made, w, u, arguments):
        return Audit(vehicle, (), int(rigid.sum()), True, sizes[0], within)
    wanted = [mode for mode in shown if mode.eigenvalue != 0]
    moving = int(np.sum(~rigid & (shown.eigenvalues != 0)))
    for tried in sizes:
        fitted = _fitted(vehicle, made, w, u, moving, tried) if wanted else []
        findings = tuple(_finding(mode, fitted, within) for mode in wanted)
        found = Audit(vehicle, findings, int(rigid.sum()), False, tried, within)
        if found.agrees:
            break
    return found


def _finding(mode: Mode, fitted: list[complex], within: float) -> Finding:
    """Compare a mode with the nearest exponent of the motion."""
    nearest = min(fitted, key=lambda s: abs(s - mode.eigenvalue), default=complex(math.nan))
    agrees = abs(nearest - mode.eigenvalue) <= within * abs(mode.eigenvalue)
    return Finding(mode.name, mode.eigenvalue, nearest, bool(agrees))


def _is_linear(made: Motion, w: Array, u: Array, arguments: Any) -> bool:
    """Tell whether the rates are linear in the states, by trying large changes of several sizes."""
    rng = np.random.default_rng(1)
    steps = rng.uniform(-1, 1, (len(w), 8)) * np.repeat([0.1, 0.5, 1.0, 3.0], 2)
    shape = (len(u), steps.shape[1])
    with np.errstate(all="ignore"):
        at = [made.rhs(w[:, None] + k * steps, np.broadcast_to(u[:, None], shape), arguments) for k in (0, 1, 2)]
    size = np.abs(at).max(axis=(0, 2))[:, None]
    return bool(np.all(np.abs(at[2] - 2 * at[1] + at[0]) <= LINEAR * size))


def _fitted(vehicle: Model, made: Motion, w: Array, u: Array, moving: int, size: float) -> list[complex]:
    """Start each mode that is no rigid position, follow all of them together, and fit their exponents."""
    slopes = made.slopes(w, u, vehicle.arguments()).A  # they only choose how motions start
    values, vectors = np.linalg.eig(slopes)
    order = np.argsort(-np.abs(values), kind="stable")[:moving]
    upper = [k for k in order if values[k].imag >= 0]
    values, vectors = values[upper].astype(complex), vectors[:, upper].astype(complex)
    twins = [k for k, value in enumerate(values) if _has_twin(value, values)]
    orders = [*(2 if value.imag else 1 for value in values), *(2 for _ in twins)]
    mixed = [_between(slopes, values[k])[:, None] for k in twins]
    values, vectors = np.concatenate([values, values[twins]]), np.concatenate([vectors, *mixed], axis=1)
    spans = SPAN / np.abs(values)
    if values.real.max() > 0:
        spans = np.minimum(spans, GROWTH / values.real.max())
    amplitude = size / np.abs(vectors[_without_mass(vehicle, made)]).max(axis=0)
    shift = (vectors * amplitude).real
    start = w[:, None, None] + np.stack([shift, -shift], axis=-1)
    scaled, members = _InOwnTime(made, spans[:, None]), start.shape[1:]
    drive = Drive([constant(float(value)) for value in u], members)
    times = np.linspace(0, 1, SAMPLES)
    where = f"{type(vehicle).model_id()}: the audit's motion cannot be followed"
    run = Follower(scaled, vehicle.arguments(), start, drive, 1.0, times=times, where=where)
    states = run.run().values
    half = (states[:, :, 0] - states[:, :, 1]) / 2
    typical = np.abs(half).max(axis=(1, 2))[:, None] + np.finfo(float).tiny
    found = []
    for k in range(len(values)):
        exponents, _ = fit_exponents((half[:, k] / typical).T, spans[k] / (SAMPLES - 1), orders[k])
        found += [complex(s) for s in exponents if s.imag >= 0]
    return found


def _has_twin(value: complex, values: Array) -> bool:
    """Tell whether another eigenvalue is so near that eigenvectors say little: a double root, or almost one."""
    near = np.abs([*(values - value), *(values.conj() - value)]) < TWIN * abs(value)
    return bool(near.sum() > (1 if value.imag else 2))


def _between(slopes: Array, value: complex) -> Array:
    """Return a motion that holds both of two eigenvalues near a value, whatever their eigenvectors are."""
    moved = slopes - value.real * np.eye(len(slopes))
    _, _, right = np.linalg.svd(moved @ moved)
    return np.asarray(right[-1] + right[-2])


def _without_mass(vehicle: Model, made: Motion) -> list[int]:
    """Return the states that are no forces or momenta: their sizes can be judged without knowing the vehicle."""
    variables = type(vehicle).declaration.variables
    chosen = [i for i, label in enumerate(made.labels) if not variables[label.rstrip("'")].dimension.mass]
    return chosen or list(range(len(made.labels)))


@dataclass(frozen=True)
class _InOwnTime:
    """A motion whose members each have a time unit [s] of their own; without events."""

    made: Motion
    unit: Array
    event_names: tuple[str, ...] = ()

    def rhs(self, w: Array, u: Array, arguments: Any) -> Array:
        """Return rates per unit of time."""
        return self.made.rhs(w, u, arguments) * self.unit


def _plain(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _both(finding: Finding) -> str:
    return f"the non-linear motion {_goes(finding.fitted)}, the linear verdict says {_going(finding.linear)}"


def _stays(s: complex) -> bool:
    return abs(s.real) < 1e-6 * abs(s)


def _goes(s: complex) -> str:
    if math.isnan(s.real):
        return "shows no such mode"
    if _stays(s):
        return f"neither grows nor decays{_at(s, ' at')}"
    return f"{'grows' if s.real > 0 else 'decays'} at {abs(s.real):.4g} 1/s{_at(s, ' and')}"


def _going(s: complex) -> str:
    if _stays(s):
        return f"neither{_at(s, ' at')}"
    return f"{'growth' if s.real > 0 else 'decay'} at {abs(s.real):.4g} 1/s{_at(s, ' and')}"


def _at(s: complex, word: str) -> str:
    return f"{word} {s.imag / (2 * math.pi):.4g} Hz" if s.imag else ""


def _count(audit: Audit) -> str:
    n = len(audit.findings)
    return f"{n} mode{'s' if n > 1 else ''}"
