"""A vehicle under control is a vehicle: its equations are the vehicle's with the law in place of its inputs."""

import pickle

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

import ucrit
from ucrit import Model, ModelError, UcritError, input, load, output, param, speed, state
from ucrit.catalogue import load as load_vehicle
from ucrit.control import Controller, close, closed
from ucrit.core.contract.files import write_vehicle
from ucrit.core.derivation.derive import symbolic
from ucrit.core.numeric.compiled import state_space
from ucrit.models.car import Car
from ucrit.models.lean import Lean


class YawFeedback(Controller):
    """Front steering by state feedback."""

    drives = ("delta_f",)
    K_V: float = param("s/m", "gain of the lateral velocity")
    K_r: float = param("s", "gain of the yaw rate")
    demand = input("rad", "steer angle that the driver wants")

    def law(self, x, u):
        return {"delta_f": u.demand - self.K_V * x.V - self.K_r * x.r}


class Lag(Controller):
    """Steering actuator that follows slowly."""

    drives = ("delta_f",)
    tau: float = param("s", "time constant", above=0)
    actual = state("rad", "angle that is reached")
    wanted = input("rad", "angle that is wanted")
    error = output("rad", "what is missing")

    def law(self, x):
        return {"delta_f": x.actual}

    def equations(self, x, dx, u):
        return self.tau * dx.actual + x.actual - u.wanted

    def outputs(self, x, u):
        return {"error": u.wanted - x.actual}


class AccelerationFeedback(Controller):
    """Front steering by the lateral acceleration, which depends on the steer angle."""

    drives = ("delta_f",)
    G: float = param("rad s^2/m", "gain")

    def law(self, y):
        return {"delta_f": self.G * y.a_y}


CAR = load("bmw-320i")


@settings(max_examples=25, deadline=None)
@given(K_V=st.floats(-0.2, 0.2), K_r=st.floats(-0.5, 0.5), U=st.floats(5, 60))
def test_state_feedback_gives_a_minus_b_k(K_V, K_r, U):
    car = CAR.with_(U=U)
    plant = state_space(car)
    expected = plant.A - plant.B[:, :1] @ np.array([[K_V, K_r]])
    found = state_space(close(car, YawFeedback, K_V=K_V, K_r=K_r))
    np.testing.assert_allclose(found.A, expected, rtol=1e-9, atol=1e-9 * abs(expected).max())


def test_an_actuator_adds_its_state_and_a_law_drives_it():
    class Demand(YawFeedback):
        drives = ("wanted",)

        def law(self, x, u):
            return {"wanted": u.demand - self.K_V * x.V - self.K_r * x.r}

    slow = close(CAR, Lag, Demand, tau=1e-7, K_V=0.01, K_r=0.1)
    quick = close(CAR, YawFeedback, K_V=0.01, K_r=0.1)
    assert list(type(slow).declaration.variables) == ["V", "r", "actual"]
    assert list(type(slow).declaration.inputs) == ["delta_r", "demand"]
    assert {"wanted", "error", "delta_f", "a_y"} <= set(type(slow).declaration.outputs)
    eigenvalues = ucrit.modes(slow).eigenvalues
    near = sorted(eigenvalues, key=abs)[:2]
    np.testing.assert_allclose(
        sorted(near, key=np.imag), sorted(ucrit.modes(quick).eigenvalues, key=np.imag), rtol=1e-4
    )


def test_feedback_through_an_output_that_depends_on_the_input_is_solved():
    G, s = 0.001, state_space(CAR)
    place = list(type(CAR).declaration.outputs).index("a_y")
    C, D = s.C[place : place + 1], s.D[place, 0]
    expected = s.A + s.B[:, :1] @ C * G / (1 - G * D)
    np.testing.assert_allclose(state_space(close(CAR, AccelerationFeedback, G=G)).A, expected, rtol=1e-10)


def test_the_book_s_criterion_for_steering_into_the_lean():
    moving = load("motorcycle-steered-to-lean")
    criterion = str(ucrit.criteria(moving))
    assert "G*U**2 - g*(a + b) > 0" in criterion
    a = symbolic(type(moving)).polynomial.expressions
    G, U, g, wheelbase = sp.Symbol("G"), *sp.symbols("U g a", positive=True)
    assert G in {sp.Symbol(s.name) for s in a[0].free_symbols}
    assert U in a[0].free_symbols
    assert g in a[0].free_symbols
    assert wheelbase in a[0].free_symbols


class Lift(Model):
    """Body that a force holds up against gravity while it climbs."""

    m: float = param("kg", "mass", above=0)
    g: float = param("m/s^2", "gravity", above=0)
    c: float = param("N s^2/m^2", "drag per velocity squared", above=0)
    w: float = speed("climbing speed")

    v = state("m/s", "upward velocity")
    F = input("N", "upward force")

    def equations(self, x, dx, u):
        return self.m * (dx.v + self.g) + self.c * x.v**2 - u.F

    def basic_motion(self):
        return {"x": {"v": self.w}, "u": {"F": self.m * self.g + self.c * self.w**2}}


def test_the_basic_motion_of_the_vehicle_is_kept():
    class Governor(Controller):
        """Force by the error of the velocity."""

        drives = ("F",)
        G: float = param("N s/m", "gain")

        def law(self, x, x0, u0):
            return {"F": u0.F - self.G * (x.v - x0.v)}

    lift = close(Lift(m=2, g=9.81, c=0.5, w=3), Governor, G=4)
    np.testing.assert_allclose(state_space(lift).A, -(2 * 0.5 * 3 + 4) / 2)
    assert ucrit.simulate(lift, 1, {"v": 3.0})["v"][-1] == pytest.approx(3)


def test_pickle_and_file_keep_the_loop(tmp_path):
    moving = load("motorcycle-steered-to-lean")
    assert pickle.loads(pickle.dumps(moving)) == moving
    path = tmp_path / "again.toml"
    path.write_text(write_vehicle(moving), encoding="utf-8")
    assert load_vehicle(path).values == moving.values
    assert type(load_vehicle(path)) is type(moving)


def test_what_is_impossible_for_the_vehicle_stays_so():
    moving = load("motorcycle-steered-to-lean")
    with pytest.raises(UcritError, match="no principal moment of inertia"):
        moving.with_(I_1=2 * (moving.I_2 + moving.I_3))


class Nothing(Controller):
    """Drives nothing."""


class Clashing(YawFeedback):
    """Declares a mass of another unit."""

    m: float = param("m", "not a mass")


class Odd(Controller):
    """Returns another input than it drives."""

    drives = ("delta_f",)

    def law(self):
        return {"delta_r": 0}


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        (lambda: closed(Car, Nothing), "Nothing: say which inputs"),
        (lambda: closed(Car, Clashing), "Clashing: car has a 'm' already, mass"),
        (lambda: closed(Lean, Car), "a controller must be a class derived from Controller"),
        (lambda: close(close(CAR, YawFeedback, K_V=0, K_r=0), YawFeedback), "has no input 'delta_f' to drive"),
        (lambda: close(CAR, YawFeedback, K_V=0, K=1), "there is no parameter 'K'"),
        (lambda: ucrit.modes(close(CAR, Odd)), "differ in delta_f, delta_r"),
    ],
)
def test_what_does_not_fit_is_refused(wrong, message):
    with pytest.raises((ModelError, UcritError), match=message):
        wrong()
