"""Transfer functions: against the book's, python-control's and the state equations'."""

import numpy as np
import pytest
import sympy as sp

from ucrit import UcritError, find_model, frequency_response, load, modes
from ucrit.analyses.linear.transfer import transfer
from ucrit.analyses.results.convert import to_control

VEHICLES = ["understeering-car", "oversteering-car-on-the-road", "released-steering-wheel", "car-and-caravan",
            "caravan-active-steering"]  # fmt: skip
C_f, C_r, m, I_z, a, b, U, s = sp.symbols("C_f C_r m I_z a b U s", positive=True)
NAMES = {x.name: x for x in (C_f, C_r, m, I_z, a, b, U, s)}


def expression(function):
    return sp.sympify(function.text, locals=NAMES)


def pairs():
    for name in VEHICLES:
        model = type(load(name)).declaration
        states = [v.label(k) for v in model.variables.values() for k in range(v.order)]
        for input in model.inputs:
            for output in (*states, *model.outputs):
                yield name, input, output


@pytest.mark.parametrize(("name", "input", "output"), [*pairs()])
def test_against_python_control(name, input, output):
    vehicle = load(name)
    system = to_control(vehicle)
    points = 1j * np.logspace(-2, 3, 40)
    full = system(points)
    expected = full[system.output_labels.index(output), system.input_labels.index(input)]
    scale = np.abs(expected).max()
    assert transfer(vehicle, input, output)(points) == pytest.approx(expected, rel=1e-9, abs=1e-11 * scale)


@pytest.mark.parametrize("name", [*VEHICLES, "neutral-car", "navion"])
def test_handed_over_in_one_call(name):
    vehicle, points = load(name), 2j * np.pi * np.geomspace(0.01, 10, 20)
    declared = type(vehicle).declaration
    outputs = [*declared.variables, *declared.outputs]
    for input in declared.inputs:
        response = frequency_response(vehicle, input, outputs, points.imag / (2 * np.pi))
        for output in outputs:
            function = transfer(vehicle, input, output)
            system = function.to_control()
            assert (system.input_labels, system.output_labels) == ([input], [output])
            scale = np.abs(response[output]).max()
            assert system(points) == pytest.approx(response[output], rel=1e-9, abs=1e-11 * scale)
            _, values = function.to_scipy().freqresp(points.imag)
            assert values == pytest.approx(response[output], rel=1e-9, abs=1e-11 * scale)


@pytest.mark.parametrize("hand_over", ["to_control", "to_scipy"])
def test_symbols_and_arrays_are_not_handed_over(hand_over):
    with pytest.raises(UcritError, match="numbers need a vehicle"):
        getattr(transfer(find_model("car"), "delta_f", "r"), hand_over)()
    several = load("understeering-car").with_(m=[1000.0, 2000.0])
    with pytest.raises(UcritError, match="give one value each for m"):
        getattr(transfer(several, "delta_f", "r"), hand_over)()


def test_the_books_transfer_functions():
    delta = m * I_z * s**2 + (m * (a**2 * C_f + b**2 * C_r) + I_z * (C_f + C_r)) / U * s
    delta += (a + b) ** 2 * C_f * C_r / U**2 + m * (b * C_r - a * C_f)
    book = {
        ("delta_f", "r"): (m * a * C_f * s + (a + b) * C_f * C_r / U) / delta,
        ("delta_r", "r"): -(m * b * C_r * s + (a + b) * C_f * C_r / U) / delta,
        ("delta_f", "a_y"): (C_f * I_z * s**2 + b * (a + b) * C_f * C_r / U * s + (a + b) * C_f * C_r) / delta,
        ("delta_r", "a_y"): (C_r * I_z * s**2 + a * (a + b) * C_f * C_r / U * s - (a + b) * C_f * C_r) / delta,
    }
    for (input, output), expected in book.items():
        assert sp.simplify(expression(transfer(find_model("car"), input, output)) - expected) == 0


def test_neutral_car_loses_a_pole_in_symbols():
    found = transfer(find_model("car"), "delta_f", "r", where={"C_r": "a*C_f/b"})
    expected = a * C_f / (I_z * s + a * (a + b) * C_f / U)
    assert sp.simplify(expression(found) - expected) == 0
    assert len(found.cancelled) == 1
    assert "is not seen" in str(found)
    rear = transfer(find_model("car"), "delta_r", "r", where={"C_r": "a*C_f/b"})
    assert sp.simplify(expression(rear) + expected) == 0


