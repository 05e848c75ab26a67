"""Axes: x forward, y to the right, z down, origin at the rear contact, moving with the bicycle; roll is positive to
the right, steer too. The wheels are thin, roll without slip and carry the load of a flat road. SI units and radians.

Everything is of first order in roll and steer. A force or rate of momentum counts by its power in the two motions
that the wheels allow: roll, and steer with the yaw that keeps the front contact on its course.
"""

from types import MappingProxyType

from ..core import Drawing, Model, coordinate, cos, param, sin, speed
from ..parts.shapes import leaning


class Bicycle(Model):
    """Bicycle with hands off the bars and a rigid rider (Whipple's model as in Meijaard et al. 2007)."""

    w: float = param("m", "wheelbase", above=0)
    c: float = param("m", "trail")
    lambda_: float = param("rad", "tilt of the steer axis from the vertical", above=-1.5, below=1.5)
    g: float = param("m/s^2", "gravity", above=0, default=9.80665)
    U: float = speed("forward speed")
    r_R: float = param("m", "radius of the rear wheel", above=0)
    m_R: float = param("kg", "mass of the rear wheel", above=0)
    I_Rxx: float = param("kg m^2", "moment of inertia of the rear wheel about a diameter", above=0)
    I_Ryy: float = param("kg m^2", "moment of inertia of the rear wheel about its axle", above=0)
    x_B: float = param("m", "centre of mass of frame and rider ahead of the rear contact")
    z_B: float = param("m", "depth of the centre of mass of frame and rider, negative above the road", below=0)
    m_B: float = param("kg", "mass of frame and rider", above=0)
    I_Bxx: float = param("kg m^2", "roll moment of inertia of frame and rider", above=0)
    I_Bxz: float = param("kg m^2", "element xz of the inertia tensor of frame and rider")
    I_Bzz: float = param("kg m^2", "yaw moment of inertia of frame and rider", above=0)
    x_H: float = param("m", "centre of mass of handlebar and fork ahead of the rear contact")
    z_H: float = param("m", "depth of the centre of mass of handlebar and fork, negative above the road", below=0)
    m_H: float = param("kg", "mass of handlebar and fork", above=0)
    I_Hxx: float = param("kg m^2", "roll moment of inertia of handlebar and fork", above=0)
    I_Hxz: float = param("kg m^2", "element xz of the inertia tensor of handlebar and fork")
    I_Hzz: float = param("kg m^2", "yaw moment of inertia of handlebar and fork", above=0)
    r_F: float = param("m", "radius of the front wheel", above=0)
    m_F: float = param("kg", "mass of the front wheel", above=0)
    I_Fxx: float = param("kg m^2", "moment of inertia of the front wheel about a diameter", above=0)
    I_Fyy: float = param("kg m^2", "moment of inertia of the front wheel about its axle", above=0)

    phi = coordinate("rad", "roll angle of the rear frame", motion="roll")
    delta = coordinate("rad", "steer angle of the handlebar", motion="steer")

    mode_names = MappingProxyType(
        {
            "roll oscillation": "weave",
            "steer oscillation": "weave",
            "roll decay": "capsize decay",
            "roll divergence": "capsize divergence",
            "steer decay": "castering decay",
        }
    )

    def bodies(self):
        """Position, mass, inertia tensor, spin momentum per speed and whether it steers, of each body."""
        return (
            (0, -self.r_R, self.m_R, (self.I_Rxx, 0, self.I_Rxx), self.I_Ryy / self.r_R, 0),
            (self.x_B, self.z_B, self.m_B, (self.I_Bxx, self.I_Bxz, self.I_Bzz), 0, 0),
            (self.x_H, self.z_H, self.m_H, (self.I_Hxx, self.I_Hxz, self.I_Hzz), 0, 1),
            (self.w, -self.r_F, self.m_F, (self.I_Fxx, 0, self.I_Fxx), self.I_Fyy / self.r_F, 1),
        )

    def arm(self, x, z):
        """Distance of a point ahead of the steer axis."""
        return (x - self.w - self.c) * cos(self.lambda_) - z * sin(self.lambda_)

    def equations(self, x, dx, ddx):
        S, C = sin(self.lambda_), cos(self.lambda_)
        # no side slip at the contacts: of the heading, and of the rear contact across it
        yaw_rate = (self.U * x.delta + self.c * dx.delta) * C / self.w
        yaw_acceleration = (self.U * dx.delta + self.c * ddx.delta) * C / self.w
        roll = steer = 0
        for ahead, depth, mass, (Ixx, Ixz, Izz), spin, steers in self.bodies():
            u = steers * self.arm(ahead, depth)
            inertial = self.U * yaw_rate + ahead * yaw_acceleration - depth * ddx.phi + u * ddx.delta
            p, r = dx.phi + steers * S * dx.delta, yaw_rate + steers * C * dx.delta
            dp, dr = ddx.phi + steers * S * ddx.delta, yaw_acceleration + steers * C * ddx.delta
            about_x = Ixx * dp + Ixz * dr + spin * self.U * r
            about_z = Ixz * dp + Izz * dr - spin * self.U * p
            turned = self.c * C / self.w
            roll += about_x - depth * mass * inertial
            steer += (turned * ahead + u) * mass * inertial + turned * about_z + steers * (S * about_x + C * about_z)
        weights = [(mass * self.g, ahead, depth, steers) for ahead, depth, mass, _, _, steers in self.bodies()]
        load = sum(weight * ahead for weight, ahead, _, _ in weights) / self.w
        for force, ahead, depth, steers in (*weights, (-load, self.w, 0, 1)):
            u = steers * self.arm(ahead, depth)
            roll -= force * (u * x.delta - depth * x.phi)
            steer -= force * u * (x.phi + S * x.delta)
        return roll, steer

    def drawing(self, x):
        return Drawing("rear", leaning(-self.z_B, x.phi))
