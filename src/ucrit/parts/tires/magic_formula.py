"""Magic formula of property files: MF 5.2 (PAC2002) and 6.1. Signs as for all tires; SI units and radians.

Coefficients are constants, by their names in ``.tir`` files; see `ucrit.parts.tires.tir`. What published programs
disagree on is a switch, a constant too, whose first value here is that of the book (H. B. Pacejka, Tire and Vehicle
Dynamics, 3rd edition, 2012, section 4.3); a file of version 5.2 has "angle" for CAMBER and "signed" for GROWTH:

========= ===================== ====================================================================================
FORMULAS  "6.1", "5.2"          which edition: camber in side force and moment differ
SLIP      "tangent", "angle"    alpha enters as its tangent or as itself
CAMBER    "sine", "angle"       gamma enters as its sine or as itself
LEAN      "factor", "quotient"  camber's PKY3 and PDY3: 1 - PKY3 abs(gamma) and 1 - PDY3 gamma^2, or, as in the
                                edition of 2006, one over 1 + PKY3 gamma^2 and 1 + PDY3 gamma^2
TRAIL     "upright", "leaning", at the pneumatic trail acts the side force of the upright wheel; of the wheel as it
          "mixed"               leans (5.2, and the edition of 2006); or the upright one's, weighted as it leans
GROWTH    "absolute", "signed"  QDZ3 lets the trail grow with the size of the camber or with the camber
REST      "leaning", "upright"  shift of the residual moment's slip as the wheel leans or as if it were upright
COSINES   1, 2                  power of cos alpha in the residual moment
BRAKED    "root", "angle"       slips in the moment under braking: the root of the sum of squares (4.E77, 4.E78), or
                                the angle whose tangent is the root of the sum of squared tangents (PAC2002)
ARMS      "scaled", "plain"     the moment's arms refer to the nominal load times LFZO or without it
MOMENT    1, -1                 sign of M_z
SIDE      1, -1                 as measured, or its mirror image: the tire on the vehicle's other side
SYMMETRIC "no", "yes"           with the shifts of one tire, or without: the mean of a tire and its mirror image
========= ===================== ====================================================================================

Turn slip is taken as zero, and cos alpha as it is: programs that guard it against standstill, by 0.1 m/s in its
denominator, have moments that are 0.6 % smaller at 16.7 m/s. The parameters FNOMIN and UNLOADED_RADIUS and the scale
factors begin with the file's values; further scale factors (LCX, LEX ...) are constants.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType
from typing import Any, ClassVar

from ...core.contract.declare import param
from ...core.errors import UcritError
from ...core.formulas.functions import atan, cos, exp, grouped, maximum, minimum, sign, sin, tan
from .coefficients import Coefficients, check_switches, curve
from .magic_formula_moment import Slip, aligning_moment
from .slip import is_zero
from .tire import Forces, Tire

SHIFTS = (
    *("PHX1", "PHX2", "PVX1", "PVX2", "RHX1", "PHY1", "PHY2", "PVY1", "PVY2", "PEY3", "RBY3", "RHY1", "RHY2"),
    *("RVY1", "RVY2", "QHZ1", "QHZ2", "QDZ6", "QDZ7", "QBZ4", "QEZ4", "SSZ1"),
)
"""Coefficients that make an upright tire pull to one side or drive by itself: left out where it is symmetric."""

FACTORS = (
    *("LCX", "LEX", "LHX", "LVX", "LGAX", "LCY", "LEY", "LHY", "LVY", "LGAY", "LKYC", "LRES", "LGAZ", "LKZC"),
    *("LXAL", "LYKA", "LVYKA", "LS", "LSGKP", "LSGAL"),
)
NEUTRAL = MappingProxyType({**dict.fromkeys(FACTORS, 1), "PKY4": 2})


class MagicFormula(Tire):
    """Magic formula of property files, for pure and combined slip with aligning moment (Pacejka 2012, section 4.3)."""

    friction = ("LMUX", "LMUY")
    switches: ClassVar[Mapping[str, tuple[Any, ...]]] = {
        "FORMULAS": ("6.1", "5.2"),
        "SLIP": ("tangent", "angle"),
        "CAMBER": ("sine", "angle"),
        "LEAN": ("factor", "quotient"),
        "TRAIL": ("upright", "leaning", "mixed"),
        "GROWTH": ("absolute", "signed"),
        "REST": ("leaning", "upright"),
        "COSINES": (1, 2),
        "BRAKED": ("root", "angle"),
        "ARMS": ("scaled", "plain"),
        "MOMENT": (1, -1),
        "SIDE": (1, -1),
        "SYMMETRIC": ("no", "yes"),
    }

    FNOMIN: float = param("N", "nominal load", above=0)
    UNLOADED_RADIUS: float = param("m", "radius of the unloaded tire", above=0)
    LFZO: float = param("1", "scale factor of the nominal load", above=0, default=1.0)
    LMUX: float = param("1", "scale factor of friction along the wheel", above=0, default=1.0)
    LMUY: float = param("1", "scale factor of friction across the wheel", above=0, default=1.0)
    LKX: float = param("1", "scale factor of the stiffness along the wheel", above=0, default=1.0)
    LKY: float = param("1", "scale factor of the cornering coefficient", above=0, default=1.0)
    LTR: float = param("1", "scale factor of the pneumatic trail", above=0, default=1.0)

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        check_switches(cls, cls.switches)
        given = {name: cls.constants.get(name, p.default) for name, p in cls.parameters.items()}
        cls.parameters = MappingProxyType({n: replace(p, default=given[n]) for n, p in cls.parameters.items()})

    @classmethod
    def part_id(cls) -> str:
        """Name of the law: that of its file, where it has one."""
        return str(cls.constants.get("FILE", "magic-formula"))

    def has(self, switch: str, value: Any) -> bool:
        """Return whether a switch has this value."""
        return bool(self.constants.get(switch, self.switches[switch][0]) == value)

    def _slip(self, F_z: Any, alpha: Any, kappa: Any = 0, gamma: Any = 0) -> Slip:
        if "PCY1" not in self.constants:
            raise UcritError("magic-formula: the law needs coefficients: read a .tir file, or MagicFormula.of({...})")
        odd = SHIFTS if self.has("GROWTH", "absolute") else (*SHIFTS, "QDZ3")
        c = Coefficients(self, NEUTRAL, odd if self.has("SYMMETRIC", "yes") else ())
        N = self.LFZO * self.FNOMIN
        a = tan(alpha) if self.has("SLIP", "tangent") else alpha
        g = gamma if is_zero(gamma) or self.has("CAMBER", "angle") else sin(gamma)
        pressure = (c.INFLPRES - c.NOMPRES) / c.NOMPRES if c.NOMPRES and c.INFLPRES else 0
        return Slip(c, F_z, N, grouped((F_z - N) / N), a, kappa, g, pressure)

    def forces(self, F_z: Any, alpha: Any, kappa: Any = 0, gamma: Any = 0) -> Forces:
        """Return the forces on the wheel."""
        side = self.constants.get("SIDE", 1)
        s = self._slip(F_z, side * alpha, kappa, side * gamma)
        F_x, F_y, induced = self.along(s), self.across(s), self.induced(s)
        F_x, F_y = F_x * self.along_weight(s), F_y * self.across_weight(s) + induced
        M_z = aligning_moment(self, s, alpha, F_x, F_y, induced)
        return Forces(F_x, side * F_y, side * self.constants.get("MOMENT", 1) * M_z)

    def side_force(self, F_z: Any, alpha: Any) -> Any:
        """Return the side force [N] of an upright wheel that rolls freely."""
        side = self.constants.get("SIDE", 1)
        return side * self.across(self._slip(F_z, side * alpha))

    def cornering_coefficient(self, F_z: Any) -> Any:
        """Return the cornering coefficient [N/rad] of the upright wheel without shifts."""
        return -self.across_stiffness(self._slip(F_z, 0))

    def slip_stiffness(self, F_z: Any) -> Any:
        """Return the longitudinal force per slip [N] without shifts."""
        return self.along_stiffness(self._slip(F_z, 0))

    def relaxation_length(self, F_z: Any, k_y: Any = None) -> Any:
        """Return the relaxation length [m] of the side force.

        By the file's coefficients PTY1 and PTY2; else, and where k_y [N/m] is given, the cornering coefficient over
        the stiffness of the sidewall, k_y or the file's LATERAL_STIFFNESS.
        """
        s = self._slip(F_z, 0)
        c = s.c
        if k_y is None and c.PTY1:
            return c.PTY1 * _twice(F_z / (c.PTY2 * s.N)) * self.UNLOADED_RADIUS * self.LFZO * c.LSGAL
        if k_y is None and not c.LATERAL_STIFFNESS:
            raise UcritError(
                f"{self.part_id()}: it has no PTY1 and no LATERAL_STIFFNESS; give the sidewall's stiffness"
            )
        return super().relaxation_length(F_z, k_y or c.LATERAL_STIFFNESS)

    def longitudinal_relaxation_length(self, F_z: Any, k_x: Any = None) -> Any:
        """Return the relaxation length [m] of the longitudinal force, by PTX1 to PTX3 or by a stiffness k_x [N/m]."""
        s = self._slip(F_z, 0)
        c = s.c
        if k_x is None and c.PTX1:
            spread = (c.PTX1 + c.PTX2 * s.d) * exp(c.PTX3 * s.d)
            return F_z * spread * self.UNLOADED_RADIUS / s.N * c.LSGKP
        if k_x is None and not c.LONGITUDINAL_STIFFNESS:
            raise UcritError(f"{self.part_id()}: it has no PTX1 and no LONGITUDINAL_STIFFNESS; give a stiffness")
        return self.slip_stiffness(F_z) / (k_x or c.LONGITUDINAL_STIFFNESS)

    # Pure slip (equations 4.E9 to 4.E30)

    def along_stiffness(self, s: Slip) -> Any:
        """Return the slope of the longitudinal force at no slip [N]."""
        c = s.c
        growth = exp(c.PKX3 * s.d) if c.PKX3 else 1
        return s.F * (c.PKX1 + c.PKX2 * s.d) * growth * (1 + c.PPX1 * s.p + c.PPX2 * s.p**2) * self.LKX

    def along(self, s: Slip) -> Any:
        """Return the longitudinal force [N] without slip angle."""
        c, lean = s.c, s.c.LGAX * s.g
        friction = (c.PDX1 + c.PDX2 * s.d) * (1 + c.PPX3 * s.p + c.PPX4 * s.p**2) * (1 - c.PDX3 * lean**2) * self.LMUX
        C, D = c.PCX1 * c.LCX, friction * s.F
        slip = s.k + (c.PHX1 + c.PHX2 * s.d) * c.LHX
        E = (c.PEX1 + c.PEX2 * s.d + c.PEX3 * s.d**2) * (1 - c.PEX4 * sign(slip) if c.PEX4 else 1) * c.LEX
        lift = s.F * (c.PVX1 + c.PVX2 * s.d) * c.LVX * self.LMUX
        return D * sin(curve(self.along_stiffness(s) / (C * D) * slip, C, minimum(E, 1))) + lift

    def across_stiffness(self, s: Slip) -> Any:
        """Return the slope of the side force at no slip [N/rad], below zero."""
        c = s.c
        u = s.F / ((c.PKY2 + c.PKY5 * s.g**2) * (1 + c.PPY2 * s.p) * s.N)
        growth = _twice(u) if c.PKY4 == 2 else sin(c.PKY4 * atan(u))
        upright = c.PKY1 * s.N * (1 + c.PPY1 * s.p) * growth * self.LKY
        lean = c.LGAY * s.g
        if is_zero(lean):
            return upright
        return upright * (1 - c.PKY3 * abs(lean)) if self.has("LEAN", "factor") else upright / (1 + c.PKY3 * lean**2)

    def friction_across(self, s: Slip) -> Any:
        """Return the coefficient of friction across the wheel."""
        c = s.c
        pressure = 1 + c.PPY3 * s.p + c.PPY4 * s.p**2
        upright, lean = (c.PDY1 + c.PDY2 * s.d) * pressure * self.LMUY, c.PDY3 * (c.LGAY * s.g) ** 2
        return upright * (1 - lean) if self.has("LEAN", "factor") else upright / (1 + lean)

    def across_shifts(self, s: Slip) -> tuple[Any, Any]:
        """Return horizontal and vertical shift of the side force."""
        c, lean = s.c, s.c.LGAY * s.g
        leaning = s.F * (c.PVY3 + c.PVY4 * s.d) * lean * c.LKYC * self.LMUY
        lift = s.F * (c.PVY1 + c.PVY2 * s.d) * c.LVY * self.LMUY + leaning
        shift = (c.PHY1 + c.PHY2 * s.d) * c.LHY
        if is_zero(s.g):
            return shift, lift
        if self.has("FORMULAS", "5.2"):
            return shift + c.PHY3 * lean, lift
        thrust = s.F * (c.PKY6 + c.PKY7 * s.d) * (1 + c.PPY5 * s.p) * c.LKYC * s.g
        return shift + (thrust - leaning) / self.across_stiffness(s), lift

    def across(self, s: Slip) -> Any:
        """Return the side force [N] of the wheel that rolls freely."""
        c, lean = s.c, s.c.LGAY * s.g
        shift, lift = self.across_shifts(s)
        slip, C, D = s.a + shift, c.PCY1 * c.LCY, self.friction_across(s) * s.F
        sided = c.PEY3 + c.PEY4 * lean
        skew = 1 + c.PEY5 * s.g**2 - (0 if is_zero(sided) else sided * sign(slip))
        E = (c.PEY1 + c.PEY2 * s.d) * skew * c.LEY
        return D * sin(curve(self.across_stiffness(s) / (C * D) * slip, C, minimum(E, 1))) + lift

    # Combined slip (equations 4.E50 to 4.E67)

    def along_weight(self, s: Slip) -> Any:
        """Return the share of the longitudinal force that the slip angle leaves."""
        c = s.c
        if is_zero(s.a):
            return 1
        B = (c.RBX1 + c.RBX3 * s.g**2) * cos(atan(c.RBX2 * s.k)) * c.LXAL
        return _weight(B, c.RCX1, minimum(c.REX1 + c.REX2 * s.d, 1), s.a, c.RHX1)

    def across_weight(self, s: Slip) -> Any:
        """Return the share of the side force that the longitudinal slip leaves."""
        c = s.c
        if is_zero(s.k):
            return 1
        B = (c.RBY1 + c.RBY4 * s.g**2) * cos(atan(c.RBY2 * (s.a - c.RBY3))) * c.LYKA
        return _weight(B, c.RCY1, minimum(c.REY1 + c.REY2 * s.d, 1), s.k, c.RHY1 + c.RHY2 * s.d)

    def induced(self, s: Slip) -> Any:
        """Return the side force that longitudinal slip brings about."""
        c = s.c
        if is_zero(s.k):
            return 0
        D = self.friction_across(s) * s.F * (c.RVY1 + c.RVY2 * s.d + c.RVY3 * s.g) * cos(atan(c.RVY4 * s.a))
        return D * sin(c.RVY5 * atan(c.RVY6 * s.k)) * c.LVYKA


def _twice(u: Any) -> Any:
    """Return ``sin(2 atan u)``, written without angles."""
    return grouped(2 * u / (1 + u * u))


def _weight(B: Any, C: Any, E: Any, slip: Any, shift: Any) -> Any:
    """Return the share of a force that the other slip leaves, 1 where there is none."""
    return maximum(cos(curve(B * (slip + shift), C, E)) / cos(curve(B * shift, C, E)), 0)
