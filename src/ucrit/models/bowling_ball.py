"""Axes: theta is the angle of the stick to the vertical, positive to either side. SI units and radians.

The stick is rigid, without mass, and held upright at its foot by a spring that resists turning: the elasticity
of a stick that is clamped there.
"""

from ..core import Drawing, Model, coordinate, cos, event, param, sin
from ..parts.shapes import pendulum_upright


class BowlingBall(Model):
    """Bowling ball on a stick: an inverted pendulum on a spring (Karnopp 2004, problem 3.2)."""

    m: float = param("kg", "mass of the ball", above=0)
    R: float = param("m", "radius of the ball", above=0)
    l: float = param("m", "foot of the stick to the centre of the ball", above=0)
    k: float = param("N m/rad", "stiffness of the foot", at_least=0)
    c: float = param("N m s/rad", "damping of the foot", at_least=0)
    g: float = param("m/s^2", "acceleration of gravity", above=0, default=9.81)

    theta = coordinate("rad", "angle of the stick to the vertical", motion="tilting")

    def inertia_about_foot(self):
        return self.m * (2 / 5 * self.R**2 + self.l**2)

    def kinetic_energy(self, x, dx):
        return self.inertia_about_foot() * dx.theta**2 / 2

    def potential_energy(self, x):
        return self.m * self.g * self.l * cos(x.theta) + self.k * x.theta**2 / 2

    def forces(self, x, dx):
        return ((-self.c * dx.theta, dx.theta),)

    def equations_newton(self, x, dx, ddx):
        weight = self.m * self.g * self.l * sin(x.theta)
        return self.inertia_about_foot() * ddx.theta - (weight - self.k * x.theta - self.c * dx.theta)

    def events(self, x):
        return {"falls over": event(cos(x.theta), ends=True)}

    def drawing(self, x):
        return Drawing("side", pendulum_upright(self.l, self.R, x.theta))
