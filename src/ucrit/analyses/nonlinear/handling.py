"""Cars near the limit: handling diagram, stability in steady turns, and which axle gives way first.

In a steady turn both axles carry side forces in proportion to their loads, so that the lateral acceleration against
each slip angle is the axle's characteristic, brought to one scale; the difference of the slip angles at equal lateral
acceleration is the handling curve (Karnopp 2004, section 6.VI, figures 6.16 and 6.17; H. B. Pacejka, Tire and Vehicle
Dynamics (2006), section 1.3.3). All of it is read off one family of steady motions.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ...core.errors import UcritError
from ...core.units import to_si
from ..linear.steady import GRAVITY
from ..results.convert import Series, Table, Tabular
from .steady_family import SteadyFamily
from .turns import Turns, chosen

Array = npt.NDArray[Any]

SATURATED = 0.03
"""An axle whose stiffness has fallen to this share of what it was gives no more side force."""

ALIKE = 0.2
"""Slips that grow at rates nearer to each other than this share saturate together."""

NEUTRAL = 1e-3
"""A difference of slip angles that changes by less than this share of what they do stays as it is."""


@dataclass(frozen=True)
class Range:
    """A piece of the handling curve on which the car is one kind: from and to lateral accelerations [m/s^2].

    ``kind`` is ``"understeer"``, ``"neutral"`` or ``"oversteer"``, or ``"unstable"``; ``curvature`` the curvatures
    [1/m] at both ends.
    """

    kind: str
    a_y: tuple[float, float]
    curvature: tuple[float, float]


@dataclass(frozen=True)
class Handling(Tabular):
    """Steady turns of a car up to the limit, to one side: at constant speed, constant radius or constant steer angle.

    Slip angles are given as the book counts them, positive in a turn with positive curvature.

    Attributes
    ----------
    vehicle
        The car.
    turns
        What stays the same (``constant`` and its ``value``), and the input that steers.
    family
        The steady turns themselves, with all states and outputs.
    speed, a_y, curvature, delta
        Speed [m/s], lateral acceleration [m/s^2], one over the radius [1/m], steer angle [rad], shape (N,).
    front, rear
        Slip angles of the axles [rad].
    gradient
        Local understeer gradient [rad/(m/s^2)]: change of ``front - rear`` with lateral acceleration; infinite where
        an axle is saturated.
    ranges
        Understeer, oversteer and instability along the way.
    largest
        Largest lateral acceleration [m/s^2].
    limit
        ``"plough-out"`` where the front axle gives way first, ``"spin"`` where the rear one does, ``"drift"`` where
        both do, and empty where neither has within the slip angles looked at.
    """

    vehicle: Model
    turns: Turns
    family: SteadyFamily = field(repr=False)
    speed: Array = field(repr=False)
    a_y: Array = field(repr=False)
    curvature: Array = field(repr=False)
    delta: Array = field(repr=False)
    front: Array = field(repr=False)
    rear: Array = field(repr=False)
    gradient: Array = field(repr=False)
    ranges: tuple[Range, ...]
    largest: float
    limit: str

    @property
    def steer(self) -> str:
        """The input that steers."""
        return self.turns.steer

    @property
    def stable(self) -> Array:
        """Whether each turn is stable with the steering held, shape (N,)."""
        return self.family.stable

    @property
    def difference(self) -> Array:
        """Slip angle of the front axle less that of the rear axle [rad], the handling curve."""
        return np.asarray(self.front - self.rear)

    @property
    def gradient_deg_per_g(self) -> Array:
        """Local understeer gradient [deg] per g of lateral acceleration."""
        return np.asarray(np.rad2deg(GRAVITY * self.gradient))

    @property
    def unstable_from(self) -> float:
        """Lateral acceleration [m/s^2] from which on turns are unstable; nan where none is."""
        return next((r.a_y[0] for r in self.ranges if r.kind == "unstable"), np.nan)

    def findings(self) -> dict[str, Any]:
        """Return what gives way first, the largest lateral acceleration [m/s^2], and both in words."""
        from .handling_words import sentences

        return {"limit": self.limit, "largest": self.largest, "sentences": [line.strip() for line in sentences(self)]}

    def table(self) -> Table:
        """Return the curves of the handling diagram."""
        columns = {
            "speed": "m/s", "a_y": "m/s^2", "curvature": "1/m", "delta": "rad", "front": "rad", "rear": "rad",
            "difference": "rad", "gradient": "rad s^2/m",
        }  # fmt: skip
        data = [Series(name, ("point",), getattr(self, name), unit) for name, unit in columns.items()]
        data.append(Series("stable", ("point",), self.stable))
        coords = (Series("point", ("point",), np.arange(self.a_y.size)),)
        return Table("handling", self.vehicle, coords, tuple(data), ("point",))

    def __str__(self) -> str:
        from .handling_words import sentences

        return "\n".join(sentences(self))


def handling_diagram(
    vehicle: Model,
    *,
    steer: str = "delta_f",
    slip: float | str = 0.3,
    free: str | Iterable[str] | None = None,
    step: float = 0.03,
    radius: float | str | None = None,
    angle: float | str | None = None,
    upto: float | str | None = None,
) -> Handling:
    """Return the handling diagram of a car: steady turns up to the limit.

    At the car's speed, the steer angle growing; or, if one of them is given, at a constant radius or a constant steer
    angle, the speed rising: the three open-loop tests of ISO 4138.

    Parameters
    ----------
    vehicle
        With scalar parameters; its model has a speed and the outputs ``a_y`` [m/s^2], ``alpha_f`` and ``alpha_r``
        [rad], and a yaw rate ``r`` [rad/s] or an output ``curvature`` [1/m].
    steer
        The input [rad] that steers.
    slip
        Slip angle [rad, or text with a unit] of an axle at which the diagram ends; below a right angle.
    free
        What else adjusts itself. By default nothing, or what the model names in ``keeps_speed``: the input that holds
        a state, such as the drive torque that keeps the forward velocity.
    step
        Largest step along the family.
    radius, angle
        Radius of the circle [m, or text with a unit], or steer angle [rad, or text with a unit], that stays the same.
    upto
        Speed [m/s, or text with a unit] at which a test with rising speed ends; 100 m/s by default.

    Returns
    -------
    Handling
        As far as the turns could be followed.

    Raises
    ------
    UcritError
        If the model lacks what is needed, or a value makes no sense.

    Examples
    --------
    >>> from ucrit import load
    >>> car = handling_diagram(load("spinning-car"))
    >>> car.limit, round(car.largest, 3), round(car.unstable_from, 3)
    ('spin', 7.845, 6.841)
    >>> circle = handling_diagram(load("ploughing-car"), radius="60 m")
    >>> circle.limit, round(float(circle.speed.max()), 2)
    ('plough-out', 22.17)
    """
    _refuse_unfit(vehicle, steer)
    keeps: dict[str, str] = getattr(type(vehicle), "keeps_speed", {})
    others = tuple(keeps) if free is None else (free,) if isinstance(free, str) else tuple(free)
    turns = chosen(vehicle, steer, others, radius, angle)
    fastest = None if upto is None else to_si(upto, "m/s", "upto")
    if fastest is not None and turns.constant == "speed":
        raise UcritError("upto ends a test with rising speed: give a radius or an angle, or set the car's speed")
    reach = to_si(slip, "rad", "slip")
    if not 0 < reach < np.pi / 2:
        raise UcritError(f"slip must be above 0 rad and below a right angle, 1.5708 rad, got {reach:g} rad")
    within = {"alpha_f": (-reach, reach), "alpha_r": (-reach, reach)}
    return _diagram(vehicle, turns, turns.follow(vehicle, within, step, fastest))


def has_handling(vehicle: Model, steer: str = "delta_f") -> bool:
    """Whether a vehicle's model has what a handling diagram needs."""
    return not _lacking(vehicle, steer)


