"""Branches of periodic solutions, followed through folds by pseudo-arclength continuation.

They begin at a Hopf point, or at a periodic solution that is known, from which they are followed both ways.

H. B. Keller, Numerical solution of bifurcation and nonlinear eigenvalue problems (1977); every size is measured against
the present cycle's own, so that a branch is followed by shares whatever the units.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import numpy.typing as npt

from . import orbit as orbits
from .collocation import Corrected, Field, SlidingError
from .cycle_locate import at_parameter, kept, locate, metric_of, point_of
from .cycle_points import Branch, Hopf, Point
from .kinks import clear, kinks, settle
from .orbit import Metric, Orbit, Tangent, norm

Array = npt.NDArray[Any]

INTERVALS, MOST_INTERVALS = 20, 160
STEP, SMALLEST_STEP = 0.15, 1e-6
TURN, CORNER = 0.9, 1e-3
"""Least cosine between the directions at two neighbouring points, and the step below which it may be anything."""

BENT = 1e-3
"""Share of the linear rates that the rest of the rates has on the first cycle."""

CLOSED = 0.3
"""A branch whose cycle has shrunk to this share of the first one ends in an equilibrium."""

ENDLESS, STANDING = 30.0, 1e-6
"""Growth of cycles during which the parameter has moved by less than this share of its range: a branch without end."""

VANISHED = 0.01
"""The same share where the branch was begun at a cycle of any size."""

AGAIN, AWAY = 0.6, 2.0
"""A branch that has been this many steps away from its first cycle, and is back within a share of one, is closed."""


def follow(
    field: Field,
    hopf: Hopf,
    lower: float,
    upper: float,
    *,
    tolerance: float = 1e-6,
    count: int = 400,
    beyond: Callable[[Orbit], bool] | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Branch | None:
    """Follow the periodic solutions that leave a Hopf point.

    Parameters
    ----------
    field
        Right-hand side and its slopes.
    hopf
        Where the branch begins.
    lower, upper
        Range of the parameter, in which the Hopf point lies.
    tolerance
        Relative error of the states that is asked for; what is reached is told at each point.
    count
        Most points.
    beyond
        Tells of an orbit that the branch shall not be followed to it.
    progress
        Called with the number of points found and the most.

    Returns
    -------
    Branch or None
        ``None`` where no periodic solution is found next to the Hopf point.
    """
    first = _first(field, hopf, upper - lower)
    if first is None:
        return None
    points, end = _followed(field, first, (lower, upper), CLOSED, tolerance, count, beyond, progress)
    return Branch(tuple(points), end)


def settled(field: Field, guess: Orbit, lower: float, upper: float) -> Point | None:
    """Return the periodic solution next to a guess, at the guess's value of the parameter.

    ``None`` where Newton's method finds none; raises `SlidingError` where the motion would slide along a jump.
    """
    still = Tangent(0 * guess.values, 0.0, 1.0, 0 * guess.mesh)
    guess, still = clear(field, guess, still)
    found = settle(field, guess, still, metric_of(guess, upper - lower))
    return None if found is None else point_of(field, found, metric_of(found.orbit, upper - lower))


def follow_both_ways(
    field: Field,
    start: Point,
    lower: float,
    upper: float,
    *,
    tolerance: float = 1e-6,
    count: int = 400,
    beyond: Callable[[Orbit], bool] | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> tuple[Branch, int]:
    """Follow the branch of a periodic solution in both directions, and tell where on it that solution is.

    Arguments are those of `follow`; ``start`` is as from `settled`.
    """
    half = (count + 1) // 2
    sides: list[tuple[list[Point], str]] = []
    for sense in (-1.0, 1.0):

        def advance(done: int, most: int, before: int = half * len(sides)) -> None:
            if progress is not None:
                progress(before + done, count)

        first = replace(start, tangent=orbits.scaled(start.tangent, sense))
        sides.append(_followed(field, first, (lower, upper), VANISHED, tolerance, half, beyond, advance))
        if sides[-1][1] == "closed":
            return Branch((_again(field, sides[-1][0][0], start), *sides[-1][0][1:]), "closed", "closed"), 0
    (behind, begin), (ahead, end) = sides
    return Branch((*behind[:0:-1], _again(field, ahead[0], start), *ahead[1:]), end, begin), len(behind) - 1


def _again(field: Field, refined: Point, start: Point) -> Point:
    """Return a point that is known better than at the start, at the start's value of the parameter."""
    found = kept(field, refined, start.orbit.parameter)
    return refined if found is None else replace(found, tangent=refined.tangent)


