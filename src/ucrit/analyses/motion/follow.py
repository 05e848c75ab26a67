"""Following motions in time: steps of a method for differential equations, stopped at kinks of inputs and at events.

All members of a batch advance together, with the error of a step measured on each of them and judged by the worst.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.errors import UcritError
from .crossings import Crossing, Watch
from .manoeuvres import Piece, Signal

Array = npt.NDArray[Any]

METHODS = ("auto", "DOP853", "Radau", "BDF", "LSODA")
EXPLICIT, IMPLICIT = "DOP853", "Radau"
IMPLICIT_TOLERANCE = 1e-9
FINEST = 2.3e-14
"""Relative error below which a step cannot be judged in double precision."""

LOOK, MANY, LIMIT = 50, 1000, 1.0
"""After so many steps, if so many more are ahead, an explicit method is left when rate times step exceeds a limit."""


@dataclass
class Drive:
    """Inputs over time: a signal for each, and values that events have set in their place."""

    signals: Sequence[Signal]
    lead: tuple[int, ...] = ()
    held: dict[int, Array] = field(default_factory=dict)
    offsets: dict[int, Array] = field(default_factory=dict)
    """What is added to a signal: the input's value on the basic motion."""

    @property
    def breaks(self) -> list[float]:
        """Times of all kinks, ascending."""
        return sorted({b for signal in self.signals for b in signal.breaks})

    def around(self, t: float) -> Callable[[float], Array]:
        """Return the inputs, shape (inputs, ...), as a smooth function of time about a time that is no break."""
        pieces: list[Piece] = [signal.piece(t) for signal in self.signals]
        held = dict(self.held)

        def inputs(now: float) -> Array:
            u = np.empty((len(pieces), *self.lead))
            for i, piece in enumerate(pieces):
                u[i] = held[i] if i in held else piece(now) + self.offsets.get(i, 0.0)
            return u

        return inputs


@dataclass
class Stretch:
    """A smooth part of a motion between two times: states and inputs as functions of time."""

    start: float
    end: float
    states: Callable[[float], Array]
    inputs: Callable[[float], Array]


@dataclass
class Course:
    """A motion that has been followed.

    ``alive_until`` [s] has the shape of the batch; ``stretches`` are kept for a single motion.
    """

    crossings: list[Crossing]
    alive_until: Array
    method: str
    stretches: list[Stretch]
    values: Array
    inputs: Array

    def at(self, times: Array) -> tuple[Array, Array]:
        """Return states and inputs, (states, T) and (inputs, T), of a single motion."""
        starts = [s.start for s in self.stretches]
        chosen = [self.stretches[max(bisect_right(starts, t) - 1, 0)] for t in times]
        states = np.array([s.states(t) for s, t in zip(chosen, times, strict=True)])
        inputs = np.array([s.inputs(t) for s, t in zip(chosen, times, strict=True)])
        return states.T, inputs.reshape(len(times), -1).T


