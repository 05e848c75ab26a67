"""Drawings of models and the scenes made of them: shapes keep their shape, paths are those of the motion."""

import numpy as np
import pytest

from ucrit import Model, ModelError, UcritError, load, modes, simulate, state
from ucrit.analyses.motion.scene import mode_scene, scene
from ucrit.catalogue import vehicle_names
from ucrit.core import Body, Drawing
from ucrit.core.contract.drawing import box

DRAWN = [name for name in vehicle_names() if hasattr(type(load(name)), "drawing")]


def lengths(corners):
    return np.linalg.norm(np.diff(corners, axis=-2), axis=-1)


def test_most_vehicles_are_drawn():
    assert len(DRAWN) > 0.8 * len(vehicle_names())


@pytest.mark.parametrize("name", DRAWN)
def test_bodies_of_a_mode_stay_rigid(name):
    vehicle = load(name)
    for mode in modes(vehicle):
        shown = mode_scene(vehicle, mode)
        for outline in shown.outlines:
            assert np.isfinite(outline.corners).all()
            if outline.look != "ground":
                edges = lengths(outline.corners)
                assert np.allclose(edges, edges[:1], rtol=1e-9, atol=1e-12), mode.name


def test_a_steady_turn_is_a_circle():
    car = load("understeering-car")
    found = simulate(car, 40, inputs={"delta_f": "step 3 deg"})
    shown = scene(found, np.linspace(10, 40, 2001))
    radius = np.hypot(car.U, found["V"][-1]) / found["r"][-1]
    columns = np.column_stack([2 * shown.path, np.ones(len(shown.path))])  # x^2 + y^2 = 2 a x + 2 b y + c
    (a, b, c), *_ = np.linalg.lstsq(columns, (shown.path**2).sum(axis=1), rcond=None)
    assert np.sqrt(c + a**2 + b**2) == pytest.approx(radius, rel=1e-6)
    assert np.hypot(*(shown.path - (a, b)).T) == pytest.approx(np.full(len(shown.path), radius), rel=1e-6)


def test_a_car_turns_right_whether_its_axes_are_its_own_or_the_roads():
    shown = []
    for name in ("oversteering-car", "oversteering-car-on-the-road"):
        found = simulate(load(name), 2, inputs={"delta_f": "pulse 0.2 deg over 0.5 s"}, tolerance=1e-9)
        shown.append(scene(found, np.linspace(0, 2, 201)))
    body, road = (s.outlines[0].corners[-1].mean(axis=0) for s in shown)
    assert body[1] < -0.1
    assert body == pytest.approx(road, rel=0.01, abs=0.01)


def test_the_paths_height_is_the_phugoids():
    plane = load("paper-airplane")
    shown = scene(simulate(plane, 6, {"V": 1.3 * plane.U}), np.linspace(0, 6, 601))
    energy = 9.80665 * shown.path[:, 1] + simulate(plane, 6, {"V": 1.3 * plane.U}).at(shown.times)["V"] ** 2 / 2
    assert np.ptp(shown.path[:, 1]) > 0.1
    assert np.ptp(energy) < 1e-4 * energy.mean()


def test_enlarged_departures():
    wheelset = load("wheelset")
    found = simulate(wheelset, 1, {"y": 1e-3})
    plain, large = scene(found), scene(found, enlarge=50)
    axle = [np.mean(s.outlines[2].corners[..., 1], axis=1) for s in (plain, large)]
    assert axle[1] == pytest.approx(50 * axle[0], rel=1e-6, abs=1e-9)


def test_what_cannot_be_shown_is_refused():
    with pytest.raises(UcritError, match="satellite cannot be shown in motion: its model has no method 'drawing'"):
        scene(simulate(load("explorer-1-rigid"), 1))
    with pytest.raises(UcritError, match="an animation shows one motion"):
        scene(simulate(load("caravan").with_(U=[10, 20]), 1))
    with pytest.raises(UcritError, match="enlarge must be above 0, got -1"):
        scene(simulate(load("caravan"), 1), enlarge=-1)
    with pytest.raises(ModelError, match="there is no view 'topp'; did you mean 'top'"):
        Drawing("topp", ())
    with pytest.raises(ModelError, match="there is no look 'wheeel'"):
        Drawing("top", (Body(box(1, 1).points, look="wheeel"),))


def test_a_drawing_with_a_misspelt_state_is_told():
    class Odd(Model):
        """Odd."""

        y = state("m", "place")

        def equations(self, x, dx):
            return dx.y

        def drawing(self, x):
            return Drawing("top", (box(1, 1, (0, x.yy)),))

    with pytest.raises(ModelError, match=r"'x\.yy', which is not declared; did you mean 'y'"):
        scene(simulate(Odd(), 1))
