"""Steady turns of cars: understeer gradient, characteristic or critical speed, and gains against speed.

In a steady turn the linear equations lose their rates, and the steer angle for a turn of radius R at speed U
is
``delta = L/R + K U**2/R`` (Karnopp 2004, section 6.V): L the effective wheelbase, K the understeer gradient.
Both are read off the static gain of the transfer function from steer angle to yaw rate, whatever the model.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ...core.errors import UcritError
from ...core.formulas.codegen import build
from ...core.html import Rich
from ...core.numeric.cache import cached

Array = npt.NDArray[Any]

GRAVITY = 9.80665
"""Standard gravity [m/s^2], for gradients per g."""

NEUTRAL = 1e-12
"""An understeer gradient below this share of its terms' usual size, ``L/U**2`` at 1 km/s, counts as none."""


@dataclass(frozen=True)
class SteadyTurn(Rich):
    """How a car turns steadily, for small slip and steer angles; array parameters make arrays.

    Attributes
    ----------
    vehicle, steer, speed
        The car, the input that steers it, and the name of its speed.
    wheelbase_formula, gradient_formula
        L [m] and K [rad/(m/s^2)] in the parameters, as text; ``gradient_latex`` as LaTeX.
    """

    vehicle: Model
    steer: str
    speed: str
    wheelbase_formula: str
    gradient_formula: str
    gradient_latex: str
    source: str = field(repr=False)
    parameters: tuple[str, ...] = field(repr=False)

    @cached_property
    def _function(self) -> Callable[..., tuple[Any, ...]]:
        return build(self.source, "steady")

    @cached_property
    def _values(self) -> tuple[Array, Array]:
        arguments = dict(zip(self.vehicle.values, self.vehicle.arguments(), strict=True))
        L, K = self._function([arguments[name] for name in self.parameters])
        L, K = np.broadcast_arrays(np.asarray(L, dtype=float), np.asarray(K, dtype=float))
        return L, np.where(np.abs(K) < NEUTRAL * np.abs(L), 0.0, K)

    @property
    def wheelbase(self) -> Any:
        """Effective wheelbase L [m], negative where steering turns the car the other way (rear steering)."""
        return _plain(self._values[0])

    @property
    def gradient(self) -> Any:
        """Understeer gradient K1 [rad/(m/s^2)]: further steer angle per lateral acceleration."""
        return _plain(self._values[1])

    @property
    def gradient_per_g(self) -> Any:
        """Understeer gradient K2 [rad] per g of lateral acceleration."""
        return _plain(GRAVITY * self._values[1])

    @property
    def gradient_deg_per_g(self) -> Any:
        """Understeer gradient K2 [deg] per g of lateral acceleration."""
        return _plain(np.rad2deg(GRAVITY * self._values[1]))

    @property
    def handling(self) -> Any:
        """``"understeer"``, ``"neutral"`` or ``"oversteer"``, an array of these for array parameters."""
        L, K = self._values
        words = np.array(["oversteer", "neutral", "understeer"])[np.sign(K * np.sign(L)).astype(int) + 1]
        return words if words.ndim else str(words)

    @property
    def characteristic_speed(self) -> Any:
        """Speed [m/s] at which an understeering car needs twice a neutral one's steer angle, else nan."""
        L, K = self._values
        with np.errstate(all="ignore"):
            return _plain(np.where(L * K > 0, np.sqrt(L / K), np.nan))

    @property
    def critical_speed(self) -> Any:
        """Speed [m/s] at which an oversteering car turns without steering; nan for others."""
        L, K = self._values
        with np.errstate(all="ignore"):
            return _plain(np.where(L * K < 0, np.sqrt(-L / K), np.nan))

    def steer_angle(self, radius: Any, speed: Any) -> Any:
        """Return the steer angle [rad] for a turn of a radius [m] at a speed [m/s]."""
        U, R = np.asarray(speed, dtype=float), np.asarray(radius, dtype=float)
        return _plain(self._over(U) / R)

    def yaw_rate_gain(self, speed: Any) -> Any:
        """Return yaw rate per steer angle [(rad/s)/rad] at speeds [m/s], shape ``(..., *speed.shape)``."""
        U = np.asarray(speed, dtype=float)
        with np.errstate(divide="ignore"):
            return _plain(U / self._over(U))

    def acceleration_gain(self, speed: Any) -> Any:
        """Return lateral acceleration per steer angle [(m/s^2)/rad] at speeds [m/s]."""
        U = np.asarray(speed, dtype=float)
        with np.errstate(divide="ignore"):
            return _plain(U**2 / self._over(U))

    def curvature_gain(self, speed: Any) -> Any:
        """Return path curvature per steer angle [(1/m)/rad] at speeds [m/s]."""
        with np.errstate(divide="ignore"):
            return _plain(1 / self._over(np.asarray(speed, dtype=float)))

    @property
    def largest_yaw_rate_gain(self) -> Any:
        """Largest yaw-rate gain [1/s], at the characteristic speed of an understeering car; nan for others."""
        return _plain(np.asarray(self.characteristic_speed) / (2 * self._values[0]))

    def _over(self, U: Array) -> Array:
        """L + K U^2, the speeds along trailing axes."""
        L, K = (v.reshape(v.shape + (1,) * U.ndim) for v in self._values)
        return np.asarray(L + K * U**2)

    def __str__(self) -> str:
        name = self.vehicle.info.name or type(self.vehicle).model_id()
        if self.vehicle.dims:
            return f"{name}: steady turns for arrays of {', '.join(self.vehicle.dims)}"
        head = f"{name}: {self.handling}"
        gradient = f"{self.gradient:.5g} rad/(m/s^2) = {self.gradient_per_g:.5g} rad/g"
        gradient += f" = {self.gradient_deg_per_g:.4g} deg/g"
        lines = [head, f"    understeer gradient K = {gradient}", f"    K = {self.gradient_formula}"]
        if self.handling == "understeer":
            lines.append(f"    characteristic speed {self.characteristic_speed:.5g} m/s, where the yaw-rate gain is")
            lines.append(f"    largest: {self.largest_yaw_rate_gain:.4g} (rad/s)/rad")
        if self.handling == "oversteer":
            lines.append(f"    critical speed {self.critical_speed:.5g} m/s, where the gains are infinite")
        return "\n".join(lines)


