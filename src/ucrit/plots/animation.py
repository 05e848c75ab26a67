"""Motions as moving pictures: GIF, MP4 by ffmpeg, or one page that needs nothing but a browser."""

from __future__ import annotations

import contextlib
import io
import itertools
import os
import shutil
import subprocess
import tempfile
import textwrap
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..core.errors import MissingExtraError, UcritError
from . import style
from .camera import LOOKS, Camera, camera, caption, frame_rate, frame_times

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from ..analyses.motion.scene import Scene
    from ..analyses.motion.simulation import Simulation

FORMATS = (".gif", ".mp4", ".html")
WIDTH = 6.4
"""Width of the picture [in]."""

TITLE = 84
"""Letters of the title that fit into a line."""


def animate(
    result: Simulation | Scene,
    path: str | os.PathLike[str],
    *,
    enlarge: float = 1.0,
    progress: Callable[[float, float], None] | None = None,
) -> None:
    """Write a motion as a moving picture; the file appears whole or not at all.

    Parameters
    ----------
    result
        What `ucrit.simulate` returned for one vehicle, or a scene made of a mode.
    path
        File that ends in ``.gif``, ``.mp4`` (needs the extra ``film``, or ffmpeg) or ``.html`` (one page with a slider,
        no network).
    enlarge
        Factor by which departures from the basic motion are drawn larger than they are; not for a scene.
    progress
        Called with the number of frames drawn and of all.

    Raises
    ------
    UcritError
        If the model has no drawing, the ending is another one, no encoder is installed, or the file cannot be written.

    Examples
    --------
    >>> from ucrit import animate, load, simulate
    >>> animate(simulate(load("supermarket-cart"), 1), "cart.avi")
    Traceback (most recent call last):
    ucrit.core.errors.UcritError: an animation is written to a file that ends in .gif, .mp4, .html, got 'cart.avi'
    """
    from ..analyses.motion.scene import Scene, scene
    from ..analyses.results.convert import write_whole

    ending = film_format(path)
    if isinstance(result, Scene):
        if enlarge != 1:
            raise UcritError("a scene is drawn as it is: enlarge goes with a simulation")
        shown = result
    else:
        shown = scene(result, frame_times(float(result.times[0]), float(result.times[-1])), enlarge=enlarge)
    if ending == ".html":
        from .animation_page import page

        write_whole(path, page(shown).encode())
        return
    write_whole(path, _film(shown, ending, progress))


def film_format(path: str | os.PathLike[str]) -> str:
    """Return the ending of an animation's file; raise `UcritError` for one that cannot be written here."""
    ending = Path(path).suffix.lower()
    if ending not in FORMATS:
        raise UcritError(f"an animation is written to a file that ends in {', '.join(FORMATS)}, got '{path}'")
    if ending == ".mp4" and encoder() is None:
        raise MissingExtraError(
            "an MP4 film needs ffmpeg: install it, or pip install 'ucrit[film]'; .gif and .html need nothing more"
        )
    return ending


def encoder() -> str | None:
    """Return the path of an ffmpeg: the one that matplotlib is set to, else that of the extra ``film``."""
    import matplotlib as mpl

    found = shutil.which(str(mpl.rcParams["animation.ffmpeg_path"]))
    if found is not None:
        return str(found)
    try:
        from imageio_ffmpeg import get_ffmpeg_exe

        return str(get_ffmpeg_exe())
    except (ImportError, RuntimeError):  # the second where the package came without a program for this machine
        return None


def _film(scene: Scene, ending: str, progress: Callable[[float, float], None] | None) -> bytes:
    from PIL import Image

    with style.settings():
        figure, show = stage(scene)
        show(0)
        figure.canvas.draw()
        figure.set_layout_engine("none")  # laid out once: each time would take longer than the drawing

        def pictures() -> Iterator[Any]:
            for k in range(len(scene.times)):
                show(k)
                figure.canvas.draw()
                size = figure.canvas.get_width_height()
                yield Image.frombytes("RGBA", size, bytes(figure.canvas.buffer_rgba()))
                if progress is not None:
                    progress(k + 1, len(scene.times))

        rate = round(frame_rate(scene.times))
        return _mp4(pictures(), rate) if ending == ".mp4" else _gif(pictures(), rate)


