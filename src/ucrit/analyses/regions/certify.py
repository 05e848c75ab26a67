"""Certified regions: stability of every vehicle in a box of parameters, as a proof, or a vehicle that is not stable.

Branch and bound with interval arithmetic: a box in which no boundary can lie and whose centre is stable is stable as a
whole, another one is halved. What is proved is proved for real numbers, whatever rounding did on the way.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from itertools import product
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ...core.contract.possible import holds
from ...core.errors import UcritError, near_match
from ...numerics.rigorous import Boxes, Proved, exact_pair
from ..linear.modes import eigenvalues
from .certificate import Certificate, Counterexample, sense_of
from .enclosing import Enclosing, within
from .exact_ranges import exact_range

Array = npt.NDArray[Any]
Progress = Callable[[int, int], None]

CHUNK = 4096
"""Boxes looked at together."""

NARROWEST = 2.0**-30
"""Boxes narrower than this share of the range in every direction are not halved any more."""

BELOW_ONE = float(np.nextafter(1.0, 0.0))

MOST = 12
"""Parameters that a box may have."""


def certify(
    vehicle: Model,
    /,
    *,
    boxes: int = 100_000,
    progress: Progress | None = None,
    **ranges: tuple[float | str, float | str] | str,
) -> Certificate:
    """Prove that every vehicle in a region is stable, or find one that is not.

    Parameters
    ----------
    vehicle
        With scalar parameters. Those outside the region stand for all numbers that are written or stored alike, one
        unit in the last place up and down.
    boxes
        How many boxes to look at before the rest is left undecided.
    progress
        Called with the number of boxes done and the most that are allowed.
    **ranges
        Ends of the range of each parameter of the region: a pair of numbers [SI], or text such as ``"20:110 km/h"``.
        Decimals mean what they say: ``0.1`` is a tenth, not the double next to it.

    Returns
    -------
    Certificate
        A proof holds for all real numbers in the region: coefficients are enclosed by interval arithmetic that is
        rounded outward. Taken on trust are IEEE arithmetic, the polynomial that was derived from the model, and that
        NumPy's sines, cosines and exponentials are right to 4e-15.

    Raises
    ------
    UcritError
        If a name, a range or the number of boxes is wrong, or the equations contain what cannot be enclosed.

    Examples
    --------
    >>> from ucrit import certify, load
    >>> print(certify(load("caravan"), m=(1150, 1250), U="36:54 km/h"))
    stable for every m from 1150 to 1250 kg and every U from 10 to 15 m/s (36 to 54 km/h): proved with 3 boxes
    >>> certify(load("caravan"), U=(10, 30)).state
    'refuted'
    """
    if isinstance(boxes, bool) or not isinstance(boxes, int) or boxes < 1:
        raise UcritError(f"boxes must be a whole number above 0, got {boxes!r}")
    search = _Search(vehicle, _read(vehicle, ranges), boxes, progress)
    return search.found()


def _read(vehicle: Model, region: Mapping[str, Any]) -> dict[str, tuple[Fraction, Fraction]]:
    """Return the ranges exactly, checked against the parameters' bounds."""
    model, declared = type(vehicle), type(vehicle).declaration.parameters
    if not region or len(region) > MOST:
        raise UcritError(f"a region is a range for each of 1 to {MOST} parameters, such as U=(5, 30)")
    for name in region:
        if name not in declared:
            raise UcritError(f"{model.model_id()}: there is no parameter '{name}'{near_match(name, declared)}")
    if extra := [name for name in vehicle.dims if name not in region]:
        raise UcritError(f"a certificate is about one vehicle: give one value each for {', '.join(extra)}")
    found = {}
    for name, given in region.items():
        parameter = declared[name]
        low, high = exact_range(given, parameter.unit, f"{model.model_id()}: {parameter.meaning} {name}")
        for end in (low, high):
            parameter.check(float(end), model.model_id())
        if parameter.is_speed and low < 0 < high:
            raise UcritError(f"{model.model_id()}: {name} cannot run through 0: certify each direction by itself")
        found[name] = low, high
    return found


