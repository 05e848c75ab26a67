"""Responses over frequency and time: against python-control and against each other."""

import warnings

import numpy as np
import pytest

from ucrit import UcritError, load
from ucrit.analyses.linear.response import frequency_response, impulse_response, step_response
from ucrit.analyses.linear.transfer import transfer
from ucrit.analyses.results.convert import to_control

CASES = [("understeering-car", "delta_r"), ("car-and-caravan", "delta_f"), ("released-steering-wheel", "tau"),
         ("oversteering-car-on-the-road", "delta_f"), ("caravan-active-steering", "omega")]  # fmt: skip


@pytest.mark.parametrize(("name", "input"), CASES)
def test_frequency_response_against_python_control(name, input):
    vehicle = load(name)
    system = to_control(vehicle)
    found = frequency_response(vehicle, input)
    expected = system(2j * np.pi * found.frequencies)[:, system.input_labels.index(input), :].T
    assert found.outputs == tuple(system.output_labels)
    assert found.values == pytest.approx(expected, rel=1e-10, abs=1e-12 * np.abs(expected).max())


@pytest.mark.parametrize(("name", "input"), CASES)
@pytest.mark.parametrize("kind", ["step", "impulse"])
def test_time_responses_against_python_control(name, input, kind):
    import control

    vehicle = load(name)
    system = to_control(vehicle)
    found = (step_response if kind == "step" else impulse_response)(vehicle, input)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of the impulse that passes straight through
        theirs = getattr(control, f"{kind}_response")(system, found.times, input=system.input_labels.index(input))
    expected = theirs.y[:, 0, :].T
    assert found.values[1:] == pytest.approx(expected[1:], rel=1e-8, abs=1e-9 * np.abs(expected).max())


def test_frequency_response_is_the_transfer_function():
    vehicle = load("car-and-caravan")
    found = frequency_response(vehicle, "delta_f", ["theta", "r_t"], [0.1, 0.5, 2.0])
    for output in ("theta", "r_t"):
        points = 2j * np.pi * found.frequencies
        assert found[output] == pytest.approx(transfer(vehicle, "delta_f", output)(points), rel=1e-10)


def test_step_is_the_integral_of_the_impulse():
    vehicle, times = load("understeering-car"), np.linspace(0, 1, 4001)
    step, kick = (f(vehicle, "delta_f", "r", times)["r"] for f in (step_response, impulse_response))
    integral = np.concatenate([[0], np.cumsum((kick[1:] + kick[:-1]) / 2 * np.diff(times))])
    assert step == pytest.approx(integral, abs=1e-6 * step.max())


def test_final_values_are_static_gains():
    for output in ("r", "a_y", "beta"):
        found = step_response(load("understeering-car"), "delta_f", output, size=0.02)
        gain = transfer(load("understeering-car"), "delta_f", output).static_gain
        assert found.final[0] == pytest.approx(0.02 * gain, rel=1e-12)
        assert found[output][-1] == pytest.approx(found.final[0], rel=1e-3)


def test_an_unstable_car_has_no_final_value():
    fast = load("oversteering-car", {"U": 50})
    assert np.isnan(step_response(fast, "delta_f").final).all()
    assert not frequency_response(fast, "delta_f", frequencies=1.0).stable
    grown = step_response(fast, "delta_f", "r")["r"]
    assert grown[-1] > grown[200] > 0


def test_rear_steering_starts_opposite():
    rear, front = (step_response(load("understeering-car"), steer, "a_y") for steer in ("delta_r", "delta_f"))
    assert rear.starts_opposite("a_y")
    assert rear["a_y"][0] * rear["a_y"][-1] < 0
    assert not front.starts_opposite("a_y")


def test_direct_part_of_an_impulse_is_told():
    car = load("understeering-car")
    found = impulse_response(car, "delta_f", "a_y", size=0.1)
    assert found.direct[0] == pytest.approx(0.1 * car.C_f / car.m, rel=1e-12)


def test_array_parameters_lead():
    U = np.array([15.0, 25.0, 35.0])
    cars = load("understeering-car").with_(U=U)
    times, frequencies = np.linspace(0, 2, 7), np.array([0.2, 1.0])
    steps = step_response(cars, "delta_f", ["r", "a_y"], times)
    waves = frequency_response(cars, "delta_f", ["r", "a_y"], frequencies)
    assert steps.values.shape == (3, 7, 2)
    assert waves.values.shape == (3, 2, 2)
    for i, speed in enumerate(U):
        one = load("understeering-car").with_(U=speed)
        assert steps.values[i] == pytest.approx(step_response(one, "delta_f", ["r", "a_y"], times).values, rel=1e-12)
        wave = frequency_response(one, "delta_f", ["r", "a_y"], frequencies)
        assert waves.values[i] == pytest.approx(wave.values, rel=1e-12)
    assert steps.overshoot("r").shape == (3,)
    assert steps.to_xarray()["r"].sizes == {"U": 3, "time": 7}
    assert waves.to_dataframe().shape[0] == 6


def test_gain_phase_and_peak():
    found = frequency_response(load("understeering-car"), "delta_f", "r")
    assert found.gain_db("r") == pytest.approx(20 * np.log10(found.gain("r")))
    assert np.abs(np.diff(found.phase_deg("r"))).max() < 20
    frequency, size = found.peak("r")
    assert size == found.gain("r").max()
    assert 0.3 < frequency < 1.5


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda car: step_response(car, "delta_ff"), "car: there is no input 'delta_ff'; did you mean 'delta_f'?"),
        (lambda car: step_response(car, "delta_f", "rr"), "car: there is no output 'rr'; did you mean 'r'?"),
        (lambda car: step_response(car, "delta_f", times=[-1]), "times must be a list of finite numbers"),
        (lambda car: step_response(car, "delta_f", times="now"), "times must be a list of numbers, got 'now'"),
        (lambda car: frequency_response(car, "delta_f", frequencies=[0.0]), "frequencies must be a list of finite"),
        (lambda car: step_response(car, "delta_f", "r")["a_y"], "the response has no output 'a_y'"),
    ],
)
def test_refusals(call, message):
    with pytest.raises(UcritError) as error:
        call(load("understeering-car"))
    assert str(error.value).startswith(message)
