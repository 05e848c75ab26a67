"""Slots: a model's force laws can be exchanged, and their parameters are the model's."""

import pickle

import numpy as np
import pytest

import ucrit
from ucrit import Model, UcritError, input, output, param, speed, state
from ucrit.catalogue import find_part, part_names
from ucrit.core.contract.part import Part, slot
from ucrit.core.numeric.motion import motion
from ucrit.parts.tires import Tire, slip_angle
from ucrit.parts.tires.brush import Brush
from ucrit.parts.tires.linear import Linear


class Sledge(Model):
    """One body on one tire."""

    m: float = param("kg", "mass", above=0)
    W: float = param("N", "load", above=0)
    tire = slot(Brush, "the tire")
    U: float = speed()

    V = state("m/s", "lateral velocity")
    delta = input("rad", "steer angle")
    a_y = output("m/s^2", "lateral acceleration")

    def equations(self, x, dx, u):
        return self.m * dx.V - self.tire.side_force(self.W, slip_angle(x.V, self.U) - u.delta)

    def outputs(self, dx):
        return {"a_y": dx.V}


SLEDGE = Sledge(m=10, W=100, tire_C=1000, tire_mu=0.5, U=5)


def test_a_slot_declares_the_parameters_of_its_law():
    assert list(Sledge.declaration.parameters) == ["m", "W", "tire_C", "tire_mu", "U"]
    assert SLEDGE.tire == Brush(C=1000, mu=0.5)
    with pytest.raises(UcritError, match=r"the tire: cornering coefficient tire_C must be above 0 N/rad, got -1"):
        SLEDGE.with_(tire_C=-1)


def test_another_law_makes_another_class_and_back():
    linear = Sledge.fitted(tire=Linear)
    assert linear is Sledge.fitted(tire=Linear) is not Sledge
    assert linear.fitted(tire=Brush) is Sledge
    assert "tire_mu" not in linear.declaration.parameters
    vehicle = linear(m=10, W=100, tire_C=1000, U=5)
    assert pickle.loads(pickle.dumps(vehicle)) == vehicle
    np.testing.assert_allclose(ucrit.modes(vehicle).eigenvalues, ucrit.modes(SLEDGE).eigenvalues)


def test_laws_with_constants_are_the_same_class_for_the_same_constants():
    law = Brush.of({"shape": 1.5})
    assert law is Brush.of({"shape": 1.5})
    assert law is not Brush.of({"shape": 1.6})
    assert pickle.loads(pickle.dumps(law(C=1.0))) == law(C=1.0)
    vehicle = Sledge.fitted(tire=law)(m=10, W=100, tire_C=1000, tire_mu=0.5, U=5)
    assert type(pickle.loads(pickle.dumps(vehicle))) is type(vehicle)


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        (lambda: Sledge.fitted(tyre=Linear), r"there is no slot 'tyre' for a part; did you mean 'tire'\?"),
        (lambda: Sledge.fitted(tire=Part), "the tire tire must be a Tire, got Part"),
        (lambda: Brush(C=1, nu=2), "brush: there is no parameter 'nu'"),
        (lambda: Brush(), "brush: cornering coefficient C is missing; it must be above 0 N/rad"),
        (lambda: find_part("bruhs", Tire), r"there is no tire law 'bruhs'; did you mean 'brush'\?"),
    ],
)
def test_what_does_not_fit_is_refused(wrong, message):
    with pytest.raises(UcritError, match=message):
        wrong()


def test_the_catalogue_finds_laws_by_their_file():
    assert {"brush", "linear"} <= set(part_names(Tire))
    assert find_part("brush", Tire) is Brush


def test_slopes_of_the_motion_are_those_of_differences():
    made, arguments, h = motion(Sledge), SLEDGE.arguments(), 1e-6
    w, u = np.array([[0.1, 0.4, -3.0]]), np.array([[0.02, 0.01, 0.0]])
    slopes = made.slopes(w, u, arguments)

    def rates(dw=0.0, du=0.0, **changes):
        return made.rhs(w + dw, u + du, SLEDGE.with_(**changes).arguments())[0]

    np.testing.assert_allclose(slopes.A[:, 0, 0], (rates(dw=h) - rates(dw=-h)) / (2 * h), rtol=1e-6, atol=1e-9)
    np.testing.assert_allclose(slopes.B[:, 0, 0], (rates(du=h) - rates(du=-h)) / (2 * h), rtol=1e-6, atol=1e-9)
    np.testing.assert_allclose(slopes.D, slopes.B)
    steps = {name: value * h for name, value in SLEDGE.values.items()}
    for i, (name, step) in enumerate(steps.items()):
        up, down = (rates(**{name: SLEDGE.values[name] + s}) for s in (step, -step))
        np.testing.assert_allclose(slopes.E[:, 0, i], (up - down) / (2 * step), rtol=1e-5, atol=1e-9)


def test_equations_are_shown_with_the_forces_as_functions():
    (equation,) = ucrit.show(Sledge).equations
    assert "F_y_tire(W, atan(V/U) - delta)" in str(equation)
    assert "tire_mu" not in str(equation)
