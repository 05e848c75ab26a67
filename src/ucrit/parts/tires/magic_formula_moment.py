"""Aligning moment of the magic formula: equations (4.E31) to (4.E49) and (4.E71) to (4.E78) of Pacejka (2012).

A trail on which the side force acts, a residual moment, and an arm on which the longitudinal force acts; the switches
are those of `ucrit.parts.tires.magic_formula`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from ...core.formulas.functions import atan, cos, minimum, sign, sqrt, tan, where
from .coefficients import curve
from .slip import is_zero

if TYPE_CHECKING:
    from .magic_formula import MagicFormula


@dataclass(frozen=True)
class Slip:
    """What all terms share: coefficients c, load F, nominal load N, excess d, slips a and k, camber g, pressure p."""

    c: Any
    F: Any
    N: Any
    d: Any
    a: Any
    k: Any
    g: Any
    p: Any


def aligning_moment(law: MagicFormula, s: Slip, alpha: Any, F_x: Any, F_y: Any, induced: Any) -> Any:
    """Return the moment [N m] for a slip angle [rad], both forces [N], and the side force that kappa induced [N]."""
    c, lean, straight = s.c, s.c.LGAZ * s.g, cos(alpha)
    slips = _slips(law, s, lean)
    trail_slip, rest_slip = _mixed(law, s, slips)
    trail = _trail(law, s, lean, slips[0], trail_slip) * straight
    rest = _rest(law, s, lean, rest_slip) * straight ** law.constants.get("COSINES", 1)
    arm = c.SSZ1 + c.SSZ2 * F_y / _nominal(law, s) + (c.SSZ3 + c.SSZ4 * s.d) * s.g
    return rest - trail * _at_trail(law, s, F_y - induced) + arm * law.UNLOADED_RADIUS * c.LS * F_x


def _nominal(law: MagicFormula, s: Slip) -> Any:
    return s.N if law.has("ARMS", "scaled") else law.FNOMIN


def _at_trail(law: MagicFormula, s: Slip, leaning: Any) -> Any:
    """Return the side force that acts at the pneumatic trail [N] (4.E74)."""
    if is_zero(s.g) or law.has("FORMULAS", "5.2") or law.has("TRAIL", "leaning"):
        return leaning
    upright = replace(s, g=0)
    return law.across(upright) * law.across_weight(s if law.has("TRAIL", "mixed") else upright)


def _slips(law: MagicFormula, s: Slip, lean: Any) -> tuple[Any, Any]:
    """Return the slips that trail and residual moment of a wheel that rolls freely go by (4.E34, 4.E37)."""
    c = s.c
    shifted = s if law.has("REST", "leaning") else replace(s, g=0)
    shift, lift = law.across_shifts(shifted)
    trail = s.a + c.QHZ1 + c.QHZ2 * s.d + (c.QHZ3 + c.QHZ4 * s.d) * lean
    return trail, s.a + shift + lift / law.across_stiffness(shifted)


def _mixed(law: MagicFormula, s: Slip, slips: tuple[Any, Any]) -> tuple[Any, Any]:
    """Return the slips with that of braking or driving mixed in."""
    if is_zero(s.k):
        return slips
    braked = (law.along_stiffness(s) / law.across_stiffness(s) * s.k) ** 2
    before, after = (tan, atan) if law.has("BRAKED", "angle") else (lambda x: x, lambda x: x)
    trail, rest = (after(where(braked > 0, sqrt(before(x) ** 2 + braked) * sign(x), before(x))) for x in slips)
    return trail, rest


def _trail(law: MagicFormula, s: Slip, lean: Any, free: Any, slip: Any) -> Any:
    """Return the pneumatic trail [m] but for the cosine of the slip angle (4.E33); ``free`` is the slip unbraked."""
    c, tilt = s.c, 0 if is_zero(lean) else abs(lean)
    B = (c.QBZ1 + c.QBZ2 * s.d + c.QBZ3 * s.d**2) * (1 + c.QBZ4 * lean + c.QBZ5 * tilt + c.QBZ6 * lean**2)
    B = B * law.LKY / law.LMUY
    growth = 1 + c.QDZ3 * (tilt if law.has("GROWTH", "absolute") else lean) + c.QDZ4 * lean**2
    D = s.F * law.UNLOADED_RADIUS / _nominal(law, s) * (c.QDZ1 + c.QDZ2 * s.d) * (1 - c.PPZ1 * s.p) * growth * law.LTR
    E = c.QEZ1 + c.QEZ2 * s.d + c.QEZ3 * s.d**2
    skew = c.QEZ4 + c.QEZ5 * lean
    if not is_zero(skew):
        E = E * (1 + skew * 2 / pi(free) * atan(B * c.QCZ1 * free))
    return D * cos(curve(B * slip, c.QCZ1, minimum(E, 1)))


def _rest(law: MagicFormula, s: Slip, lean: Any, slip: Any) -> Any:
    """Return the residual moment [N m] but for the cosine of the slip angle (4.E36, 4.E47)."""
    c, tilt = s.c, 0 if is_zero(lean) else abs(lean)
    upright = (c.QDZ6 + c.QDZ7 * s.d) * c.LRES
    leaning = (c.QDZ8 + c.QDZ9 * s.d) * (1 + c.PPZ2 * s.p) + (c.QDZ10 + c.QDZ11 * s.d) * tilt
    D = s.F * law.UNLOADED_RADIUS * (upright + leaning * lean * c.LKZC) * law.LMUY
    B = c.QBZ9 * law.LKY / law.LMUY
    if c.QBZ10:
        B = B + c.QBZ10 * law.across_stiffness(s) / (law.friction_across(s) * s.F)
    return D * cos(atan(B * slip))


def pi(slip: Any) -> Any:
    """Return pi, exactly among symbols."""
    if hasattr(slip, "free_symbols"):
        import sympy

        return sympy.pi
    return math.pi
