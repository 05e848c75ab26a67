"""What the scripts beside this file share: a picture's name, its look, and the data that are kept inside its file.

Every PNG carries the points of its own curves and its words, in a hundredth of the size of the picture itself. A test
draws the figures again and compares: a picture that no longer shows what the package finds is told by its name.
"""

import json
import re
from pathlib import Path

import numpy as np
from matplotlib.colors import to_hex
from matplotlib.text import Text
from PIL import Image
from PIL.PngImagePlugin import PngInfo

from ucrit.plots import style

HERE = Path(__file__).parent
DPI = 135
WIDTH = 7.4
"""Inches; 999 pixels."""
POINTS = 24
"""Points of a curve that are kept, evenly spaced along it."""
SEEN = 0.005
"""Part of the axes by which a curve may move before the picture is stale: about the width of a line."""

PICTURES = {}
"""What draws each picture, by the name of its file."""
COMPARED = {}
"""When each is compared with what is found: by the "tests", at each "build" of the pages, or only by "hand"."""


def picture(name, compared="tests"):
    """Register a function that returns a figure, and when it is compared."""

    def register(draw):
        PICTURES[name], COMPARED[name] = draw, compared
        return draw

    return register


def command(name):
    """Return the command that draws a picture; it stands in the pages beside it."""
    return f"python docs/images/draw.py {name}"


def figure_with_axes(height, columns=1, **options):
    """Return an empty figure of the pages' width, and its axes."""
    figure = style.new_figure(WIDTH, height)
    axes = figure.subplots(1, columns, **options)
    for one in np.atleast_1d(axes):
        style.tidy(one)
    return figure, axes


def curve(axes, x, y, number, text, **options):
    """Draw a line in the colour and dash of its number, for the legend to name."""
    chosen = {"color": style.colour(number), "linestyle": style.dash(number), "linewidth": 1.7, **options}
    axes.plot(x, y, label=text, **chosen)


def save(figure, name):
    """Write a picture beside this script with its data inside, the same bytes every time."""
    kept = PngInfo()
    kept.add_text("data", json.dumps(data(figure)), zip=True)
    figure.savefig(HERE / f"{name}.png", dpi=DPI, pil_kwargs={"pnginfo": kept})


def stale(figure, name):
    """Return what differs between a figure and the picture of its name, in words; empty where nothing does."""
    path = HERE / f"{name}.png"
    if not path.is_file():
        return "there is no such file"
    with Image.open(path) as image:
        kept = image.info.get("data")
    return difference(json.loads(kept), json.loads(json.dumps(data(figure)))) if kept else "it holds no data"


def difference(kept, found, place="the figure"):
    """Compare words exactly and places to what can be seen."""
    if isinstance(kept, dict) and isinstance(found, dict):
        if kept.keys() != found.keys():
            return f"{place} has {sorted(kept)} in the file and {sorted(found)} now"
        pairs = [(kept[key], found[key], f"{key} of {place}") for key in kept]
    elif isinstance(kept, list) and isinstance(found, list):
        if len(kept) != len(found):
            return f"{place}: {len(kept)} in the file, {len(found)} now"
        pairs = [(a, b, f"{place}, {i + 1}") for i, (a, b) in enumerate(zip(kept, found, strict=True))]
    elif isinstance(kept, float) and isinstance(found, float):
        return "" if abs(kept - found) <= SEEN else f"{place}: {kept:g} in the file, {found:g} now"
    else:
        return "" if kept == found else f"{place}: {kept!r} in the file, {found!r} now"
    return next((told for told in (difference(*pair) for pair in pairs) if told), "")


def data(figure):
    """Return the words and the curves of a figure, places as parts of the axes."""
    figure.draw_without_rendering()
    return {"words": words(figure.legends), "axes": [axes_data(axes) for axes in figure.axes]}


def words(artists):
    """Return the texts within artists, with numbers cut to four digits."""
    found = [text.get_text() for artist in artists for text in artist.findobj(Text) if text.get_text()]
    return [re.sub(r"\d+\.\d+", lambda match: f"{float(match[0]):.4g}", text) for text in found]


def axes_data(axes):
    """Return what stands in axes: words, numbers at the ticks, and points of all that is drawn."""
    legend = [axes.get_legend()] if axes.get_legend() else []
    titles = [axes.title, axes.xaxis.label, axes.yaxis.label]
    limits = [f"{v:.3g}" for v in (*axes.get_xlim(), *axes.get_ylim())]
    found = {"words": words([*titles, *axes.texts, *legend]), "limits": limits}
    if not axes.axison:  # a drawing, not a diagram: its layout is the places of its words
        return found | {"places": [along(axes, placed(text, [text.get_position()])) for text in axes.texts]}
    drawn = [(to_hex(line.get_color()), placed(line, line.get_xydata())) for line in axes.lines]
    for shape in axes.collections:
        paths = [path.vertices for path in shape.get_paths()]
        if paths and len(shape.get_offsets()) <= 1:
            drawn.append(("", placed(shape, np.vstack(paths))))
    drawn += [("", placed(patch, patch.get_path().vertices)) for patch in axes.patches]
    return found | {"curves": [[colour, along(axes, points)] for colour, points in drawn]}


def placed(artist, points):
    """Return points of an artist as places on the paper."""
    return artist.get_transform().transform(points)


def along(axes, points):
    """Return places evenly spaced along a line [parts of the axes], those within the axes and a little beyond."""
    inside = axes.transAxes.inverted().transform(np.asarray(points, dtype=float))
    inside = inside[np.isfinite(inside).all(axis=-1)].clip(-0.5, 1.5)
    length = np.append(0, np.cumsum(np.hypot(*np.diff(inside, axis=0).T))) if len(inside) > 1 else np.zeros(len(inside))
    if not len(inside) or length[-1] == 0:
        return np.round(inside[:1], 4).tolist()
    even = np.linspace(0, length[-1], POINTS)
    return np.round(np.column_stack([np.interp(even, length, inside[:, k]) for k in (0, 1)]), 4).tolist()