def _followed(
    field: Field,
    first: Point,
    within: tuple[float, float],
    vanished: float,
    tolerance: float,
    count: int,
    beyond: Callable[[Orbit], bool] | None,
    progress: Callable[[int, int], None] | None,
) -> tuple[list[Point], str]:
    """Return the points of a branch from one of them on, in the direction of its tangent, and why they end."""
    (lower, upper), away = within, 0.0
    points, step, small = [first], STEP, vanished * first.metric.states
    while len(points) < count:
        here = _refined(field, points[-1], tolerance, len(points))
        points[-1] = here
        found, step, steps = _advance(field, here, step)
        if found is None:
            return points, "slides" if steps else "stuck"
        new = point_of(field, found, metric_of(found.orbit, upper - lower))
        if here.tangent.parameter * new.tangent.parameter < 0:
            turn = locate(field, here, new, lambda found: found.tangent.parameter)
            points += [turn] if turn else []
        if beyond is not None and beyond(new.orbit):
            return points, "large"
        points.append(new)
        parameter = new.orbit.parameter
        if not lower <= parameter <= upper:
            edge = at_parameter(field, points[-2], new, lower if parameter < lower else upper)
            points[-1:] = [edge] if edge else []
            return points, "range"
        if np.all(new.metric.states < small):
            return points, "equilibrium"
        apart = _apart(first, new)
        if away > AWAY * STEP and apart < AGAIN * STEP and _same_way(first, new):
            return points, "closed"
        away = max(away, apart)
        if _endless(points, upper - lower):
            return points, "endless"
        step = min(STEP, step * (1.4 if steps <= 4 else 1.0 if steps <= 7 else 0.7))
        if progress is not None:
            progress(len(points), count)
    return points, "count"


def _apart(one: Point, other: Point) -> float:
    """Return how far two points of a branch are from each other, in the sizes of the first."""
    metric = one.metric
    sizes_ = np.abs(other.metric.states - metric.states) / metric.states
    period = abs(other.orbit.period - one.orbit.period) / metric.period
    return float(max(sizes_.max(), period, abs(other.orbit.parameter - one.orbit.parameter) / metric.parameter))


def _same_way(one: Point, other: Point) -> bool:
    return one.tangent.parameter * other.tangent.parameter > 0


def _endless(points: list[Point], span: float) -> bool:
    """Tell whether cycles have grown `ENDLESS` times while the parameter stood still."""
    last = points[-1]
    for point in reversed(points):
        if abs(point.orbit.parameter - last.orbit.parameter) > STANDING * span:
            return False
        if np.any(last.metric.states > ENDLESS * point.metric.states):
            return True
    return False


def _first(field: Field, hopf: Hopf, span: float) -> Point | None:
    """Return the first small cycle of a branch, as large as makes the equations' curvature felt."""
    size = _bending_size(field, hopf)
    if np.isnan(size):
        return None
    mesh = np.linspace(0, 1, INTERVALS + 1)
    shares = mesh[:-1, None] + np.diff(mesh)[:, None] * orbits.NODES
    wave = np.real(hopf.vector * np.exp(2j * np.pi * shares[..., None]))
    rest = Orbit(mesh, np.broadcast_to(hopf.state, wave.shape), 2 * np.pi / hopf.omega, hopf.parameter)
    for scale in size * np.array([1.0, 0.1, 0.01, 10.0]):
        away = Tangent(scale * wave, 0.0, 0.0, 0 * mesh)
        guess, away = clear(field, orbits.moved(rest, away, 1.0), away)
        try:
            found = settle(field, guess, away, metric_of(guess, span))
        except SlidingError:
            continue
        if found is not None and abs(found.orbit.period / rest.period - 1) < 0.2:
            return point_of(field, found, metric_of(found.orbit, span))
    return None


