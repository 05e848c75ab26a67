"""A motion as one page: an SVG picture, a small script that moves it, a slider. No network."""

from __future__ import annotations

import json
import math
from html import escape
from typing import TYPE_CHECKING, Any

from .camera import LOOKS, camera, caption

if TYPE_CHECKING:
    from ..analyses.motion.scene import Scene

SHARPNESS = 4000
"""Steps of a window's width to which places are rounded."""

TEMPLATE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>@caption@</title>
<style>
body { font: 15px/1.4 system-ui, sans-serif; margin: 1rem auto; max-width: 60rem; padding: 0 1rem; color: #1b1f24;
  background: #fefefe; }
svg { width: 100%; height: auto; max-height: 80vh; background: #fefefe; border: 1px solid #d3d8de; }
svg * { vector-effect: non-scaling-stroke; stroke-linejoin: round; stroke-linecap: round; }
.grid { stroke: #d3d8de; stroke-width: 1; }
.path { stroke: #d55e00; stroke-width: 1; fill: none; }
@looks@
form { display: flex; gap: 0.8rem; align-items: center; }
input { flex: 1; }
output { min-width: 5em; text-align: right; font-variant-numeric: tabular-nums; }
</style>
</head>
<body>
<p>@caption@. Lines of the grid are @grid@ m apart.</p>
<svg viewBox="0 0 @width@ @height@" role="img" aria-label="@caption@">
<g id="grid" class="grid"></g><g id="world"></g></svg>
<form><button type="button" id="play">Play</button>
<input type="range" id="frame" min="0" max="@last@" value="0" aria-label="time">
<output id="clock"></output></form>
<script>
"use strict";
const film = @film@;
const svg = "http://www.w3.org/2000/svg", world = document.getElementById("world");
const grid = document.getElementById("grid"), slider = document.getElementById("frame");
const clock = document.getElementById("clock"), button = document.getElementById("play");
const make = (name, parent, look) => {
  const made = document.createElementNS(svg, name);
  made.setAttribute("class", look);
  return parent.appendChild(made);
};
if (film.path) make("polyline", world, "path").setAttribute("points", film.path.join(" "));
const bodies = film.bodies.map(b => make(b.closed ? "polygon" : "polyline", world, b.look));
function lines(x, y) {
  grid.replaceChildren();
  const put = (x1, y1, x2, y2) => {
    const line = make("line", grid, "grid");
    for (const [key, value] of Object.entries({x1, y1, x2, y2})) line.setAttribute(key, value);
  };
  const step = film.grid, w = film.width, h = film.height;
  for (let i = Math.ceil((x - w / 2) / step); i * step < x + w / 2; i++)
    put(i * step - x + w / 2, 0, i * step - x + w / 2, h);
  for (let i = Math.ceil((y - h / 2) / step); i * step < y + h / 2; i++)
    put(0, i * step - y + h / 2, w, i * step - y + h / 2);
}
function show(k) {
  const [x, y] = film.centres[k];
  world.setAttribute("transform", `translate(${film.width / 2 - x} ${film.height / 2 - y})`);
  film.bodies.forEach((b, i) => bodies[i].setAttribute("points", b.corners[k].join(" ")));
  lines(x, y);
  clock.textContent = film.times[k].toFixed(2) + " s";
  slider.value = k;
}
let start = null;
function tick(now) {
  if (start === null) return;
  const span = film.times[film.times.length - 1] - film.times[0];
  const part = ((now - start) / 1000 / film.seconds) % 1.15;
  show(Math.min(Math.round(part * (film.times.length - 1)), film.times.length - 1));
  requestAnimationFrame(tick);
}
function play(on) {
  button.textContent = on ? "Stop" : "Play";
  start = on ? performance.now() - 1000 * film.seconds * slider.value / film.times.length : null;
  if (on) requestAnimationFrame(tick);
}
button.addEventListener("click", () => play(start === null));
slider.addEventListener("input", () => { play(false); show(Number(slider.value)); });
show(0);
if (!matchMedia("(prefers-reduced-motion: reduce)").matches) play(true);
</script>
</body>
</html>
"""


def film(scene: Scene) -> dict[str, Any]:
    """Return a scene as plain data that a script can show: windows, outlines and times, rounded to what can be seen.

    >>> from ucrit import load, modes
    >>> from ucrit.analyses.motion.scene import mode_scene
    >>> caravan = load("caravan")
    >>> len(film(mode_scene(caravan, modes(caravan).list()[0]))["times"])
    121
    """
    from .camera import frame_rate

    seen = camera(scene)
    step = 10.0 ** math.floor(math.log10(seen.width / SHARPNESS))
    digits = max(-round(math.log10(step)), 0)

    def rounded(points: Any) -> Any:
        return [[round(float(x), digits), round(float(-y), digits)] for x, y in points]

    return {
        "times": [round(float(t), 4) for t in scene.times],
        "seconds": (len(scene.times) - 1) / frame_rate(scene.times),
        "width": seen.width,
        "height": seen.height,
        "grid": seen.grid,
        "centres": rounded(seen.centres),
        "path": [f"{x},{y}" for x, y in rounded(scene.path)] if scene.travels else None,
        "bodies": [
            {"look": o.look, "closed": o.closed, "corners": [[f"{x},{y}" for x, y in rounded(c)] for c in o.corners]}
            for o in scene.outlines
        ],
    }


def page(scene: Scene) -> str:
    """Return a scene as the text of an HTML page."""
    shown = film(scene)
    looks = "\n".join(
        f".{name} {{ fill: {look['fill']}; stroke: {look['line']}; stroke-width: {2.5 if name == 'wheel' else 1.5}; }}"
        for name, look in LOOKS.items()
    ).replace(".wheel {", ".wheel { fill-opacity: 0.9;")
    fields = {
        "caption": escape(caption(scene)),
        "looks": looks + "\npolyline { fill: none !important; }",
        "width": f"{shown['width']:.6g}",
        "height": f"{shown['height']:.6g}",
        "grid": f"{shown['grid']:g}",
        "last": str(len(scene.times) - 1),
        "film": json.dumps(shown, separators=(",", ":")).replace("</", "<\\/"),
    }
    text = TEMPLATE
    for name, value in fields.items():
        text = text.replace(f"@{name}@", value)
    return text
