"""Distributions of critical speeds: closed forms, one vehicle at a time, and plain random numbers say the same."""

import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.stats import norm, truncnorm

from ucrit import UcritError, critical, find_model, load, plot, uncertainty
from ucrit.analyses.regions.critical_many import crossings
from ucrit.analyses.regions.sampling import drawn, unit_points
from ucrit.catalogue import VEHICLES, vehicle_names
from ucrit.core.contract.possible import allowed
from ucrit.core.contract.tolerances import Tolerance, Tolerances
from ucrit.core.numeric.compiled import compiled, direction

WITH_SPEED = list(
    {type(v): n for n, v in ((n, load(n)) for n in vehicle_names()) if type(v).declaration.speed}.values()
)


def with_tolerances(vehicle, *entries, correlations=()):
    return vehicle.with_info(tolerances=Tolerances(entries, tuple(correlations)))


@pytest.mark.parametrize("name", WITH_SPEED)
def test_critical_speeds_of_many_are_those_of_each(name):
    vehicle = load(name)
    names = [key for key in vehicle.values if key != type(vehicle).declaration.speed]
    random = np.random.default_rng(1)
    columns = {key: np.full(2, float(vehicle.values[key])) for key in names}
    changed = vehicle
    for key in names:  # one after the other, so that values stay possible together
        value = columns[key][0] * (1 + 0.2 * random.uniform(-1, 1))
        if allowed(changed, key).allows(value):
            changed = changed.with_(**{key: value})
            columns[key][1] = value
    sense = direction(vehicle)
    found = crossings(vehicle, columns, sense)
    unsure = compiled(type(vehicle), sense).degrees(type(vehicle).declaration.speed) is None
    assert found.exact is not unsure
    for row in range(2):
        each = critical(vehicle.with_(**{key: float(x[row]) for key, x in columns.items()}))
        speeds = sorted(abs(c.value) for c in each if abs(c.value) < 1e8)
        edges = [v for v in found.edges[row] if v < 1e8]  # a neutral car: a root within rounding of infinity
        np.testing.assert_allclose(edges, speeds, rtol=1e-9)
        if sense > 0:
            assert found.stable_at_lower[row] == each.stable_at_lower
            middle = [0.5 * (a + b) for a, b in zip([0, *speeds], [*speeds, 2 * max(speeds, default=1)], strict=True)]
            for speed in middle:
                inside = any(a < speed < b for a, b in each.stable_ranges())
                assert found.stable(speed)[row] == inside


OVERSTEERING = load("oversteering-car")
CAR = with_tolerances(
    OVERSTEERING,
    Tolerance("m", 90.0),
    Tolerance("a", 0.0, 1.2, 1.3),
    Tolerance("C_f", 8e3, 105e3, 135e3),
    Tolerance("C_r", 15e3),
    correlations=[("C_f", "C_r", 0.6)],
)


def closed_form(p):
    """Critical speed of an oversteering car, infinity where it understeers."""
    p = {**OVERSTEERING.values, **p}
    moment = p["a"] * p["C_f"] - p["b"] * p["C_r"]
    with np.errstate(all="ignore"):
        square = p["C_f"] * p["C_r"] * (p["a"] + p["b"]) ** 2 / (p["m"] * moment)
        return np.where(moment > 0, np.sqrt(square), np.inf)


def test_the_distribution_is_that_of_the_closed_form():
    found = uncertainty(CAR, samples=4096, seed=3)
    np.testing.assert_allclose(found.critical, closed_form(found.parameters), rtol=1e-10)
    assert found.as_given == pytest.approx(float(closed_form({})))
    random = np.random.default_rng(8)
    z = random.normal(size=(4, 100_000))
    z[3] = 0.6 * z[2] + 0.8 * z[3]
    C_f = truncnorm.ppf(norm.cdf(z[2]), -15 / 8, 15 / 8, loc=120e3, scale=8e3)
    p = {"m": 1500 + 90 * z[0], "a": random.uniform(1.2, 1.3, z.shape[1]), "C_f": C_f, "C_r": 75e3 + 15e3 * z[3]}
    plain = closed_form(p)
    for share in (0.05, 0.25, 0.5, 0.75):
        assert found.quantile(share) == pytest.approx(np.quantile(plain, share), rel=0.01)
    for speed in (25, 30, 40):
        assert found.probability(speed) == pytest.approx(np.mean(plain < speed), abs=0.01)
    assert found.never == pytest.approx(np.mean(np.isinf(plain)), abs=0.01)
    assert found.never > 0.02


