"""Axes: x along the track, y to the left; psi positive to the left. SI units and radians.

The car body moves straight with speed V; the wheelsets lie b ahead of and b behind the truck's centre. f_x
acts along, f_y across the rolling direction, for one wheel, which carries the load N. R as in the wheelset
with gravity.
"""

from types import MappingProxyType

from ..core import Drawing, Model, coordinate, cos, param, sin, speed
from ..core.contract.drawing import box, moved
from ..parts.creep import contact_velocities, creep_forces
from ..parts.shapes import rails, wheelset


class RailTruckRigid(Model):
    """Truck that holds two wheelsets rigidly, under a car body (Karnopp 2004, chapter 10, problems)."""

    m: float = param("kg", "mass of the truck with its wheelsets", above=0)
    I: float = param("kg m^2", "yaw moment of inertia of the truck with its wheelsets", above=0)
    b: float = param("m", "half the wheelbase", above=0)
    d: float = param("m", "half the distance between the contact points", above=0)
    r_0: float = param("m", "rolling radius in the central position", above=0)
    lambda_: float = param("1", "conicity: slope of the treads, positive when the flange side is larger")
    f_x: float = param("N", "longitudinal creep coefficient of a wheel", above=0)
    f_y: float = param("N", "lateral creep coefficient of a wheel", above=0)
    N: float = param("N", "vertical load of a wheel", at_least=0)
    R: float = param("m", "radius of the tread's hollow less that of the rail head", above=0)
    k_s: float = param("N/m", "lateral stiffness between truck and car body", at_least=0)
    k_t: float = param("N m/rad", "yaw stiffness between truck and car body", at_least=0)
    c_s: float = param("N s/m", "lateral damping between truck and car body", at_least=0)
    c_t: float = param("N m s/rad", "yaw damping between truck and car body", at_least=0)
    V: float = speed("forward speed")

    y = coordinate("m", "lateral displacement of the truck's centre", motion="lateral")
    psi = coordinate("rad", "yaw angle of the truck", motion="yaw")

    mode_names = MappingProxyType({"lateral oscillation": "hunting", "yaw oscillation": "hunting"})

    def kinetic_energy(self, x, dx):
        return self.m * dx.y**2 / 2 + self.I * dx.psi**2 / 2

    def potential_energy(self, x):
        rise = sum((x.y + end * sin(x.psi)) ** 2 for end in (self.b, -self.b)) / (2 * self.R)
        springs = self.k_s * x.y**2 / 2 + self.k_t * x.psi**2 / 2
        return springs + 2 * self.N * (rise - self.lambda_ * self.d * x.psi**2)

    def forces(self, x, dx):
        return (
            *self.wheelset_forces(x, dx, self.b),
            *self.wheelset_forces(x, dx, -self.b),
            (-self.c_s * dx.y, dx.y),
            (-self.c_t * dx.psi, dx.psi),
        )

    def wheelset_forces(self, x, dx, ahead):
        y = x.y + ahead * sin(x.psi)
        points = contact_velocities(self.V, y, x.psi, dx.y, dx.psi, self.d, self.r_0, self.lambda_)
        turned = ((along, across + ahead * dx.psi) for along, across in points)
        return creep_forces(self.V, tuple(turned), self.f_x, self.f_y)

    def equations_newton(self, x, dx, ddx):
        Y = -self.k_s * x.y - self.c_s * dx.y
        M = 4 * self.N * self.lambda_ * self.d * x.psi - self.k_t * x.psi - self.c_t * dx.psi
        for ahead in (self.b, -self.b):
            ((left, _), (across, _), (right, _), _) = self.wheelset_forces(x, dx, ahead)
            load = -2 * self.N / self.R * (x.y + ahead * sin(x.psi))
            Y += 2 * across * cos(x.psi) + (left + right) * sin(x.psi) + load
            M += ahead * (2 * across + load * cos(x.psi)) + self.d * (right - left)
        return self.m * ddx.y - Y, self.I * ddx.psi - M

    def drawing(self, x):
        at = (0, x.y)
        ends = (wheelset(self.d, self.r_0, moved(at, x.psi, ahead), x.psi) for ahead in (self.b, -self.b))
        frame = box(2.6 * self.b, 1.2 * self.d, at, x.psi)
        return Drawing("top", (*rails(self.d, 3 * self.b), frame, *sum(ends, ())), travel=(self.V, 0, 0))
