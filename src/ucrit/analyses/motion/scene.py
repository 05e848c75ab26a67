"""A motion as moving lines: a vehicle's own drawing, placed on the ground by following how its axes travel.

The path comes from the velocities that the drawing states, integrated by cubic splines through them. A mode is shown
by the linear motion along its eigenvector, of a size that can be seen.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.drawing import Drawing
from ...core.contract.methods import Names, call
from ...core.contract.model import Model
from ...core.errors import UcritError
from ...core.numeric.compiled import labels
from ...core.numeric.motion import motion
from ..linear.modes import Mode
from .simulation import Simulation

Array = npt.NDArray[Any]

PERIODS, PER_PERIOD = 3, 40
"""How long a mode is shown, and in how many frames a period."""


@dataclass(frozen=True)
class Outline:
    """Lines of one body over time: corners [m], shape (frames, points, 2), and how they look."""

    corners: Array
    look: str
    closed: bool


@dataclass(frozen=True)
class Scene:
    """A vehicle's lines over time, to the right and up as they are seen.

    Attributes
    ----------
    vehicle
        Who moves.
    view
        ``"top"``, ``"side"`` or ``"rear"``.
    times
        [s], shape (frames,).
    outlines
        From the back to the front.
    path
        Origin of the drawing's axes [m], shape (frames, 2).
    travels
        Whether it goes anywhere.
    enlarged
        Factor by which departures from the basic motion are drawn larger than they are.
    """

    vehicle: Model
    view: str
    times: Array
    outlines: tuple[Outline, ...]
    path: Array
    travels: bool
    enlarged: float = 1.0

    @property
    def size(self) -> float:
        """Largest extent [m] of the vehicle in the first frame."""
        moving = np.concatenate([o.corners[0] for o in self.outlines if o.look != "ground"])
        return float(np.ptp(moving, axis=0).max())


def scene(result: Simulation, times: Any = None, *, enlarge: float = 1.0) -> Scene:
    """Return a simulation as moving lines.

    Parameters
    ----------
    result
        Of one vehicle.
    times
        Of the frames [s]; by default those of the result.
    enlarge
        Factor by which departures from the basic motion are drawn larger than they are.

    Raises
    ------
    UcritError
        If the model has no drawing, the result is a batch, or the factor is not above 0.

    Examples
    --------
    >>> from ucrit import load, simulate
    >>> shown = scene(simulate(load("understeering-car"), 5, inputs={"delta_f": "step 1 deg"}))
    >>> shown.view, bool(shown.path[-1, 1] < 0)  # a turn to the right leads downwards, seen from above
    ('top', True)
    """
    if result.dims:
        raise UcritError("an animation shows one motion: give scalar parameters and initial values")
    if not enlarge > 0:
        raise UcritError(f"enlarge must be above 0, got {enlarge!r}")
    refuse_without_drawing(result.vehicle)
    shown = result if times is None else result.at(times)
    basic, _ = motion(type(result.vehicle)).basic(result.vehicle.arguments())
    values = basic + enlarge * (shown.values - basic)
    states = dict(zip(shown.states, values.T, strict=True))
    inputs = dict(zip(shown.inputs, shown.input_values.T, strict=True))
    return place(result.vehicle, shown.times, states, inputs, enlarge)


def mode_scene(vehicle: Model, mode: Mode, *, size: float = 0.15, periods: float = PERIODS) -> Scene:
    """Return a mode as moving lines: the linear motion along its eigenvector.

    Parameters
    ----------
    vehicle
        With scalar parameters.
    mode
        One of its `modes`.
    size
        Largest angle [rad], or length as a share of the drawing, that is shown.
    periods
        How many periods, or e-foldings of a mode that does not oscillate.

    Raises
    ------
    UcritError
        If the model has no drawing.
    """
    refuse_without_drawing(vehicle)
    made, s = motion(type(vehicle)), mode.eigenvalue
    basic, u = made.basic(vehicle.arguments())
    full = _full_shape(vehicle, mode)
    count = int(PER_PERIOD * periods) + 1
    span = periods * (2 * np.pi / s.imag if s.imag else 1 / (abs(s) or 1.0))
    times = np.linspace(0, span, count)
    wave = np.exp(s * times - max(s.real, 0) * span)  # a growing motion reaches its size at the end
    still = place(vehicle, times[:1], dict(zip(made.labels, basic[:, None], strict=True)), _named(vehicle, u[:, None]))
    reach = _reach(vehicle, full, still.size)
    values = basic[:, None] + size / reach * (full[:, None] * wave).real
    driven = _named(vehicle, np.broadcast_to(u[:, None], (len(u), count)))
    return place(vehicle, times, dict(zip(made.labels, values, strict=True)), driven)


def _named(vehicle: Model, u: Array) -> dict[str, Array]:
    return dict(zip(type(vehicle).declaration.inputs, u, strict=True))


def _full_shape(vehicle: Model, mode: Mode) -> Array:
    """Return a mode's shape in all states, also those that constraints tie to others."""
    made = motion(type(vehicle))
    w, u = made.basic(vehicle.arguments())
    if labels(vehicle) == made.labels:
        return np.array([mode.shape[name] for name in made.labels])
    values, vectors = np.linalg.eig(made.slopes(w, u, vehicle.arguments()).A)
    return np.asarray(vectors[:, np.argmin(np.abs(values - mode.eigenvalue))])


