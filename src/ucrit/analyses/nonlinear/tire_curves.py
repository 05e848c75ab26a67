"""Curves of a tire: side force, aligning moment, driving and braking force, and all that a tire can do at once.

Any law will do that answers ``forces(F_z, alpha, kappa, gamma)`` with F_x, F_y and M_z, as those of `ucrit.tire` do.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ...core.contract.part import Part, slot
from ...core.errors import UcritError, near_match
from ..results.convert import Series, Table, Tabular

Array = npt.NDArray[Any]

LOADS = (1500.0, 3000.0, 4500.0, 6000.0)
ENVELOPE = (2.0, 5.0, 10.0, 20.0)
"""Slip angles [degrees] of the envelope."""

REACH = np.radians(np.linspace(0, 90, 61)[:-1])
"""Slip angles [rad] among which the limit of friction is sought."""

ANGLES = {"rad": 1.0, "deg": np.pi / 180}


@dataclass(frozen=True, eq=False)
class TireCurves(Tabular):
    """Forces of one tire over loads, roads and slips.

    Attributes
    ----------
    tire
        The tire.
    roads
        Friction of each road as a multiple of the tire's own, by name, R of them.
    loads
        Vertical loads [N], shape (L,).
    alpha
        Slip angles [rad], shape (A,).
    kappa
        Longitudinal slips, shape (K,), from -1, locked, to 1.
    beta
        Slip angles [rad] of the envelope, shape (S,).
    F_y, M_z
        Side force [N] and aligning moment [N m] of the wheel that rolls freely, shape (R, L, A).
    F_x
        Longitudinal force [N] without slip angle, shape (R, L, K).
    envelope_x, envelope_y
        Longitudinal and side force [N] together, shape (R, L, S, K).
    limit_x, limit_y
        The limit of friction: the forces [N] farthest out in each of D directions, from braking to driving, of all
        that any two slips give, shape (R, L, D). Its shape is near an ellipse.
    """

    tire: Any
    roads: Mapping[str, float]
    loads: Array
    alpha: Array
    kappa: Array
    beta: Array
    F_y: Array
    M_z: Array
    F_x: Array
    envelope_x: Array
    envelope_y: Array
    limit_x: Array
    limit_y: Array

    @property
    def cornering_coefficient(self) -> Array:
        """``-dF_y/dalpha`` [N/rad] at no slip, of each load, shape (L,)."""
        return np.asarray(np.broadcast_to(self.tire.cornering_coefficient(self.loads), self.loads.shape), dtype=float)

    @property
    def peak_side(self) -> tuple[Array, Array]:
        """Greatest side force [N] among the slip angles, and where [rad]; nan if it still rises, shape (R, L) each."""
        return _peak(np.abs(self.F_y), np.abs(self.alpha))

    @property
    def peak_braking(self) -> tuple[Array, Array]:
        """Greatest braking force [N], and its slip kappa; nan if only the locked wheel has it, shape (R, L) each."""
        braking = np.flatnonzero(self.kappa <= 0)[::-1]
        return _peak(-self.F_x[..., braking], self.kappa[braking])

    @property
    def locked(self) -> Array:
        """Braking force [N] of the locked wheel that moves straight ahead, shape (R, L)."""
        return np.asarray(-self.F_x[..., 0])

    def table(self) -> Table:
        """Return all curves with their units, side by side: the points of a shorter one end in nan."""
        count = max(self.alpha.size, self.kappa.size, self.limit_x.shape[-1])

        def padded(values: Array) -> Array:
            return np.pad(
                values, [(0, 0)] * (values.ndim - 1) + [(0, count - values.shape[-1])], constant_values=np.nan
            )

        coords = (
            Series("road", ("road",), np.array(list(self.roads)), ""),
            Series("load", ("load",), self.loads, "N"),
            Series("beta", ("beta",), self.beta, "rad"),
            Series("point", ("point",), np.arange(count), "1"),
        )
        free, both = ("road", "load", "point"), ("road", "load", "beta", "point")
        data = (
            Series("alpha", ("point",), padded(self.alpha), "rad"),
            Series("F_y", free, padded(self.F_y), "N"),
            Series("M_z", free, padded(self.M_z), "N m"),
            Series("kappa", ("point",), padded(self.kappa), "1"),
            Series("F_x", free, padded(self.F_x), "N"),
            Series("envelope_x", both, padded(self.envelope_x), "N"),
            Series("envelope_y", both, padded(self.envelope_y), "N"),
            Series("limit_x", free, padded(self.limit_x), "N"),
            Series("limit_y", free, padded(self.limit_y), "N"),
        )
        return Table("tire curves", _bench(self.tire), coords, data, free)


def tire_curves(
    tire: Any,
    loads: Sequence[float] | Array = LOADS,
    roads: Mapping[str, float] | None = None,
    *,
    alpha: Sequence[float] | Array | None = None,
    kappa: Sequence[float] | Array | None = None,
    beta: Sequence[float] | Array | None = None,
    gamma: float = 0.0,
) -> TireCurves:
    """Return the curves of a tire: side force, moment, longitudinal force, and both forces together.

    Parameters
    ----------
    tire
        As from `ucrit.tire`.
    loads
        Vertical loads [N].
    roads
        Friction of roads as multiples of the friction that the tire is given for, by name:
        ``{"dry": 1, "wet": 0.7, "ice": 0.1}``; by default one, as it is.
    alpha
        Slip angles [rad] of the curves of a wheel that rolls freely; 0 to 20 degrees by default.
    kappa
        Longitudinal slips; from locked, -1, to 1 by default.
    beta
        Slip angles [rad] at which both slips are combined; 2, 5, 10 and 20 degrees by default.
    gamma
        Camber [rad].

    Raises
    ------
    UcritError
        If a load is not above zero, a slip is impossible, or the law knows no friction and roads are given.

    Examples
    --------
    >>> from ucrit import tire, tire_curves
    >>> curves = tire_curves(tire("brush", C="1 kN/deg", mu=0.9), [2000, 4000], {"dry": 1, "ice": 0.1})
    >>> curves.peak_side[0].round(6).tolist()
    [[1800.0, 3600.0], [180.0, 360.0]]
    """
    _refuse_other(tire)
    F_z = _numbers(loads, "load", "N", above=0.0)
    angles = _numbers(np.radians(np.linspace(0, 20, 161)) if alpha is None else alpha, "slip angle", "rad")
    slips = _numbers(_slips() if kappa is None else kappa, "longitudinal slip", "1")
    combined = _numbers(np.radians(ENVELOPE) if beta is None else beta, "slip angle", "rad")
    if np.any(np.abs([*angles, *combined]) > np.pi / 2):
        raise UcritError("slip angles must be within a quarter turn, 1.5708 rad; give degrees as numpy.radians(...)")
    if slips[0] < -1:
        raise UcritError(f"longitudinal slip must be at least -1, where the wheel is locked, got {slips[0]:g}")
    surfaces = {"as given": 1.0} if roads is None else dict(roads)
    tires = [tire if factor == 1 else tire.on_road(factor) for factor in surfaces.values()]
    with np.errstate(all="ignore"):
        free = [one.forces(F_z[:, None], angles, 0, gamma) for one in tires]
        straight = [one.forces(F_z[:, None], 0.0, slips, gamma) for one in tires]
        both = [one.forces(F_z[:, None, None], combined[:, None], slips, gamma) for one in tires]
        limits = [_limit(one, F_z, slips, gamma) for one in tires]

    def stacked(found: list[Any], name: str, *shape: int) -> Array:
        return np.array([np.broadcast_to(getattr(forces, name), (F_z.size, *shape)) for forces in found], dtype=float)

    found = TireCurves(
        *(tire, surfaces, F_z, angles, slips, combined),
        F_y=stacked(free, "F_y", angles.size),
        M_z=stacked(free, "M_z", angles.size),
        F_x=stacked(straight, "F_x", slips.size),
        envelope_x=stacked(both, "F_x", combined.size, slips.size),
        envelope_y=stacked(both, "F_y", combined.size, slips.size),
        limit_x=np.stack([x for x, _ in limits]),
        limit_y=np.stack([y for _, y in limits]),
    )
    _refuse_absurd(found)
    return found


def _refuse_other(tire: Any) -> None:
    if not isinstance(tire, Part) or not callable(getattr(tire, "forces", None)):
        got = f"the law {tire.__name__} without numbers" if isinstance(tire, type) else type(tire).__name__
        raise UcritError(f"tire_curves needs a tire, as from ucrit.tire('brush', C=80_000), got {got}")


def _refuse_absurd(found: TireCurves) -> None:
    """Refuse loads at which a law, carried on far beyond the loads that it is for, gives no number."""
    forces = (found.F_y, found.F_x, found.M_z, found.envelope_x, found.envelope_y, found.limit_x, found.limit_y)
    fine = [np.isfinite(F).all(axis=tuple(k for k in range(F.ndim) if k != 1)) for F in forces]
    wrong = found.loads[~np.all(fine, axis=0)]
    if wrong.size:
        raise UcritError(f"{type(found.tire).part_id()}: the law gives no forces at a load of {wrong[0]:g} N")


def _limit(tire: Any, F_z: Array, slips: Array, gamma: float) -> tuple[Array, Array]:
    """Return the forces [N] farthest out in directions from braking to driving, each (L, D)."""
    found = tire.forces(F_z[:, None, None], REACH[:, None], slips, gamma)
    shape = (F_z.size, REACH.size, slips.size)
    F_x, F_y = (np.broadcast_to(F, shape).reshape(F_z.size, -1) for F in (found.F_x, found.F_y))
    theta = np.linspace(np.pi, 0, 91)[:, None]
    out = [np.argmax(x * np.cos(theta) - y * np.sin(theta), axis=-1) for x, y in zip(F_x, F_y, strict=True)]
    return np.take_along_axis(F_x, np.array(out), -1), np.take_along_axis(F_y, np.array(out), -1)


def cornering_coefficient(alpha: Sequence[float] | Array, force: Sequence[float] | Array, unit: str = "rad") -> float:
    """Return the cornering coefficient [N/rad] estimated from measured points of a tire's curve.

    The slope at no slip of the odd cubic that fits best, through its own point of no force; a force that grows with
    the slip angle gives a positive coefficient, whichever sign it is told with.

    Parameters
    ----------
    alpha
        Slip angles, three or more, in the rising part of the curve.
    force
        Side forces [N], or their ratios to the load, from which the coefficient per load follows.
    unit
        Unit of the slip angles, ``"rad"`` or ``"deg"``.

    Examples
    --------
    >>> import numpy as np
    >>> from ucrit import cornering_coefficient, tire
    >>> degrees = np.linspace(-2, 2, 9)
    >>> forces = tire("pacejka-205-60r15").side_force(4000, np.radians(degrees))
    >>> round(cornering_coefficient(degrees, forces, "deg"), -2)
    46100.0
    """
    if unit not in ANGLES:
        raise UcritError(f"unit of the slip angles cannot be '{unit}'{near_match(unit, ANGLES)}")
    x, y = (np.asarray(v, dtype=float).ravel() for v in (alpha, force))
    if x.size != y.size or np.unique(x).size < 3 or not np.isfinite([*x, *y]).all():
        raise UcritError(
            f"a slope needs three or more points, as many forces as slip angles; got {x.size} and {y.size}"
        )
    x = x * ANGLES[unit]
    scale = np.abs(x).max()
    columns = np.stack([x / scale, (x / scale) ** 3, *([np.ones_like(x)] if x.min() < 0 else [])], axis=1)
    found = np.linalg.lstsq(columns, y, rcond=None)[0]
    return float(abs(found[0]) / scale)


def _slips() -> Array:
    """Longitudinal slips from -1 to 1, close together where forces change fast."""
    fine = np.linspace(0, 1, 81) ** 2
    return np.concatenate([-fine[:0:-1], fine])


def _numbers(values: Any, what: str, unit: str, above: float = -np.inf) -> Array:
    try:
        found = np.atleast_1d(np.asarray(values, dtype=float))
    except (TypeError, ValueError):
        raise UcritError(f"{what}s must be numbers in {unit}, got {values!r}") from None
    if found.ndim != 1 or not found.size or not np.isfinite(found).all():
        raise UcritError(f"{what}s must be a list of finite numbers, got {values!r}")
    if (found <= above).any():
        raise UcritError(f"{what} must be above {above:g} {unit}, got {found[found <= above][0]:g} {unit}")
    return found


def _peak(forces: Array, slips: Array) -> tuple[Array, Array]:
    """Return the greatest value and its slip, a summit by a parabola; at an end of the slips the slip is nan."""
    at = np.argmax(forces >= forces.max(-1, keepdims=True) * (1 - 1e-9), axis=-1)  # the first of a plateau
    ends = (at == 0) | (at == slips.size - 1)
    i = np.clip(at, 1, slips.size - 2)
    low, mid, high = (np.take_along_axis(forces, (i + k)[..., None], -1)[..., 0] for k in (-1, 0, 1))
    x_0, x_1, x_2 = (slips[i + k] for k in (-1, 0, 1))
    left, right = (mid - low) / (x_1 - x_0), (high - mid) / (x_2 - x_1)
    bend = (right - left) / (x_2 - x_0)
    with np.errstate(all="ignore"):
        step = np.where((bend < 0) & (high < mid * (1 - 1e-9)), (x_0 + x_1) / 2 - left / (2 * bend) - x_1, 0.0)
    top = mid + step * (left + bend * (x_1 + step - x_0))
    return np.where(ends, forces.max(-1), np.maximum(top, mid)), np.where(ends, np.nan, x_1 + step)


@cache
def _bench_of(law: Any) -> type[Model]:
    """Return a model that has nothing but a tire of one law."""
    return type("TireBench", (Model,), {"__doc__": "One tire on a test bench.", "tire": slot(law, "tire")})


def _bench(tire: Any) -> Model:
    """Return the tire on a test bench, for the tables that results are told in."""
    law: Any = type(tire)
    found = _bench_of(law)(**{f"tire_{name}": getattr(tire, name) for name in law.parameters})
    return found.with_info(name=law.part_id())