def _refuse_unfit(vehicle: Model, steer: str) -> None:
    missing = _lacking(vehicle, steer)
    if missing:
        *some, last = missing
        needs = f"{', '.join(some)} and {last}" if some else last
        raise UcritError(f"{type(vehicle).model_id()}: a handling diagram needs {needs}, which the model does not have")


def _lacking(vehicle: Model, steer: str) -> list[str]:
    declared = type(vehicle).declaration
    outputs, inputs, states = declared.outputs, declared.inputs, declared.variables
    needed = [
        (declared.speed is None, "a speed"),
        *(
            (outputs.get(n) is None or outputs[n].unit != u, f"an output {n} [{u}]")
            for n, u in (("a_y", "m/s^2"), ("alpha_f", "rad"), ("alpha_r", "rad"))
        ),
        ("curvature" not in outputs and "r" not in states, "an output curvature [1/m] or a yaw rate r [rad/s]"),
        (inputs.get(steer) is None or inputs[steer].unit != "rad", f"a steer angle {steer} [rad]"),
    ]
    return [text for lacks, text in needed if lacks]


def _diagram(vehicle: Model, turns: Turns, family: SteadyFamily) -> Handling:
    speed = turns.speeds(vehicle, family)
    front, rear = -family["alpha_f"], -family["alpha_r"]
    curvature = family["curvature"] if "curvature" in family.values else family["r"] / speed
    opening = family.rates["alpha_r"] - family.rates["alpha_f"]
    with np.errstate(all="ignore"):
        gradient = opening / family.rates["a_y"]
    a_y = family["a_y"]
    ranges = _ranges(family, a_y, curvature, opening)
    top = int(np.argmax(a_y))
    return Handling(
        vehicle, turns, family, speed, a_y, curvature, family[turns.steer], front, rear, gradient, ranges,
        float(a_y[top]), _limit(family, top),
    )  # fmt: skip


