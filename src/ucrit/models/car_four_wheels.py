"""Axes: x forward, y to the right, z down, fixed to the body; r positive to the right. SI units and radians.

Wheels are front left, front right, rear left, rear right: fl, fr, rl, rr. Vertical loads follow the accelerations of
the centre of mass with a lag T, as a body on springs does, and are in the end those of statics; the front axle takes
the share zeta of the moment in roll. A wheel that has lifted carries nothing, and the others then carry no more than
they did: results are good up to the first lift. A motion ends where a whole side has lifted, and before standstill,
where slips have no value.
"""

import math
from types import MappingProxyType

from ..core import Drawing, Model, cos, event, input, output, param, sin, slot, speed, sqrt, state
from ..parts.shapes import car
from ..parts.tires import longitudinal_slip, slip_angle
from ..parts.tires.linear import Linear

WHEELS = ("fl", "fr", "rl", "rr")
PLACES = ("front left", "front right", "rear left", "rear right")
LOCKED = 0.05
"""Spin of a wheel, as a share of that of one that rolls freely, below which it is called locked."""
LEAST = 1e-6
"""Load of a wheel that has lifted, as a share of its load at rest, so that tire laws keep a value."""


def larger(a, b):
    """Return the larger of two values, without a condition that conditions of tire laws would enclose."""
    return (a + b + abs(a - b)) / 2


