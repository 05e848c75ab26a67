"""Modes of motion: eigenvalues, frequency, damping, growth, and which states take part."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.mode_names import motion_word, staying_word
from ...core.contract.model import Model
from ...core.errors import UcritError
from ...core.numeric.compiled import compiled, direction, labels, state_space
from ...core.numeric.reach import refuse_lost, unusable
from ...core.record import Record
from ...numerics.assignment import assign
from ..results.convert import Series, Table, Tabular, complex_series, unit_of

Array = npt.NDArray[Any]

ALIKE = 1.1
"""Ratio of moduli up to which two modes of one name are not told apart as slow and fast."""


@dataclass(frozen=True)
class Mode(Record):
    """One real mode or one pair of conjugate modes of a vehicle.

    Attributes
    ----------
    name
        What it is called; no other mode of the vehicle has this name. It is the motion that takes part most, and how
        it goes: ``yaw oscillation``, ``lateral divergence``, or the field's own name: ``hunting``.
    motion
        The motion that takes part most: ``yaw``.
    eigenvalue
        [1/s]; of a pair the one with the positive imaginary part.
    participation
        Share of each state, by name; independent of units, adds up to 1.
    shape
        Complex amplitude of each state, by name, the largest variable scaled to 1.
    """

    name: str
    motion: str
    eigenvalue: complex
    participation: dict[str, float]
    shape: dict[str, complex]

    @property
    def oscillates(self) -> bool:
        """Whether this is a pair of complex eigenvalues."""
        return self.eigenvalue.imag != 0

    @property
    def frequency_hz(self) -> float:
        """Damped frequency [Hz], 0 for a real mode."""
        return self.eigenvalue.imag / (2 * math.pi)

    @property
    def damping_ratio(self) -> float:
        """``-Re/|eigenvalue|``; 1 for a decaying, -1 for a growing real mode, nan for a zero eigenvalue."""
        size = abs(self.eigenvalue)
        return -self.eigenvalue.real / size if size else math.nan

    @property
    def time_to_half(self) -> float:
        """Time [s] in which a decaying mode halves, ``inf`` for one that does not decay."""
        return math.log(2) / -self.eigenvalue.real if self.eigenvalue.real < 0 else math.inf

    @property
    def time_to_double(self) -> float:
        """Time [s] in which a growing mode doubles, ``inf`` for one that does not grow."""
        return math.log(2) / self.eigenvalue.real if self.eigenvalue.real > 0 else math.inf

    def _repr_html_(self) -> str:
        from ..results import notebook

        return notebook.mode(self)


@dataclass(frozen=True)
class Modes(Tabular):
    """Eigenvalues and eigenvectors of a vehicle; leading dimensions are those of its array parameters.

    A mode is named after the variable that takes part most. Where the field has names of its own, a model gives them
    by the names that follow: ``mode_names = {"swivel oscillation": "shimmy"}``; of several modes that one of them fits,
    the least stable gets it.

    Attributes
    ----------
    eigenvalues
        Shape (..., n), from the least to the most stable, conjugates together, positive frequency first.
    vectors
        Shape (..., n, n), right eigenvectors as columns.
    participation
        Shape (..., n, n): share of state i (row) in mode k (column).
    """

    vehicle: Model
    labels: tuple[str, ...]
    eigenvalues: Array
    vectors: Array
    participation: Array

    def __iter__(self) -> Iterator[Mode]:
        return iter(self.list())

    def __len__(self) -> int:
        return len(self.list())

    def list(self) -> list[Mode]:
        """Return the modes of a vehicle with scalar parameters, one entry for a conjugate pair."""
        if self.eigenvalues.ndim != 1:
            raise UcritError("modes of a vehicle with array parameters are arrays: use .eigenvalues and .participation")
        kept = [k for k, value in enumerate(self.eigenvalues) if value.imag >= 0]
        motions = self._motions(kept)
        derived = [f"{motion} {self._going(k)}" for motion, k in zip(motions, kept, strict=True)]
        names = _distinct(_called(derived, type(self.vehicle).mode_names), self.eigenvalues[kept])
        return [
            Mode(
                name,
                motion,
                complex(self.eigenvalues[k]),
                dict(zip(self.labels, map(float, self.participation[:, k]), strict=True)),
                dict(zip(self.labels, map(complex, self._shape(k)), strict=True)),
            )
            for name, motion, k in zip(names, motions, kept, strict=True)
        ]

    @property
    def names(self) -> tuple[str, ...]:
        """Names of all n eigenvalues of a vehicle with scalar parameters, also of conjugates."""
        names: list[str] = []
        upper = iter(self.list())
        for value in self.eigenvalues:
            names.append(next(upper).name if value.imag >= 0 else f"{names[-1]}, conjugate")
        return tuple(names)

    def table(self) -> Table:
        """Return eigenvalues, frequency, damping ratio and participation with their units."""
        coords = [Series(name, (name,), x, unit_of(self.vehicle, name)) for name, x in self.vehicle.dims.items()]
        dims = tuple(self.vehicle.dims)
        names = np.arange(1, self.eigenvalues.shape[-1] + 1) if dims else np.array(self.names)
        coords += [Series("mode", ("mode",), names), Series("state", ("state",), np.array(self.labels))]
        size = np.abs(self.eigenvalues)
        damping = np.divide(-self.eigenvalues.real, size, out=np.full(size.shape, np.nan), where=size > 0)
        data = (
            *complex_series("eigenvalue", (*dims, "mode"), self.eigenvalues, "1/s"),
            Series("frequency", (*dims, "mode"), self.eigenvalues.imag / (2 * math.pi), "Hz"),
            Series("damping_ratio", (*dims, "mode"), damping, "1"),
            Series("participation", (*dims, "state", "mode"), self.participation, "1"),
        )
        return Table("modes", self.vehicle, tuple(coords), data, (*dims, "mode"))

    def _shape(self, k: int) -> Array:
        """Scale a vector by its largest variable; rates follow."""
        pairs = zip(self.vectors[:, k], self.labels, strict=True)
        values = np.array([v if "'" not in label else 0 for v, label in pairs])
        return np.asarray(self.vectors[:, k] / values[np.argmax(abs(values))])

    def _motions(self, kept: Sequence[int]) -> tuple[str, ...]:
        """Return the motion that each of the kept modes is named after.

        It is that of the variable that takes part most. A model whose variables name as many motions as it has modes
        may say ``one_mode_each = True``: each motion then names the one mode in which it has its share, such that
        all shares together are largest.
        """
        rows: dict[str, list[int]] = {}
        motions = [self._motion(label.rstrip("'")) for label in self.labels]
        for i, motion in enumerate(motions):
            rows.setdefault(motion, []).append(i)
        if type(self.vehicle).one_mode_each and len(rows) == len(kept):
            shares = np.array([[self.participation[own, k].sum() for own in rows.values()] for k in kept])
            names = tuple(rows)
            return tuple(names[i] for i in assign(1 - shares[None])[0])
        return tuple(self._motion(self._most(k)) for k in kept)

    def _most(self, k: int) -> str:
        """Return the variable that takes part most in a mode, its rates included."""
        share: dict[str, float] = {}
        for label, part in zip(self.labels, self.participation[:, k], strict=True):
            base = label.rstrip("'")
            share[base] = share.get(base, 0.0) + float(part)
        return max(share, key=lambda name: share[name])

    def _motion(self, name: str) -> str:
        variable = type(self.vehicle).declaration.variables.get(name)
        return motion_word(variable) if variable else name

    def _going(self, k: int) -> str:
        value = complex(self.eigenvalues[k])
        if value == 0:
            return self._staying(self.labels[int(np.argmax(self.participation[:, k]))])
        return "oscillation" if value.imag else "decay" if value.real < 0 else "divergence"

    def _staying(self, label: str) -> str:
        """Return what it is that nothing restores, by the unit of the state that takes part most."""
        variable = type(self.vehicle).declaration.variables.get(label.rstrip("'"))
        return staying_word(variable, label.count("'")) if variable else "value"

    @property
    def growth(self) -> Array:
        """Largest real part [1/s] over all modes but rigid positions, of shape (...)."""
        return growth(self.vehicle, self.eigenvalues)

    def __str__(self) -> str:
        if self.eigenvalues.ndim != 1:
            shape = ", ".join(f"{name}: {values.size}" for name, values in self.vehicle.dims.items())
            return f"{self.eigenvalues.shape[-1]} modes at each of {shape}"
        return "\n".join(
            f"{mode.name:<24} {mode.eigenvalue.real:+.6g}{mode.eigenvalue.imag:+.6g}j" for mode in self.list()
        )

    def _repr_html_(self) -> str:
        from ..results import notebook

        if self.eigenvalues.ndim != 1:
            return super()._repr_html_()
        return notebook.modes(self.list(), f"Modes: {notebook.name_of(self.vehicle)}")


def modes(vehicle: Model) -> Modes:
    """Return eigenvalues, eigenvectors and participation of a vehicle's linear motion.

    Parameters
    ----------
    vehicle
        Its array parameters span leading dimensions of the result.

    Returns
    -------
    Modes
        Iterating over it gives named `Mode` objects when all parameters are scalars. Accuracy is that of
        LAPACK's balanced QR; eigenvalues that are zero whatever the parameters are returned as exact zeros.

    Examples
    --------
    >>> from ucrit import load, modes
    >>> [round(mode.eigenvalue.real, 5) for mode in modes(load("bmw-320i"))]
    [-21.50352, -21.58519]
    """
    values, vectors = eigensystem(vehicle)
    return Modes(vehicle, labels(vehicle), values, vectors, _participation(vectors))


def eigensystem(vehicle: Model) -> tuple[Array, Array]:
    """Return eigenvalues [1/s] (..., n) and right eigenvectors (..., n, n) in columns, in order."""
    values, vectors = np.linalg.eig(_state_matrix(vehicle))
    values, vectors = values.astype(complex), vectors.astype(complex)
    if not vehicle.dims:
        refuse_lost(vehicle, values)
    order = _order(values)
    values = np.take_along_axis(values, order, axis=-1)
    vectors = np.take_along_axis(vectors, order[..., None, :], axis=-1)
    return _with_exact_zeros(vehicle, values), vectors


def eigenvalues(vehicle: Model) -> Array:
    """Return eigenvalues [1/s] alone, of shape (..., n), ordered as in `Modes`."""
    values = np.linalg.eigvals(_state_matrix(vehicle)).astype(complex)
    return _with_exact_zeros(vehicle, np.take_along_axis(values, _order(values), axis=-1))


def _state_matrix(vehicle: Model) -> Array:
    A = state_space(vehicle).A
    if not np.all(np.isfinite(A)):
        raise unusable(vehicle)
    return A


def _order(values: Array) -> Array:
    """Sort by falling real part; a pair's two members share one rounded key, positive frequency first."""
    scale = np.abs(values).max(axis=-1, keepdims=True) + np.finfo(float).tiny
    real = np.round(values.real / scale, 12)
    return np.lexsort((-values.imag, np.abs(values.imag), -real), axis=-1)


