"""A small picture of a map of yes and no, written without a drawing library."""

from __future__ import annotations

import base64
import struct
import zlib
from typing import Any

import numpy as np
import numpy.typing as npt

WIDTH = 240
"""Pixels of the longer side."""

GOOD, BAD = (198, 224, 180), (244, 204, 204)


def png(stable: npt.NDArray[Any]) -> bytes:
    """Return a PNG of a two-dimensional array of bool; its first dimension runs to the right, its second upwards."""
    if stable.ndim != 2 or not stable.size:
        raise ValueError(f"a picture has two dimensions, got shape {stable.shape}")
    seen = stable.T[::-1]
    shape = [max(1, round(WIDTH * n / max(seen.shape))) if max(seen.shape) > WIDTH else n for n in seen.shape]
    grow = max(1, WIDTH // max(shape))
    rows, columns = (
        np.minimum((np.arange(k * grow) / grow * n / k).astype(int), n - 1)
        for k, n in zip(shape, seen.shape, strict=True)
    )
    pixels = seen[np.ix_(rows, columns)].astype(np.uint8)
    height, width = pixels.shape
    lines = b"".join(b"\0" + line.tobytes() for line in pixels)
    head = struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0)
    chunks = ((b"IHDR", head), (b"PLTE", bytes((*BAD, *GOOD))), (b"IDAT", zlib.compress(lines)), (b"IEND", b""))
    return b"\x89PNG\r\n\x1a\n" + b"".join(_chunk(name, content) for name, content in chunks)


def _chunk(name: bytes, content: bytes) -> bytes:
    return struct.pack(">I", len(content)) + name + content + struct.pack(">I", zlib.crc32(name + content))


def image(stable: npt.NDArray[Any], alt: str) -> str:
    """Return the picture as an HTML element that holds it."""
    from html import escape

    data = base64.b64encode(png(stable)).decode()
    return f'<img alt="{escape(alt)}" src="data:image/png;base64,{data}">'
