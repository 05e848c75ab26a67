"""Drawings as SVG inside the page: unique ids, colours for light and dark, a text for screen readers."""

from __future__ import annotations

import io
import re
from html import escape
from typing import Any

from markupsafe import Markup

from ..plots import style

COLOURS = {
    style.INK: "--ink",
    style.MUTED: "--muted",
    style.GRID: "--grid",
    style.STABLE: "--stable",
    style.UNSTABLE: "--unstable",
    style.PAPER: "--paper",
    **{colour: f"--c{i}" for i, colour in enumerate(style.BRANCHES)},
}
"""Which property of the page's style sheet takes the place of which colour of the drawings."""

_HEAD = re.compile(r"^.*?(<svg\b[^>]*>)", re.DOTALL)
_METADATA = re.compile(r"\s*<metadata>.*?</metadata>", re.DOTALL)
_STYLE = re.compile(r"\s*<defs>\s*<style.*?</style>\s*</defs>", re.DOTALL)
_SIZE = re.compile(r'viewBox="0 0 ([\d.]+) ([\d.]+)"')
_PATH = re.compile(r'\bd="[^"]*"')
_DIGITS = re.compile(r"(\d+\.\d\d)\d+")
_COMMENT = re.compile(r"\s*<!--.*?-->", re.DOTALL)


def svg(figure: Any, prefix: str, description: str) -> Markup:
    """Return a figure as an inline SVG element.

    Parameters
    ----------
    figure
        A matplotlib figure.
    prefix
        Put before all ids, so that drawings on one page do not share them.
    description
        What a reader who does not see it is told.
    """
    buffer = io.StringIO()
    nothing = {"Date": None, "Creator": None, "Format": None, "Type": None}
    with style.settings():
        figure.savefig(buffer, format="svg", metadata=nothing, transparent=True)
    text = buffer.getvalue()
    size = _SIZE.search(text)
    assert size is not None
    text = _HEAD.sub("", text, count=1)
    for useless in (_METADATA, _STYLE, _COMMENT):
        text = useless.sub("", text)
    used = set(re.findall(r'(?:url\(#|xlink:href="#)([^")]+)', text))
    text = re.sub(r' id="([^"]+)"', lambda m: f' id="{prefix}-{m[1]}"' if m[1] in used else "", text)
    text = re.sub(r"url\(#([^)]+)\)", rf"url(#{prefix}-\1)", text)
    text = re.sub(r'xlink:href="#([^"]+)"', rf'href="#{prefix}-\1"', text)
    text = _PATH.sub(lambda path: _DIGITS.sub(r"\1", path[0]), text)
    for colour, name in COLOURS.items():
        text = text.replace(colour, f"var({name})")
    head = (
        f'<svg class="figure" role="img" aria-label="{escape(description)}" '
        f'viewBox="0 0 {size[1]} {size[2]}" style="max-width: {float(size[1]) * 4 / 3:.0f}px">'
    )
    return Markup(head + text.strip())