class _Search:
    """Branch and bound, whole arrays of boxes at a time, the coarse ones first."""

    def __init__(
        self, vehicle: Model, ranges: Mapping[str, tuple[Fraction, Fraction]], most: int, progress: Progress | None
    ) -> None:
        self.vehicle, self.ranges, self.most, self.progress = vehicle, ranges, most, progress
        self.names = list(ranges)
        self.asked = Enclosing(vehicle, self.names, sense_of(vehicle, ranges))
        pairs = [(exact_pair(low), exact_pair(high)) for low, high in ranges.values()]
        self.lower = np.array([[low[0]] for low, _ in pairs])
        self.upper = np.array([[high[1]] for _, high in pairs])
        self.inner = [(low[1], high[0]) for low, high in pairs]
        self.done = 0

    def found(self) -> Certificate:
        """Look at boxes until all are proved, one is refuted, or there were enough."""
        share, narrow = 0.0, [np.zeros((2, len(self.names), 0))]
        example = self._refuted(Boxes(*[np.array(list(product(*self.inner))).T] * 2))
        queue = [np.stack([self.lower, self.upper])]
        while queue and self.done < self.most and example is None:
            block = queue.pop(0)
            take = min(CHUNK, self.most - self.done)
            if block.shape[2] > take:
                queue.insert(0, block[:, :, take:])
                block = block[:, :, :take]
            self.done += block.shape[2]
            proved, example, axis = self._look(Boxes(*block))
            share += float(self._volume(block[:, :, proved]))
            rest, axis = block[:, :, ~proved], axis[~proved]
            wide = ((rest[1] - rest[0]) > NARROWEST * (self.upper - self.lower)).any(axis=0)
            narrow.append(rest[:, :, ~wide])
            if wide.any():
                queue.append(_halved(rest[:, :, wide], axis[wide]))
            if self.progress is not None:
                self.progress(self.done, self.most)
        left = np.concatenate([*narrow, *queue], axis=2).transpose(2, 1, 0)
        left = left if example is None else left[:0]
        whole = example is None and not len(left)
        return Certificate(self.vehicle, self.ranges, example, 1.0 if whole else min(share, BELOW_ONE), left, self.done)

    def _volume(self, block: Array) -> Any:
        return np.prod((block[1] - block[0]) / (self.upper - self.lower), axis=0).sum()

    def _look(self, boxes: Boxes) -> tuple[Array, Counterexample | None, Array]:
        """Return which boxes are stable for sure, a counter-example, and along which axis to halve the others."""
        count = boxes.lower.shape[1]
        with np.errstate(all="ignore"):
            sign = self.asked.signs(boxes)
            stable, unstable = self.asked.at_centres(boxes, sign)
            barriers = self.asked.barriers(boxes, sign)
            axis = np.argmax((boxes.upper - boxes.lower) / (self.upper - self.lower), axis=0)
            proved = stable
            for number, barrier in enumerate(barriers):
                fine = np.broadcast_to(barrier.ends[0] > 0, count).copy()
                open_ = np.flatnonzero(proved & ~fine)
                if open_.size:
                    fine[open_] = self._on_face(boxes, sign, barrier, number, open_)
                    axis[open_] = self._steepest(boxes, barrier, open_)
                proved = proved & fine
        return proved, self._refuted(boxes, unstable), axis

    def _on_face(self, boxes: Boxes, sign: Array, barrier: Proved, number: int, chosen: Array) -> Array:
        """Look again on the face where a barrier is least, where its slopes tell which face that is."""
        if barrier.slopes is None:
            return np.zeros(chosen.size, dtype=bool)
        least, most = (np.broadcast_to(s, boxes.lower.shape)[:, chosen] for s in barrier.slopes)
        lower, upper = boxes.lower[:, chosen], boxes.upper[:, chosen]
        face = Boxes(np.where(most <= 0, upper, lower), np.where(least >= 0, lower, upper))
        again = self.asked.barriers(face, sign[chosen])[number]
        return np.asarray(np.broadcast_to(again.ends[0] > 0, chosen.size))

    def _steepest(self, boxes: Boxes, barrier: Proved, chosen: Array) -> Array:
        """Return the axis along which a barrier varies most over each box."""
        width = (boxes.upper - boxes.lower)[:, chosen]
        relative = width / (self.upper - self.lower)
        if barrier.slopes is None:
            return np.asarray(np.argmax(relative, axis=0))
        size = np.fmax(*(np.abs(np.broadcast_to(s, boxes.lower.shape)[:, chosen]) for s in barrier.slopes))
        smear = np.where(relative > NARROWEST, size * width, -1.0)
        known = np.isfinite(smear).all(axis=0)
        return np.asarray(np.where(known, np.argmax(smear, axis=0), np.argmax(relative, axis=0)))

    def _refuted(self, boxes: Boxes, unstable: Array | None = None) -> Counterexample | None:
        """Return the most unstable of the centres that are not stable for sure."""
        if unstable is None:
            with np.errstate(all="ignore"):
                _, unstable = self.asked.at_centres(boxes, self.asked.signs(boxes))
        ends = list(self.ranges.values())
        points = [p for p in boxes.centre.T[np.flatnonzero(unstable)[:256]] if within(p, ends) and self._possible(p)]
        if not points:
            return None
        columns = dict(zip(self.names, np.array(points).T, strict=True))
        values = eigenvalues(self.vehicle.with_(**self._scalars()).along("point", **columns))
        worst = int(np.argmax(values.real.max(axis=-1)))
        order = np.argsort(-values[worst].real)
        at = {name: float(x[worst]) for name, x in columns.items()}
        return Counterexample(self.vehicle.with_(**at), at, tuple(complex(z) for z in values[worst][order]))

    def _scalars(self) -> dict[str, float]:
        """One value for each parameter that the vehicle has as an array."""
        return {name: float(self.vehicle.values[name][0]) for name in self.vehicle.dims}  # type: ignore[index]

    def _possible(self, point: Array) -> bool:
        values = {**self.vehicle.values, **{name: float(x) for name, x in zip(self.names, point, strict=True)}}
        return all(np.all(true) for true in holds(type(self.vehicle), values).values())


def _halved(block: Array, axis: Array) -> Array:
    """Halve boxes, shape (2, d, N), each along its axis; both halves share the middle."""
    rows = np.arange(block.shape[2])
    middle = (block[0, axis, rows] + block[1, axis, rows]) / 2
    left, right = block.copy(), block.copy()
    left[1, axis, rows] = middle
    right[0, axis, rows] = middle
    return np.concatenate([left, right], axis=2)
