"""Static stability in pitch: static margin, neutral point, and the line of moment against lift.

An airplane is statically stable if its nose drops as its lift grows, ``dC_M/dC_L < 0`` about the centre of mass,
and it can be trimmed if the moment vanishes at a positive lift (Karnopp 2004, section 9.III).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ...core.errors import UcritError, near_match
from ...core.html import Rich
from ...core.numeric.cache import cached
from ...core.numeric.compiled import labels, state_space
from ...core.numeric.motion import motion
from ..results.convert import Series, Table, Tabular

Array = npt.NDArray[Any]

PAIRS = {("C_L", "C_M"): ("1", "1"), ("L", "M"): ("N", "N m")}
"""Outputs that hold lift and moment about the centre of mass, and their units."""

DOWNWARD = ("w", "W")
"""Names of a downward velocity [m/s]."""


MOST_POINTS = 1_000_000
"""Points that a moment line may have."""


@dataclass(frozen=True)
class StaticMargin(Rich):
    """How an airplane's moment answers a change of lift; array parameters make arrays.

    Attributes
    ----------
    margin
        ``-dC_M/dC_L``, positive if stable: how far the centre of mass may move back, in chords, or in m where the
        model has forces instead of coefficients.
    unit
        ``"1"`` or ``"m"``.
    formula
        The same in symbols.
    """

    vehicle: Model
    margin: Any
    unit: str
    formula: str

    @property
    def stable(self) -> Any:
        """Whether the nose drops as the lift grows."""
        found = np.asarray(self.margin) > 0
        return found if found.ndim else bool(found)

    @property
    def neutral_point(self) -> Any:
        """Place of the centre of mass for which the margin vanishes, from where the parameter ``h`` counts, in chords.

        Where a model has no such parameter, its distance behind the centre of mass.
        """
        declared = type(self.vehicle).declaration.parameters.get("h")
        if declared is None or declared.unit != "1" or self.unit != "1":
            return self.margin
        arguments = dict(zip(self.vehicle.values, self.vehicle.arguments(), strict=True))
        return arguments["h"] + self.margin

    def __str__(self) -> str:
        name = self.vehicle.info.name or type(self.vehicle).model_id()
        of = " m" if self.unit == "m" else " chords"
        if self.vehicle.dims:
            least, most = np.min(self.margin), np.max(self.margin)
            return f"{name}: static margin {least:.4g} to {most:.4g}{of} for arrays of {', '.join(self.vehicle.dims)}"
        word = "stable" if self.stable else "unstable"
        head = f"{name}: statically {word} in pitch, static margin {self.margin:.4g}{of}"
        return f"{head}\n    margin = {self.formula}\n    neutral point {self.neutral_point:.4g}{of}"


@dataclass(frozen=True)
class MomentLine(Tabular):
    """Moment against lift at one setting of the controls for each row.

    Attributes
    ----------
    input
        The input that differs from row to row; empty if there is one row.
    settings
        Its values [SI], shape (k,); none if there is no such input.
    lift, moment
        Coefficients, or N and N m, shape (k, n).
    """

    vehicle: Model
    input: str
    settings: Array
    lift: Array
    moment: Array

    @property
    def trimmed(self) -> Array:
        """Lift at which the moment vanishes, shape (k,); nan where it does not on this line."""
        change = np.sign(self.moment[:, :-1]) != np.sign(self.moment[:, 1:])
        first = np.argmax(change, axis=1)
        rows = np.arange(len(first))
        M_0, M_1 = self.moment[rows, first], self.moment[rows, first + 1]
        L_0, L_1 = self.lift[rows, first], self.lift[rows, first + 1]
        with np.errstate(all="ignore"):
            zero = L_0 - M_0 * (L_1 - L_0) / (M_1 - M_0)
        return np.where(change.any(axis=1), zero, np.nan)

    @property
    def slope(self) -> Array:
        """Change of moment per change of lift from end to end, shape (k,): negative if statically stable."""
        return np.asarray((self.moment[:, -1] - self.moment[:, 0]) / (self.lift[:, -1] - self.lift[:, 0]))

    def table(self) -> Table:
        """Return lift and moment of every line, by setting and point."""
        declared = type(self.vehicle).declaration
        (lift, moment), _ = _needed(type(self.vehicle))
        rows = (self.input or "line", "point")
        settings = self.settings if self.input else np.arange(1, len(self.lift) + 1)
        coords = (
            Series(rows[0], rows[:1], settings, declared.inputs[self.input].unit if self.input else "1"),
            Series("point", rows[1:], np.arange(1, self.lift.shape[1] + 1), "1"),
        )
        data = (
            Series(lift, rows, self.lift, declared.outputs[lift].unit),
            Series(moment, rows, self.moment, declared.outputs[moment].unit),
        )
        return Table("moment against lift", self.vehicle, coords, data, rows)


def static_margin(vehicle: Model) -> StaticMargin:
    """Return the static margin of an airplane.

    Parameters
    ----------
    vehicle
        Any model with a downward velocity ``w`` or ``W`` [m/s] and the outputs ``C_L`` and ``C_M``, or lift ``L`` [N]
        and moment ``M`` [N m].

    Raises
    ------
    UcritError
        If the model lacks what is needed.

    Examples
    --------
    >>> from ucrit import load, static_margin
    >>> print(static_margin(load("model-glider")))
    Chuck glider of balsa wood: statically stable in pitch, static margin 0.009279 m
        margin = l*(S_t*a_t*m_w - S*a*m_t)/((m_t + m_w)*(S*a + S_t*a_t))
        neutral point 0.009279 m
    """
    cls = type(vehicle)
    (lift, moment), downward = _needed(cls)
    names = list(cls.declaration.outputs)
    C, column = state_space(vehicle).C, labels(vehicle).index(downward)
    slope = C[..., names.index(moment), column] / C[..., names.index(lift), column]
    formula = cached(cls, f"margin-{lift}-{moment}", lambda: _derive(cls, lift, moment, downward))
    margin = -slope if slope.ndim else -float(slope)
    return StaticMargin(vehicle, margin, "m" if lift == "L" else "1", formula)


def moment_line(
    vehicle: Model,
    input: str = "",
    settings: Sequence[float] | Array | None = None,
    angles: tuple[float, float] = (-0.1, 0.2),
    points: int = 61,
) -> MomentLine:
    """Return the moment about the centre of mass against the lift, as the angle of attack changes.

    Parameters
    ----------
    vehicle
        As for `static_margin`, with scalar parameters.
    input
        Name of an input to be set, such as the elevator's angle.
    settings
        Its values [SI], one line each; without them there is one line for the controls of the basic motion.
    angles
        Least and largest change of the angle of attack from the basic motion [rad].
    points
        Number of points of each line.

    Examples
    --------
    >>> from ucrit import load, moment_line, trim
    >>> plane = load("navion-from-geometry")
    >>> level = trim(plane)
    >>> line = moment_line(plane, "delta_e", [level["delta_e"] - 0.02, level["delta_e"]])
    >>> bool(abs(line.trimmed[1] - level["C_L"]) < 1e-12), bool(line.trimmed[0] > level["C_L"])
    (True, True)
    """
    cls = type(vehicle)
    (lift, moment), downward = _needed(cls)
    if vehicle.dims:
        raise UcritError(f"{cls.model_id()}: a moment line is of one vehicle, got arrays for {', '.join(vehicle.dims)}")
    inputs, outputs = list(cls.declaration.inputs), list(cls.declaration.outputs)
    if input and input not in inputs:
        raise UcritError(f"{cls.model_id()}: there is no input '{input}'{near_match(input, inputs)}")
    if bool(input) != (settings is not None):
        raise UcritError(f"{cls.model_id()}: give the name of an input together with its settings")
    if not 2 <= points <= MOST_POINTS:
        raise UcritError(f"points must be a whole number from 2 to {MOST_POINTS}, got {points}")
    moving, arguments = motion(cls), vehicle.arguments()
    values = np.atleast_1d(np.asarray(settings if input else 0.0, dtype=float))
    w, u = (np.repeat(v[:, None], points, axis=1)[:, None].repeat(len(values), 1) for v in moving.basic(arguments))
    ahead = _speed(vehicle)
    w[moving.labels.index(downward)] += ahead * np.tan(np.linspace(*angles, points))
    if input:
        u[inputs.index(input)] = values[:, None]
    y = moving.outputs(w, u, arguments)
    return MomentLine(vehicle, input, values if input else values[:0], y[outputs.index(lift)], y[outputs.index(moment)])


def _speed(vehicle: Model) -> float:
    name = type(vehicle).declaration.speed
    if name is None:
        raise UcritError(f"{type(vehicle).model_id()}: a moment line needs a speed, which the model does not have")
    return float(vehicle.values[name])


def _needed(cls: type[Model]) -> tuple[tuple[str, str], str]:
    """Return the names of the outputs and of the downward velocity."""
    outputs, variables = cls.declaration.outputs, cls.declaration.variables
    pairs = (
        pair
        for pair, units in PAIRS.items()
        if all(name in outputs and outputs[name].unit == unit for name, unit in zip(pair, units, strict=True))
    )
    pair = next(pairs, None)
    downward = next((n for n in DOWNWARD if n in variables and variables[n].unit == "m/s"), None)
    if pair is None or downward is None:
        raise UcritError(
            f"{cls.model_id()}: static stability in pitch needs a downward velocity w [m/s] and the outputs "
            "C_L and C_M [1], or L [N] and M [N m]"
        )
    return pair, downward


def _derive(cls: type[Model], lift: str, moment: str, downward: str) -> str:
    """Write the margin in the parameters."""
    from sympy import ZZ, Dummy
    from sympy.polys.rings import PolyRing

    from ...core.derivation.derive import symbolic
    from ...core.derivation.rings import integer_fraction, polynomial_field
    from ...core.formulas import typeset
    from ...core.formulas.factor import readable_ratio
    from ..linear.steady import sign_inside

    system = symbolic(cls)
    names, column = list(cls.declaration.outputs), list(cls.declaration.variables).index(downward)
    slopes = [system.C[0][names.index(name), column] for name in (lift, moment)]
    domain, (per_lift, per_moment), functions = polynomial_field(slopes, system.bounds)
    ring = PolyRing((*domain.symbols, Dummy("s")), ZZ, "lex")
    top, bottom = integer_fraction(-per_moment / per_lift, domain, ring)
    return typeset.text(sign_inside(readable_ratio(top, bottom).xreplace(functions)))
