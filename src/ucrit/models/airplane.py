"""Axes: x forward along the path of the basic motion, z down, fixed to the body; q and theta positive nose up.
SI units and radians.

Level flight at speed U. Angle of attack counts from zero lift of wing and body. Places on the chord, h and h_0, count
from its leading edge in chords c. Thrust acts along x through the centre of mass. The tail is in the downwash that
left the wing some time earlier. The elevator turns the tail's direction of zero lift.
"""

from ..core import Drawing, Model, cos, input, output, param, sin, speed, sqrt, state
from ..parts.shapes import airplane_side
from ..parts.wings import angle_of_attack


class Airplane(Model):
    """Airplane with wing, tail and elevator in its plane of symmetry (Karnopp 2004, section 9.III)."""

    m: float = param("kg", "mass", above=0)
    I_yy: float = param("kg m^2", "pitch moment of inertia about the centre of mass", above=0)
    S: float = param("m^2", "area of the wing", above=0)
    c: float = param("m", "mean chord of the wing", above=0)
    a: float = param("1/rad", "lift slope of wing and body", above=0)
    C_D0: float = param("1", "drag coefficient without lift", above=0)
    k: float = param("1", "induced drag per lift coefficient squared: 1/(pi A) for an elliptical wing", at_least=0)
    C_M0: float = param("1", "moment coefficient of wing and body without lift")
    h: float = param("1", "leading edge to centre of mass, in chords")
    h_0: float = param("1", "leading edge to aerodynamic centre of wing and body, in chords")
    S_t: float = param("m^2", "area of the tail", above=0)
    l: float = param("m", "aerodynamic centre of wing and body to that of the tail", above=0)
    a_t: float = param("1/rad", "lift slope of the tail", above=0)
    eta: float = param("1", "tail efficiency: dynamic pressure at the tail per that at the wing", above=0, default=1)
    epsilon: float = param("1", "downwash angle per angle of attack", at_least=0)
    i_t: float = param("rad", "angle of the tail to the wing's direction of zero lift, positive nose up")
    tau: float = param("1", "angle of attack of the tail per elevator angle", above=0)
    rho: float = param("kg/m^3", "density of the air", above=0, default=1.225)
    g: float = param("m/s^2", "gravity", above=0, default=9.80665)
    U: float = speed("speed of level flight")

    u = state("m/s", "forward velocity", motion="phugoid")
    w = state("m/s", "downward velocity", motion="short period")
    q = state("rad/s", "pitch rate", motion="short period")
    theta = state("rad", "pitch angle from level flight", motion="phugoid")

    delta_e = input("rad", "elevator angle, positive down")
    T = input("N", "thrust")

    alpha = output("rad", "angle of attack")
    C_L = output("1", "lift coefficient, pitch rate aside")
    C_M = output("1", "moment coefficient about the centre of mass, pitch rate aside")

    mirror = False
    one_mode_each = True

    @property
    def l_t(self):
        return self.l - (self.h - self.h_0) * self.c

    @property
    def tail_share(self):
        """Lift coefficient of the whole airplane per angle of attack of the tail."""
        return self.eta * self.a_t * self.S_t / self.S

    def coefficients(self, alpha, delta_e, turning=0):
        """Lift, drag and moment coefficients; ``turning`` is what rates add to the tail's angle of attack."""
        wing = self.a * alpha
        tail = self.tail_share * (alpha * (1 - self.epsilon) + self.i_t + self.tau * delta_e + turning)
        C_D = self.C_D0 + self.k * wing**2
        return wing + tail, C_D, self.C_M0 + (self.h - self.h_0) * wing - self.l_t / self.c * tail

    def trim(self):
        """Angle of attack, elevator angle and thrust of level flight: lift balances weight, moments vanish."""
        pressure = self.rho * self.U**2 / 2 * self.S
        C_L = self.m * self.g / pressure
        tail = (self.C_M0 + (self.h - self.h_0) * C_L) * self.c / self.l
        alpha = (C_L - tail) / self.a
        delta_e = (tail / self.tail_share - alpha * (1 - self.epsilon) - self.i_t) / self.tau
        return alpha, delta_e, pressure * self.coefficients(alpha, delta_e)[1]

    def basic_motion(self):
        _, delta_e, T = self.trim()
        return {"x": {"u": self.U}, "u": {"delta_e": delta_e, "T": T}}

    def angle(self, x):
        return self.trim()[0] + angle_of_attack(x.u, x.w)

    def lift_drag_moment(self, x, dx, u):
        V = sqrt(x.u**2 + x.w**2)
        rate_of_alpha = (x.u * dx.w - x.w * dx.u) / V**2
        turning = (self.l_t * x.q + self.epsilon * self.l * rate_of_alpha) / V
        C_L, C_D, C_M = self.coefficients(self.angle(x), u.delta_e, turning)
        pressure = self.rho * V**2 / 2 * self.S
        return pressure * C_L, pressure * C_D, pressure * self.c * C_M

    def equations(self, x, dx, u):
        L, D, M = self.lift_drag_moment(x, dx, u)
        V = sqrt(x.u**2 + x.w**2)
        X = u.T + (L * x.w - D * x.u) / V
        Z = -(L * x.u + D * x.w) / V
        return (
            self.m * (dx.u + x.q * x.w + self.g * sin(x.theta)) - X,
            self.m * (dx.w - x.q * x.u - self.g * cos(x.theta)) - Z,
            self.I_yy * dx.q - M,
            dx.theta - x.q,
        )

    def outputs(self, x, u):
        alpha = self.angle(x)
        C_L, _, C_M = self.coefficients(alpha, u.delta_e)
        return {"alpha": alpha, "C_L": C_L, "C_M": C_M}

    def drawing(self, x):
        travel = x.u * cos(x.theta) + x.w * sin(x.theta), x.u * sin(x.theta) - x.w * cos(x.theta), 0
        return Drawing("side", airplane_side(1.8 * self.l, angle=x.theta), travel=travel)