def _limit(family: SteadyFamily, top: int) -> str:
    """Name the axle whose slip runs away where the lateral acceleration is largest, just behind a corner there."""
    slips = {name: np.abs(family.rates[name]) for name in ("alpha_f", "alpha_r")}
    gain = np.abs(family.rates["a_y"])
    with np.errstate(all="ignore"):
        shares = np.array([(gain / s) / (gain / s)[0] for s in slips.values()]).min(axis=0)
    if shares[top] > SATURATED and top + 1 < len(gain):
        top += 1
    if shares[top] > SATURATED:
        return ""
    grows = {name: float(s[top]) for name, s in slips.items()}
    small, large = sorted(grows.values())
    if small > (1 - ALIKE) * large:
        return "drift"
    return "plough-out" if grows["alpha_f"] > grows["alpha_r"] else "spin"


def _ranges(family: SteadyFamily, a_y: Array, curvature: Array, opening: Array) -> tuple[Range, ...]:
    """Split the way where stability changes and where the difference of slip angles stops growing or falling."""
    usual = NEUTRAL * (np.abs(family.rates["alpha_f"]) + np.abs(family.rates["alpha_r"]))
    sense = np.where(np.abs(opening) < usual, 0, np.sign(opening)).astype(int)
    kinds = np.array(["oversteer", "neutral", "understeer"])[sense + 1]
    kinds = np.where(family.stable, kinds, "unstable")
    cuts = [0, *(np.flatnonzero(kinds[1:] != kinds[:-1]) + 1)]
    ends = [_border(family, a_y, curvature, opening, int(k)) for k in cuts[1:]]
    places = [(float(a_y[0]), float(curvature[0])), *ends, (float(a_y[-1]), float(curvature[-1]))]
    return tuple(
        Range(str(kinds[k]), (one[0], other[0]), (one[1], other[1]))
        for k, one, other in zip(cuts, places[:-1], places[1:], strict=True)
    )


def _border(family: SteadyFamily, a_y: Array, curvature: Array, opening: Array, k: int) -> tuple[float, float]:
    """Return lateral acceleration and curvature where the kind changes between points k - 1 and k."""
    change = next((c for c in family.changes if c.after == k - 1), None)
    if change is not None and family.stable[k] != family.stable[k - 1]:
        there = float(change.values["a_y"])
        turn = np.interp(there, *_rising(a_y[k - 1 : k + 1], curvature[k - 1 : k + 1]))
        return there, change.values.get("curvature", float(turn))
    one, other = opening[k - 1], opening[k]
    share = one / (one - other) if one * other < 0 else 0.5
    return tuple(float(v[k - 1] + share * (v[k] - v[k - 1])) for v in (a_y, curvature))  # type: ignore[return-value]


def _rising(x: Array, y: Array) -> tuple[Array, Array]:
    order = np.argsort(x)
    return x[order], y[order]
