"""Axes: x along the ground, to either side of the spot where the track is level; z up. SI units and radians.

The track lies in a vertical plane and the marble rolls along it without slip; z = kappa x^2/2 is the path of
its centre.
"""

from ..core import Drawing, Model, coordinate, param, sqrt
from ..parts.shapes import ball_on_a_path


class Marble(Model):
    """Marble in a bowl, on the flat or on a hill (Karnopp 2004, figure 3.1)."""

    m: float = param("kg", "mass", above=0)
    kappa: float = param("1/m", "curvature of the path, positive in a bowl, negative on a hill")
    b: float = param("N s/m", "drag on the centre", at_least=0)
    g: float = param("m/s^2", "acceleration of gravity", above=0, default=9.81)

    x = coordinate("m", "horizontal displacement of the centre", motion="rolling")

    def velocity(self, x, dx):
        return dx.x * sqrt(1 + self.kappa**2 * x.x**2)

    def kinetic_energy(self, x, dx):
        inertia_of_a_ball = 2 / 5
        return (1 + inertia_of_a_ball) * self.m * self.velocity(x, dx) ** 2 / 2

    def potential_energy(self, x):
        return self.m * self.g * self.kappa * x.x**2 / 2

    def forces(self, x, dx):
        velocity = self.velocity(x, dx)
        return ((-self.b * velocity, velocity),)

    def drawing(self, x):
        return Drawing("side", ball_on_a_path(self.kappa, x.x))
