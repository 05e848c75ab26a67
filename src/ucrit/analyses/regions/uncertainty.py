"""How sure a critical speed is: its distribution over the tolerances of the parameters, and which of them matter."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ...core.errors import UcritError
from ...core.numeric.compiled import direction
from ...core.units import to_si
from ..results.convert import Series, Table, Tabular, unit_of
from ..stability.wording import speed_text
from .critical_many import Crossings, crossings
from .influence import Influence, influence
from .sampling import check_count, drawn, toleranced, unit_points

Array = npt.NDArray[Any]
Progress = Callable[[int, int], None]

QUANTILES = (0.05, 0.5, 0.95)
"""Shares that `Uncertainty.sentence` tells."""


@dataclass(frozen=True, eq=False)
class Uncertainty(Tabular):
    """Critical speeds of many vehicles drawn from the tolerances of one.

    Attributes
    ----------
    vehicle
        The vehicle with its tolerances.
    parameters
        Values of the toleranced parameters by name [SI], each of shape (N,).
    critical
        Shape (N,) [m/s]: the speed at which a vehicle first loses stability, going faster; infinity where it never
        does (or not up to ``upto``), 0 where it has none to lose.
    as_given
        The same for the parameters' values as they stand in the file.
    upto
        Speed [m/s] up to which was looked, or infinity.
    crossings
        All critical speeds of every vehicle.
    influence
        Sobol indices of the critical speed, where they were asked for.
    seed
        What the quasi-random points were scrambled with.
    """

    vehicle: Model
    parameters: dict[str, Array]
    critical: Array
    as_given: float
    upto: float
    crossings: Crossings
    influence: Influence | None
    seed: int

    @property
    def samples(self) -> int:
        """Number of vehicles drawn."""
        return int(self.critical.size)

    @property
    def never(self) -> float:
        """Share of the vehicles that never lose stability (or not up to ``upto``), 0 to 1."""
        return float(np.mean(np.isinf(self.critical)))

    @property
    def always(self) -> float:
        """Share of the vehicles that are unstable at every speed, 0 to 1."""
        return float(np.mean(self.critical == 0))

    @property
    def varies(self) -> bool:
        """Whether not all of the vehicles have the same critical speed, or none."""
        return bool((self.critical != self.critical[0]).any())

    def quantile(self, share: float) -> float:
        """Return the speed [m/s] at or below which this share of all vehicles first loses stability.

        Infinity where fewer do.

        Raises
        ------
        UcritError
            If ``share`` is not between 0 and 1.
        """
        if not 0 <= share <= 1:
            raise UcritError(f"a quantile is that of a share between 0 and 1, got {share}")
        return float(np.quantile(self.critical, share, method="inverted_cdf"))

    def probability(self, speed: Any) -> Array:
        """Return the share of all vehicles that are not stable at given speeds [m/s], of the same shape.

        Unlike `critical` this counts also what is unstable at low speeds only.

        Raises
        ------
        UcritError
            If a speed is not above 0, or above ``upto``.
        """
        speeds = np.asarray(speed, dtype=float)
        if not ((speeds > 0) & (speeds <= self.upto)).all():
            most = "" if np.isinf(self.upto) else f" and at most {self.upto:g} m/s"
            raise UcritError(f"a speed must be above 0 m/s{most}, got {speeds.min():g} to {speeds.max():g}")
        flat = [1 - np.mean(self.crossings.stable(float(v))) for v in speeds.ravel()]
        return np.array(flat).reshape(speeds.shape)

    @property
    def sentence(self) -> str:
        """The distribution in words."""
        return self.words()

    def words(self, say: Callable[[float], str] = speed_text) -> str:
        """Return the distribution in words.

        Parameters
        ----------
        say
            Writes a speed [m/s].
        """
        if self.always == 1:
            return f"unstable at every speed{self._limit(say)} in all {self.samples} cases"
        if self.never == 1:
            return f"stability is never lost{self._limit(say)} in all {self.samples} cases"
        low, middle, high = (self.quantile(share) for share in QUANTILES)
        if np.isinf(low):
            return f"stability is lost{self._limit(say, 'at some speed')} in {_share(1 - self.never)} of all cases"
        if middle == 0:
            text = f"unstable at every speed{self._limit(say)} in {_share(self.always)} of all cases"
            return text + (f"; never lost{self._limit(say)} in {_share(self.never)}" if self.never else "")
        ends = [_speed(speed, say) for speed in (middle, low, high)]
        text = f"critical speed {ends[0]} in the middle, in 9 of 10 cases from {ends[1]} to {ends[2]}"
        if self.never:
            text += f"; never lost{self._limit(say)} in {_share(self.never)} of all cases"
        return text + (f"; unstable at every speed in {_share(self.always)}" if self.always else "")

    def _limit(self, say: Callable[[float], str], otherwise: str = "") -> str:
        return f" {otherwise}".rstrip() if np.isinf(self.upto) else f" up to {say(self.upto)}"

    def findings(self) -> dict[str, Any]:
        """Return the distribution in words, the critical speed [m/s] as given, and the shares without one."""
        return {"sentence": self.sentence, "as_given": self.as_given, "never": self.never, "always": self.always}

    def table(self) -> Table:
        """Return one row for each vehicle: its parameters and its critical speed."""
        rows = ("sample",)
        numbers = Series("sample", rows, np.arange(1, self.samples + 1))
        data = [Series(name, rows, x, unit_of(self.vehicle, name)) for name, x in self.parameters.items()]
        data.append(Series("critical_speed", rows, self.critical, "m/s"))
        return Table("uncertainty", self.vehicle, (numbers,), tuple(data), rows)

    def __str__(self) -> str:
        return self.sentence + ("" if self.influence is None else f"\n{self.influence}")


def _speed(speed: float, say: Callable[[float], str]) -> str:
    return say(speed) if np.isfinite(speed) else "none at all"


def _share(share: float) -> str:
    return f"{100 * share:.3g} %"


def uncertainty(
    vehicle: Model,
    *,
    samples: int = 4096,
    seed: int = 0,
    upto: Any = None,
    indices: bool = False,
    progress: Progress | None = None,
) -> Uncertainty:
    """Return the distribution of a vehicle's critical speed over the tolerances of its parameters.

    Parameters
    ----------
    vehicle
        One whose file gives tolerances: ``m = { value = 1500, sd = 20 }`` is normal, cut where the parameter's bounds
        are; ``{ value = 1500, min = 1400, max = 1700 }`` is uniform; with all three the normal is cut there.
    samples
        How many vehicles to draw, a power of two: scrambled Sobol points, correlated by a Gaussian copula.
    seed
        Number that decides the scrambling; the same seed gives the same result.
    upto
        Speed [m/s, or text with a unit] up to which to look; any speed by default.
    indices
        Whether to compute Sobol indices too (needs SALib, extra ``scale``), with ``samples`` more vehicles for each
        group of parameters and twice that besides.
    progress
        Called with the number of vehicles done and of all.

    Returns
    -------
    Uncertainty
        The standard error of a probability p is at most ``sqrt(p (1 - p) / samples)``, mostly far less.

    Raises
    ------
    UcritError
        If the vehicle has no speed or no tolerances, or values drawn are impossible together.
    MissingExtraError
        If indices are asked for and SALib is not installed.

    Examples
    --------
    >>> from ucrit import load, uncertainty
    >>> found = uncertainty(load("caravan"), samples=1024)
    >>> 20 < found.quantile(0.5) < 26
    True
    """
    speed = type(vehicle).declaration.speed
    if speed is None:
        raise UcritError(f"{type(vehicle).model_id()} has no speed, so that it has no critical speed either")
    names = toleranced(vehicle)
    check_count(samples)
    if isinstance(seed, bool) or not isinstance(seed, int) or not 0 <= seed < 2**32 - 1:
        raise UcritError(f"seed must be a whole number from 0 to {2**32 - 2}, got {seed!r}")
    limit = np.inf if upto is None else abs(to_si(upto, "m/s", "upto"))
    if not limit > 0:
        raise UcritError(f"upto must be a speed other than 0 m/s, got {upto}")
    groups = len(vehicle.info.tolerances.groups())
    total = samples * (3 + groups) if indices else samples
    sense = direction(vehicle)

    def lost(columns: dict[str, Array], done: int = 0) -> tuple[Crossings, Array]:
        found = crossings(vehicle, columns, sense, None if progress is None else lambda k, _: progress(done + k, total))
        first = found.first_lost()
        return found, np.where(first <= limit, first, np.inf)

    columns = drawn(vehicle, unit_points(len(names), samples, seed))
    found, critical = lost(columns)
    _, given = lost({name: np.array([float(vehicle.values[name])]) for name in names}, samples - 1)
    result = Uncertainty(vehicle, columns, critical, float(given[0]), limit, found, None, seed)
    if not indices:
        return result
    if not result.varies:
        raise UcritError(
            f"{type(vehicle).model_id()}: {result.sentence}: no tolerance has influence, ask for no indices"
        )
    ranked = influence(vehicle, samples, seed, limit, lambda points: lost(drawn(vehicle, points), samples)[1])
    return replace(result, influence=ranked)