def steady_turn(vehicle: Model, steer: str = "delta_f") -> SteadyTurn:
    """Analyse the steady turns of a car.

    Parameters
    ----------
    vehicle
        Any model with a speed, a yaw rate ``r`` [rad/s] among its states and the steer angle among its
        inputs.
    steer
        The input [rad] that steers.

    Returns
    -------
    SteadyTurn
        Valid while tires stay in their linear range.

    Raises
    ------
    UcritError
        If the model lacks what is needed, or its steady steer angle is no ``L/R + K U**2/R``.

    Examples
    --------
    >>> from ucrit import load
    >>> turn = steady_turn(load("understeering-car"))
    >>> turn.gradient_formula
    'm*(C_r*b - C_f*a)/(C_f*C_r*(a + b))'
    >>> round(turn.characteristic_speed, 2)
    28.72
    """
    cls = type(vehicle)
    declared = cls.declaration
    missing = [
        text
        for lacks, text in (
            (declared.speed is None, "a speed"),
            (
                declared.variables.get("r") is None or declared.variables["r"].unit != "rad/s",
                "a yaw rate r [rad/s]",
            ),
            (
                declared.inputs.get(steer) is None or declared.inputs[steer].unit != "rad",
                f"a steer angle {steer} [rad]",
            ),
        )
        if lacks
    ]
    if missing or declared.speed is None:
        raise UcritError(
            f"{cls.model_id()}: a steady turn needs {' and '.join(missing)}, which the model does not have"
        )
    facts = cached(cls, f"steady-{steer}", lambda: _derive(cls, steer))
    return SteadyTurn(vehicle, steer, declared.speed, **{**facts, "parameters": tuple(facts["parameters"])})


