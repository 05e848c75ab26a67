"""Curves and animations of simulations: what is drawn is what was computed."""

import json
import re
import subprocess
import sys

import matplotlib as mpl
import numpy as np
import pytest
from PIL import Image

from ucrit import UcritError, animate, load, modes, plot, simulate
from ucrit.analyses.motion.scene import mode_scene, scene
from ucrit.plots import animation, draw_frame
from ucrit.plots.animation import encoder
from ucrit.plots.camera import frame_times


@pytest.fixture(scope="module")
def fall():
    return simulate(load("bowling-ball-on-a-thin-stick"), 4, {"theta": "5 deg"})


def test_curves_are_the_result(fall):
    figure = plot(fall)
    drawn = {line.get_gid(): line for axes in figure.axes for line in axes.lines if line.get_gid()}
    assert set(drawn) == {"theta", "theta'"}
    assert np.array_equal(drawn["theta"].get_data(), [fall.times, fall["theta"]])
    assert any("falls over" in text.get_text() for axes in figure.axes for text in axes.texts)
    batch = simulate(load("caravan"), 1, {"theta": [0.1, 0.2]})
    assert len([line for line in plot(batch).axes[0].lines if line.get_gid()]) == 2
    with pytest.raises(UcritError, match="a batch of one dimension, got U, initial theta"):
        plot(simulate(load("caravan").with_(U=[1, 2]), 1, {"theta": [0.1, 0.2]}))


def test_a_frame_holds_the_bodies_where_they_are(fall):
    shown = scene(fall, [0, 2])
    (axes,) = draw_frame(shown, 1).axes
    ball = next(o for o in shown.outlines if o.closed)
    assert any(np.allclose(patch.get_xy()[:-1], ball.corners[1]) for patch in axes.patches)
    low, high = axes.get_xlim(), axes.get_ylim()
    for outline in shown.outlines:
        x, y = outline.corners[1].T
        assert low[0] <= x.min() <= x.max() <= low[1]
        assert high[0] <= y.min() <= y.max() <= high[1]


def test_the_window_goes_along_with_a_vehicle_that_goes_far():
    shown = scene(simulate(load("caravan"), 5, {"theta": 0.1}))
    for k in (0, 399):
        (axes,) = draw_frame(shown, k).axes
        low, high = axes.get_xlim()
        assert low < shown.path[k, 0] < high < low + 30


def test_a_gif_has_the_frames_and_moves(fall, tmp_path):
    path = tmp_path / "fall.gif"
    told = []
    animate(scene(fall, np.linspace(0, 3, 6)), path, progress=lambda *step: told.append(step))
    with Image.open(path) as film:
        assert film.n_frames == 6
        film.seek(5)
        last = film.convert("RGB").tobytes()
        film.seek(0)
        assert film.convert("RGB").tobytes() != last
    assert told[-1] == (6, 6)
    assert [p.name for p in tmp_path.iterdir()] == ["fall.gif"]


def test_a_page_stands_alone_and_holds_the_places(fall, tmp_path):
    path = tmp_path / "fall.html"
    animate(fall, path)
    text = path.read_text()
    assert not re.search(r"(src|href)=|@\w+@|url\(|import ", text)
    assert set(re.findall(r"https?://[^\"]*", text)) == {"http://www.w3.org/2000/svg"}
    film = json.loads(re.search(r"const film = (\{.*\});", text)[1])
    assert film["times"][-1] == pytest.approx(fall.times[-1], abs=1e-4)
    shown = scene(fall, np.array(film["times"]).clip(0, fall.times[-1]))
    for body, outline in zip(film["bodies"], shown.outlines, strict=True):
        places = np.array([[point.split(",") for point in frame] for frame in body["corners"]], dtype=float)
        assert np.abs(places * [1, -1] - outline.corners).max() < 2e-3 * shown.size


def test_a_mode_can_be_animated(tmp_path):
    caravan = load("caravan")
    animate(mode_scene(caravan, next(iter(modes(caravan)))), tmp_path / "sway.html")
    assert "Touring caravan" in (tmp_path / "sway.html").read_text()


def test_a_name_that_could_be_markup_is_only_text(fall, tmp_path):
    ball = fall.vehicle.with_info(name="</script><b>@film@")
    animate(simulate(ball, 1, {"theta": 0.1}), tmp_path / "a.html")
    text = (tmp_path / "a.html").read_text()
    assert "<b>" not in text
    assert text.count("</script>") == 1


def test_an_mp4_film_has_all_frames_and_moves(fall, tmp_path):
    animate(fall, tmp_path / "a.mp4")
    shown = ["-vf", "scale=64:64", "-f", "rawvideo", "-pix_fmt", "gray", "-"]
    decoded = subprocess.run([encoder(), "-i", tmp_path / "a.mp4", *shown], capture_output=True, check=True)
    frames = np.frombuffer(decoded.stdout, np.uint8).reshape(-1, 64, 64).astype(int)
    assert b"h264" in decoded.stderr
    assert b"yuv420p" in decoded.stderr  # what browsers play
    assert len(frames) == len(frame_times(0.0, fall.times[-1]))
    assert np.abs(frames[-1] - frames[0]).max() > 50


def test_an_encoder_that_fails_is_told(fall, tmp_path, monkeypatch):
    broken = tmp_path / "ffmpeg"
    broken.write_text("#!/bin/sh\nexit 1\n")
    broken.chmod(0o755)
    monkeypatch.setitem(mpl.rcParams, "animation.ffmpeg_path", str(broken))
    with pytest.raises(UcritError, match="ffmpeg could not write the film"):
        animate(fall, tmp_path / "a.mp4")
    assert not (tmp_path / "a.mp4").exists()


def test_what_cannot_be_written_is_refused(fall, tmp_path, monkeypatch):
    with pytest.raises(UcritError, match=r"ends in \.gif, \.mp4, \.html, got 'a\.avi'"):
        animate(fall, "a.avi")
    monkeypatch.setenv("PATH", "")
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    with pytest.raises(UcritError, match=r"an MP4 film needs ffmpeg: install it, or pip install 'ucrit\[film\]'"):
        animate(fall, tmp_path / "a.mp4")
    with pytest.raises(UcritError, match="enlarge goes with a simulation"):
        animate(scene(fall), tmp_path / "a.gif", enlarge=2)
    with pytest.raises(UcritError, match="cannot be written"):
        animate(fall, tmp_path / "none" / "a.html")
    assert not list(tmp_path.iterdir())
    assert animation.FORMATS == (".gif", ".mp4", ".html")
