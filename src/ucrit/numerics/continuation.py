"""Curves of solutions of n equations in n + 1 unknowns, followed round folds by pseudo-arclength.

Each step goes along the tangent and back to the curve at right angles to it by Newton's method (H. B. Keller, in
P. Rabinowitz (ed.), Applications of Bifurcation Theory (1977) 359-384). A step is taken only if Newton's method
converges from nearby, the tangent turns little, and the chord agrees with the tangents at both of its ends; else it is
halved. A step over which the orientation of the bordered Jacobian changes has gone past a branch point or has jumped to
another curve: it is halved until a jump would show, and what is left is reported as a branch point. Where the
equations have a kink the curve has a corner, round which it goes on with the slopes of the other side.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from .curve_points import Array, Function, NoConvergenceError, Point, bordered, solve, tangent_at

__all__ = ["Crossing", "Curve", "NoConvergenceError", "Point", "follow", "turning"]

TURN = 0.25
"""Largest angle [rad] between the tangents at both ends of a step, in scaled unknowns."""

NEAR = 0.25
"""Largest first correction of a step, as a share of its length."""

BEND = 0.35, 0.01
"""Chord and mean tangent of a step may differ by this share of the tangents' difference, and this much."""

BRANCH = 1e-6
"""Length of a step in scaled unknowns below which two curves are taken to cross."""

STANDING, STILL = 1e-4, 1.0
"""A quantity that moves by less than this share of its usual size per length of the curve stands still; a curve ends
on which it has done so for this length. (Lengths are shares of the way gone, so that little is still to come.)"""

CORNERS, CORNER = (1e-5, 1e-4, 1e-3), 0.02
"""Lengths of a step across a kink of the equations, and the angle [rad] from which on the curve has a corner there."""


Test = Callable[[Point], float]


@dataclass(frozen=True)
class Crossing:
    """Where a test function changes its sign: its name, the index of the point before, and the point."""

    name: str
    after: int
    point: Point


@dataclass(frozen=True)
class Curve:
    """A piece of a curve of solutions.

    Attributes
    ----------
    points, tangents
        Shape (N, n + 1).
    crossings
        Where test functions change sign, in order; those named ``"branch"`` are branch points.
    end
        ``"closed"``, ``"still"`` (what was to move does no more), ``"points"`` (as many as allowed), ``"failed"``, or
        the name of the stop that ended it.
    reason
        Why it failed, else empty.
    """

    points: Array
    tangents: Array
    crossings: tuple[Crossing, ...]
    end: str
    reason: str = ""


def turning(index: int) -> Test:
    """Return the test that changes sign where an unknown has an extremum along the curve: a fold."""
    return lambda point: float(point.tangent[index])


def follow(
    function: Function,
    start: Array,
    towards: Array,
    *,
    scale: Array | float = 1.0,
    tests: Mapping[str, Test] | None = None,
    stops: Mapping[str, Callable[[Array], float]] | None = None,
    moves: Test | None = None,
    step: float = 0.02,
    largest: float = 0.1,
    smallest: float = 1e-7,
    points: int = 5000,
) -> Curve:
    """Follow the solutions of ``function(y) = 0`` from one of them.

    Parameters
    ----------
    function
        Gives values (n,) and Jacobian (n, n + 1) for n + 1 unknowns.
    start
        A point near the curve, moved onto it at right angles to ``towards``.
    towards
        Direction in the space of the unknowns in which to set out.
    scale
        Usual size of each unknown, in which steps are measured; it grows with the way that an unknown has gone.
    tests
        Functions of a `Point` whose changes of sign are located. One that cannot tell its sign from rounding gives 0;
        a sign changes only where it is another one afterwards.
    stops
        Functions of the unknowns that are positive inside; where one is no longer, the curve ends, on it.
    moves
        Rate along the curve, in its usual size, of what shall move. Where it vanishes for good the solutions go off
        to no end (a car on tires that are saturated turns ever faster on one circle), and the curve ends.
    step, largest, smallest
        First, largest and smallest length of a step in scaled unknowns.
    points
        Most points.

    Returns
    -------
    Curve
        The whole way as far as it could be followed.

    Raises
    ------
    NoConvergenceError
        If there is no solution near the start.

    Examples
    --------
    >>> def circle(y):
    ...     return np.array([y @ y - 1]), 2 * y[None]
    >>> found = follow(circle, np.array([1.0, 0.0]), np.array([0.0, 1.0]), tests={"fold": turning(1)})
    >>> found.end, [f"{c.point.y[1]:.9f}" for c in found.crossings]
    ('closed', ['1.000000000', '-1.000000000'])
    """
    start = np.asarray(start, dtype=float)
    walk = _Walk(function, np.broadcast_to(np.asarray(scale, dtype=float), start.shape).copy())
    walk.begin(start, np.asarray(towards, dtype=float))
    return walk.go(tests or {}, stops or {}, moves, [step, largest, smallest], points)


