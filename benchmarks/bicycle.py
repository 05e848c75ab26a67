"""Tracked modes of the benchmark bicycle beside BicycleParameters, where that is installed (extra ``benchmark``)."""

from __future__ import annotations

from importlib.util import find_spec
from typing import Any

import numpy as np

from benchmarks.timing import Row, compared, interleaved
from ucrit import load, locus

COUNTS = (1_000, 100_000)
LIMIT = 1 / 20


def speeds() -> list[Row]:
    """Compare tracked eigenvalues at many speeds."""
    if find_spec("bicycleparameters") is None:
        return [Row("\nBenchmark bicycle: BicycleParameters is not installed (pip install 'ucrit[benchmark]')")]
    from bicycleparameters.bicycle import sort_eigenmodes

    ours, theirs = load("benchmark-bicycle"), _theirs()
    rows: list[Row] = []
    for count in COUNTS:
        v = np.linspace(0.1, 10, count)

        def sorted_() -> Any:
            return sort_eigenmodes(*theirs.calc_eigen(v=v))  # noqa: B023

        def tracked() -> Any:
            return locus(ours, "U", 0.1, 10, points=count)  # noqa: B023

        median = interleaved({"theirs": sorted_, "ours": tracked}, 1 if count > 10_000 else 5)
        base = median["theirs"]
        rows += [
            Row(f"\nTracked modes of the benchmark bicycle at {count:,} speeds (CPU time)"),
            Row("BicycleParameters, eigenvalues and sorting", base, 1.0),
            compared("ucrit locus: tracked, named, refined", median["ours"], base, LIMIT if count > 10_000 else None),
        ]
    v = np.linspace(0.1, 10, 50)
    wanted = np.sort_complex(theirs.calc_eigen(v=v)[0])
    got = np.sort_complex(np.linalg.eigvals(_matrices(ours, v)))
    same = float(np.abs(got - wanted).max())
    return [*rows, Row(f"  eigenvalues differ by at most {same:.1e} 1/s", ok=same < 1e-6)]


def _matrices(vehicle: Any, v: Any) -> Any:
    from ucrit.core.numeric.compiled import state_space

    return state_space(vehicle.with_(U=v)).A


def _theirs() -> Any:
    """Return BicycleParameters' model with the same numbers; two inertias that play no part are the paper's."""
    from bicycleparameters.models import Meijaard2007Model
    from bicycleparameters.parameter_sets import Meijaard2007ParameterSet

    values = load("benchmark-bicycle").values
    names = {"lambda_": "lam", "U": "v"}
    numbers = {names.get(name, name.replace("_", "")): float(value) for name, value in values.items()}
    return Meijaard2007Model(Meijaard2007ParameterSet({**numbers, "IByy": 11.0, "IHyy": 0.06}, True))
