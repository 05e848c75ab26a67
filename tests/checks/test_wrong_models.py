"""No check that cannot fail: each is shown a model that is wrong in just the way it looks for."""

import pytest

from ucrit.checks import check_model
from ucrit.core import Model, coordinate, cos, input, output, param, sin, speed, state
from ucrit.core.numeric import compiled as core_compiled
from ucrit.core.numeric import motion as core_motion
from ucrit.models.car import Car
from ucrit.models.trailer import Trailer
from ucrit.models.trailer_kinematic import TrailerKinematic
from ucrit.models.trailer_rigid_tire import TrailerRigidTire


class Slider(Model):
    """Mass on a spring with a force on it (written for this test, 2024)."""

    m: float = param("kg", "mass", above=0)
    d: float = param("kg/m", "drag", at_least=0)
    k: float = param("N/m", "stiffness", above=0)
    y = coordinate("m", "position")
    F = input("N", "force")
    power = output("W", "power of the force")

    def equations(self, x, dx, ddx, u):
        return self.m * ddx.y + self.d * abs(dx.y) * dx.y + self.k * x.y - u.F

    def outputs(self, x, dx, u):
        return {"power": u.F * dx.y}

    even = ("power",)


class Pendulum(Model):
    """Pendulum of varying length, by forces and by energies (written for this test, 2024)."""

    m: float = param("kg", "mass", above=0)
    k: float = param("N/m", "stiffness", above=0)
    g: float = param("m/s^2", "gravity", above=0)
    l: float = param("m", "length at rest", above=0)
    z = coordinate("m", "extension")
    phi = coordinate("rad", "angle")
    even = ("z",)

    def kinetic_energy(self, x, dx):
        return self.m * (dx.z**2 + (self.l + x.z) ** 2 * dx.phi**2) / 2

    def potential_energy(self, x):
        rest = self.m * self.g / self.k
        return self.k * (x.z + rest) ** 2 / 2 - self.m * self.g * (self.l + x.z) * cos(x.phi)

    def equations(self, x, dx, ddx):
        length = self.l + x.z
        return (
            self.m * (ddx.z - length * dx.phi**2) + self.k * x.z + self.m * self.g * (1 - cos(x.phi)),
            length * ddx.phi + 2 * dx.z * dx.phi + self.g * sin(x.phi),
        )

    def conserved(self, x, dx):
        return {"energy": self.kinetic_energy(x, dx) + self.potential_energy(x)}


def failing(model, **options):
    return [check.name for check in check_model(model, **options).failed]


@pytest.mark.parametrize("model", [Slider, Pendulum])
def test_right_models_pass(model):
    report = check_model(model)
    assert report.ok, str(report)


def test_class_without_description():
    class Bare(Slider):
        pass

    assert failing(Bare) == ["declarations"]


def test_description_without_source():
    class Unsourced(Slider):
        """Mass on a spring."""

    assert failing(Unsourced) == ["declarations"]


def test_quantity_without_meaning():
    class Meaningless(Slider):
        """Slider, 2024."""

        d: float = param("kg/m", " ", at_least=0)

    assert failing(Meaningless) == ["declarations"]


def test_default_out_of_bounds():
    class Defaulted(Slider):
        """Slider, 2024."""

        d: float = param("kg/m", "drag", at_least=0, default=-1)

    assert failing(Defaulted) == ["declarations"]


def test_wrong_unit_stops_the_rest():
    class Clash(Slider):
        """Slider, 2024."""

        d: float = param("kg/s", "drag", at_least=0)

    report = check_model(Clash)
    assert [check.name for check in report.failed] == ["equations"]
    assert "unlike units" in report.failed[0].detail
    assert all(check.passed is None for check in report.checks[2:])


def test_basic_motion_that_is_none():
    class Sagging(Slider):
        """Slider, 2024."""

        def equations(self, x, dx, ddx, u):
            return self.m * ddx.y + self.k * (x.y + self.m * self.k / self.d**2) - u.F

    assert failing(Sagging) == ["equations"]


def test_equations_that_raise_something_else():
    class Broken(Slider):
        """Slider, 2024."""

        def equations(self, x, dx, ddx, u):
            return self.m * ddx.y + undefined  # noqa: F821

    report = check_model(Broken)
    assert report.failed[0].detail == "NameError: name 'undefined' is not defined"