def _bending_size(field: Field, hopf: Hopf) -> float:
    """Return the size of the eigenvector's motion at which the rates are no longer linear in it."""
    angles = np.exp(2j * np.pi * np.arange(8) / 8)
    wave = np.real(hopf.vector[:, None] * angles)
    A, _ = field.slopes(hopf.state[:, None], hopf.parameter)
    linear = A[0] @ wave
    rest = field.rates(hopf.state[:, None], hopf.parameter)
    level = np.abs(linear).max(axis=1) + np.abs(linear).max() * 1e-300
    scales = np.geomspace(1e-9, 1e6, 151)
    x = hopf.state[:, None, None] + scales * wave[..., None]
    with np.errstate(all="ignore"):
        rates = field.rates(x.reshape(len(wave), -1), hopf.parameter).reshape(x.shape)
        bent = np.abs((rates - rest[..., None]) / scales - linear[..., None]).max(axis=1) / level[:, None]
    share = np.nanmax(np.where(np.isfinite(bent), bent, np.inf), axis=0)
    far = np.flatnonzero((share > BENT) & (np.arange(len(scales)) > 20))
    return float(scales[max(far[0] - 1, 0)] if far.size else np.nan)


def _refined(field: Field, point: Point, tolerance: float, number: int) -> Point:
    """Return a point on a mesh that suits it, finer where the error asks for it."""
    for _ in range(4):
        count = len(point.orbit.widths)
        wanted = count * (point.error / tolerance) ** 0.2 if point.error > 0 else count
        more = int(min(max(1.2 * wanted, 0.7 * count), 2 * count, MOST_INTERVALS))
        if point.error <= tolerance and number % 4:
            return point
        orbit, ahead = clear(field, point.orbit, point.tangent)
        mesh = orbits.adapted_mesh(orbit, point.metric.states, max(more, INTERVALS), kinks(field, orbit))
        try:
            found = settle(field, orbit.on(mesh), orbits.carried(ahead, orbit, mesh), point.metric)
        except SlidingError:
            return point
        if found is None:
            return point
        better = point_of(field, found, point.metric, point.fold)
        gain = point.error / max(better.error, 1e-300)
        point = better
        if better.error <= tolerance or (count == MOST_INTERVALS and gain < 1.5):
            return point
    return point


def _advance(field: Field, here: Point, step: float) -> tuple[Corrected | None, float, int]:
    """Return the next solution along a branch, the step that led to it and Newton's steps.

    Where there is none, the last number tells whether that is because the motion would slide along a jump of a law.
    """
    widths, metric = here.orbit.widths, here.metric
    ahead = orbits.scaled(here.tangent, 1 / norm(here.tangent, widths, metric))
    slides = 0
    while step > SMALLEST_STEP:
        try:
            found, slides = settle(field, orbits.moved(here.orbit, ahead, step), ahead, metric), 0
        except SlidingError:
            found, slides = None, 1
        least = TURN if step > CORNER else 0.0
        if found is not None and _cosine(found, here.orbit, ahead, metric) > least:
            return found, step, found.steps
        step /= 2
    found = _round_corner(field, here)
    return found, STEP / 10, slides if found is None else found.steps


def _round_corner(field: Field, here: Point) -> Corrected | None:
    """Return a solution a little farther in the parameter, where no step along the old direction leads to one.

    Where a cycle begins to touch a jump, its size and what it does may change at any rate.
    """
    if field.switches is None or not here.tangent.parameter:
        return None
    sense = float(np.sign(here.tangent.parameter))
    ahead = Tangent(0 * here.orbit.values, 0.0, sense, 0 * here.orbit.mesh)
    for share in (1e-1, 1e-2, 1e-3, 1e-4):
        try:
            found = settle(field, orbits.moved(here.orbit, ahead, share * here.metric.parameter), ahead, here.metric)
        except SlidingError:
            continue
        if found is not None:
            return found
    return None


def _cosine(found: Corrected, orbit: Orbit, ahead: Tangent, metric: Metric) -> float:
    """Return the cosine between the branch's direction at a solution and one given on an orbit's mesh."""
    a, b, widths = found.tangent, orbits.carried(ahead, orbit, found.orbit.mesh), found.orbit.widths
    product = orbits.inner(a.values, b.values, widths, metric)
    product += a.period * b.period / metric.period**2 + a.parameter * b.parameter / metric.parameter**2
    return product / norm(a, widths, metric) / norm(b, widths, metric)