def test_samples_follow_their_tolerances():
    columns = drawn(CAR, unit_points(4, 2**14, 1))
    assert columns["m"].mean() == pytest.approx(1500, abs=0.1)
    assert columns["m"].std() == pytest.approx(90, rel=1e-3)
    assert 1.2 <= columns["a"].min() < 1.201 < 1.299 < columns["a"].max() <= 1.3
    assert 105e3 <= columns["C_f"].min() < 105.1e3
    assert np.corrcoef(columns["C_f"], columns["C_r"])[0, 1] == pytest.approx(0.6, abs=0.02)
    assert abs(np.corrcoef(columns["m"], columns["C_r"])[0, 1]) < 0.01
    bounded = with_tolerances(load("caravan"), Tolerance("c", 4000.0))
    assert drawn(bounded, unit_points(1, 2**10, 1))["c"].min() >= 0


@settings(max_examples=10)
@given(st.integers(0, 2**31), st.sampled_from([64, 256]))
def test_the_same_seed_gives_the_same_result(seed, samples):
    one, other = (uncertainty(CAR, samples=samples, seed=seed) for _ in range(2))
    np.testing.assert_array_equal(one.critical, other.critical)
    assert not np.array_equal(one.critical, uncertainty(CAR, samples=samples, seed=seed + 1).critical)


def test_probability_counts_ranges_that_are_stable_in_between():
    found = uncertainty(
        with_tolerances(load("caravan-undamped-hitch").with_(I_c=4200), Tolerance("k", 50.0)), samples=64
    )
    assert found.always == 1
    assert found.probability([1, 30]).tolist() == [1, 1]
    assert found.quantile(0.5) == 0
    found = uncertainty(load("caravan"), samples=256, upto="90 km/h")
    assert found.never == pytest.approx(np.mean(uncertainty(load("caravan"), samples=256).critical > 25))
    with pytest.raises(UcritError, match="at most 25 m/s"):
        found.probability(30)


def test_correlated_parameters_share_an_index_and_endless_speeds_are_cut():
    pytest.importorskip("SALib", reason="needs the extra 'scale'")
    done = []
    found = uncertainty(CAR, samples=1024, indices=True, progress=lambda *x: done.append(x))
    ranked = found.influence
    assert done[-1] == (1024 * 6, 1024 * 6)
    assert ranked.groups == (("m",), ("a",), ("C_f", "C_r"))
    assert ranked.cut > found.quantile(0.9)
    assert ranked.names[np.argmax(ranked.total)] == "C_f, C_r"
    limited, again = (uncertainty(CAR, samples=1024, indices=True, upto=60).influence for _ in range(2))
    np.testing.assert_array_equal(limited.total_error, again.total_error)
    assert limited.cut == 60
    assert np.all(limited.first <= limited.total + limited.total_error + limited.first_error)
    assert str(limited).count("%") == 6


def test_indices_agree_with_another_estimator():
    pytest.importorskip("SALib", reason="needs the extra 'scale'")
    mild = with_tolerances(
        OVERSTEERING,
        Tolerance("m", 60.0),
        Tolerance("C_f", 2e3),
        Tolerance("C_r", 2e3),
        correlations=[("C_f", "C_r", 0.5)],
    )
    found = uncertainty(mild, samples=2048, indices=True).influence
    assert found.groups == (("m",), ("C_f", "C_r"))
    A, B = (unit_points(6, 2**15, 5)[:, part] for part in (slice(3), slice(3, 6)))
    a = closed_form(drawn(mild, A))
    for i, chosen in enumerate(np.array([[True, False, False], [False, True, True]])):
        shared = closed_form(drawn(mild, np.where(chosen, A, B)))
        others = closed_form(drawn(mild, np.where(chosen, B, A)))
        assert found.first[i] == pytest.approx(np.cov(a, shared)[0, 1] / a.var(), abs=0.03)
        assert found.total[i] == pytest.approx(np.mean((a - others) ** 2) / (2 * a.var()), abs=0.03)