@pytest.mark.parametrize("unused", ["d", "F", "rate"])
def test_declared_and_never_used(unused):
    class Partly(Slider):
        """Slider, 2024."""

        def equations(self, x, dx, ddx, u):
            drag = 0 if unused == "d" else self.d * abs(dx.y) * dx.y
            inertia = 0 if unused == "rate" else self.m * ddx.y
            return inertia + drag + self.k * x.y + self.m * self.k / self.m * x.y * 0 - (0 if unused == "F" else u.F)

        def outputs(self, x, dx, u):
            return {"power": self.k * x.y * dx.y}

    assert "everything is used" in failing(Partly)


def test_sign_error_in_a_force():
    class Pushed(Trailer):
        """Trailer whose tire force has the wrong sign, 2024."""

        def forces(self, x, dx):
            (force, lateral), damper = super().forces(x, dx)
            return (-force, lateral), damper

    assert "further derivations" in failing(Pushed)


def test_derivation_that_differs_in_the_nonlinear_motion_only():
    class Second(Trailer):
        """Trailer without the centripetal term in its second derivation, 2024."""

        def equations_newton(self, x, dx, ddx):
            force, moment = super().equations_newton(x, dx, ddx)
            return force + self.m * self.a * dx.theta**2 * sin(x.theta), moment

    report = check_model(Second)
    assert [check.detail for check in report.failed] == ["equations_newton gives another x'' in the non-linear motion"]


def test_constrained_derivation_that_differs():
    class Second(TrailerRigidTire):
        """Trailer with another damper in its second derivation, 2024."""

        def equations_newton(self, x, dx, ddx):
            constraint, moment = super().equations_newton(x, dx, ddx)
            return constraint, moment + self.c * dx.theta

    assert failing(Second) == ["further derivations"]


def test_older_derivation_is_of_another_model():
    class Simplified(TrailerKinematic):
        """Trailer without slip, again, 2024."""

        def equations_again(self, x, dx):
            return dx.theta + self.U * sin(x.theta) / (self.a + self.b)

    class Stated(Simplified):
        """Trailer on an elastic string, 2024."""

        def equations(self, x, dx):
            return (self.a + self.b) * dx.theta + 2 * self.U * sin(x.theta)

    assert failing(Simplified) == []
    assert failing(Stated) == []


def test_hidden_number_with_a_unit(monkeypatch):
    class Hidden(Slider):
        """Slider with gravity as a number, 2024."""

        def equations(self, x, dx, ddx, u):
            return self.m * ddx.y + self.d * abs(dx.y) * dx.y + (self.k + 9.81 * self.d) * x.y - u.F

    assert failing(Hidden) == ["equations"]
    monkeypatch.setattr("ucrit.core.derivation.trace.check_dimensions", lambda traced: None)
    assert failing(Hidden) == ["change of units"]


def test_hidden_number_in_the_nonlinear_motion(monkeypatch):
    class Hidden(Slider):
        """Slider with a speed as a number, 2024."""

        def equations(self, x, dx, ddx, u):
            return self.m * ddx.y + self.d * dx.y**3 + self.k * x.y - u.F

    monkeypatch.setattr("ucrit.core.derivation.trace.check_dimensions", lambda traced: None)
    assert failing(Hidden) == ["change of units"]


def test_asymmetric_motion():
    class Lopsided(Slider):
        """Slider with drag to one side, 2024."""

        def equations(self, x, dx, ddx, u):
            return self.m * ddx.y + self.d * dx.y**2 + self.k * x.y - u.F

    assert failing(Lopsided) == ["mirror symmetry"]

    class Declared(Lopsided):
        """Slider that says so, 2024."""

        mirror = False

    assert failing(Declared) == []


def test_asymmetric_output_and_misspelt_even():
    class Odd(Slider):
        """Slider whose output has no side and does not say so, 2024."""

        even = ()

    class Misspelt(Slider):
        """Slider, 2024."""

        even = ("powr",)

    assert failing(Odd) == ["mirror symmetry"]
    assert check_model(Misspelt).failed[0].detail == "even names 'powr'; did you mean 'power'?"


