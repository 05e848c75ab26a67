"""Events: found at their instant, ending, bouncing and switching as the model says; in batches as one by one."""

import numpy as np
import pytest

from ucrit import Model, ModelError, UcritError, coordinate, input, load, param, simulate, state
from ucrit.core import event, sign, where


class Ball(Model):
    """Ball that bounces."""

    e: float = param("1", "restitution", at_least=0, default=0.5)
    g: float = param("m/s^2", "gravity", above=0, default=10)
    z = coordinate("m", "height")

    def equations(self, ddx):
        return ddx.z + self.g

    def basic_motion(self):
        return {"ddx": {"z": -self.g}}

    def events(self, x, dx):
        return {
            "bounces": event(x.z, when="falling", after={"dx": {"z": -self.e * dx.z}}),
            "is at the top": event(dx.z, when="falling"),
        }


class Slider(Model):
    """Block that dry friction brings to rest: once it stands, it is locked until the pull exceeds the friction."""

    m: float = param("kg", "mass", above=0, default=2)
    F: float = param("N", "friction", above=0, default=4)
    v = state("m/s", "velocity")
    pull = input("N", "pull")
    locked = input("1", "whether it stands")

    def equations(self, x, dx, u):
        return where(u.locked > 0.5, self.m * dx.v, self.m * dx.v - (u.pull - self.F * sign(x.v)))

    def basic_motion(self):
        return {"u": {"locked": 1}}

    def events(self, x, u):
        stands, moves = {"x": {"v": 0}, "u": {"locked": 1}}, {"x": {"v": 1e-9}, "u": {"locked": 0}}
        return {
            "locks": event(x.v, when="falling", during=u.locked < 0.5, after=stands),
            "slides": event(u.pull - self.F, when="rising", during=u.locked > 0.5, after=moves),
        }


def test_bounces_are_at_their_instants():
    found = simulate(Ball(), 2.4, {"z": 5})
    times = [(e.name, round(e.time, 10)) for e in found.events]
    assert times == [("bounces", 1), ("is at the top", 1.5), ("bounces", 2), ("is at the top", 2.25)]
    first = found.events[0]
    assert first.states["z'"] == pytest.approx(-10)
    assert found.at(first.time)["z'"][0] == pytest.approx(5)
    assert found["z"].min() > -1e-12
    assert not found.ended


def test_bounces_that_pile_up_are_told():
    with pytest.raises(UcritError, match=r"the event '.*' happens over and over at 3 s"):
        simulate(Ball(), 5, {"z": 5}, tolerance=1e-6)


def test_a_mode_is_an_input_that_events_set():
    found = simulate(Slider(), 6, {"v": 3.0}, {"locked": 0, "pull": "step 10 N at 4 s"})
    names = [(e.name, round(e.time, 6)) for e in found.events]
    assert names == [("locks", 1.5), ("slides", 4)]
    assert found.at([1, 3, 5])["v"] == pytest.approx([1, 0, 3], abs=1e-6)
    assert found.at([1, 3, 5])["locked"].tolist() == [0, 1, 0]


def test_an_event_that_ends_the_motion_gives_its_last_time():
    found = simulate(load("motorcycle-lean"), 10, {"theta": "1 deg"})
    assert found.ended == "falls over"
    assert found.times[-1] == found.events[-1].time < 2
    assert found["theta"][-1] == pytest.approx(np.pi / 2, abs=1e-12)
    kept = simulate(load("motorcycle-lean"), 10, {"theta": "1 deg"}, times=[0, 1, 5]).times
    assert kept.tolist() == [0, 1, found.times[-1]]


def test_events_of_the_catalogue():
    cart = load("supermarket-cart").with_(U=-1.2)
    turning = simulate(cart, 12, {"r": 1e-3, "v_y": cart.b * 1e-3})
    assert [e.name for e in turning.events] == ["turns round"]
    energy = cart.m * (1.2**2 + (cart.b * 1e-3) ** 2) + cart.I_z * 1e-6
    fastest = np.sqrt(energy / (cart.I_z + cart.m * cart.b**2))  # all of it in turning, where it stands
    assert turning.events[0].states["r"] == pytest.approx(fastest, rel=1e-9)
    ball = load("bowling-ball-on-a-thin-stick").with_(k=0, c=0)
    falling = simulate(ball, 10, {"theta": 0.01})
    rise = 2 * ball.m * ball.g * ball.l * np.cos(0.01) / ball.inertia_about_foot()
    assert falling.ended == "falls over"
    assert falling.events[-1].states["theta'"] == pytest.approx(np.sqrt(rise), rel=1e-10)


def test_a_batch_is_its_members_one_by_one():
    times = np.linspace(0, 1.3, 14)
    batch = simulate(Ball(e=[0.5, 0.8]), 1.3, {"z": [5.0, 5.0, 1.0]}, times=times)
    assert batch.values.shape == (2, 3, 14, 2)
    assert list(batch.dims) == ["e", "initial z"]
    for i, e in enumerate((0.5, 0.8)):
        for k, z in enumerate((5.0, 5.0, 1.0)):
            one = simulate(Ball(e=e), 1.3, {"z": z}, times=times)
            assert np.abs(batch["z"][i, k] - one["z"]).max() < 1e-10
            mine = [(x.name, x.time) for x in batch.events if x.member == (i, k)]
            assert [n for n, _ in mine] == [x.name for x in one.events]
            assert [t for _, t in mine] == pytest.approx([x.time for x in one.events], abs=1e-11)


