"""What every law of tire forces answers.

Signs: the slip angle alpha is positive when the contact point moves to the wheel's positive lateral side, and the side
force opposes it; the longitudinal slip kappa is positive when the wheel drives, and F_x goes with it. SI units and
radians; forces act on one wheel.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from ...core.part import Part


class Forces(NamedTuple):
    """Forces [N] along and across the wheel and moment [N m] about the vertical through the contact point."""

    F_x: Any
    F_y: Any
    M_z: Any


class Tire(Part):
    """Base of all tire laws: forces for a vertical load F_z [N], slip angle alpha [rad] and slip kappa."""

    def forces(self, F_z: Any, alpha: Any, kappa: Any = 0) -> Forces:
        """Return the forces on the wheel."""
        raise NotImplementedError

    def side_force(self, F_z: Any, alpha: Any) -> Any:
        """Return the side force [N] of a wheel that rolls freely."""
        return self.forces(F_z, alpha).F_y
