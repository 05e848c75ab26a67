"""Following the motion in time: against exact solutions, linear responses and other descriptions of the same."""

import json

import numpy as np
import pytest

from ucrit import UcritError, load, simulate, step_response


def test_oscillator_is_the_exact_solution():
    mass = load("driven-mass").with_(b=0.2)
    found = simulate(mass, 30, {"x": 1, "x'": -0.5})
    damping, frequency = 0.1, np.sqrt(4 - 0.1**2)
    t = found.times
    sine = (-0.5 + damping) / frequency
    expected = np.exp(-damping * t) * (np.cos(frequency * t) + sine * np.sin(frequency * t))
    assert np.abs(found["x"] - expected).max() < 1e-10


@pytest.mark.parametrize("steer", [1e-6, lambda t: 1e-6], ids=["constant", "function"])
def test_small_step_of_steer_is_the_linear_response(steer):
    car = load("understeering-car")
    times = np.linspace(0, 2, 21)
    found = simulate(car, 2, inputs={"delta_f": steer}, times=times)
    linear = step_response(car, "delta_f", times=times, size=1e-6)
    for name in ("V", "r", "a_y", "beta"):
        expected = linear[name]
        assert np.abs(found[name] - expected).max() < 1e-6 * np.abs(expected).max()
    assert np.all(found["delta_f"] == 1e-6)


def test_input_that_changes_with_time():
    car = load("bmw-320i-on-ice")
    found = simulate(car, 3, inputs={"X": lambda t: 1000 * np.sin(t), "N": "0 N m"})
    expected = car.U_0 + 1000 / car.m * (1 - np.cos(found.times))
    assert found["U"] == pytest.approx(expected, rel=1e-12)
    assert found["X"] == pytest.approx(1000 * np.sin(found.times))


def test_two_descriptions_of_one_car_move_alike():
    road = load("oversteering-car-on-the-road")
    body = load("oversteering-car").with_(**road.values)
    kick = 1e-6
    r = simulate(body, 1, {"r": kick})["r"]
    names = [name for name in simulate(road, 1).states if name.endswith("'")]
    found = simulate(road, 1, {names[-1]: kick})[names[-1]]
    assert np.abs(found - r).max() < 1e-6 * np.abs(r).max()


def test_basic_motion_goes_on():
    cart = load("supermarket-cart")
    found = simulate(cart, 5)
    assert np.all(found["v_x"] == cart.U)
    assert np.all(found["r"] == 0)


def test_constraint_is_kept_and_a_start_that_breaks_it_refused():
    cart = load("supermarket-cart").with_(U=-1.2)
    found = simulate(cart, 12, {"r": 1e-3, "v_y": cart.b * 1e-3})
    assert np.abs(found["v_y"] - cart.b * found["r"]).max() < 1e-11
    assert found["v_x"][-1] > 1
    with pytest.raises(UcritError, match=r"must keep the constraint .*v_y.* = 0, got"):
        simulate(cart, 1, {"r": 1e-3})


def test_table_and_conversions():
    found = simulate(load("bmw-320i"), 1, {"r": "1 deg/s"}, times=[0, 0.5, 1])
    assert found["r"][0] == pytest.approx(np.pi / 180)
    content = json.loads(found.to_json())
    assert content["coordinates"]["time"]["values"] == [0, 0.5, 1]
    assert content["variables"]["r"]["unit"] == "rad/s"
    frame = found.to_dataframe()
    assert list(frame.columns) == ["time", *found.states, *found.outputs, *found.inputs]
    assert frame.attrs["units"]["a_y"] == "m/s^2"
    assert found.to_xarray()["V"].dims == ("time",)


def test_rates_have_their_unit():
    found = simulate(load("bowling-ball-on-a-stick"), 1, {"theta": "1 deg"})
    units = {series.name: series.unit for series in found.table().data}
    assert units == {"theta": "rad", "theta'": "rad/s"}


def test_tolerance_is_what_it_says():
    mass = load("driven-mass").with_(b=0)
    errors = [
        abs(simulate(mass, 10, {"x": 1}, times=[10], tolerance=tolerance)["x"][0] - np.cos(20))
        for tolerance in (1e-4, 1e-8, 1e-12)
    ]
    assert errors[0] > 1e2 * errors[1] > 1e4 * errors[2]
    assert errors[2] < 1e-11


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"until": 0}, "time until must be above 0 s, got 0 s"),
        ({"until": "3 kg"}, "time until is measured in s"),
        ({"until": 1, "initial": {"thetta": 1}}, "there is no such state; did you mean 'theta'?"),
        ({"until": 1, "initial": {"theta": "1 m"}}, "initial theta is measured in rad"),
        ({"until": 1, "initial": {"theta": float("nan")}}, "initial theta must be finite, got nan"),
        ({"until": 1, "inputs": {"delta": 1}}, "there is no input 'delta'"),
        ({"until": 1, "times": [0, 2]}, "times must ascend within 0 s and 1 s"),
        ({"until": 1, "times": [1, 0]}, "times must ascend"),
        ({"until": 1, "times": "soon"}, "times must be a list of numbers"),
        ({"until": 1, "tolerance": 1e-20}, "tolerance must be within"),
        ({"until": 1, "method": "Radaw"}, "there is no method 'Radaw'; did you mean 'Radau'?"),
        ({"until": 1, "initial": {"theta": [[1]]}}, "initial theta must be a number or a one-dimensional array"),
    ],
)
def test_mistakes_are_refused_in_a_sentence(arguments, words):
    with pytest.raises(UcritError) as error:
        simulate(load("bowling-ball-on-a-stick"), **arguments)
    assert words in str(error.value)


