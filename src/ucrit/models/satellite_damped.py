"""Axes: x, y, z along the principal axes of inertia, fixed to the satellite. SI units and radians.

A balanced wheel inside turns about the y axis against viscous friction, by the rate w relative to the
satellite. It stands for whatever takes energy out of a satellite that wobbles: sloshing fuel, whipping antennas.
I_yy is the satellite's without the wheel, whose J comes to it; I_xx and I_zz are those of both.
"""

from ..core import param, state
from ..parts.rigid_body import angular_momentum, components, dot, inertia_tensor, possible_inertia, rate_in_space
from .satellite import Satellite


class SatelliteDamped(Satellite):
    """Spinning satellite with an internal damper (P. C. Hughes, Spacecraft Attitude Dynamics (1986), chapter 5)."""

    J: float = param("kg m^2", "moment of inertia of the damper's wheel about its axis", above=0)
    c: float = param("N m s/rad", "viscous friction of the wheel", above=0)

    w = state("rad/s", "rate of the wheel relative to the satellite", motion="damper")

    even = ("q", "w")

    def inertia(self):
        return inertia_tensor(self.I_xx, self.I_yy + self.J, self.I_zz)

    def possible(self):
        return possible_inertia("I_xx, I_yy + J, I_zz", self.inertia())

    def momentum(self, spin, wheel):
        H_x, H_y, H_z = angular_momentum(self.inertia(), spin)
        return H_x, H_y + self.J * wheel, H_z

    def equations(self, x, dx):
        spin = components(x, "p q r")
        H, dH = self.momentum(spin, x.w), self.momentum(components(dx, "p q r"), dx.w)
        return (*rate_in_space(H, dH, frame=spin), self.J * (dx.q + dx.w) + self.c * x.w)

    def conserved(self, x, dx):
        H = self.momentum(components(x, "p q r"), x.w)
        return {"angular momentum squared": dot(H, H)}