class Follower:
    """One run: where it is, who is still moving, what has happened.

    Parameters
    ----------
    made
        The motion: ``rhs(w, u, arguments)``, and ``slopes`` and events where there are some.
    arguments
        Parameters that broadcast over the batch.
    start
        States at time 0, shape (states, ...).
    drive
        The inputs.
    until
        Last time [s].
    times
        Times [s] at which a batch's states are wanted; None for a single motion, whose course is kept.
    tolerance
        Relative error of a step; by default 1e-12, 1e-9 for an implicit method.
    method
        One of `METHODS`.
    where
        Begin of error messages.
    progress
        Called with the time reached and the last one.
    """

    def __init__(
        self,
        made: Any,
        arguments: Sequence[Any],
        start: Array,
        drive: Drive,
        until: float,
        *,
        times: Array | None = None,
        tolerance: float | None = None,
        method: str = "auto",
        where: str = "",
        progress: Callable[[float, float], None] | None = None,
    ) -> None:
        self.made, self.arguments, self.drive, self.until = made, arguments, drive, until
        self.w = np.array(start, dtype=float)
        self.lead = self.w.shape[1:]
        self.times, self.tolerance, self.where, self.progress = times, tolerance, where, progress
        self.may_switch, self.method = method == "auto", EXPLICIT if method == "auto" else method
        self.alive_until = np.full(self.lead, np.inf)
        self.watch = Watch(made, arguments, self.lead)
        self.stretches: list[Stretch] = []
        count = 0 if times is None else len(times)
        self.values = np.full((len(self.w), *self.lead, count), np.nan)
        self.inputs = np.full((len(drive.signals), *self.lead, count), np.nan)

    @property
    def alive(self) -> Array:
        """Whose motion has not ended."""
        return np.asarray(np.isinf(self.alive_until))

    def run(self) -> Course:
        """Follow the motion to its end."""
        t = 0.0
        self.watch.begin(self.w, self.drive.around(self._middle(0.0, self._ends()[0]))(0.0))
        for end in self._ends():
            while t < end and self.alive.any():
                t = self._stretch(t, end)
        if self.times is not None:
            self._note_last(t)
        reached = np.where(self.alive, self.until, self.alive_until)
        return Course(self.watch.found, reached, self.method, self.stretches, self.values, self.inputs)

    def _ends(self) -> list[float]:
        return [*(b for b in self.drive.breaks if 0 < b < self.until), self.until]

    def _middle(self, a: float, b: float) -> float:
        return a + (b - a) / 2

    def _stretch(self, t: float, end: float) -> float:
        """Go on to the end, or to an event that changes something, or to a change of method; return the time."""
        inputs = self.drive.around(self._middle(t, end))
        solver, steps = self._solver(t, end, inputs), 0
        while solver.status == "running":
            self._step(solver)
            steps += 1
            states = self._states(solver)
            stop = self.watch.look(solver.t_old, solver.t, states, inputs, self.alive)
            reached = solver.t if stop is None else stop.time
            self._note(Stretch(solver.t_old, reached, states, inputs))
            if self.progress is not None:
                self.progress(reached, self.until)
            if stop is not None:
                self._change(stop, states(reached), inputs(reached))
                return reached
            if self._too_stiff(solver, steps, inputs):
                self.method = IMPLICIT
                break
        self.w = solver.y.reshape(self.w.shape)
        return float(solver.t)

    def _step(self, solver: Any) -> None:
        try:
            with np.errstate(all="ignore"):
                solver.step()
        except np.linalg.LinAlgError:
            raise UcritError(f"{self.where}: the equations cannot be solved for the accelerations") from None
        except ValueError as error:
            if isinstance(error, UcritError):
                raise
            raise self._lost(solver.t) from None  # the implicit methods refuse what is not finite
        if solver.status == "failed" or not np.isfinite(solver.y).all():
            raise self._lost(solver.t)

    def _lost(self, t: float) -> UcritError:
        return UcritError(f"{self.where}: it grows without bound or meets a singularity at {t:.6g} s")

    def _solver(self, t: float, end: float, inputs: Callable[[float], Array]) -> Any:
        import scipy.integrate

        shape, alive = self.w.shape, self.alive

        def rates(now: float, flat: Array) -> Array:
            found = self.made.rhs(flat.reshape(shape), inputs(now), self.arguments)
            return (found if alive.all() else np.where(alive, found, 0)).ravel()

        explicit = self.method == EXPLICIT
        tolerance = self.tolerance or (1e-12 if explicit else IMPLICIT_TOLERANCE)
        # The solver judges the mean square over all members; that of the worst is at most their number times it.
        tolerance = max(tolerance / max(math.prod(self.lead), 1) ** 0.5, FINEST)
        options = {} if explicit else {"jac": lambda now, flat: self._jacobian(flat, inputs(now))}
        try:
            with np.errstate(all="ignore"):
                made = getattr(scipy.integrate, self.method)
                return made(rates, t, self.w.ravel(), end, rtol=tolerance, atol=1e-3 * tolerance, **options)
        except np.linalg.LinAlgError:
            raise UcritError(f"{self.where}: the equations cannot be solved for the accelerations") from None
        except ValueError as error:
            if isinstance(error, UcritError):
                raise
            raise self._lost(t) from None

    def _jacobian(self, flat: Array, u: Array) -> Array:
        """Return the exact slopes of all members, which do not depend on each other."""
        n, members = len(self.w), int(np.prod(self.lead))
        A = self.made.slopes(flat.reshape(self.w.shape), u, self.arguments).A
        A = np.where(self.alive[..., None, None], A, 0).reshape(members, n, n)
        whole = np.zeros((n, members, n, members))
        each = np.arange(members)
        whole[:, each, :, each] = A
        return whole.reshape(n * members, n * members)

    def _states(self, solver: Any) -> Callable[[float], Array]:
        """Return the states within the last step; of a batch they are worked out only where they are wanted."""
        shape = self.w.shape
        made: list[Any] = []

        def states(t: float) -> Array:
            with np.errstate(all="ignore"):
                if not made:
                    made.append(solver.dense_output())
                return np.asarray(made[0](t)).reshape(shape)

        if self.times is None:
            states(solver.t)
        return states

    def _too_stiff(self, solver: Any, steps: int, inputs: Callable[[float], Array]) -> bool:
        """Tell whether it is stability, not accuracy, that keeps the steps of an explicit method small."""
        h = solver.step_size
        if self.lead or not self.may_switch or self.method != EXPLICIT or steps % LOOK:
            return False
        if (solver.t_bound - solver.t) / h < MANY:
            return False
        slopes = self.made.slopes(solver.y.reshape(self.w.shape), inputs(solver.t), self.arguments).A
        rates = np.linalg.eigvals(slopes)
        return bool(-rates.real.min() * h > LIMIT)

    def _change(self, stop: Crossing, w: Array, u: Array) -> None:
        """Let an event end a member's motion or set its states and inputs."""
        self.w = w.copy()
        if stop.ends:
            self.alive_until[stop.member] = stop.time
            return
        after, held = self.made.after_event(stop.which, w, u, self.arguments)
        mine: Any = (slice(None), *stop.member)
        self.w[mine] = after[mine]
        for place, value in held.items():
            kept = np.array(np.broadcast_to(u[place], self.lead), dtype=float)
            kept[stop.member] = np.broadcast_to(value, self.lead)[stop.member]
            self.drive.held[place] = kept

    def _note(self, stretch: Stretch) -> None:
        if self.times is None:
            self.stretches.append(stretch)
            return
        first, last = np.searchsorted(self.times, (stretch.start, stretch.end))
        for k in range(first, last):
            self._note_at(k, stretch.states(self.times[k]), stretch.inputs(self.times[k]))

    def _note_last(self, t: float) -> None:
        assert self.times is not None
        for k in np.flatnonzero(self.times == t):
            self._note_at(int(k), self.w, self.drive.around(np.nextafter(t, -np.inf))(t))

    def _note_at(self, k: int, states: Array, inputs: Array) -> None:
        self.values[..., k] = np.where(self.alive, states, np.nan)
        self.inputs[..., k] = np.where(self.alive, inputs, np.nan)