def test_results_are_tables_and_drawings():
    found = uncertainty(load("caravan"), samples=256)
    frame = found.to_dataframe()
    assert list(frame.columns) == ["sample", "m", "I_c", "b", "C", "k", "c", "critical_speed"]
    assert len(frame) == 256
    assert "critical speed" in str(found)
    assert len(plot(found).axes) == 1
    with pytest.raises(UcritError, match="nothing to draw"):
        plot(uncertainty(with_tolerances(load("understeering-car"), Tolerance("m", 10.0)), samples=64))


@pytest.mark.parametrize(
    ("vehicle", "options", "message"),
    [
        (load("bmw-320i"), {}, "car: no parameter has a tolerance; write one into the vehicle file, such as m = {"),
        (load("driven-mass"), {}, "has no speed"),
        (CAR, {"samples": 1000}, "samples must be a power of two, got 1000; did you mean 512 or 1024?"),
        (CAR, {"samples": 1}, "samples must be a whole number from 2 to"),
        (CAR, {"samples": 2.5}, "samples must be a whole number"),
        (CAR, {"seed": -1}, "seed must be a whole number from 0 to"),
        (CAR, {"upto": 0}, "upto must be a speed other than 0 m/s"),
        (CAR, {"upto": "3 kg"}, "upto is measured in m/s"),
        (CAR.with_(a=2), {}, "centre of mass to front axle a = 2 m lies outside its tolerance, 1.2 to 1.3 m"),
        (CAR.with_(m=[1, 2]), {}, "uncertainty is that of one vehicle: give one value each for m"),
    ],
)
def test_wrong_input_is_refused_in_a_sentence(vehicle, options, message):
    with pytest.raises(UcritError) as caught:
        uncertainty(vehicle, **options)
    assert message in str(caught.value)


def test_correlations_that_contradict_one_another_are_refused():
    three = [("m", "C_f", 0.9), ("C_f", "C_r", 0.9), ("m", "C_r", -0.9)]
    wrong = with_tolerances(OVERSTEERING, *(Tolerance(n, 10.0) for n in ("m", "C_f", "C_r")), correlations=three)
    with pytest.raises(UcritError, match="contradict one another"):
        uncertainty(wrong, samples=64)


def test_values_that_are_impossible_together_are_refused():
    body = find_model("lean")
    name = next(n for n in vehicle_names() if type(load(n)) is body)
    vehicle = load(name)
    with pytest.raises(UcritError, match="no principal moment of inertia"):
        uncertainty(with_tolerances(vehicle, Tolerance("I_2", 3 * float(vehicle.values["I_2"]))), samples=64)


def test_a_vehicle_without_any_stable_speed_has_no_critical_one(tmp_path):
    path = tmp_path / "falling.toml"
    text = (VEHICLES / "motorcycle-lean.toml").read_text()
    path.write_text(re.sub(r"(?m)^m = (\d+)", r"m = { value = \1, sd = 5 }", text))
    vehicle = load(path)
    assert str(uncertainty(vehicle, samples=64)) == "unstable at every speed in all 64 cases"
    assert uncertainty(vehicle, samples=64, upto=9).sentence == (
        "unstable at every speed up to 9 m/s (32.4 km/h) in all 64 cases"
    )
    with pytest.raises(UcritError, match="unstable at every speed in all 64 cases: no tolerance has influence"):
        uncertainty(vehicle, samples=64, indices=True)


@pytest.mark.parametrize(
    ("critical", "upto", "told"),
    [
        ([0.0] * 6 + [np.inf] * 2, np.inf, "unstable at every speed in 75 % of all cases; never lost in 25 %"),
        ([np.inf] * 99 + [1.0], np.inf, "stability is lost at some speed in 1 % of all cases"),
        ([np.inf] * 99 + [1.0], 20.0, "stability is lost up to 20 m/s (72 km/h) in 1 % of all cases"),
        ([np.inf] * 8, 20.0, "stability is never lost up to 20 m/s (72 km/h) in all 8 cases"),
        ([300.0, 400.0], np.inf, "critical speed 300 m/s (1080 km/h) in the middle, "),
    ],
)
def test_distributions_in_words(critical, upto, told):
    found = uncertainty(load("caravan"), samples=64)
    assert replace(found, critical=np.array(critical), upto=upto).sentence.startswith(told)