def _reach(vehicle: Model, shape: Array, length: float) -> float:
    """Return the largest angle, or length in vehicle lengths, of a shape; velocities count per second of travel."""
    variables, found = type(vehicle).declaration.variables, []
    for label, value in zip(motion(type(vehicle)).labels, shape, strict=True):
        unit = variables[label.rstrip("'")].state_unit(label.count("'"))
        weight = {"rad": 1.0, "m": 1 / length, "rad/s": 0.3, "m/s": 0.3 / length}.get(unit, 0.0)
        found.append(weight * abs(value))
    return float(max(*found, np.finfo(float).tiny))


def refuse_without_drawing(vehicle: Model) -> None:
    """Raise `UcritError` for a model that does not say what it looks like."""
    if not hasattr(vehicle, "drawing"):
        raise UcritError(
            f"{type(vehicle).model_id()} cannot be shown in motion: its model has no method 'drawing' "
            "that says what it looks like"
        )


def place(
    vehicle: Model, times: Array, states: Mapping[str, Array], inputs: Mapping[str, Array], enlarged: float = 1.0
) -> Scene:
    """Return a vehicle's drawing for states and inputs over time, placed along the path that follows from them."""
    names = {name: states[name] for name in type(vehicle).declaration.variables if name in states}
    drawing: Drawing = call(vehicle.drawing, {"x": Names("x", names), "u": Names("u", inputs)})  # type: ignore[attr-defined]
    frames = len(times)
    forward, aside, turn = (np.broadcast_to(np.asarray(v, dtype=float), (frames,)) for v in drawing.travel)
    heading = _integral(times, turn)
    cosine, sine = np.cos(heading), np.sin(heading)
    path = np.stack(
        [_integral(times, forward * cosine - aside * sine), _integral(times, forward * sine + aside * cosine)], axis=-1
    )
    flip = np.array([1.0, -1.0 if drawing.turned else 1.0])
    outlines = []
    for body in drawing.bodies:
        corners = np.broadcast_to(body.placed(), (frames, len(body.points), 2))
        x, y = corners[..., 0], corners[..., 1]
        c, s = cosine[:, None], sine[:, None]
        turned = np.stack([c * x - s * y, s * x + c * y], axis=-1) + path[:, None]
        outlines.append(Outline(turned * flip, body.look, body.closed))
    travels = bool(np.any(forward) or np.any(aside))
    return Scene(vehicle, drawing.view, times, tuple(outlines), path * flip, travels, enlarged)


def _integral(times: Array, values: Array) -> Array:
    """Return the integral of samples from the first time on."""
    if len(times) < 2 or not np.any(values):
        return np.zeros(len(times))
    if len(times) < 4:
        return np.concatenate([[0.0], np.cumsum(np.diff(times) * (values[1:] + values[:-1]) / 2)])
    from scipy.interpolate import CubicSpline

    return np.asarray(CubicSpline(times, values).antiderivative()(times))
