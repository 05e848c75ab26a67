"""Axes: x along the track, y to the left; psi positive to the left. SI units and radians.

The car body moves straight with speed V; wheelset 1 lies b ahead of the frame's centre, wheelset 2 as far
behind. f_x acts along, f_y across the rolling direction, for one wheel.
"""

from types import MappingProxyType

from ..core import Drawing, Model, coordinate, cos, param, sin, speed
from ..core.contract.drawing import box
from ..parts.creep import contact_velocities, creep_forces
from ..parts.shapes import rails, wheelset


class RailTruck(Model):
    """Truck with two wheelsets in lateral and yaw primary suspension (Karnopp 2004, chapter 10)."""

    m: float = param("kg", "mass of a wheelset", above=0)
    I: float = param("kg m^2", "yaw moment of inertia of a wheelset", above=0)
    m_f: float = param("kg", "mass of the frame", above=0)
    I_f: float = param("kg m^2", "yaw moment of inertia of the frame", above=0)
    b: float = param("m", "half the wheelbase", above=0)
    d: float = param("m", "half the distance between the contact points", above=0)
    r_0: float = param("m", "rolling radius in the central position", above=0)
    lambda_: float = param("1", "conicity: slope of the treads, positive when the flange side is larger")
    f_x: float = param("N", "longitudinal creep coefficient of a wheel", above=0)
    f_y: float = param("N", "lateral creep coefficient of a wheel", above=0)
    k_1: float = param("N/m", "lateral stiffness between a wheelset and the frame", above=0)
    k_2: float = param("N m/rad", "yaw stiffness between a wheelset and the frame", above=0)
    k_s: float = param("N/m", "lateral stiffness between frame and car body", at_least=0)
    k_t: float = param("N m/rad", "yaw stiffness between frame and car body", at_least=0)
    c_s: float = param("N s/m", "lateral damping between frame and car body", at_least=0)
    c_t: float = param("N m s/rad", "yaw damping between frame and car body", at_least=0)
    V: float = speed("forward speed")

    y_1 = coordinate("m", "lateral displacement of the leading wheelset", motion="wheelset")
    psi_1 = coordinate("rad", "yaw angle of the leading wheelset", motion="wheelset yaw")
    y_2 = coordinate("m", "lateral displacement of the trailing wheelset", motion="wheelset")
    psi_2 = coordinate("rad", "yaw angle of the trailing wheelset", motion="wheelset yaw")
    y_f = coordinate("m", "lateral displacement of the frame's centre", motion="frame")
    psi_f = coordinate("rad", "yaw angle of the frame", motion="frame yaw")

    mode_names = MappingProxyType({"wheelset oscillation": "hunting", "wheelset yaw oscillation": "hunting"})

    def kinetic_energy(self, x, dx):
        leading = self.m * dx.y_1**2 / 2 + self.I * dx.psi_1**2 / 2
        trailing = self.m * dx.y_2**2 / 2 + self.I * dx.psi_2**2 / 2
        return leading + trailing + self.m_f * dx.y_f**2 / 2 + self.I_f * dx.psi_f**2 / 2

    def potential_energy(self, x):
        primary = (
            self.k_1 * (x.y_f + self.b * sin(x.psi_f) - x.y_1) ** 2
            + self.k_1 * (x.y_f - self.b * sin(x.psi_f) - x.y_2) ** 2
            + self.k_2 * (x.psi_f - x.psi_1) ** 2
            + self.k_2 * (x.psi_f - x.psi_2) ** 2
        )
        secondary = self.k_s * x.y_f**2 + self.k_t * x.psi_f**2
        return (primary + secondary) / 2

    def forces(self, x, dx):
        return (
            *self.wheelset_forces(x.y_1, x.psi_1, dx.y_1, dx.psi_1),
            *self.wheelset_forces(x.y_2, x.psi_2, dx.y_2, dx.psi_2),
            (-self.c_s * dx.y_f, dx.y_f),
            (-self.c_t * dx.psi_f, dx.psi_f),
        )

    def equations_newton(self, x, dx, ddx):
        leading = self.balance(x.y_1, x.psi_1, dx.y_1, dx.psi_1, self.b, x)
        trailing = self.balance(x.y_2, x.psi_2, dx.y_2, dx.psi_2, -self.b, x)
        (Y_1, M_1, spring_1, twist_1), (Y_2, M_2, spring_2, twist_2) = leading, trailing
        Y_f = -spring_1 - spring_2 - self.k_s * x.y_f - self.c_s * dx.y_f
        arms = self.b * cos(x.psi_f) * (spring_2 - spring_1)
        M_f = arms - twist_1 - twist_2 - self.k_t * x.psi_f - self.c_t * dx.psi_f
        return (
            self.m * ddx.y_1 - Y_1,
            self.I * ddx.psi_1 - M_1,
            self.m * ddx.y_2 - Y_2,
            self.I * ddx.psi_2 - M_2,
            self.m_f * ddx.y_f - Y_f,
            self.I_f * ddx.psi_f - M_f,
        )

    def balance(self, y, psi, dy, dpsi, ahead, x):
        """Side force and yaw moment on a wheelset, and the parts of them that the frame's springs exert."""
        ((left, _), (across, _), (right, _), _) = self.wheelset_forces(y, psi, dy, dpsi)
        spring = self.k_1 * (x.y_f + ahead * sin(x.psi_f) - y)
        twist = self.k_2 * (x.psi_f - psi)
        Y = 2 * across * cos(psi) + (left + right) * sin(psi) + spring
        return Y, self.d * (right - left) + twist, spring, twist

    def wheelset_forces(self, y, psi, dy, dpsi):
        velocities = contact_velocities(self.V, y, psi, dy, dpsi, self.d, self.r_0, self.lambda_)
        return creep_forces(self.V, velocities, self.f_x, self.f_y)

    def drawing(self, x):
        leading = wheelset(self.d, self.r_0, (self.b, x.y_1), x.psi_1)
        trailing = wheelset(self.d, self.r_0, (-self.b, x.y_2), x.psi_2)
        frame = box(2.6 * self.b, 1.2 * self.d, (0, x.y_f), x.psi_f)
        return Drawing("top", (*rails(self.d, 3 * self.b), frame, *leading, *trailing), travel=(self.V, 0, 0))