def test_energy_and_conserved_quantity_that_change():
    class Centripetal(Pendulum):
        """Pendulum whose spring feels no centripetal force, 2024."""

        kinetic_energy = Pendulum.kinetic_energy

        def equations(self, x, dx, ddx):
            spring, swing = super().equations(x, dx, ddx)
            return spring + self.m * (self.l + x.z) * dx.phi**2, swing

    assert failing(Centripetal) == ["energy balance", "conserved quantities"]


def test_compiled_functions_that_differ(monkeypatch):
    original = core_compiled.Compiled.coefficients.func
    changed = lambda self: lambda p: (2 * original(self)(p)[0], *original(self)(p)[1:])  # noqa: E731
    monkeypatch.setattr(core_compiled.Compiled, "coefficients", property(changed))
    assert "compiled functions" in failing(TrailerKinematic)


def test_compiled_matrices_that_differ(monkeypatch):
    original = core_compiled.Compiled.blocks
    monkeypatch.setattr(core_compiled.Compiled, "blocks", lambda self, p: [2 * M for M in original(self, p)])
    assert failing(TrailerKinematic) == ["compiled functions"]


@pytest.mark.parametrize("model", [Car, TrailerRigidTire])
def test_linearisation_that_differs(monkeypatch, model):
    original = core_motion.Motion.rhs
    monkeypatch.setattr(core_motion.Motion, "rhs", lambda self, w, u, p: 1.001 * original(self, w, u, p))
    assert failing(model) == ["bond graph in motion", "linearisation"]


def test_derived_criterion_of_another_model(monkeypatch):
    from ucrit.checks import stability

    real = stability.criteria
    monkeypatch.setattr(stability, "criteria", lambda model, direction: real(model, direction=-direction))
    assert failing(TrailerKinematic) == ["derived criterion"]


def test_vehicle_gives_the_centre_of_the_random_parameters():
    slider = Slider(m=1e6, d=1, k=1)
    assert check_model(slider).ok


def test_model_with_longitudinal_motion_needs_even():
    class Rolling(Model):
        """Mass that rolls at a speed of its own (written for this test, 2024)."""

        m: float = param("kg", "mass", above=0)
        c: float = param("N s/m", "drag", above=0)
        U: float = speed("forward speed")
        v = state("m/s", "forward velocity")
        w = state("m/s", "lateral velocity")

        def basic_motion(self):
            return {"x": {"v": self.U}}

        def equations(self, x, dx):
            return self.m * dx.v + self.c * (x.v - self.U), self.m * dx.w + self.c * x.w * x.v / self.U

    class Even(Rolling):
        """Mass that rolls (2024)."""

        even = ("v",)

    assert failing(Rolling) == ["mirror symmetry"]
    assert failing(Even) == []


class TwoWheels(Model):
    """Two spinning wheels, left and right, that a plate couples, made for a test in 2026."""

    I: float = param("kg m^2", "inertia", above=0)
    c: float = param("N m s", "damping", above=0)
    d: float = param("N m s^3", "drag", above=0)

    omega_l = state("1/s", "spin on the left")
    omega_r = state("1/s", "spin on the right")

    even = ("omega_l", "omega_r")
    sides = (("omega_l", "omega_r"),)

    def equations(self, x, dx):
        shared = self.c * (x.omega_l - x.omega_r)
        return self.I * dx.omega_l + self.d * x.omega_l**3 + shared, self.I * dx.omega_r - shared + self.drag(x)

    def drag(self, x):
        return self.d * x.omega_r**3


def test_pairs_change_sides_in_the_mirror():
    class OneSide(TwoWheels):
        """A wheel that drags more than the other, made for a test in 2026."""

        def drag(self, x):
            return 2 * self.d * x.omega_r**3

    class Misnamed(TwoWheels):
        """A pair that is not there, made for a test in 2026."""

        sides = (("omega_l", "omega_x"),)

    found = {c.name: c for c in check_model(TwoWheels).checks}["mirror symmetry"]
    assert found.passed
    assert any("the rate of omega" in c.detail for c in check_model(OneSide).failed)
    assert any("sides names 'omega_x'" in c.detail for c in check_model(Misnamed).failed)