class CarFourWheels(Model):
    """Plane car on four wheels that spin, with load transfer (after Karnopp 2004, chapter 6 and Problem 6.8)."""

    m: float = param("kg", "mass", above=0)
    I_z: float = param("kg m^2", "yaw moment of inertia about the centre of mass", above=0)
    a: float = param("m", "centre of mass to front axle", above=0)
    b: float = param("m", "centre of mass to rear axle", above=0)
    h: float = param("m", "height of the centre of mass", at_least=0)
    t_f: float = param("m", "track of the front axle", above=0)
    t_r: float = param("m", "track of the rear axle", above=0)
    zeta: float = param("1", "front axle's share of the stiffness in roll", at_least=0, at_most=1, default=0.5)
    T: float = param("s", "lag of the loads behind the accelerations", above=0, default=0.1)
    R: float = param("m", "radius of the wheels", above=0)
    I_w: float = param("kg m^2", "moment of inertia of one wheel about its axle", above=0)
    xi: float = param("1", "front axle's share of the drive torque", at_least=0, at_most=1, default=1.0)
    omega_b: float = param("rad/s", "spin of a wheel below which its brake fades", above=0, default=0.5)
    g: float = param("m/s^2", "gravity", above=0, default=9.80665)
    front = slot(Linear, "each front tire")
    rear = slot(Linear, "each rear tire")
    U: float = speed("forward speed of the basic motion")

    v_x = state("m/s", "forward velocity of the centre of mass", motion="forward")
    v_y = state("m/s", "lateral velocity of the centre of mass", motion="sideslip")
    r = state("rad/s", "yaw rate", motion="yaw")
    A_x = state("m/s^2", "forward acceleration that the loads have followed", motion="pitch lag")
    A_y = state("m/s^2", "lateral acceleration that the loads have followed", motion="roll lag")
    omega_fl = state("rad/s", "spin of the front left wheel", motion="wheel")
    omega_fr = state("rad/s", "spin of the front right wheel", motion="wheel")
    omega_rl = state("rad/s", "spin of the rear left wheel", motion="wheel")
    omega_rr = state("rad/s", "spin of the rear right wheel", motion="wheel")

    mode_names = MappingProxyType(
        {
            "sideslip oscillation": "yaw oscillation",
            "sideslip divergence": "spin divergence",
            "yaw divergence": "spin divergence",
        }
    )

    delta_f = input("rad", "front steer angle")
    delta_r = input("rad", "rear steer angle")
    drive = input("N m", "drive torque on all wheels together, by open differentials")
    brake_fl = input("N m", "brake torque of the front left wheel")
    brake_fr = input("N m", "brake torque of the front right wheel")
    brake_rl = input("N m", "brake torque of the rear left wheel")
    brake_rr = input("N m", "brake torque of the rear right wheel")

    a_x = output("m/s^2", "forward acceleration of the centre of mass")
    a_y = output("m/s^2", "lateral acceleration of the centre of mass")
    curvature = output("1/m", "curvature of a steady turn, one over its radius")
    beta = output("rad", "sideslip angle of the centre of mass")
    alpha_f = output("rad", "slip angle of the front axle's middle")
    alpha_r = output("rad", "slip angle of the rear axle's middle")
    load_transfer = output("1", "load of the left wheels less that of the right ones, over the weight")
    F_fl = output("N", "load of the front left wheel")
    F_fr = output("N", "load of the front right wheel")
    F_rl = output("N", "load of the rear left wheel")
    F_rr = output("N", "load of the rear right wheel")

    even = ("v_x", "A_x", "omega_fl", "omega_fr", "omega_rl", "omega_rr", "drive", "brake_fl", "brake_fr", "brake_rl",
            "brake_rr", "a_x", "F_fl", "F_fr", "F_rl", "F_rr")  # fmt: skip
    sides = tuple((f"{kind}_{axle}l", f"{kind}_{axle}r") for kind in ("omega", "brake", "F") for axle in "fr")
    keeps_speed = MappingProxyType({"drive": "v_x"})
    wheel_loads = ("F_fl", "F_fr", "F_rl", "F_rr")
    valid = MappingProxyType(dict.fromkeys(wheel_loads, (0.0, math.inf)))

    def basic_motion(self):
        return {"x": {"v_x": self.U, **{f"omega_{wheel}": self.U / self.R for wheel in WHEELS}}}

    def places(self):
        """Places of the wheels: forward and to the right of the centre of mass."""
        yield from ((self.a, -self.t_f / 2), (self.a, self.t_f / 2))
        yield from ((-self.b, -self.t_r / 2), (-self.b, self.t_r / 2))

    def loads_at_rest(self):
        """Vertical loads of a front and of a rear wheel without accelerations."""
        share = self.m * self.g / (2 * (self.a + self.b))
        return share * self.b, share * self.a

    def loads(self, x):
        """Vertical loads of the wheels, negative where one would have to be held down."""
        front, rear = self.loads_at_rest()
        pitch = self.m * x.A_x * self.h / (2 * (self.a + self.b))
        front, rear = front - pitch, rear + pitch
        roll = self.m * x.A_y * self.h
        left, right = self.zeta * roll / self.t_f, (1 - self.zeta) * roll / self.t_r
        return front + left, front - left, rear + right, rear - right

    def tires(self, u):
        """Tires of the wheels, as they are on their road."""
        return self.front, self.front, self.rear, self.rear

    def slips(self, x, u):
        """Of each wheel: slip angle and longitudinal slip."""
        steer = (u.delta_f, u.delta_f, u.delta_r, u.delta_r)
        for (ahead, right), delta, wheel in zip(self.places(), steer, WHEELS, strict=True):
            forward, sideways = x.v_x - right * x.r, x.v_y + ahead * x.r
            along = forward * cos(delta) + sideways * sin(delta)
            across = sideways * cos(delta) - forward * sin(delta)
            yield slip_angle(across, along), longitudinal_slip(self.R, getattr(x, f"omega_{wheel}"), along)

    def wheels(self, x, u):
        """Of each wheel: forward and rightward force on the car, and moment about its axle."""
        steer, (front, rear) = (u.delta_f, u.delta_f, u.delta_r, u.delta_r), self.loads_at_rest()
        loads = map(larger, self.loads(x), (LEAST * front, LEAST * front, LEAST * rear, LEAST * rear))
        for tire, load, delta, slips in zip(self.tires(u), loads, steer, self.slips(x, u), strict=True):
            F = tire.forces(load, *slips)
            yield F.F_x * cos(delta) - F.F_y * sin(delta), F.F_x * sin(delta) + F.F_y * cos(delta), self.R * F.F_x

    def equations(self, x, dx, u):
        X, Y, road = zip(*self.wheels(x, u), strict=True)
        N = sum(ahead * y - right * f for (ahead, right), f, y in zip(self.places(), X, Y, strict=True))
        a_x, a_y = dx.v_x - x.v_y * x.r, dx.v_y + x.v_x * x.r
        shares = (self.xi / 2, self.xi / 2, (1 - self.xi) / 2, (1 - self.xi) / 2)
        spinning = []
        for wheel, share, moment in zip(WHEELS, shares, road, strict=True):
            omega, brake = getattr(x, f"omega_{wheel}"), getattr(u, f"brake_{wheel}")
            held = brake * omega / sqrt(omega**2 + self.omega_b**2)
            spinning.append(self.I_w * getattr(dx, f"omega_{wheel}") - (share * u.drive - held - moment))
        return (
            self.m * a_x - sum(X),
            self.m * a_y - sum(Y),
            self.I_z * dx.r - N,
            self.T * dx.A_x - (a_x - x.A_x),
            self.T * dx.A_y - (a_y - x.A_y),
            *spinning,
        )

    def outputs(self, x, dx, u):
        loads = self.loads(x)
        return {
            "a_x": dx.v_x - x.v_y * x.r,
            "a_y": dx.v_y + x.v_x * x.r,
            "curvature": x.r / sqrt(x.v_x**2 + x.v_y**2),
            "beta": slip_angle(x.v_y, x.v_x),
            "alpha_f": slip_angle(x.v_y + self.a * x.r, x.v_x) - u.delta_f,
            "alpha_r": slip_angle(x.v_y - self.b * x.r, x.v_x) - u.delta_r,
            "load_transfer": (loads[0] - loads[1] + loads[2] - loads[3]) / (self.m * self.g),
            **dict(zip((f"F_{wheel}" for wheel in WHEELS), loads, strict=True)),
        }

    def events(self, x, u):
        loads, slips = self.loads(x), self.slips(x, u)
        left, right = loads[0] + loads[2], loads[1] + loads[3]
        locks = {
            f"locks its {place} wheel": event(kappa + 1 - LOCKED, when="falling")
            for place, (_, kappa) in zip(PLACES, slips, strict=True)
        }
        lifts = {f"lifts its {p} wheel": event(load, when="falling") for p, load in zip(PLACES, loads, strict=True)}
        return {
            **locks,
            **lifts,
            "rolls over onto its right side": event(left, when="falling", ends=True),
            "rolls over onto its left side": event(right, when="falling", ends=True),
            "has slowed to a tenth of its speed": event(x.v_x - self.U / 10, when="falling", ends=True),
        }

    def drawing(self, x, u):
        return Drawing("top", car(self.a, self.b, u.delta_f, u.delta_r), turned=True, travel=(x.v_x, x.v_y, x.r))
