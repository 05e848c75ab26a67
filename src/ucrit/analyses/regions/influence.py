"""Which tolerances make a critical speed uncertain: Sobol indices.

They are those of I. M. Sobol (Mathematics and Computers in Simulation 55 (2001) 271-280), as SALib estimates them.
Parameters that are correlated share one index, because variance cannot be divided between them; groups are independent
of one another.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ...core.errors import UcritError
from ..results.convert import Series, Table, Tabular, needed

Array = npt.NDArray[Any]


@dataclass(frozen=True, eq=False)
class Influence(Tabular):
    """Sobol indices of the critical speed.

    Attributes
    ----------
    vehicle
        The vehicle with its tolerances.
    groups
        Independent groups of parameters, each of one parameter or of several that are correlated.
    first, total
        Shape (groups,): share of the variance that would go if the group were known, and share that would stay if all
        others were.
    first_error, total_error
        Half widths of their 95 % confidence intervals, by bootstrap.
    cut
        Speed [m/s] that stands for higher ones and for vehicles that never lose stability, or infinity.
    """

    vehicle: Model
    groups: tuple[tuple[str, ...], ...]
    first: Array
    total: Array
    first_error: Array
    total_error: Array
    cut: float

    @property
    def names(self) -> tuple[str, ...]:
        """Groups by name, such as ``m`` or ``m, I_z``."""
        return tuple(", ".join(group) for group in self.groups)

    def table(self) -> Table:
        """Return one row for each group."""
        rows = ("group",)
        arrays = {
            "first": self.first,
            "first_error": self.first_error,
            "total": self.total,
            "total_error": self.total_error,
        }
        data = tuple(Series(name, rows, x, "1") for name, x in arrays.items())
        return Table("influence", self.vehicle, (Series("group", rows, np.array(self.names)),), data, rows)

    def __str__(self) -> str:
        order = np.argsort(-self.total)
        return "\n".join(
            f"{self.names[i]}: {100 * self.first[i]:.1f} % of the variance alone, {100 * self.total[i]:.1f} % in all"
            for i in order
        )


def influence(vehicle: Model, samples: int, seed: int, limit: float, critical: Callable[[Array], Array]) -> Influence:
    """Estimate Sobol indices by Saltelli's design.

    Parameters
    ----------
    vehicle
        The vehicle with its tolerances.
    samples
        Base points, a power of two; vehicles are computed for ``samples * (groups + 2)``.
    seed
        For scrambling and bootstrap.
    limit
        Speed that stands for infinity; where it is infinite, the largest critical speed found does.
    critical
        Gives critical speeds of points of the unit cube, shape (N, parameters).
    """
    needed("SALib", "scale", "an index of influence")
    from SALib.analyze import sobol as analyze
    from SALib.sample import sobol as sample

    tolerances = vehicle.info.tolerances
    groups = tuple(tolerances.groups())
    labels = {name: f"g{i}" for i, group in enumerate(groups) for name in group}
    grouped = [labels[name] for name in tolerances.names]
    problem = {
        "num_vars": len(tolerances),
        "names": list(tolerances.names),
        "bounds": [[0.0, 1.0]] * len(tolerances),
        "groups": grouped,
    }
    points = sample.sample(problem, samples, calc_second_order=False, seed=seed)
    speeds = critical(points)
    finite = speeds[np.isfinite(speeds)]
    cut = limit if np.isfinite(limit) else np.inf if finite.size == speeds.size else float(finite.max(initial=0))
    speeds = np.minimum(speeds, cut)
    if not np.ptp(speeds) > 0:
        raise UcritError(
            f"{type(vehicle).model_id()}: the critical speed is the same within all tolerances, nothing has influence"
        )
    found = analyze.analyze(problem, speeds, calc_second_order=False, seed=seed + 1)  # 0 would be none
    order = [list(dict.fromkeys(grouped)).index(f"g{i}") for i in range(len(groups))]
    S1, S1e, ST, STe = (np.asarray(found[key], dtype=float)[order] for key in ("S1", "S1_conf", "ST", "ST_conf"))
    return Influence(vehicle, groups, S1, ST, S1e, STe, cut)