def test_members_of_a_batch_end_by_themselves():
    times = np.linspace(0, 2, 21)
    batch = simulate(load("motorcycle-lean"), 2, {"theta": ["1 deg", "10 deg", 0]}, times=times)
    ends = {e.member[0]: e.time for e in batch.events}
    assert ends[1] < ends[0] < 2
    assert 2 not in ends
    for k in (0, 1):
        assert np.array_equal(np.isnan(batch["theta"][k]), times >= ends[k])
    assert np.all(batch["theta"][2] == 0)
    data = batch.to_xarray()
    assert data["theta"].dims == ("initial theta", "time")
    assert data["initial theta"].attrs["units"] == "rad"


@pytest.mark.parametrize(
    ("made", "words"),
    [
        ({"a": event(1, after={"x": {"y": 1}})}, "event 'a' sets 'y', no state or input"),
        ([1], "events must be a dictionary"),
    ],
)
def test_wrong_events_are_refused(made, words):
    class Wrong(Model):
        """Wrong."""

        x = state("m", "place")

        def equations(self, dx):
            return dx.x

        def events(self):
            return made

    with pytest.raises(ModelError, match=words):
        simulate(Wrong(), 1)


def test_unlike_units_in_an_event_and_wrong_words_are_refused():
    class Unlike(Model):
        """Unlike."""

        x = state("m", "place")

        def equations(self, x, dx):
            return dx.x

        def events(self, x, dx):
            return {"meets": x.x + dx.x}

    with pytest.raises(ModelError, match="event 'meets' combines unlike units"):
        simulate(Unlike(), 1)
    with pytest.raises(ModelError, match="when 'risin'; did you mean 'rising'"):
        event(1, when="risin")
    with pytest.raises(ModelError, match="not both"):
        event(1, ends=True, after={"x": {"a": 1}})
    with pytest.raises(ModelError, match="no argument 'y'"):
        type("Odd", (Unlike,), {"events": lambda self, y: {}})


def braked(torque):
    """Return a car on four wheels, braked on its left wheels."""
    car = load("four-wheel-car-on-brush-tires")
    return simulate(car, 3, inputs={"brake_fl": torque, "brake_rl": torque}, method="LSODA", tolerance=1e-7)


def test_a_car_tells_which_wheels_lock_and_ends_before_it_stands():
    names = [e.name for e in braked(3000).events]
    assert {"locks its front left wheel", "locks its rear left wheel"} <= set(names)
    assert not any("right" in name for name in names if "locks" in name)
    assert not [e for e in braked(300).events if "locks" in e.name]
    car = load("four-wheel-car-on-brush-tires")
    stop = simulate(car, 20, inputs={f"brake_{wheel}": 900 for wheel in ("fl", "fr", "rl", "rr")}, tolerance=1e-7)
    assert stop.ended == "has slowed to a tenth of its speed"


def test_a_high_van_lifts_its_inner_wheels_and_rolls_over_and_a_low_one_does_not():
    """At the lateral acceleration of statics, g t/(2 h)."""
    van, dwell = load("high-van"), {"delta_f": "dwell 8 deg at 1 s"}
    high, low = (simulate(v, 6, inputs=dwell, tolerance=1e-8) for v in (van, van.with_(h=0.8)))
    assert [e.name for e in high.events] == ["lifts its front left wheel", "rolls over onto its right side"]
    assert high.ended == "rolls over onto its right side"
    assert abs(high["A_y"][-1]) == pytest.approx(van.g * van.t_f / (2 * van.h), rel=1e-6)
    assert not low.events
    mirrored = simulate(van, 6, inputs={"delta_f": "dwell -8 deg at 1 s"}, tolerance=1e-8)
    assert mirrored.ended == "rolls over onto its left side"
    assert mirrored.times[-1] == pytest.approx(high.times[-1], rel=1e-7)


def test_a_wheelset_tells_which_flange_touches():
    wheelset = load("worn-wheelset", {"V": 45})
    events = simulate(wheelset, 0.5, {"y": 0.0079}).events
    assert [e.name.split()[-2] for e in events] == ["right", "left"] * 2 + ["right"]
    for e in events:
        assert abs(e.states["y"]) == pytest.approx(wheelset.clearance, rel=1e-12)
        assert e.states["y"] * e.states["y'"] > 0


def test_events_are_in_the_files(tmp_path):
    fall = simulate(load("motorcycle-lean"), 5, {"theta": [0.0, 0.1, -0.2]})
    data = fall.to_xarray()
    assert data["event name"].values.tolist() == ["falls over"] * 2
    assert data["event time"].values.tolist() == [e.time for e in fall.events]
    assert data["event initial theta"].values.tolist() == [-0.2, 0.1]
    fall.to_netcdf(tmp_path / "fall.nc")
    fall.to_mat(tmp_path / "fall.mat")
    assert '"falls over"' in fall.to_json()
    assert "event" not in fall.to_dataframe().columns