@dataclass
class _Walk:
    function: Function
    scale: Array
    found: list[Point] = field(default_factory=list)
    crossings: list[Crossing] = field(default_factory=list)

    def begin(self, start: Array, towards: Array) -> None:
        along = towards / self.scale
        along = along / np.linalg.norm(along)
        y, jacobian, _ = solve(self.function, start, along, self.scale)
        self.found.append(Point(y, tangent_at(jacobian, along, self.scale) * self.scale, jacobian))

    def go(
        self,
        tests: Mapping[str, Test],
        stops: Mapping[str, Any],
        moves: Test | None,
        lengths: Sequence[float],
        points: int,
    ) -> Curve:
        (h, largest, smallest), still = lengths, 0.0
        signs = {name: test(self.found[0]) for name, test in tests.items()}
        first = signs
        for name, inside in stops.items():
            if inside(self.found[0].y) <= 0:
                return self.curve(name)
        while len(self.found) < points:
            try:
                new, turned = self.step(h)
                crossed = self.orientation(new) != self.orientation(self.found[-1])
                if crossed and h > BRANCH:
                    h = max(h / 2, BRANCH)
                    continue
            except NoConvergenceError as error:
                h /= 2
                if h >= smallest:
                    continue
                corner = self.round_corner()
                if corner is None:
                    return self.curve("failed", str(error))
                self.found.append(corner)
                values = {name: test(corner) for name, test in tests.items()}
                after, changed = len(self.found) - 2, [n for n, v in values.items() if v * signs[n] < 0]
                self.crossings += [Crossing(name, after, corner) for name in changed]
                signs.update({name: value or signs[name] for name, value in values.items()})
                h = 10 * smallest
                continue
            passed = next((name for name, inside in stops.items() if inside(new.y) <= 0), "")
            if passed:
                new = self.locate(lambda p, n=passed: stops[n](p.y), h)  # type: ignore[misc]
            closed = not passed and self.closes(new, h)
            if closed:
                new, (t, y) = self.found[0], self.frame()
                h = float(t @ ((new.y - y) / self.scale))
            if crossed:
                self.crossings.append(Crossing("branch", len(self.found) - 1, new))
            self.look(tests, signs, new, h)
            self.found.append(new)
            first = {name: first[name] or sign for name, sign in signs.items()}
            if closed:
                self.crossings += [
                    Crossing(name, len(self.found) - 2, new)
                    for name, test in tests.items()
                    if test(new) == 0 > signs[name] * first[name]
                ]
            if passed or closed:
                return self.curve(passed or "closed")
            still = still + h if moves is not None and abs(moves(new)) <= STANDING else 0.0
            if still >= STILL:
                return self.curve("still")
            self.scale = np.maximum(self.scale, np.abs(new.y - self.found[0].y))
            h = min(largest, h * min(1.6, max(0.5, 0.5 * TURN / max(turned, 1e-12))))
        return self.curve("points")

    def orientation(self, point: Point) -> float:
        """Sign of the bordered Jacobian's determinant."""
        sign, _ = np.linalg.slogdet(bordered(point.jacobian * self.scale, point.tangent / self.scale))
        return float(sign)

    def curve(self, end: str, reason: str = "") -> Curve:
        points, tangents, _ = (np.array(part) for part in zip(*self.found, strict=True))
        return Curve(points, tangents, tuple(self.crossings), end, reason)

    def frame(self) -> tuple[Array, Array]:
        """Scaled unit tangent at the last point, and the point."""
        last = self.found[-1]
        t = last.tangent / self.scale
        return t / np.linalg.norm(t), last.y

    def at(self, h: float) -> tuple[Point, float]:
        t, y = self.frame()
        new, jacobian, first = solve(self.function, y + h * t * self.scale, t, self.scale)
        return Point(new, tangent_at(jacobian, t, self.scale) * self.scale, jacobian), first

    def step(self, h: float) -> tuple[Point, float]:
        t, y = self.frame()
        new, first = self.at(h)
        if first > NEAR * h:
            raise NoConvergenceError("the curve turns too sharply to be followed")
        after = new.tangent / self.scale
        turned = math.acos(min(1.0, float(t @ after)))
        chord = (new.y - y) / self.scale
        chord /= np.linalg.norm(chord)
        mean = (t + after) / np.linalg.norm(t + after)
        bent = float(np.linalg.norm(chord - mean))
        if turned > TURN or bent > BEND[0] * float(np.linalg.norm(after - t)) + BEND[1]:
            raise NoConvergenceError("the curve has a corner, or another one is too near to tell them apart")
        return new, turned

    def round_corner(self) -> Point | None:
        """Return a point a little beyond a kink of the equations, where the curve has a corner; None where it has none.

        The determinants with the tangents on both sides have one sign: Jacobians beside a kink differ by a matrix of
        rank one, which leaves the determinant with the kink's normal as it is.
        """
        t, y = self.frame()
        before = self.found[-1]
        for length in CORNERS:
            try:
                jacobian = self.function(y + length * t * self.scale)[1]
                if not np.isfinite(jacobian).all():
                    return None
                ahead = tangent_at(jacobian, t, self.scale)
                beyond = Point(y, ahead * self.scale, jacobian)
                ahead = ahead * (1 if self.orientation(beyond) == self.orientation(before) else -1)
                if abs(float(t @ ahead)) > math.cos(CORNER):
                    continue
                new, jacobian, first = solve(self.function, y + length * ahead * self.scale, ahead, self.scale)
                tangent = tangent_at(jacobian, ahead, self.scale)
            except NoConvergenceError:
                continue
            if first < length and float(tangent @ ahead) > math.cos(TURN):
                return Point(new, tangent * self.scale, jacobian)
        return None

    def closes(self, new: Point, h: float) -> bool:
        if len(self.found) < 4:
            return False
        first, (_, y) = self.found[0], self.frame()
        t = first.tangent / self.scale
        t /= np.linalg.norm(t)
        old, now = ((p - first.y) / self.scale for p in (y, new.y))
        near = min(float(np.linalg.norm(old)), float(np.linalg.norm(now))) < 1.5 * h
        same = float(t @ (new.tangent / self.scale)) > 0.5
        return near and same and float(t @ old) < 0 <= float(t @ now)

    def look(self, tests: Mapping[str, Test], signs: dict[str, float], new: Point, h: float) -> None:
        """Locate the tests' changes of sign in a step, in the order in which they come; ``signs`` are the last ones."""
        here = []
        for name, test in tests.items():
            value = test(new)
            if value * signs[name] < 0:
                last = self.found[-1]
                point = self.locate(test, h) if test(last) != 0 else last
                here.append(Crossing(name, len(self.found) - 1, point))
            signs[name] = value or signs[name]
        t, y = self.frame()
        self.crossings += sorted(here, key=lambda c: float(t @ ((c.point.y - y) / self.scale)))

    def locate(self, test: Test, h: float) -> Point:
        """Return the point within the step ahead at which a test vanishes, by regula falsi (Illinois) and halving.

        At a branch point itself the curves cannot be told apart; it is then interpolated between its neighbours.
        """
        low, high = (0.0, self.found[-1]), (h, self.at(h)[0])
        f_low, f_high = test(low[1]), test(high[1])
        for count in range(100):
            if high[0] - low[0] <= 1e-13 * h or f_high == 0:
                return high[1]
            share = f_low / (f_low - f_high) if count % 3 else 0.5
            found = self._between(low[0], high[0], share)
            if found is None:
                break
            value = test(found[1])
            if value == 0:
                return found[1]
            if value * f_low > 0:
                low, f_low, f_high = found, value, f_high / 2
            else:
                high, f_high, f_low = found, value, f_low / 2
        share = test(low[1]) / (test(low[1]) - test(high[1]))
        y, tangent = self._interpolated(low, high, share)
        return Point(y, tangent, self.function(y)[1])

    def _interpolated(self, low: tuple[float, Point], high: tuple[float, Point], share: float) -> tuple[Array, Array]:
        """Cubic through two points with their tangents, and the straight line between these."""
        t, _ = self.frame()
        one, other = (p.tangent / float(t @ (p.tangent / self.scale)) for _, p in (low, high))
        width, rest = high[0] - low[0], 1 - share
        ends = rest**2 * (1 + 2 * share) * low[1].y + share**2 * (1 + 2 * rest) * high[1].y
        return ends + width * share * rest * (rest * one - share * other), rest * one + share * other

    def _between(self, low: float, high: float, share: float) -> tuple[float, Point] | None:
        for part in (share, 0.8 * share + 0.1, 0.4 * share + 0.3):
            at = low + part * (high - low)
            try:
                point, _ = self.at(at)
            except NoConvergenceError:
                continue
            if float(self.frame()[0] @ (point.tangent / self.scale)) > math.cos(2 * TURN):
                return at, point
        return None