def _derive(cls: type[Model], steer: str) -> dict[str, Any]:
    """Write U delta/r as L + K U^2."""
    from ...core.derivation.cramer import cramer
    from ...core.derivation.derive import symbolic
    from ...core.formulas import typeset
    from ...core.formulas.codegen import generate
    from ...core.formulas.factor import readable_ratio

    system = symbolic(cls, 1)
    found = cramer(system, steer, "r")
    above, below = found.in_s(found.numerator)[0], found.in_s(found.denominator)[0]
    ring = above.ring
    names = [symbol.name for symbol in ring.symbols]
    if cls.declaration.speed not in names or not above:
        raise UcritError(f"{cls.model_id()}: {steer} does not turn the car steadily")
    at = names.index(cls.declaration.speed)
    below = below * ring.gens[at]
    common = above.gcd(below)
    above, below = above.exquo(common), below.exquo(common)
    if above.LC < 0:
        above, below = -above, -below
    parts: dict[int, dict[Any, Any]] = {0: {}, 2: {}}
    for monom, c in below.terms():
        parts.setdefault(monom[at], {})[(*monom[:at], 0, *monom[at + 1 :])] = c
    if any(m[at] for m in above.itermonoms()) or set(parts) != {0, 2}:
        raise UcritError(f"{cls.model_id()}: the steer angle of a steady turn is not of the form L/R + K U**2/R")
    ratios = (readable_ratio(ring.from_dict(parts[k]), above).xreplace(dict(found.functions)) for k in (0, 2))
    L, K = map(sign_inside, ratios)
    symbols = list(system.traced.parameters.values())
    return {
        "wheelbase_formula": typeset.text(L),
        "gradient_formula": typeset.text(K),
        "gradient_latex": typeset.latex(K),
        "source": generate("steady", [symbols], [L, K]),
        "parameters": [s.name for s in symbols],
    }


def sign_inside(product: Any) -> Any:
    """Write ``-m*(x - y)`` as ``m*(y - x)``, and no sum with minus signs only."""
    if not product.is_Mul:
        return product
    parts, sign = [], 1
    for part in product.args:
        base, exponent = part.as_base_exp()
        if base.is_Add and exponent.is_odd and all(t.could_extract_minus_sign() for t in base.args):
            part, sign = (-base) ** exponent, -sign
        parts.append(part)
    whole = sign * type(product)(*parts)
    sums = [p for p in parts if p.is_Add and any(t.could_extract_minus_sign() for t in p.args)]
    if sums and whole.could_extract_minus_sign():
        return sign * type(product)(*(-p if p == sums[0] else p for p in parts)) * -1
    return whole


def axle_loads(vehicle: Model) -> tuple[Any, Any]:
    """Return the static loads [N] of front and rear axle, of which side forces in a steady turn are shares.

    The vehicle needs the parameters ``m`` [kg], ``a`` [m] and ``b`` [m]; `UcritError` tells which are missing.

    Examples
    --------
    >>> from ucrit import load
    >>> [round(force) for force in axle_loads(load("understeering-car"))]
    [8024, 6686]
    """
    cls = type(vehicle)
    for name, unit in (("m", "kg"), ("a", "m"), ("b", "m")):
        parameter = cls.declaration.parameters.get(name)
        if parameter is None or parameter.unit != unit:
            raise UcritError(f"{cls.model_id()}: axle loads need a parameter {name} [{unit}]")
    arguments = dict(zip(vehicle.values, vehicle.arguments(), strict=True))
    m, a, b = (np.asarray(arguments[name], dtype=float) for name in ("m", "a", "b"))
    return _plain(m * GRAVITY * b / (a + b)), _plain(m * GRAVITY * a / (a + b))


def _plain(value: Any) -> Any:
    array = np.asarray(value)
    return array if array.ndim else float(array)
