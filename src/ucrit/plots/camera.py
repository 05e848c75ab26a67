"""How a scene is looked at: a window that shows everything, or one that goes along with a vehicle that goes far."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from .style import BRANCHES, INK, MUTED

if TYPE_CHECKING:
    from ..analyses.motion.scene import Scene

Array = npt.NDArray[Any]

FAR = 6.0
"""Vehicle lengths of a path beyond which the window goes along."""

WIDE, HIGH, LEAST = 4.6, 2.4, 0.3
"""Width and height in vehicle lengths of a window that goes along; least height per width of any."""

LOOKS = {
    "body": {"fill": "#cfe0ee", "line": INK},
    "wheel": {"fill": INK, "line": INK},
    "part": {"fill": "none", "line": BRANCHES[1]},
    "ground": {"fill": "none", "line": MUTED},
}
"""Colours of bodies by their look."""

FRAMES, FEWEST, RATE = 200, 40, 25
"""Most and fewest frames of an animation, and most of them a second."""


@dataclass(frozen=True)
class Camera:
    """Windows of all frames: centres (frames, 2), width and height [m], and the distance of grid lines [m]."""

    centres: Array
    width: float
    height: float
    grid: float


def camera(scene: Scene) -> Camera:
    """Return the windows through which a scene is seen."""
    corners = np.concatenate([o.corners.reshape(-1, 2) for o in scene.outlines])
    low, high = corners.min(axis=0), corners.max(axis=0)
    size = max(scene.size, 1e-9)
    frames = len(scene.times)
    if np.ptp(scene.path, axis=0).max() > FAR * size:
        width, height, centres = WIDE * size, HIGH * size, scene.path.copy()
        spread = np.ptp(corners[:, 1]) if np.ptp(scene.path[:, 1]) < size else 0.0
        if 0 < spread < 2 * height:
            height, centres[:, 1] = max(height, 1.3 * spread), (low[1] + high[1]) / 2
    else:
        width, height = 1.15 * np.maximum(high - low, 0.02 * size)
        width, height = max(width, 1.2 * size), max(height, LEAST * width)
        centres = np.broadcast_to((low + high) / 2, (frames, 2))
    return Camera(np.asarray(centres), float(width), float(height), round_distance(width / 5))


def round_distance(value: float) -> float:
    """Return the largest of 1, 2, 5 times a power of ten that is not above a value.

    >>> round_distance(37), round_distance(0.6)
    (20.0, 0.5)
    """
    power = 10.0 ** np.floor(np.log10(value))
    return float(max(step for step in (1, 2, 5) if step * power <= value * (1 + 1e-12)) * power)


def frame_times(start: float, end: float) -> Array:
    """Return the times of the frames of an animation."""
    return np.linspace(start, end, int(np.clip(round((end - start) * RATE), FEWEST, FRAMES)))


def frame_rate(times: Array) -> float:
    """Return frames a second: those of real time where that can be seen."""
    return float(np.clip((len(times) - 1) / max(times[-1] - times[0], 1e-9), 10, RATE))


def caption(scene: Scene) -> str:
    """Return what is seen, in words."""
    from ..core.contract.drawing import VIEWS

    name = scene.vehicle.info.name or type(scene.vehicle).__name__
    larger = "" if scene.enlarged == 1 else f", departures drawn {scene.enlarged:g} times as large"
    return f"{name}, {VIEWS[scene.view]}{larger}"
