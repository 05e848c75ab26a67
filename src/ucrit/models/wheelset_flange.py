"""Axes and signs as in the wheelset. SI units and radians.

Each wheel carries the load N, and friction bounds its creep force. Beyond the clearance on either side a flange
touches its rail, which gives way like a spring.
"""

from ..core import event, maximum, param
from ..parts.creep import contact_velocities, creep_force, creepage, saturated_share
from .wheelset import Wheelset


class WheelsetFlange(Wheelset):
    """Wheelset sprung in a truck frame, with flanges and creep that friction bounds (Karnopp 2004, section 10.II)."""

    N: float = param("N", "vertical load of a wheel", above=0)
    mu: float = param("1", "coefficient of friction between wheel and rail", above=0)
    clearance: float = param("m", "lateral displacement at which a flange touches the rail", above=0)
    k_f: float = param("N/m", "lateral stiffness of a rail against the flange", at_least=0)

    bond_graph = equations_bond_graph = None  # that of the wheelset has other forces

    def potential_energy(self, x):
        squeezed = maximum(abs(x.y) - self.clearance, 0)
        return super().potential_energy(x) + self.k_f * squeezed**2 / 2

    def wheel_forces(self, point):
        along, across = (creepage(velocity, self.V) for velocity in point)
        share = saturated_share(self.f_x, self.f_y, (along, across), self.mu * self.N)
        return share * creep_force(self.f_x, along), share * creep_force(self.f_y, across)

    def forces(self, x, dx):
        points = contact_velocities(self.V, x.y, x.psi, dx.y, dx.psi, self.d, self.r_0, self.lambda_)
        return tuple(pair for point in points for pair in zip(self.wheel_forces(point), point, strict=True))

    def events(self, x):
        return {
            "touches a rail with its left flange": event(x.y - self.clearance, when="rising"),
            "touches a rail with its right flange": event(x.y + self.clearance, when="falling"),
        }