def _gif(pictures: Iterator[Any], rate: int) -> bytes:
    from PIL import Image

    content = io.BytesIO()
    first, *others = [picture.convert("RGB").quantize(32, dither=Image.Dither.NONE) for picture in pictures]
    first.save(content, "GIF", save_all=True, append_images=others, duration=1000 // rate, loop=0)
    return content.getvalue()


def _mp4(pictures: Iterator[Any], rate: int) -> bytes:
    first = next(pictures)
    size = "{}x{}".format(*first.size)
    given = ["-f", "rawvideo", "-pix_fmt", "rgba", "-s", size, "-r", str(rate), "-i", "-"]
    even = ["-vf", "crop=trunc(iw/2)*2:trunc(ih/2)*2", "-c:v", "h264", "-pix_fmt", "yuv420p"]  # what browsers play
    with tempfile.TemporaryDirectory() as folder:
        film = Path(folder) / "film.mp4"
        command = [str(encoder()), "-loglevel", "error", *given, *even, "-movflags", "+faststart", str(film)]
        with subprocess.Popen(command, stdin=subprocess.PIPE, stderr=subprocess.PIPE) as run:
            assert run.stdin is not None
            assert run.stderr is not None
            with contextlib.suppress(BrokenPipeError):  # it says itself why it stopped
                for picture in itertools.chain([first], pictures):
                    run.stdin.write(picture.tobytes())
                run.stdin.close()
            told = run.stderr.read().decode(errors="replace").strip()
        if run.returncode:
            reason = told.splitlines()[-1] if told else f"exit status {run.returncode}"
            raise UcritError(f"ffmpeg could not write the film: {reason}")
        return film.read_bytes()


def draw_frame(scene: Scene, index: int) -> Any:
    """Return a figure with one frame of a scene.

    >>> from ucrit import load, simulate
    >>> from ucrit.analyses.motion.scene import scene
    >>> len(draw_frame(scene(simulate(load("caravan"), 1)), 0).axes)
    1
    """
    with style.settings():
        figure, show = stage(scene)
        show(index)
    return figure


def stage(scene: Scene) -> tuple[Any, Callable[[int], None]]:
    """Return a figure, and a function that puts the lines of a frame into it."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.ticker import MultipleLocator

    seen = camera(scene)
    title = textwrap.fill(caption(scene), TITLE)
    height = min(WIDTH * 0.88 * seen.height / seen.width + 0.9, 7.0) + 0.2 * title.count("\n")
    figure = style.new_figure(WIDTH, height)
    FigureCanvasAgg(figure)
    axes = figure.add_subplot()
    style.tidy(axes)
    axes.set_aspect("equal")
    axes.set_title(title, fontsize=9, color=style.INK, loc="left")
    axes.set_xlabel("m")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(MultipleLocator(seen.grid))
    if scene.travels:
        axes.plot(*scene.path.T, color=style.BRANCHES[1], linewidth=1, zorder=1, gid="path")
    lines = [_artist(axes, outline, 2 + i / 100) for i, outline in enumerate(scene.outlines)]
    clock = axes.text(0.99, 0.98, "", transform=axes.transAxes, ha="right", va="top", fontsize=9, color=style.INK)
    return figure, lambda k: _show(scene, seen, axes, lines, clock, k)


def _artist(axes: Any, outline: Any, order: float) -> Any:
    look = LOOKS[outline.look]
    if not outline.closed:
        width = 2.2 if outline.look == "wheel" else 1.3
        return axes.plot([], [], color=look["line"], linewidth=width, zorder=order, solid_capstyle="round")[0]
    return axes.fill([0, 0, 0], [0, 0, 0], facecolor=look["fill"], edgecolor=look["line"], linewidth=1, zorder=order)[0]


def _show(scene: Scene, seen: Camera, axes: Any, lines: list[Any], clock: Any, k: int) -> None:
    for line, outline in zip(lines, scene.outlines, strict=True):
        if outline.closed:
            line.set_xy(outline.corners[k])
        else:
            line.set_data(*outline.corners[k].T)
    x, y = seen.centres[k]
    axes.set_xlim(x - seen.width / 2, x + seen.width / 2)
    axes.set_ylim(y - seen.height / 2, y + seen.height / 2)
    clock.set_text(f"{scene.times[k]:.2f} s")