def rigid_positions(vehicle: Model, values: Array) -> Array:
    """Tell which eigenvalues (..., n) are zero whatever the parameters: as many of the smallest as there are."""
    count = compiled(type(vehicle), direction(vehicle)).structural_zeros
    rank = np.argsort(np.argsort(np.abs(values), axis=-1, kind="stable"), axis=-1, kind="stable")
    return np.asarray(rank < count)


def growth(vehicle: Model, values: Array) -> Array:
    """Return the largest real part [1/s] of eigenvalues (..., n) but for rigid positions, ``-inf`` if none is left."""
    return np.asarray(np.where(rigid_positions(vehicle, values), -np.inf, values.real).max(axis=-1))


def _with_exact_zeros(vehicle: Model, values: Array) -> Array:
    """Set the structural zeros to zero."""
    return np.where(rigid_positions(vehicle, values), 0, values)


def _participation(vectors: Array) -> Array:
    """Share of each state in each mode, ``|left * right|``; of the right vectors alone where none is left."""
    try:
        left = np.swapaxes(np.linalg.inv(vectors), -1, -2)
        product = np.abs(left * vectors)
        defective = ~np.isfinite(product).all(axis=(-1, -2), keepdims=True)
    except np.linalg.LinAlgError:
        product, defective = np.abs(vectors), np.zeros((*vectors.shape[:-2], 1, 1), dtype=bool)
    product = np.where(defective, np.abs(vectors), product)
    return np.asarray(product / product.sum(axis=-2, keepdims=True))