def test_neutral_car_loses_a_pole_in_numbers():
    car = load("neutral-car")
    found = transfer(car, "delta_f", "r")
    (pole,) = found.cancellations()
    assert pole.real == pytest.approx(-(car.C_f + car.C_r) / (car.m * car.U), rel=1e-9)
    assert "is cancelled by a zero" in str(found)
    assert transfer(load("understeering-car"), "delta_f", "r").cancellations() == []


def test_rear_steering_answers_the_wrong_way_first():
    rear, front = (transfer(load("understeering-car"), steer, "a_y") for steer in ("delta_r", "delta_f"))
    assert rear.non_minimum_phase
    assert not front.non_minimum_phase
    assert "starts opposite to where it ends" in str(rear)
    (zero,) = rear.zeros[rear.zeros.real > 0]
    car = load("understeering-car")
    length, inertia = car.a + car.b, car.I_z * car.U / car.C_f
    root = (-car.a * length + np.sqrt((car.a * length) ** 2 + 4 * inertia * car.U * length)) / (2 * inertia)
    assert zero == pytest.approx(root, rel=1e-12)


def test_static_gain_and_integration():
    car = load("understeering-car")
    K = car.m * (car.b * car.C_r - car.a * car.C_f) / ((car.a + car.b) * car.C_f * car.C_r)
    gain = car.U / (car.a + car.b + K * car.U**2)
    assert transfer(car, "delta_f", "r").static_gain == pytest.approx(gain, rel=1e-12)
    road = transfer(load("oversteering-car-on-the-road"), "delta_f", "psi")
    assert np.isinf(road.static_gain)
    assert "integrated" in str(road)


def test_poles_are_the_eigenvalues():
    for name in ("understeering-car", "released-steering-wheel", "car-and-caravan"):
        vehicle = load(name)
        input = next(iter(type(vehicle).declaration.inputs))
        assert np.sort_complex(transfer(vehicle, input, "a_y").poles) == pytest.approx(
            np.sort_complex(modes(vehicle).eigenvalues), rel=1e-9
        )


def test_arrays_of_parameters_and_frequencies():
    U = np.linspace(10, 40, 4)
    points = 2j * np.pi * np.array([0.1, 1.0, 3.0])
    both = transfer(load("understeering-car").with_(U=U), "delta_f", "r")
    assert both(points).shape == (4, 3)
    for i, speed in enumerate(U):
        one = transfer(load("understeering-car").with_(U=speed), "delta_f", "r")
        assert both(points)[i] == pytest.approx(one(points), rel=1e-14)
        assert both.static_gain[i] == pytest.approx(one.static_gain, rel=1e-14)
    with pytest.raises(UcritError, match="one vehicle"):
        _ = both.poles


def test_a_number_for_a_parameter():
    found = transfer(load("oversteering-car"), "delta_f", "r", where={"C_r": 90e3})
    expected = transfer(load("oversteering-car").with_(C_r=90e3), "delta_f", "r")
    assert found(1j) == pytest.approx(expected(1j), rel=1e-14)


def test_texts():
    found = transfer(find_model("car"), "delta_f", "r", where={"C_r": "a*C_f/b"})
    assert found.text == "(C_f*U*a)/(I_z*U*s + C_f*a*(a + b))"
    assert found.latex == r"\frac{C_{f} U a}{I_{z} U s + C_{f} a \left(a + b\right)}"
    assert found._repr_html_().startswith('<math display="block"><mfrac>')
    assert found.unit == "rad/s/rad"


@pytest.mark.parametrize(
    ("arguments", "options", "message"),
    [
        (("delta_ff", "r"), {}, "car: there is no input 'delta_ff'; did you mean 'delta_f'?"),
        (("delta_f", "rr"), {}, "car: there is no output 'rr'; did you mean 'r'?"),
        (("delta_f", "r"), {"where": {"Cr": 1}}, "car: there is no parameter 'Cr'; did you mean 'C_r'?"),
        (("delta_f", "r"), {"where": {"C_r": "a*X"}}, "car: C_r: the formula 'a*X' uses 'X'"),
        (("../x", "r"), {}, "car: there is no input '../x'"),
    ],
)
def test_refusals(arguments, options, message):
    with pytest.raises(UcritError) as error:
        transfer(find_model("car"), *arguments, **options)
    assert str(error.value).startswith(message)


def test_numbers_need_a_vehicle():
    with pytest.raises(UcritError, match="numbers need a vehicle"):
        _ = transfer(find_model("car"), "delta_f", "r").poles
