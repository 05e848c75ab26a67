"""What every law of tire forces answers.

Signs: the slip angle alpha is positive when the contact point moves to the wheel's positive lateral side, and the side
force opposes it; the longitudinal slip kappa is positive when the wheel drives, -1 when it is locked, and F_x goes with
it; the camber gamma is positive when the wheel's top leans to its positive lateral side. M_z is positive about the
vertical by which x turns to y, whether y is to the left or to the right: with that, a force behind the wheel's centre
makes M_z and F_y of opposite sign. SI units and radians; forces act on one wheel, whose load is above zero.
"""

from __future__ import annotations

from typing import Any, ClassVar, NamedTuple

from ...core.contract.part import Part
from ...core.errors import UcritError
from ...core.made import made


class Forces(NamedTuple):
    """Forces [N] along and across the wheel and moment [N m] about the vertical through the contact point."""

    F_x: Any
    F_y: Any
    M_z: Any


class Tire(Part):
    """Base of all tire laws: forces for a vertical load F_z [N], slip angle alpha [rad], slip kappa, camber gamma.

    A law states `forces`, `cornering_coefficient` and `slip_stiffness`; ``friction`` names the parameters that a
    slippery road makes smaller.
    """

    friction: ClassVar[tuple[str, ...]] = ()

    @classmethod
    def unwritten(cls, slot: str) -> type[Part]:
        """Return a tire whose forces are functions without a formula, such as ``F_y_front(F_z, alpha)``."""
        return made(_unwritten, cls, slot)  # type: ignore[no-any-return]

    def forces(self, F_z: Any, alpha: Any, kappa: Any = 0, gamma: Any = 0) -> Forces:
        """Return the forces on the wheel."""
        raise NotImplementedError

    def side_force(self, F_z: Any, alpha: Any) -> Any:
        """Return the side force [N] of an upright wheel that rolls freely."""
        return self.forces(F_z, alpha).F_y

    def cornering_coefficient(self, F_z: Any) -> Any:
        """Return ``-dF_y/dalpha`` [N/rad] at no slip, under a load F_z [N]."""
        raise NotImplementedError

    def slip_stiffness(self, F_z: Any) -> Any:
        """Return ``dF_x/dkappa`` [N] at no slip, under a load F_z [N]."""
        raise NotImplementedError

    def relaxation_length(self, F_z: Any, k_y: Any) -> Any:
        """Return the distance [m] over which the side force builds up, for a sidewall of stiffness k_y [N/m].

        ``C_alpha/k_y``: the sidewall is a spring in series with the tread (Karnopp 2004, section 8.VI).
        """
        return self.cornering_coefficient(F_z) / k_y

    def on_road(self, factor: Any) -> Tire:
        """Return the tire on a road whose friction is this multiple, a number or symbol, of what it is given for."""
        if not self.friction:
            raise UcritError(f"{type(self).part_id()}: the law knows no friction, so no road can change it")
        values = {name: factor * value if name in self.friction else value for name, value in self.__dict__.items()}
        return type(self).bound(values) if hasattr(factor, "free_symbols") else type(self)(**values)


def axle_coefficient(tire: Tire, F_z: Any, transfer: Any) -> Any:
    """Return the cornering coefficient [N/rad] of an axle whose wheels carry ``F_z + transfer`` and ``F_z - transfer``.

    With a coefficient that grows less than the load does, a transfer of load lowers the axle's sum (Karnopp 2004,
    section 4.II).
    """
    return tire.cornering_coefficient(F_z + transfer) + tire.cornering_coefficient(F_z - transfer)


def _unwritten(law: type[Tire], slot: str) -> type[Tire]:
    def forces(self: Any, F_z: Any, alpha: Any, kappa: Any = 0, gamma: Any = 0) -> Forces:
        from sympy import Function

        given = [F_z, alpha, *(slip for slip in (kappa, gamma) if slip != 0)]
        return Forces(*(Function(f"{name}_{slot}", real=True)(*given) for name in Forces._fields))

    return type(law.__name__, (law,), {"forces": forces, "side_force": Tire.side_force, "__module__": law.__module__})