def mode_name(model: type[Model], motion: str, going: str) -> str:
    """Return what a model calls a mode that is alone in its motion, such as the one that becomes unstable.

    >>> from ucrit import find_model
    >>> mode_name(find_model("nose-gear"), "swivel", "oscillation")
    'shimmy'
    """
    name = f"{motion} {going}"
    return model.mode_names.get(name, name)


def _called(derived: Sequence[str], own: Mapping[str, str]) -> list[str]:
    """Give each of the field's names to one mode, the least stable of those it fits; they come in this order."""
    names: list[str] = []
    for name in derived:
        called = own.get(name, name)
        names.append(name if called in names else called)
    return names


def _distinct(names: list[str], values: Array) -> list[str]:
    """Tell modes of one name apart: slow and fast for two unlike ones, else numbers by modulus."""
    result, sizes = list(names), np.abs(values)
    for name in set(names):
        same = sorted((i for i, n in enumerate(names) if n == name), key=lambda i: sizes[i])
        if len(same) == 2 and sizes[same[1]] > ALIKE * sizes[same[0]]:
            result[same[0]], result[same[1]] = f"slow {name}", f"fast {name}"
        elif len(same) > 1:
            for number, i in enumerate(same, 1):
                result[i] = f"{name} {number}"
    return result
