"""How eigenvalues, growth and critical speeds change with every parameter.

For a simple eigenvalue with right vector x and left vector y, ``d lambda/dp = y A' x / (y x)``
(P. Lancaster, Numerische Mathematik 6 (1964) 377-387). A repeated eigenvalue has no such derivative.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ...core.numeric.compiled import compiled, direction, labels, state_slopes, state_space
from ..linear.modes import eigensystem, modes, rigid_positions
from ..results.convert import Series, Table, Tabular, complex_series, unit_of
from .critical import Critical, critical

Array = npt.NDArray[Any]

GAP = 1e-7
"""Eigenvalues closer than this share of the largest one count as repeated."""

ERROR = 1e-6
"""Derivatives whose relative error from rounding may exceed this are withheld."""

AXIS = 1e-7
"""Real parts below this share of the largest eigenvalue count as zero at a critical speed."""


@dataclass(frozen=True)
class CriticalSlope:
    """How one critical speed changes with every parameter.

    Attributes
    ----------
    critical
        The critical speed.
    slopes
        dU_crit/dp by parameter, in m/s per unit of the parameter; nan where the speed has no derivative (two
        modes cross together, an eigenvalue is repeated there, or the axis is touched and not crossed).
    normalised
        ``p/U_crit dU_crit/dp``: percent of critical speed per percent of parameter.
    """

    critical: Critical
    slopes: dict[str, float]
    normalised: dict[str, float]


@dataclass(frozen=True, eq=False)
class Sensitivity(Tabular):
    """Derivatives of a vehicle's eigenvalues and critical speeds.

    Attributes
    ----------
    vehicle
        Its array parameters span the leading dimensions.
    names
        Names of the eigenvalues, their numbers where parameters are arrays.
    eigenvalues
        Shape (..., n) [1/s], least stable first.
    slopes
        By parameter p, shape (..., n): d(eigenvalue)/dp [1/s per unit of p], complex; nan where the
        eigenvalue is repeated (closer than 1e-7 of the largest to another) or so ill-conditioned that
        rounding may spoil it.
    growth
        By parameter, shape (...): derivative of the largest real part [1/s per unit of p], nan as above.
    critical
        One entry for each critical speed, ascending; empty for array parameters and for models without speed.
    """

    vehicle: Model
    names: tuple[str, ...]
    eigenvalues: Array
    slopes: dict[str, Array]
    growth: dict[str, Array]
    critical: tuple[CriticalSlope, ...]

    @property
    def normalised(self) -> dict[str, Array]:
        """``p d(eigenvalue)/dp`` [1/s] by parameter: change per relative change of the parameter."""
        values = dict(zip(self.vehicle.values, self.vehicle.arguments(), strict=True))
        return {name: slope * np.asarray(values[name])[..., None] for name, slope in self.slopes.items()}

    def table(self) -> Table:
        """Return the slopes of eigenvalues, growth and critical speeds, one variable a parameter."""
        dims = tuple(self.vehicle.dims)
        coords = [Series(name, (name,), x, unit_of(self.vehicle, name)) for name, x in self.vehicle.dims.items()]
        coords.append(Series("mode", ("mode",), np.array(self.names)))
        data = list(complex_series("eigenvalue", (*dims, "mode"), self.eigenvalues, "1/s"))
        for name, slope in self.slopes.items():
            unit = _per("1/s", unit_of(self.vehicle, name))
            data += complex_series(f"d_eigenvalue_d_{name}", (*dims, "mode"), slope, unit)
            data.append(Series(f"d_growth_d_{name}", dims, np.asarray(self.growth[name]), unit))
        if not dims:
            coords.append(Series("critical", ("critical",), np.arange(1, 1 + len(self.critical))))
            data += self._of_critical()
        return Table("sensitivity", self.vehicle, tuple(coords), tuple(data), (*dims, "mode"))

    def _of_critical(self) -> list[Series]:
        name = type(self.vehicle).declaration.speed
        unit = "1" if name is None else unit_of(self.vehicle, name)
        speeds = np.array([c.critical.value for c in self.critical], dtype=float)
        found = [Series("critical_speed", ("critical",), speeds, unit)]
        for key in self.slopes:
            slopes = np.array([c.slopes.get(key, np.nan) for c in self.critical], dtype=float)
            per = _per(unit, unit_of(self.vehicle, key))
            found.append(Series(f"d_critical_speed_d_{key}", ("critical",), slopes, per))
        return found

    def _repr_html_(self) -> str:
        from ..results import notebook

        return super()._repr_html_() if self.vehicle.dims else notebook.sensitivity(self)


def _per(unit: str, divisor: str) -> str:
    return unit if divisor == "1" else f"{unit} per {divisor}"


def sensitivity(vehicle: Model) -> Sensitivity:
    """Differentiate eigenvalues, growth and critical speeds with respect to every parameter.

    Parameters
    ----------
    vehicle
        Array parameters span leading dimensions of the result; critical speeds need scalars.

    Returns
    -------
    Sensitivity
        Exact derivatives, not differences: the matrices are differentiated in symbols.

    Examples
    --------
    >>> from ucrit import load
    >>> found = sensitivity(load("caravan"))
    >>> bool(found.growth["c"] < 0), found.critical[0].slopes["c"] > 0
    (True, True)
    """
    values, slopes = _slopes(vehicle)
    worst = np.argmax(np.where(rigid_positions(vehicle, values), -np.inf, values.real), axis=-1)[..., None]
    growth = {name: np.take_along_axis(slope.real, worst, axis=-1)[..., 0] for name, slope in slopes.items()}
    scalar = not vehicle.dims
    names = modes(vehicle).names if scalar else tuple(map(str, range(1, len(labels(vehicle)) + 1)))
    found: tuple[CriticalSlope, ...] = ()
    if scalar and type(vehicle).declaration.speed is not None:
        found = tuple(_critical_slope(vehicle, one) for one in critical(vehicle))
    return Sensitivity(vehicle, names, values, slopes, growth, found)


def _slopes(vehicle: Model) -> tuple[Array, dict[str, Array]]:
    """Eigenvalues and their derivatives by parameter."""
    values, right = eigensystem(vehicle)
    A = state_space(vehicle).A
    left, sure = _left(A, values, right)
    rigid = rigid_positions(vehicle, values)
    slopes = {}
    for name, dA in state_slopes(vehicle).items():
        with np.errstate(all="ignore"):
            slope = np.einsum("...ki,...ij,...jk->...k", left, dA, right)
        # Rigid positions stay at zero whatever the parameters.
        slopes[name] = np.where(rigid, 0, np.where(sure, slope, complex(np.nan, np.nan)))
    return values, slopes


def _left(A: Array, values: Array, right: Array) -> tuple[Array, Array]:
    """Left vectors in rows, scaled to ``y x = 1``, and which eigenvalues are simple enough.

    Each solves a bordered system that is regular exactly if its eigenvalue is simple, whatever others are.
    """
    n = values.shape[-1]
    size = np.abs(values).max(axis=-1, keepdims=True) + np.finfo(float).tiny
    apart = np.abs(values[..., :, None] - values[..., None, :]) + np.where(np.eye(n, dtype=bool), np.inf, 0)
    gap = apart.min(axis=-1, initial=np.inf) / size
    simple = gap > GAP
    bordered = np.zeros((*values.shape, n + 1, n + 1), dtype=complex)
    bordered[..., :n, :n] = np.swapaxes(A, -1, -2)[..., None, :, :] - values[..., None, None] * np.eye(n)
    columns = np.swapaxes(right, -1, -2)
    bordered[..., :n, n] = np.conj(columns) * size[..., None]
    bordered[..., n, :n] = columns
    bordered[~simple] = np.eye(n + 1)
    target = np.zeros((*values.shape, n + 1, 1), dtype=complex)
    target[..., n, 0] = 1
    left = np.linalg.solve(bordered, target)[..., :n, 0]
    spread = np.abs(left * columns).sum(axis=-1)
    error = np.finfo(float).eps * spread / np.where(simple, gap, 1)
    return left, simple & (error < ERROR)


def _critical_slope(vehicle: Model, one: Critical) -> CriticalSlope:
    """Differentiate the condition that holds all along the boundary, ``f(U, p) = 0``: dU/dp = -f_p/f_U."""
    change = _boundary_slopes(vehicle.with_(**{one.parameter: one.value}), one.kind)
    across = change.pop(one.parameter)
    slopes = {name: -slope / across + 0.0 if across else np.nan for name, slope in change.items()}
    normalised = {name: slope * float(vehicle.values[name]) / one.value for name, slope in slopes.items()}
    return CriticalSlope(one, slopes, normalised)


def _boundary_slopes(there: Model, kind: str) -> dict[str, float]:
    """Derivatives of f: of a_0 at a divergence, of the real part of the crossing pair at a flutter."""
    values, slopes = _slopes(there)
    unknown = dict.fromkeys(slopes, np.nan)
    on_axis = (np.abs(values.real) <= AXIS * np.abs(values).max()) & (values.imag > 0)
    functions = compiled(type(there), direction(there))
    zeros = functions.structural_zeros
    # m equal eigenvalues come out of a computation apart by the m-th root of its precision.
    near = np.abs(values) <= 10 * np.finfo(float).eps ** (1 / (zeros + 2)) * np.abs(values).max()
    if kind == "divergence" and not on_axis.any() and np.count_nonzero(near) == zeros + 1:
        # The crossing eigenvalue joins those of rigid positions, but a_0 knows nothing of these.
        found = functions.static_slopes(there.arguments())
        return dict(zip(slopes, map(float, found), strict=True))
    if kind == "flutter" and np.count_nonzero(on_axis) == 1:
        return {name: float(slope[on_axis][0].real) for name, slope in slopes.items()}
    return unknown
