"""Magic formula of 1989. Signs as for all tires; SI units and radians outside, its own units inside.

Coefficients are constants, ``MagicFormula89.of({"a0": 1.3, ...})``, or those of a property file whose format is PAC89.
Inside, loads are in kN, angles in degrees and longitudinal slip in per cent, forces come out in N and moments in N m;
the parameters F_unit and L_unit carry the units. The formula's own slip angle has the other sign: its side force goes
with it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any, ClassVar

from ...core.contract.declare import param
from ...core.errors import UcritError
from ...core.formulas.functions import exp, grouped, length, sin, where
from .coefficients import Coefficients, check_switches, curve
from .magic_formula_moment import pi
from .slip import is_zero
from .tire import Forces, Tire

NEEDED = ("a0", "a1", "a2", "a3", "a4", "a7", "b0", "b1", "b2", "b3", "b4", "b8", "c0", "c1", "c2", "c3", "c4", "c9")
"""Coefficients that have no neutral value."""

SHIFTS = ("a9", "a10", "a12", "a13", "b9", "b10", "c12", "c13", "c16", "c17")
"""Coefficients that make an upright tire pull to one side: left out where the tire is symmetric."""


class MagicFormula89(Tire):
    """Magic formula in the form of 1989, each force for itself (Bakker, Pacejka, Lidner, SAE 890087).

    Side force a0 to a13, longitudinal force b0 to b10, aligning moment c0 to c17. The coefficients say nothing of
    combined slip, and published programs differ in it; here it is by similarity, which is this package's own choice:
    each force is taken at the length of both slips, the longitudinal one told as an angle as stiff as it, and has its
    share. A locked wheel's force so opposes its sliding only roughly.

    Switches among the constants: SYMMETRIC ("no", "yes": without the shifts), MOMENT (1, or -1 where the coefficients
    c are for a moment of the other sign).
    """

    friction = ("LMU",)
    switches: ClassVar[Mapping[str, tuple[Any, ...]]] = {"SYMMETRIC": ("no", "yes"), "MOMENT": (1, -1)}

    LMU: float = param("1", "scale factor of friction", above=0, default=1.0)
    F_unit: float = param("N", "load that the coefficients count in", above=0, default=1000.0)
    L_unit: float = param("m", "length that the coefficients of the moment count in", above=0, default=1.0)

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        check_switches(cls, cls.switches)
        for name in NEEDED:
            if name not in cls.constants:
                raise UcritError(f"{cls.part_id()}: coefficient {name} is missing; needed are {', '.join(NEEDED)}")

    @classmethod
    def part_id(cls) -> str:
        """Name of the law: that of its file, where it has one."""
        return str(cls.constants.get("FILE", "magic-formula-89"))

    @property
    def _numbers(self) -> Coefficients:
        if not self.constants:
            raise UcritError("magic-formula-89: the law needs its coefficients: MagicFormula89.of({'a0': 1.3, ...})")
        return Coefficients(self, {}, SHIFTS if self.constants.get("SYMMETRIC") == "yes" else ())

    def _side(self, c: Any, F: Any, alpha: Any, gamma: Any) -> Any:
        """Return the side force [N] that goes with a slip angle [degrees], for a load in kN and a camber in degrees."""
        D = (c.a1 * F + c.a2) * F * self.LMU
        slope = self._side_slope(c, F, gamma)
        shift = c.a8 * gamma + c.a9 * F + c.a10
        lift = c.a11 * F * gamma + c.a12 * F + c.a13
        return D * sin(curve(slope / (c.a0 * D) * (alpha + shift), c.a0, c.a6 * F + c.a7)) + lift

    def _side_slope(self, c: Any, F: Any, gamma: Any = 0) -> Any:
        """Return B C D [N/degree]; ``sin(2 atan u)`` is written without angles."""
        u = F / c.a4
        slope = c.a3 * 2 * u / (1 + u * u)
        return slope if is_zero(gamma) or is_zero(c.a5) else slope * (1 - c.a5 * abs(gamma))

    def _along(self, c: Any, F: Any, kappa: Any) -> Any:
        """Return the longitudinal force [N] for a load in kN and a slip in per cent."""
        D = (c.b1 * F + c.b2) * F * self.LMU
        slope = self._along_slope(c, F)
        return D * sin(curve(slope / (c.b0 * D) * (kappa + c.b9 * F + c.b10), c.b0, (c.b6 * F + c.b7) * F + c.b8))

    def _along_slope(self, c: Any, F: Any) -> Any:
        return (c.b3 * F + c.b4) * F * (1 if is_zero(c.b5) else exp(-c.b5 * F))

    def _moment(self, c: Any, F: Any, alpha: Any, gamma: Any) -> Any:
        """Return the moment [N m] as the formula has it, for a slip angle and a camber in degrees."""
        lean = 0 if is_zero(gamma) else abs(gamma)
        D = (c.c1 * F + c.c2) * F * self.LMU
        slope = (c.c3 * F + c.c4) * F * (1 - c.c6 * lean) * (1 if is_zero(c.c5) else exp(-c.c5 * F))
        E = ((c.c7 * F + c.c8) * F + c.c9) * (1 - c.c10 * lean)
        shift = c.c11 * gamma + c.c12 * F + c.c13
        lift = (c.c14 * F + c.c15) * F * gamma + c.c16 * F + c.c17
        return D * sin(curve(slope / (c.c0 * D) * (alpha + shift), c.c0, E)) + lift

    def forces(self, F_z: Any, alpha: Any, kappa: Any = 0, gamma: Any = 0) -> Forces:
        """Return the forces on the wheel."""
        c, F, degrees = self._numbers, grouped(F_z / self.F_unit), 180 / pi(alpha)
        newton = self.F_unit / 1000
        slip, lean = -alpha * degrees, gamma if is_zero(gamma) else -gamma * degrees
        if is_zero(kappa):
            F_x, F_y = self._along(c, F, 0), self._side(c, F, slip, lean)
        else:
            F_x, F_y = self._combined(c, F, slip, 100 * kappa, lean)
        M_z = self.constants.get("MOMENT", 1) * self._moment(c, F, slip, lean)
        return Forces(newton * F_x, newton * F_y, newton * self.L_unit * M_z)

    def side_force(self, F_z: Any, alpha: Any) -> Any:
        """Return the side force [N] of an upright wheel that rolls freely."""
        slip = -alpha * 180 / pi(alpha)
        return self.F_unit / 1000 * self._side(self._numbers, grouped(F_z / self.F_unit), slip, 0)

    def _combined(self, c: Any, F: Any, alpha: Any, kappa: Any, gamma: Any) -> tuple[Any, Any]:
        """Return both forces [N] at the length of both slips, the longitudinal one told as an angle as stiff as it."""
        scale = self._along_slope(c, F) / self._side_slope(c, F)
        both = length(kappa * scale, alpha)
        odd = all(is_zero(getattr(c, name)) for name in SHIFTS)
        F_x = _share(lambda x: self._along(c, F, x / scale), kappa * scale, both, self._along_slope(c, F) / scale, odd)
        straight = odd and is_zero(gamma)
        F_y = _share(lambda x: self._side(c, F, x, gamma), alpha, both, self._side_slope(c, F, gamma), straight)
        return F_x, F_y

    def cornering_coefficient(self, F_z: Any) -> Any:
        """Return the cornering coefficient [N/rad] of the upright wheel without shifts."""
        return self.F_unit / 1000 * self._side_slope(self._numbers, F_z / self.F_unit) * 180 / math.pi

    def slip_stiffness(self, F_z: Any) -> Any:
        """Return the longitudinal force per slip [N] without shifts."""
        return self.F_unit / 1000 * self._along_slope(self._numbers, F_z / self.F_unit) * 100


def _share(force: Callable[[Any], Any], slip: Any, both: Any, slope: Any, is_odd: bool) -> Any:
    """Return a force's share for one slip out of both: that of its odd part, and the square of it of its even part."""
    any_slip = both > 1e-12  # as formulas, lengths are never quite zero
    full = where(any_slip, both, 1)
    if is_odd:
        return where(any_slip, force(full) / full, slope) * slip
    ahead, behind = force(full), force(-full)
    odd = where(any_slip, (ahead - behind) / 2 / full, slope) * slip
    return odd + where(any_slip, (ahead + behind) / 2 * (slip / full) ** 2, force(0))