def test_motion_that_runs_away_is_told():
    with pytest.raises(UcritError, match="cannot be followed until 1000 s: it grows without bound"):
        simulate(load("driven-mass").with_(k=-4), "1e3 s", {"x": 1})


def test_input_that_is_no_number_is_told_with_its_time():
    with pytest.raises(UcritError, match="input delta_f must be a finite number, got nan at 0 s"):
        simulate(load("bmw-320i"), 1, inputs={"delta_f": lambda t: float("nan")})


def test_arrays_of_parameters_and_starts_are_followed_together_as_one_by_one():
    caravan, times = load("caravan"), np.linspace(0, 3, 7)
    batch = simulate(caravan.with_(U=[10.0, 30.0]), 3, {"theta": [1e-3, 0.1, 0.4]}, times=times)
    assert batch.values.shape == (2, 3, 7, 4)
    for i, U in enumerate((10, 30)):
        for k, theta in enumerate((1e-3, 0.1, 0.4)):
            one = simulate(caravan.with_(U=U), 3, {"theta": theta}, times=times)
            assert np.abs(batch["theta"][i, k] - one["theta"]).max() < 1e-10
    frame = batch.to_dataframe()
    assert list(frame.columns[:3]) == ["U", "initial theta", "time"]
    assert len(frame) == 2 * 3 * 7
    assert batch.to_xarray()["x"].dims == ("U", "initial theta", "time")


def test_array_parameters_reach_outputs_and_inputs():
    car = load("bmw-320i")
    many = simulate(car.with_(m=[1000, 2000]), 1, inputs={"delta_f": "step 1 deg at 0.5 s"}, times=[0, 1])
    for k, m in enumerate((1000, 2000)):
        one = simulate(car.with_(m=m), 1, inputs={"delta_f": "step 1 deg at 0.5 s"}, times=[0, 1])
        assert many["a_y"][k] == pytest.approx(one["a_y"], rel=1e-9)
    assert many["delta_f"].shape == (2, 2)


def test_dense_output_is_the_motion_at_other_times():
    mass = load("driven-mass").with_(b=0)
    found, at = simulate(mass, 10, {"x": 1}), np.random.default_rng(3).uniform(0, 10, 50)
    assert np.abs(found.at(at)["x"] - np.cos(2 * at)).max() < 1e-11
    assert found.at(3)["x"].shape == (1,)
    with pytest.raises(UcritError, match="times must be within 0 s and 10 s, got 11"):
        found.at(11)
    with pytest.raises(UcritError, match="a batch, or a copy, is known at its times only"):
        simulate(mass.with_(m=[1, 2]), 1).at(0.5)


@pytest.mark.parametrize("method", ["Radau", "BDF", "LSODA"])
def test_other_methods_follow_the_same_motion(method):
    caravan = load("caravan")
    found = simulate(caravan, 2, {"theta": 0.2}, times=[1, 2], method=method)
    expected = simulate(caravan, 2, {"theta": 0.2}, times=[1, 2])
    assert found.method == method
    assert np.abs(found["theta"] - expected["theta"]).max() < 1e-6


def test_implicit_methods_follow_a_batch():
    caravan = load("caravan")
    batch = simulate(caravan.with_(U=[10, 20]), 1, {"theta": 0.2}, times=[1], method="Radau", tolerance=1e-7)
    one = simulate(caravan.with_(U=20), 1, {"theta": 0.2}, times=[1])
    assert batch["theta"][1] == pytest.approx(one["theta"], rel=1e-5)


def test_a_stiff_motion_changes_to_an_implicit_method_by_itself():
    mass = load("driven-mass").with_(m=1, b=2e4, k=1e4)
    found = simulate(mass, 5, {"x": 1}, times=[1, 5])
    slow = 1e4 * (1 - np.sqrt(1 - 1e4 / 1e8))
    assert found.method == "Radau"
    assert found["x"] == pytest.approx(np.exp(-slow * found.times), rel=1e-4)
    assert simulate(mass.with_(b=0.2, k=1), 5, {"x": 1}).method == "DOP853"


def test_progress_is_told():
    told = []
    simulate(load("caravan"), 2, {"theta": 0.1}, progress=lambda done, last: told.append((done, last)))
    assert told[-1] == (2, 2)
    assert [t for t, _ in told] == sorted(t for t, _ in told)


def test_unknown_name_in_a_result():
    with pytest.raises(UcritError, match="has no 'rr'; did you mean 'r'"):
        simulate(load("bmw-320i"), 1)["rr"]
