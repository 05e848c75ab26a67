import json

import numpy as np
import pytest

from ucrit import Model, UcritError, analyze, coordinate, load, modes, param, state, verdict
from ucrit.catalogue import vehicle_names


@pytest.mark.parametrize(
    ("vehicle", "options", "sentence"),
    [
        (
            "caravan",
            {},
            "stable up to 23.24 m/s (83.6 km/h); above it the sway grows at 0.77 Hz (flutter)",
        ),
        ("caravan", {"upto": "70 km/h", "changes": {"c": "4500 N m s/rad"}}, None),
        ("bmw-320i", {}, "stable at every speed up to 10 m/s (36 km/h), and at every higher one"),
        (
            "bmw-320i",
            {"upto": "144 km/h", "changes": {"C_r": "50 kN/rad"}},
            "stable up to 22.37 m/s (80.5 km/h); above it the spin motion runs away (divergence)",
        ),
        (
            "caravan",
            {"upto": "-5 km/h"},
            "unstable backing up at every speed to 1.389 m/s (5 km/h): the jackknife motion runs away, "
            "doubling in 2.1 s",
        ),
        ("wheelset-1-in-20", {}, "neutral: the hunting at 1.67 Hz neither grows nor dies out"),
    ],
)
def test_the_verdict_in_words(vehicle, options, sentence):
    found = analyze(vehicle, **options)
    assert sentence is None or found.sentence == sentence
    assert "\n" not in found.sentence


@pytest.mark.parametrize("name", vehicle_names())
def test_the_dictionary_is_plain_data_in_the_documented_schema(name):
    found = analyze(name)
    data = json.loads(json.dumps(found.to_dict(), allow_nan=False))
    assert data["schema"] == 1
    assert set(data) == {
        "schema",
        "vehicle",
        "model",
        "verdict",
        "speed",
        "modes",
        "critical",
        "criteria",
        "criteria_in",
        "remedies",
    }
    for mode in data["modes"]:
        assert {"name", "re", "im", "frequency_hz", "damping_ratio", "participation"} <= set(mode)
        assert sum(mode["participation"].values()) == pytest.approx(1)
    for item in data["critical"]:
        assert {"parameter", "value", "unit", "kind", "frequency_hz", "stable"} <= set(item)
    assert bool(data["remedies"]) == (not found.stable)
    assert sum(2 if mode["im"] else 1 for mode in data["modes"]) == modes(found.vehicle).eigenvalues.size


def test_stable_means_at_every_speed_up_to_the_asked_one():
    shimmying = load("caravan").with_(c=0, I_c=2500)
    speeds = np.linspace(0.5, 40, 80)
    for U in speeds[::8]:
        below = modes(shimmying.with_(U=speeds[speeds <= U])).growth
        assert analyze(shimmying, upto=float(U)).stable == bool(np.all(below < 0))


def test_wrong_requests_are_refused():
    with pytest.raises(UcritError, match="has no speed"):
        analyze("wheelset-1-in-20", upto="3 m/s")
    with pytest.raises(UcritError, match="has no speed"):
        analyze(load("wheelset-1-in-20"), upto=3)
    with pytest.raises(UcritError, match="measured in m/s, got '3 kg'"):
        analyze("caravan", upto="3 kg")
    with pytest.raises(UcritError, match="one vehicle"):
        analyze(load("caravan").with_(m=[1.0, 2.0]))
    with pytest.raises(UcritError, match="one vehicle"):
        verdict(load("caravan").with_(m=[1.0, 2.0]))


class Inverted(Model):
    """An inverted pendulum on a spring with a damper (a source)."""

    m: float = param("kg", "mass", above=0)
    l: float = param("m", "length", above=0)
    k: float = param("N m/rad", "stiffness", at_least=0)
    c: float = param("N m s/rad", "damping")
    g: float = param("m/s^2", "gravity", above=0, default=9.81)
    phi = coordinate("rad", "angle")

    def equations(self, x, dx, ddx):
        from ucrit.core import sin

        return self.m * self.l**2 * ddx.phi + self.c * dx.phi + self.k * x.phi - self.m * self.g * self.l * sin(x.phi)


@pytest.mark.parametrize(
    ("values", "state", "static", "start"),
    [
        ({"k": 20, "c": 1}, "asymptotically stable", "stable", "asymptotically stable"),
        ({"k": 5, "c": 1}, "unstable", "unstable", "statically unstable"),
        ({"k": 20, "c": -1}, "unstable", "stable", "dynamically unstable"),
        ({"k": 20, "c": 0}, "neutral", "stable", "neutral: 2 roots on the imaginary axis"),
        ({"k": 9.8125, "c": 1, "g": 9.8125}, "neutral", "neutral", "neutral: 1 root on the imaginary axis"),
    ],
)
def test_static_and_dynamic_stability_are_told_apart(values, state, static, start):
    found = verdict(Inverted(**{"m": 1, "l": 1, **values}))
    assert (found.state, found.static) == (state, static)
    assert str(found).startswith(start)


def test_rigid_positions_are_harmless_and_said_so():
    car = load("oversteering-car-on-the-road").with_(U=20)
    found = verdict(car)
    assert (found.rigid_positions, found.marginal, found.stable) == (2, 0, True)
    assert "2 zero roots of positions or speeds that nothing restores, which is harmless" in str(found)
    assert [mode.eigenvalue for mode in modes(car)].count(0) == 2


def test_modes_of_one_name_are_told_apart():
    class Twins(Model):
        """Three lags of one motion (a source)."""

        T: float = param("s", "time", above=0)
        x = state("m", "x", motion="slide")
        y = state("m", "y", motion="slide")
        z = state("m", "z", motion="slide")

        def equations(self, x, dx):
            return self.T * dx.x + x.x, self.T * dx.y + 2 * x.y, self.T * dx.z + 3 * x.z

    names = [mode.name for mode in modes(Twins(T=1))]
    assert names == ["slide decay 1", "slide decay 2", "slide decay 3"]


def test_participation_does_not_depend_on_units():
    first = modes(load("caravan")).participation
    scale = np.diag([1e3, 1e3, 1.0, 1.0])
    from ucrit.analyses.linear.modes import _participation
    from ucrit.core.numeric.compiled import state_space

    A = state_space(load("caravan")).A
    values, vectors = np.linalg.eig(scale @ A @ np.linalg.inv(scale))
    order = [int(np.argmin(abs(values - v))) for v in modes(load("caravan")).eigenvalues]
    assert first == pytest.approx(_participation(vectors)[:, order], rel=1e-9)


def test_a_zero_root_is_called_by_what_stays():
    said = analyze(load("four-wheel-car")).sentence
    assert said.endswith("(a zero root: forward speed, which nothing restores, harmless)")
    names = [mode.name for mode in modes(load("large-airplane-body"))]
    assert names == ["forward speed", "sideslip speed", "heave speed", "roll rate", "pitch rate", "yaw rate"]
