"""Static stability: does a vehicle that is held at an angle start to turn back when it is let go?

A static analysis looks at one moment only. It leaves out the velocities that the motion brings about, so
that a car that is statically unstable (oversteering) runs stably below its critical speed (Karnopp 2004,
section 9.V).
"""

from __future__ import annotations

from dataclasses import dataclass

from ...core.contract.model import Model
from ...core.errors import UcritError, near_match
from ...core.html import Rich
from ...core.numeric.cache import cached
from ...core.numeric.compiled import direction, labels, state_space
from .critical import critical
from .verdict import verdict

LONGEST = 600
"""Operations in the equations up to which the answer is derived in symbols."""


@dataclass(frozen=True)
class StaticStability(Rich):
    """What a vehicle does from rest in a displaced position.

    Attributes
    ----------
    displaced
        The variable that is displaced, all others held at zero.
    answer
        The rate that starts to change: ``r'``.
    slope
        Its value per displacement [SI].
    formula
        The same in symbols, empty where the answer comes through another variable.
    stable
        Whether the answer takes the displacement back.
    dynamic
        Whether the motion as a whole is stable at the present speed.
    critical_speeds
        Speeds [m/s] at which that changes.
    """

    vehicle: Model
    displaced: str
    answer: str
    slope: float
    formula: str
    stable: bool
    dynamic: bool
    critical_speeds: tuple[float, ...]

    @property
    def decides(self) -> bool:
        """Whether the static answer is the dynamic one at every speed of the present sign."""
        return self.stable == self.dynamic and not self.critical_speeds

    def __str__(self) -> str:
        name = self.vehicle.info.name or type(self.vehicle).model_id()
        word = "stable" if self.stable else "unstable"
        formula = f" = {self.formula}" if self.formula else ""
        lines = [
            f"{name}: statically {word}",
            f"    let go at {self.displaced}: {self.answer}/{self.displaced}{formula} = {self.slope:.5g}",
            f"    dynamically {'stable' if self.dynamic else 'unstable'} at the present parameters",
        ]
        if self.critical_speeds:
            lines.append("    which changes at " + ", ".join(f"{U:.5g} m/s" for U in self.critical_speeds))
        if not self.decides:
            lines.append("    the static answer does not decide: it leaves out the velocities that follow")
        return "\n".join(lines)


def static_stability(vehicle: Model, displaced: str | None = None) -> StaticStability:
    """Judge static stability and compare it with the dynamic one.

    Parameters
    ----------
    vehicle
        With scalar parameters: a model in body-fixed axes with a lateral velocity V [m/s] and a yaw rate r
        [rad/s], or one with an angle among its variables.
    displaced
        ``"V"`` (a sideslip) or the name of an angle; by default V, else the first angle.

    Raises
    ------
    UcritError
        If the model has neither, or parameters are arrays.

    Examples
    --------
    >>> from ucrit import load
    >>> car = static_stability(load("oversteering-car"))
    >>> car.formula, car.stable, car.dynamic
    ('(C_r*b - C_f*a)/(I_z*U)', False, True)
    """
    cls = type(vehicle)
    declared = cls.declaration
    if vehicle.dims:
        raise UcritError("static stability is that of one vehicle: give scalar parameters")
    turns = {"V": "m/s", "r": "rad/s"}
    body_fixed = all(n in declared.variables and declared.variables[n].unit == u for n, u in turns.items())
    angles = [name for name, v in declared.variables.items() if v.unit == "rad"]
    choices = (["V"] if body_fixed else []) + angles
    if not choices:
        raise UcritError(f"{cls.model_id()}: static stability needs the variables V [m/s] and r [rad/s], or an angle")
    name = displaced or choices[0]
    if name not in choices:
        raise UcritError(f"{cls.model_id()}: '{name}' cannot be displaced{near_match(name, choices)}")
    turning = "r" if name == "V" else name
    answer, slope, direct = _answer(vehicle, name, turning)
    sense = direction(vehicle)
    formula = cached(cls, f"static{sense:+d}-{name}", lambda: _derive(cls, sense, name, turning)) if direct else ""
    stable = slope > 0 if name == "V" else slope < 0
    speeds = tuple(c.value for c in critical(vehicle)) if declared.speed else ()
    return StaticStability(vehicle, name, answer, slope, formula, stable, verdict(vehicle).stable, speeds)


def _answer(vehicle: Model, name: str, turning: str) -> tuple[str, float, bool]:
    """Return what answers, its slope, and whether it is the turning variable's own highest derivative."""
    states, A = list(labels(vehicle)), state_space(vehicle).A
    if name not in states:
        raise UcritError(
            f"{type(vehicle).model_id()}: {name} is tied to the other variables and cannot be displaced alone"
        )
    column = states.index(name)
    chain = [i for i, label in enumerate(states) if label.rstrip("'") == turning]
    slope = float(A[chain[-1], column])
    label = states[chain[-1]] + "'"
    if slope == 0 and len(chain) == 1:
        return f"{label}'", float((A @ A)[chain[-1], column]), False
    return label, slope, True


def _derive(cls: type[Model], direction: int, name: str, turning: str) -> str:
    """Solve the explicit equations for one highest derivative per unit of one state; empty if too long to be read."""
    from sympy import ZZ, Dummy, count_ops
    from sympy.polys.matrices import DomainMatrix
    from sympy.polys.rings import PolyRing

    from ...core.derivation.derive import symbolic
    from ...core.derivation.rings import integer_fraction, polynomial_field
    from ...core.formulas import typeset
    from ...core.formulas.factor import readable_ratio
    from ..linear.steady import sign_inside

    system = symbolic(cls, direction)
    e = system.explicit
    if sum(count_ops(entry) for entry in (*e.L, *e.R)) > LONGEST:
        return ""
    variables = [chain[0].name for chain in system.traced.q]
    below = [v + "'" * k for v, order in zip(variables, e.orders, strict=True) for k in range(order)]
    n, column = e.L.rows, e.R[:, below.index(name)]
    domain, elements, functions = polynomial_field([*e.L, *column], system.bounds)
    L = DomainMatrix([elements[i * n : (i + 1) * n] for i in range(n)], (n, n), domain)
    rhs = DomainMatrix([[c] for c in elements[n * n :]], (n, 1), domain)
    found = L.lu_solve(rhs).to_list()[variables.index(turning)][0]
    ring = PolyRing((*domain.symbols, Dummy("s")), ZZ, "lex")
    top, bottom = integer_fraction(found, domain, ring)
    return typeset.text(sign_inside(readable_ratio(top, bottom).xreplace(functions)))
